"""Pages that commands write in a test or for a module have empty figures, unless a test asks that they are drawn.

``tests/roughfilm/pages/test_browser.py`` draws a page of every kind.
"""

from collections.abc import Iterator

import pytest
from empty_figures import empty_figures

from roughfilm.batch import jobs


@pytest.fixture(scope="module", autouse=True)
def _empty() -> Iterator[pytest.MonkeyPatch]:
    with pytest.MonkeyPatch.context() as patch:
        empty_figures(patch)
        yield patch


@pytest.fixture(scope="module", autouse=True)
def _once() -> Iterator[None]:
    """A quick model of a comparison is solved once, as its time is looked at nowhere here."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(jobs, "REPEATS", 1)
        yield


@pytest.fixture
def drawn(_empty: pytest.MonkeyPatch) -> Iterator[None]:
    """Figures of this test are drawn."""
    _empty.undo()
    yield
    empty_figures(_empty)
