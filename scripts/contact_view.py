"""A surface in space under a few loads, by pyvista: python -m scripts.contact_view C.h5 PICTURE.png LOAD ..."""

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from contact.files import replacing
from contact.mechanics.contact import Contact
from contact.mechanics.contact_store import load_contact

MOST_POINTS = 256
"""Along a side; finer surfaces are drawn by every second, third ... point."""

PANEL = (760, 560)
"""Pixels."""

RELIEF = 0.2
"""Height of the undeformed surface over its longer side, in the picture."""

CONTACT = "#d7301f"


def draw(contacts: Sequence[Contact], picture: Path) -> None:
    """Draw one PNG: the surface under each load, seen from the counter body; colour is the gap, contact is red."""
    import pyvista

    columns = min(2, len(contacts))
    lines = -(-len(contacts) // columns)
    plotter = pyvista.Plotter(
        off_screen=True,
        shape=(lines, columns),
        border=False,
        window_size=[PANEL[0] * columns, PANEL[1] * lines],
    )
    plotter.background_color = "white"  # type: ignore[assignment]
    first = contacts[0]
    nx, ny = first.heights.shape
    length, width = nx * first.spacing[0], ny * first.spacing[1]
    stretch = RELIEF * max(length, width) / (float(np.ptp(first.heights)) or 1.0)
    top = max(float(np.percentile(contact.gap, 99.5)) for contact in contacts) * 1e6 or 1.0
    step = max(1, -(-max(nx, ny) // MOST_POINTS))
    for number, contact in enumerate(contacts):
        plotter.subplot(number // columns, number % columns)
        x, y = (np.arange(n)[::step] * d for n, d in zip((nx, ny), first.spacing, strict=True))
        gap = contact.gap[::step, ::step]
        height = -gap * stretch
        grid = pyvista.StructuredGrid(*(axis[..., None] for axis in (*np.meshgrid(x, y, indexing="ij"), height)))
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
                "title": "gap, µm (red: contact)",
                "n_labels": 4,
                "fmt": "%.2f",
                "color": "#222222",
                "title_font_size": 18,
                "label_font_size": 16,
                "position_x": 0.25,
                "position_y": 0.01,
                "width": 0.5,
                "height": 0.06,
            },
        )
        plotter.add_text(
            f"{contact.load / 1e6:.4g} MPa, {100 * contact.area_fraction:.1f} % contact",
            position=(20, PANEL[1] - 44),
            font_size=12,
            color="#222222",
        )
        middle = (length / 2, width / 2, -RELIEF / 2 * max(length, width))
        away = max(length, width)
        plotter.camera_position = [
            (middle[0] - 0.75 * away, middle[1] - 1.15 * away, middle[2] + 1.15 * away),
            (middle[0], middle[1], middle[2] - 0.1 * away),
            (0, 0, 1),
        ]
        plotter.camera.view_angle = 34.0
    with replacing(picture) as scratch:
        plotter.screenshot(str(scratch))


if __name__ == "__main__":
    draw([load_contact(Path(sys.argv[1]), float(load)) for load in sys.argv[3:]], Path(sys.argv[2]))
