"""The liquid in a rough gap, in space: python -m roughfilm.figures.gap_view RESULT.h5 PICTURE.png."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.rendering import scalar_bar, write_picture
from roughfilm.figures.spatial.relief import MAX_POINTS, MAX_SCENE_POINTS, white_plotter
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.store import load

if TYPE_CHECKING:
    import pyvista

WINDOW = (1500, 760)
"""Pixels."""

MIN_HEIGHT = 0.16
"""Smallest height of the gap over its longer side, in the picture."""

MIN_WIDTH = 0.35
"""Smallest width of the picture over its length; a narrower period is repeated."""

LINES = 60
"""Streamlines that start at the inflow."""

SPEED = "speed over the mean along x"

WALL, CONTACT = "#9aa5b1", "#d7301f"


def draw(result: Result, picture: Path) -> None:
    """Draw the lower wall, contact in red, speed in two sections, and streamlines along the gradient. It turns."""
    film = film_of(result)
    plotter, turning = (white_plotter(WINDOW) for _ in range(2))
    _add(plotter, film, most=MAX_POINTS, bar=scalar_bar((0.3, 0.005), (0.4, 0.07), labels=5))
    _add(turning, film, most=MAX_SCENE_POINTS)
    write_picture(plotter, picture, turning)


def _add(
    plotter: "pyvista.Plotter",
    film: "pyvista.StructuredGrid",
    *,
    most: int,
    bar: "pyvista.ScalarBarArgs | None" = None,
) -> None:
    """Show a film whose wall has at most so many points along a side, and look at it from above its corner."""
    import pyvista

    length, _, height = np.ptp(film.points, axis=0)
    low, high = film.points[:, 2].min(), film.points[:, 2].max()
    plotter.add_mesh(lower_wall(film, most), color=WALL, smooth_shading=True, specular=0.2)
    touching = contact_of(film)
    if touching is not None:
        plotter.add_mesh(touching, color=CONTACT)
    open_film = film.threshold(0.5, scalars="kept").cell_data_to_point_data()
    bounds = film.bounds
    look: dict[str, Any] = {"scalars": SPEED, "cmap": "magma", "lighting": False}
    look["clim"] = (0, float(np.percentile(open_film[SPEED], 99.9)))
    for number, (normal, place) in enumerate((("x", bounds[1] - 1e-3 * length), ("y", bounds[3] - 1e-3 * length))):
        origin = [bounds[0], bounds[2], low]
        origin["xy".index(normal)] = place
        section = open_film.slice(normal=normal, origin=origin)
        if section.n_cells:
            barred = number == 0 and bar is not None
            plotter.add_mesh(section, show_scalar_bar=barred, scalar_bar_args=bar if barred else None, **look)
    seeds = pyvista.PolyData(_seeds(film))
    lines = open_film.streamlines_from_source(
        seeds, vectors="velocity", integration_direction="forward", max_length=3 * length
    )
    if lines.n_points:
        plotter.add_mesh(lines, line_width=2.5, show_scalar_bar=False, **look)
    middle = np.array([(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (low + high) / 2 - 1.1 * height])
    away = max(length, bounds[3] - bounds[2])
    plotter.camera_position = [tuple(middle + away * np.array([-0.85, -1.2, 1.15])), tuple(middle), (0, 0, 1)]
    plotter.camera.view_angle = 34.0


def film_of(result: Result) -> "pyvista.StructuredGrid":
    """The film as cells with their velocity, in µm, stretched upward until it can be seen; contact has none."""
    import pyvista

    vertices = result.fields["vertices"].values * 1e6
    velocity, open_cells = result.fields["cell_velocity"].values, result.fields["kept"].values
    length, width = (float(np.ptp(vertices[..., axis])) for axis in range(2))
    repeats = max(1, round(MIN_WIDTH * length / width))
    shifts = [vertices[:, (0 if n == 0 else 1) :] + [0.0, n * width, 0.0] for n in range(repeats)]
    points, flow = np.concatenate(shifts, axis=1), np.tile(velocity, (1, repeats, 1, 1))
    there = np.tile(open_cells, (1, repeats))
    stretch = max(1.0, MIN_HEIGHT * max(length, width * repeats) / float(np.ptp(points[..., 2])))
    grid = pyvista.StructuredGrid(points[..., 0], points[..., 1], points[..., 2] * stretch)
    shown = flow * [1.0, 1.0, stretch]
    grid.cell_data["velocity"] = shown.reshape(-1, 3, order="F")
    grid.cell_data["kept"] = np.repeat(there[..., None], flow.shape[2], axis=2).ravel(order="F")
    size = np.linalg.norm(flow, axis=3)
    mean = flow[..., 0][there > 0].mean() or 1.0
    grid.cell_data[SPEED] = (size / mean).ravel(order="F")
    return grid


def lower_wall(film: "pyvista.StructuredGrid", most: int) -> "pyvista.StructuredGrid":
    """The rough wall alone, with at most so many points along a side."""
    nx, ny, _ = film.dimensions
    step = max(1, -(-max(nx, ny) // most))
    wall: pyvista.StructuredGrid = film.extract_subset(
        (0, nx - 1, 0, ny - 1, 0, 0), rate=(step, step, 1), boundary=True
    )
    return wall


def contact_of(film: "pyvista.StructuredGrid") -> "pyvista.UnstructuredGrid | None":
    """Where the walls touch, as a patch of the upper wall; None if nowhere."""
    nx, ny, nz = film.dimensions
    patch = film.extract_subset((0, nx - 1, 0, ny - 1, nz - 1, nz - 1)).threshold(0.5, scalars="kept", invert=True)
    return patch if patch.n_cells else None


def _seeds(film: "pyvista.StructuredGrid") -> Array:
    """Places at the inflow, in three rows across the gap."""
    nx, ny, nz = film.dimensions
    points = film.points.reshape((nx, ny, nz, 3), order="F")
    rows = np.unique(np.linspace(0, ny - 1, LINES // 3).round().astype(int))
    lower, upper = points[0, rows, 0], points[0, rows, -1]
    inside = np.array([film.bounds[1] - film.bounds[0], 0.0, 0.0]) * 1e-3
    return np.concatenate([lower + part * (upper - lower) + inside for part in (0.25, 0.5, 0.75)])


if __name__ == "__main__":
    draw(load(Path(sys.argv[1])), Path(sys.argv[2]))
