"""Pages without the curves and pictures of their figures, for tests that look at the rest of a page."""

import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG

from roughfilm.rom.ladder.model import Availability

ABSENT = Availability(available=False, detail="left out in a test")
DRAWING = ("roughfilm.cli.first_steps.compare", "roughfilm.figures.spatial.relief")
"""Modules that start a process which draws the flow of a comparison or a surface."""


def empty_figures(patch: pytest.MonkeyPatch) -> None:
    """Write figures empty and draw no pictures, since layout and drawing take most of the time of a page."""
    patch.setattr(FigureCanvasSVG, "print_svg", lambda _self, file, **_: file.write("<svg></svg>"))
    for module in DRAWING:
        patch.setattr(f"{module}.draw_apart", lambda *_: ABSENT)
