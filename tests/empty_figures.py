"""Pages without the curves of their figures, for tests that look at the rest of a page."""

import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG


def empty_figures(patch: pytest.MonkeyPatch) -> None:
    """Write figures empty, since layout and drawing take most of the time of a page."""
    patch.setattr(FigureCanvasSVG, "print_svg", lambda _self, file, **_: file.write("<svg></svg>"))
