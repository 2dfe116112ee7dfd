"""Pages that commands write in a test have empty figures, since layout and drawing take most of the time of a page.

Fixtures that a module shares draw theirs, and ``tests/roughfilm/pages/test_browser.py`` draws a page of every kind.
"""

import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG


@pytest.fixture
def drawn():
    """Figures of this test are drawn."""


@pytest.fixture(autouse=True)
def _empty_figures(request, monkeypatch):
    if "drawn" not in request.fixturenames:
        monkeypatch.setattr(FigureCanvasSVG, "print_svg", lambda _self, file, **_: file.write("<svg></svg>"))
