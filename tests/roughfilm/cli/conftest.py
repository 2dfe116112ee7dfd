"""Pages that commands write in a test have empty figures.

Fixtures that a module shares draw their figures unless they call ``empty_figures`` too, and
``tests/roughfilm/pages/test_browser.py`` draws a page of every kind.
"""

import pytest
from empty_figures import empty_figures


@pytest.fixture
def drawn():
    """Figures of this test are drawn."""


@pytest.fixture(autouse=True)
def _empty_figures(request, monkeypatch):
    if "drawn" not in request.fixturenames:
        empty_figures(monkeypatch)
