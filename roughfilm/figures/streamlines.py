"""Streamlines and speed over grooves or dimples: python -m roughfilm.figures.streamlines RESULT.h5 PICTURE.png."""

import sys
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.rendering import scalar_bar, write_picture
from roughfilm.figures.spatial.dimples import draw as draw_dimples
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.store import load

SIDE_MARGIN = 0.35
"""Length of film that is shown on each side of the grooves, over the length of the grooves."""

MIN_DEPTH = 1e-3
"""Smallest depth of a groove that is shown, over that of the deepest."""

WINDOW = (1500, 500)
"""Pixels."""

HEIGHT_TO_WIDTH = 0.22
"""Height of the stretched film over its width, in the picture."""


def stream_function(vertices: Array, velocity: Array, *, periodic: bool = True) -> Array:
    """ψ = ∫ (u dy - v dx) along the columns from the still wall, at the vertices; shape (nx + 1, ny + 1), m²/s.

    Second order; the mean of the two neighbouring columns at each vertex, and at an end the column beside it.

    Parameters
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, 2), m.
    velocity : velocity in the cells, shape (nx, ny, 2), m/s.
    periodic : whether the last column is the first one a period later; otherwise the film has two ends.
    """
    across = np.diff(vertices, axis=1)
    layers = (across[1:] + across[:-1]) / 2
    rise = velocity[..., 0] * layers[..., 1] - velocity[..., 1] * layers[..., 0]
    columns = np.pad(np.cumsum(rise, axis=1), ((0, 0), (1, 0)))
    before, behind = (columns[-1:], columns[:1]) if periodic else (columns[:1], columns[-1:])
    around = np.concatenate([before, columns, behind])
    return np.asarray((around[1:] + around[:-1]) / 2)


def shown(vertices: Array) -> slice:
    """The columns of vertices that a picture shows: all grooves, with a margin on both sides."""
    x, lower = vertices[:, 0, 0], vertices[:, 0, 1]
    depth = lower.max() - lower
    grooved = np.flatnonzero(depth > MIN_DEPTH * depth.max())
    left, right = x[grooved[0]], x[grooved[-1]]
    margin = SIDE_MARGIN * (right - left)
    inside = np.flatnonzero((x >= left - margin) & (x <= right + margin))
    return slice(int(inside[0]), int(inside[-1]) + 1)


def draw(result: Result, picture: Path) -> None:
    """Draw one PNG: colour is speed relative to the sliding wall's, lines are streamlines. Dimples are in space."""
    import pyvista

    vertices = result.fields["vertices"].values
    if vertices.shape[-1] == 3:
        draw_dimples(result, picture)
        return
    velocity = result.fields["cell_velocity"].values
    sliding_speed = float(np.abs(velocity[:, -1, 0]).max())
    x, y = vertices[..., 0] * 1e6, vertices[..., 1] * 1e6
    periodic = result.provenance["scene"]["kind"] == "pocket"
    window = shown(vertices) if periodic else slice(0, vertices.shape[0])
    left, right = x[window.start, 0], x[window.stop - 1, 0]
    width, height = right - left, y.max() - y.min()
    stretch = max(1.0, HEIGHT_TO_WIDTH * width / height)

    grid = pyvista.StructuredGrid(x[window, :, None], y[window, :, None] * stretch, np.zeros_like(x[window, :, None]))
    speed = np.linalg.norm(velocity, axis=2)[window.start : window.stop - 1]
    grid.cell_data["speed"] = (speed / sliding_speed).ravel(order="F")
    psi = stream_function(vertices, velocity, periodic=periodic)[window]
    psi *= np.sign(psi[:, -1].mean())
    grid.point_data["psi"] = psi.ravel(order="F")
    flow = psi[:, -1].mean()
    levels = [*(np.linspace(0, 1, 15)[1:-1] ** 1.5 * flow)]
    if psi.min() < -1e-5 * flow:
        levels += [*np.linspace(psi.min(), 0, 6)[1:]]
    if "kept" in result.fields:
        grid.cell_data["kept"] = result.fields["kept"].values.ravel(order="F")
        grid = grid.threshold(0.5, scalars="kept")
    lines = grid.contour(sorted(levels), scalars="psi")

    plotter = pyvista.Plotter(off_screen=True, window_size=list(WINDOW))
    plotter.background_color = "white"  # type: ignore[assignment]
    plotter.add_mesh(
        grid.cell_data_to_point_data(),
        scalars="speed",
        cmap="viridis",
        clim=(0, 1),
        lighting=False,
        scalar_bar_args=scalar_bar((0.3, 0.02), (0.4, 0.09), labels=6, size=22),
    )
    plotter.add_mesh(lines, color="white", line_width=2)
    plotter.add_mesh(grid.extract_feature_edges(), color="#222222", line_width=2)
    plotter.view_xy()  # type: ignore[call-arg]
    plotter.camera.parallel_projection = True
    plotter.camera.focal_point = (
        (left + right) / 2,
        (y.max() + y.min()) / 2 * stretch - 0.035 * width,
        0,
    )
    plotter.camera.parallel_scale = width / WINDOW[0] * WINDOW[1] / 2 * 1.04
    write_picture(plotter, picture)


if __name__ == "__main__":
    draw(load(Path(sys.argv[1])), Path(sys.argv[2]))
