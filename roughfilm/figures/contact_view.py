"""A surface in space under a few loads, by pyvista: python -m roughfilm.figures.contact_view VIEWS.npz PICTURE.png."""

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.mechanics.gap_map import GapMap
from roughfilm.figures.rendering import draw_apart, embedded
from roughfilm.rom.ladder.model import Availability

PANEL = (760, 560)
"""Pixels."""

RELIEF = 0.2
"""Height of the undeformed surface over its longer side, in the picture."""

CONTACT = "#d7301f"


def draw_views_apart(views: Sequence[GapMap], picture: Path) -> Availability:
    """Draw one PNG, in a process of its own; says why where it fails."""
    first = views[0]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "views.npz"
        np.savez(
            file,
            gaps=np.array([view.gap for view in views]),
            titles=np.array([f"{view.load / 1e6:.4g} MPa, {100 * view.area_fraction:.3g} % contact" for view in views]),
            spacing=np.array(first.spacing),
            relief=first.relief,
        )
        return draw_apart("roughfilm.figures.contact_view", file, picture)


def view_picture(views: Sequence[GapMap]) -> tuple[str | None, str]:
    """The picture as the text of an image's address, or why there is none."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "contacts.png"
        drawn = draw_views_apart(views, path)
        return (embedded(path), "") if drawn.available else (None, drawn.detail)


def draw(file: Path, picture: Path) -> None:
    """The surface under each load, seen from the counter body; colour is the gap, contact is red."""
    import pyvista

    with np.load(file) as held:
        gaps, titles = held["gaps"], [str(title) for title in held["titles"]]
        (dx, dy), relief = held["spacing"], float(held["relief"])
    columns = len(gaps) if len(gaps) <= 3 else 2
    lines = -(-len(gaps) // columns)
    plotter = pyvista.Plotter(
        off_screen=True,
        shape=(lines, columns),
        border=False,
        window_size=[PANEL[0] * columns, PANEL[1] * lines],
    )
    plotter.background_color = "white"  # type: ignore[assignment]
    nx, ny = gaps.shape[1:]
    length, width = nx * dx, ny * dy
    away = max(length, width)
    stretch = RELIEF * away / relief
    top = max(float(np.percentile(gap, 99.5)) for gap in gaps) * 1e6 or 1.0
    x, y = np.meshgrid(np.arange(nx) * dx, np.arange(ny) * dy, indexing="ij")
    for number, (gap, title) in enumerate(zip(gaps, titles, strict=True)):
        plotter.subplot(number // columns, number % columns)
        grid = pyvista.StructuredGrid(*(axis[..., None] for axis in (x, y, -gap * stretch)))
        grid.point_data["gap, µm"] = np.where(gap > 0, gap * 1e6, -1.0).ravel(order="F")
        plotter.add_mesh(
            grid,
            scalars="gap, µm",
            cmap="YlGnBu",
            clim=(0, top),
            below_color=CONTACT,
            smooth_shading=True,
            specular=0.3,
            show_scalar_bar=number == 0,
            scalar_bar_args={
                "title": "",
                "n_labels": 4,
                "fmt": "%.2f",
                "color": "#222222",
                "label_font_size": 16,
                "position_x": 0.25,
                "position_y": 0.01,
                "width": 0.5,
                "height": 0.06,
            },
        )
        plotter.add_text(title, position=(20, PANEL[1] - 44), font_size=12, color="#222222")
        middle = (length / 2, width / 2, -RELIEF / 2 * away)
        plotter.camera_position = [
            (middle[0] - 0.75 * away, middle[1] - 1.15 * away, middle[2] + 1.15 * away),
            (middle[0], middle[1], middle[2] - 0.1 * away),
            (0, 0, 1),
        ]
        plotter.camera.view_angle = 34.0
    with replacing(picture) as scratch:
        plotter.screenshot(str(scratch))


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
