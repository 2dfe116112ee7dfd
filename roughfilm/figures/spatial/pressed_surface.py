"""A surface in space under loads, by pyvista: python -m roughfilm.figures.spatial.pressed_surface VIEWS.npz OUT.png."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.mechanics.gap_map import GapMap
from roughfilm.figures.rendering import draw_apart, embedded, scalar_bar, write_picture
from roughfilm.figures.spatial.relief import MAX_POINTS, MAX_SCENE_POINTS, add_relief, white_plotter

PANEL = (760, 560)
"""Pixels."""

CONTACT = "#d7301f"


def view_picture(views: Sequence[GapMap]) -> tuple[str | None, str]:
    """The address of an image that holds the picture, drawn in a process of its own, or None and the reason."""
    first = views[0]
    with scratch_directory() as folder:
        file, picture = folder / "views.npz", folder / "contacts.png"
        np.savez(
            file,
            gaps=np.array([view.gap for view in views]),
            titles=np.array([f"{view.load / 1e6:.4g} MPa, {100 * view.area_fraction:.3g} % contact" for view in views]),
            spacing=np.array(first.spacing),
            relief=first.relief,
        )
        drawn = draw_apart("roughfilm.figures.spatial.pressed_surface", file, picture)
        return (embedded(picture), "") if drawn.available else (None, drawn.detail)


def draw(file: Path, picture: Path) -> None:
    """Draw the surface under each load from the counter body; colour is the gap, contact is red. The last one turns."""
    with np.load(file) as held:
        gaps, titles = held["gaps"], [str(title) for title in held["titles"]]
        spacing, relief = held["spacing"], float(held["relief"])
    columns = len(gaps) if len(gaps) <= 3 else 2
    lines = -(-len(gaps) // columns)
    plotter = white_plotter((PANEL[0] * columns, PANEL[1] * lines), shape=(lines, columns), border=False)
    turning = white_plotter(PANEL)
    top = max(float(np.percentile(gap, 99.5)) for gap in gaps) * 1e6 or 1.0
    look: dict[str, Any] = {"name": "gap, µm", "cmap": "YlGnBu", "clim": (0, top), "below_color": CONTACT}
    colours = [np.where(gap > 0, gap * 1e6, -1.0) for gap in gaps]
    bar = scalar_bar((0.25, 0.01), (0.5, 0.06), labels=4, digits=2, size=16)
    for number, (gap, colour, title) in enumerate(zip(gaps, colours, titles, strict=True)):
        plotter.subplot(number // columns, number % columns)
        first = bar if number == 0 else None
        add_relief(plotter, -gap, colour, spacing, relief, most=MAX_POINTS, bar=first, **look)
        plotter.add_text(title, position=(20, PANEL[1] - 44), font_size=12, color="#222222")
    add_relief(turning, -gaps[-1], colours[-1], spacing, relief, most=MAX_SCENE_POINTS, **look)
    write_picture(plotter, picture, turning)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
