"""A surface in space, by pyvista: python -m roughfilm.figures.spatial.relief SURFACE.npz PICTURE.png."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.rendering import draw_apart, embedded, scalar_bar, write_picture

if TYPE_CHECKING:
    import pyvista

WINDOW = (1300, 640)
"""Pixels."""

RELIEF = 0.2
"""Height of a surface over its longer side, in the picture."""

MAX_POINTS, MAX_SCENE_POINTS = 512, 160
"""Largest number of points along a side in a picture and in a scene, which is then below half a megabyte."""


def surface_picture(surface: Surface) -> tuple[str | None, str]:
    """The address of an image that holds the picture, drawn in a process of its own, or None and the reason."""
    with scratch_directory() as folder:
        file, picture = folder / "surface.npz", folder / "surface.png"
        np.savez(file, heights=surface.heights, spacing=np.array(surface.spacing))
        drawn = draw_apart("roughfilm.figures.spatial.relief", file, picture)
        return (embedded(picture), "") if drawn.available else (None, drawn.detail)


def draw(file: Path, picture: Path) -> None:
    """Draw the surface from above its corner; colour is the height. It turns."""
    with np.load(file) as held:
        heights, spacing = held["heights"], held["spacing"]
    limits = tuple(np.percentile(heights, [0.1, 99.9]) * 1e6)
    look: dict[str, Any] = {"name": "height, µm", "cmap": "cividis", "clim": limits}
    bar = scalar_bar((0.3, 0.01), (0.4, 0.06), labels=5, digits=2, size=16)
    plotter, turning = (white_plotter(WINDOW) for _ in range(2))
    relief = float(np.ptp(heights)) or 1.0
    add_relief(plotter, heights, heights * 1e6, spacing, relief, most=MAX_POINTS, bar=bar, **look)
    add_relief(turning, heights, heights * 1e6, spacing, relief, most=MAX_SCENE_POINTS, **look)
    write_picture(plotter, picture, turning)


def white_plotter(window: tuple[int, int], **options: Any) -> "pyvista.Plotter":
    """A plotter for a picture of so many pixels."""
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=list(window), **options)
    plotter.background_color = "white"  # type: ignore[assignment]
    return plotter


def add_relief(
    plotter: "pyvista.Plotter",
    heights: Array,
    scalars: Array,
    spacing: Array,
    relief: float,
    *,
    most: int,
    name: str,
    bar: "pyvista.ScalarBarArgs | None" = None,
    **look: Any,
) -> None:
    """Show a surface from above its corner, with the colours of ``scalars`` and at most so many points along a side.

    Parameters
    ----------
    heights, scalars : shape (nx, ny); heights in m.
    spacing : (dx, dy), m.
    relief : the height that is drawn as ``RELIEF`` of the longer side, m.
    most : largest number of points along a side.
    name : of the scalars.
    bar : options of the colour bar, None for no bar.
    look : options of ``pyvista.Plotter.add_mesh``.
    """
    import pyvista

    step = max(1, -(-max(heights.shape) // most))
    (nx, ny), (dx, dy) = heights.shape, spacing
    away = max(nx * dx, ny * dy)
    x, y = np.meshgrid(np.arange(nx)[::step] * dx, np.arange(ny)[::step] * dy, indexing="ij")
    z = heights[::step, ::step] * (RELIEF * away / relief)
    grid = pyvista.StructuredGrid(*(axis[..., None] for axis in (x, y, z)))
    grid.point_data[name] = scalars[::step, ::step].ravel(order="F")
    plotter.add_mesh(
        grid,
        scalars=name,
        smooth_shading=True,
        specular=0.3,
        show_scalar_bar=bar is not None,
        scalar_bar_args=bar,
        **look,
    )
    middle = (nx * dx / 2, ny * dy / 2, z.max() - RELIEF / 2 * away)
    plotter.camera_position = [
        (middle[0] - 0.75 * away, middle[1] - 1.15 * away, middle[2] + 1.15 * away),
        (middle[0], middle[1], middle[2] - 0.1 * away),
        (0, 0, 1),
    ]
    plotter.camera.view_angle = 38.0


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
