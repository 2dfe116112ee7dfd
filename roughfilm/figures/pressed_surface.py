"""A surface in space under loads, by pyvista: python -m roughfilm.figures.pressed_surface VIEWS.npz PICTURE.png."""

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import PICTURE
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.mechanics.gap_map import GapMap
from roughfilm.figures.rendering import draw_apart, embedded, scalar_bar

PANEL = (760, 560)
"""Pixels."""

RELIEF = 0.2
"""Height of the undeformed surface over its longer side, in the picture."""

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
        drawn = draw_apart("roughfilm.figures.pressed_surface", file, picture)
        return (embedded(picture), "") if drawn.available else (None, drawn.detail)


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
            scalar_bar_args=scalar_bar((0.25, 0.01), (0.5, 0.06), labels=4, digits=2, size=16),
        )
        plotter.add_text(title, position=(20, PANEL[1] - 44), font_size=12, color="#222222")
        middle = (length / 2, width / 2, -RELIEF / 2 * away)
        plotter.camera_position = [
            (middle[0] - 0.75 * away, middle[1] - 1.15 * away, middle[2] + 1.15 * away),
            (middle[0], middle[1], middle[2] - 0.1 * away),
            (0, 0, 1),
        ]
        plotter.camera.view_angle = 34.0
    with replacing(picture, PICTURE) as scratch:
        plotter.screenshot(str(scratch))


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
