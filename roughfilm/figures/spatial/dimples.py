"""The flow over a dimple in space, by pyvista: python -m roughfilm.figures.streamlines RESULT.h5 PICTURE.png."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.plan.places import deepest_dimple, middle_line
from roughfilm.figures.rendering import scalar_bar, write_picture
from roughfilm.figures.spatial.relief import white_plotter
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.scene import Pocket

if TYPE_CHECKING:
    import pyvista

WINDOW = (1500, 760)
"""Pixels."""

MARGIN = 1.0
"""Film that is shown on each side of the dimple, over half of its extent."""

HEIGHT = 0.24
"""Height of the film with the dimple over the longer side of the picture; smaller ones are stretched."""

RIM = 0.03
"""Depth of the line that shows the rim of a dimple, over its greatest depth."""

FASTEST = 0.5
"""Largest speed of the colours of streamlines, over the sliding speed; those that start below mid-film are slower."""

PRESSURE, SPEED = "pressure on the sliding wall, kPa", "speed over sliding speed"

WALL = "#b9c2cc"


def draw(result: Result, picture: Path) -> None:
    """Draw the wall with the deepest dimple, streamlines over it, and the pressure on the rear of the sliding wall."""
    scene = read_scene(result.provenance["scene"])
    assert isinstance(scene, Pocket)
    film = film_around(scene, result)
    plotter, turning = (white_plotter(WINDOW) for _ in range(2))
    _add(plotter, scene, film, barred=True)
    _add(turning, scene, film, barred=False)
    write_picture(plotter, picture, turning)


def film_around(scene: Pocket, result: Result) -> "pyvista.StructuredGrid":
    """The cells around the deepest dimple, in µm, stretched upward until the film can be seen, with their velocity."""
    import pyvista

    vertices = result.fields["vertices"].values * 1e6
    first, last = _window(scene, vertices)
    shown = vertices[first[0] : last[0] + 1, first[1] : last[1] + 1]
    cells = slice(first[0], last[0]), slice(first[1], last[1])
    sides, height = np.ptp(shown[..., :2], axis=(0, 1, 2)).max(), np.ptp(shown[..., 2])
    stretch = max(1.0, HEIGHT * sides / height)
    grid = pyvista.StructuredGrid(shown[..., 0], shown[..., 1], shown[..., 2] * stretch)
    velocity = result.fields["cell_velocity"].values[cells]
    grid.cell_data["velocity"] = (velocity * [1.0, 1.0, stretch]).reshape(-1, 3, order="F")
    grid.cell_data[SPEED] = (np.linalg.norm(velocity, axis=-1) / scene.speed).ravel(order="F")
    on_wall = result.fields["pressure"].values[cells] * 1e-3
    grid.cell_data[PRESSURE] = np.repeat(on_wall[..., None], velocity.shape[2], axis=2).ravel(order="F")
    return grid


def _window(scene: Pocket, vertices: Array) -> tuple[tuple[int, int], tuple[int, int]]:
    """The first and the last numbers of the vertices along x and y around the deepest dimple, in the cell."""
    dimple, x, y = deepest_dimple(scene)
    first, last = [], []
    for axis, (middle, half) in enumerate(zip((x, y), dimple.half_spans, strict=True)):
        faces = (vertices[:, 0, -1, 0], vertices[0, :, -1, 1])[axis]
        reach = (1 + MARGIN) * half * 1e6
        inside = np.flatnonzero((faces >= middle * 1e6 - reach) & (faces <= middle * 1e6 + reach))
        first.append(int(inside[0]))
        last.append(int(inside[-1]))
    return (first[0], first[1]), (last[0], last[1])


def _add(plotter: "pyvista.Plotter", scene: Pocket, film: "pyvista.StructuredGrid", *, barred: bool) -> None:
    """Show the film from before the sliding wall, above the corner at the inlet."""
    nx, ny, nz = film.dimensions
    line = middle_line(scene) * 1e6
    points = film.points.reshape((nx, ny, nz, 3), order="F")
    middle = int(np.argmin(np.abs(points[0, :, -1, 1] - line)))
    wall = film.extract_subset((0, nx - 1, 0, ny - 1, 0, 0))
    plotter.add_mesh(wall, color=WALL, smooth_shading=True, specular=0.2)
    land, floor = wall.bounds[5], wall.bounds[4]
    rim = wall.extract_surface(algorithm=None).elevation().contour([land - RIM * (land - floor)], scalars="Elevation")
    plotter.add_mesh(rim, color="#222222", line_width=2)
    sliding = film.extract_subset((0, nx - 1, middle, ny - 1, nz - 1, nz - 1))
    limit = float(f"{np.abs(film[PRESSURE]).max():.2g}")
    look: dict[str, Any] = {"cmap": "RdBu_r", "clim": (-limit, limit), "opacity": 0.75, "lighting": False}
    places = {PRESSURE: ((0.06, 0.01), 5, 0 if limit >= 20 else 2), SPEED: ((0.54, 0.01), 6, 1)}
    bars: dict[str, Any] = {
        name: {**scalar_bar(place, (0.4, 0.07), labels=labels, digits=digits), "title": name}
        for name, (place, labels, digits) in places.items()
    }
    plotter.add_mesh(
        sliding.cell_data_to_point_data(),
        scalars=PRESSURE,
        show_scalar_bar=barred,
        scalar_bar_args=bars[PRESSURE] if barred else None,
        **look,
    )
    plotter.add_mesh(
        _streamlines(film, points, middle),
        scalars=SPEED,
        cmap="viridis",
        clim=(0, FASTEST),
        line_width=2.5,
        lighting=False,
        show_scalar_bar=barred,
        scalar_bar_args=bars[SPEED] if barred else None,
    )
    bounds = np.array(film.bounds).reshape(3, 2)
    centre, away = bounds.mean(axis=1), float(np.ptp(bounds, axis=1).max())
    centre[2] -= 0.15 * away
    plotter.camera_position = [tuple(centre + away * np.array([-0.5, -1.18, 0.8])), tuple(centre), (0, 0, 1)]
    plotter.camera.view_angle = 36.0


def _streamlines(film: "pyvista.StructuredGrid", points: Array, middle: int) -> "pyvista.PolyData":
    """The streamlines from the inflow, and those through places in the dimple."""
    import pyvista

    flow, look = film.cell_data_to_point_data(), {"vectors": "velocity", "compute_vorticity": False}
    over = flow.streamlines_from_source(
        pyvista.PolyData(_upstream(points, middle)), integration_direction="forward", max_length=2 * film.length, **look
    )
    inside = flow.streamlines_from_source(
        pyvista.PolyData(_in_dimple(points, middle)), integration_direction="both", max_length=0.7 * film.length, **look
    )
    lines: pyvista.PolyData = over + inside
    return lines


def _upstream(points: Array, middle: int) -> Array:
    """Places at the inflow from the front to the plane through the dimple, at two heights."""
    rows = np.unique(np.linspace(0, middle, 10).round().astype(int))
    low, high = points[0, rows, 0], points[0, rows, -1]
    inside = np.array([np.ptp(points[..., 0]) * 1e-3, 0.0, 0.0])
    return np.concatenate([low + part * (high - low) + inside for part in (0.15, 0.45)])


def _in_dimple(points: Array, middle: int) -> Array:
    """Places in the dimple, at a few heights below the land, in the plane through it and beside it."""
    land = points[..., 0, 2].max()
    low = points[:, :, 0]
    deepest = int(np.argmin(low[:, middle, 2]))
    half = np.count_nonzero(low[deepest, : middle + 1, 2] < land - 0.05 * (land - low[..., 2].min()))
    rows = np.unique(middle - np.array([0.0, 0.35, 0.7]) * half).round().astype(int)
    parts = np.linspace(0.2, 0.8, 3)
    floor = low[deepest, rows]
    return np.concatenate([floor + part * np.array([0.0, 0.0, 1.0]) * (land - floor[:, 2:]) for part in parts])
