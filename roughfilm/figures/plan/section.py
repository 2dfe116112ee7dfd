"""Streamlines and speed in the plane along the sliding through the middle of a dimple."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.plan.places import between, edges_on, middle_line
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.scene import Pocket

MARGIN = 0.35
"""Length of film that is shown on each side of the dimples, over the length between their outer edges."""

POINTS = (300, 120)
"""Points of the even grid along the section and over its height on which streamlines are followed."""


def section(scene: Pocket, result: Result) -> str:
    """The speed over the sliding speed, and streamlines, in the plane through the middle of the deepest dimple.

    The streamlines are those of the velocity in the plane. In a plane of symmetry they are those of the flow.
    """
    x, z, velocity = in_section(scene, result)
    edges = edges_on(scene, middle_line(scene)) or (x[0], x[-1])
    margin = MARGIN * (edges[-1] - edges[0])
    inside = (x > edges[0] - margin) & (x < edges[-1] + margin)
    x, z, velocity = x[inside] * 1e6, z[inside] * 1e6, velocity[inside] / scene.speed
    figure, axes = new_figure((10, 3.6))
    speed = np.linalg.norm(velocity, axis=-1)
    image = axes.pcolormesh(
        np.broadcast_to(x[:, None], z.shape), z, speed, shading="gouraud", cmap="viridis", vmin=0, rasterized=True
    )
    along, up, u, w = even(x, z, velocity)
    axes.streamplot(along, up, u.T, w.T, color="white", linewidth=0.8, arrowsize=0.8, density=(1.6, 0.9))
    axes.fill_between(x, z[:, 0], up[0], color="#c9ced4", linewidth=0)
    axes.grid(visible=False)
    axes.set(xlim=(x[0], x[-1]), ylim=(up[0], up[-1]), xlabel="position x along the sliding, µm", ylabel="height z, µm")
    figure.colorbar(image, ax=axes, label="speed over sliding speed")
    return svg(figure)


def in_section(scene: Pocket, result: Result) -> tuple[Array, Array, Array]:
    """The velocity in the section through the middle of a dimple, with the walls; lengths in m.

    Returns
    -------
    x : positions of the columns along the sliding, shape (nx,).
    z : heights of the middles of the cells and of both walls, shape (nx, nz + 2).
    velocity : velocity along x and z there, m/s, shape (nx, nz + 2, 2).
    """
    line, breadth = middle_line(scene), scene.plan().breadth
    vertices, cells = result.fields["vertices"].values[:, :-1], result.fields["cell_velocity"].values
    rows = vertices[0, :, -1, 1]
    edges = between(rows, vertices, line, breadth)
    faces = (edges[:-1] + edges[1:]) / 2
    flow = between((rows + np.append(rows[1:], breadth / 2)) / 2, cells, line, breadth)[..., [0, 2]]
    heights = np.concatenate([faces[:, :1, 2], (faces[:, 1:, 2] + faces[:, :-1, 2]) / 2, faces[:, -1:, 2]], axis=1)
    walls = np.zeros((len(flow), 1, 2)), np.tile([scene.speed, 0.0], (len(flow), 1, 1))
    return faces[:, -1, 0], heights, np.concatenate([walls[0], flow, walls[1]], axis=1)


def even(x: Array, z: Array, velocity: Array) -> tuple[Array, Array, Array, Array]:
    """The places of an even grid over a section, and the velocity there; not a number below the wall."""
    along, up = np.linspace(x[0], x[-1], POINTS[0]), np.linspace(z.min(), z.max(), POINTS[1])
    found = np.full((*POINTS, 2), np.nan)
    for number, place in enumerate(along):
        right = int(np.clip(np.searchsorted(x, place), 1, x.size - 1))
        part = (place - x[right - 1]) / (x[right] - x[right - 1])
        heights = (1 - part) * z[right - 1] + part * z[right]
        there = (1 - part) * velocity[right - 1] + part * velocity[right]
        open_ = up >= heights[0]
        for axis in range(2):
            found[number, open_, axis] = np.interp(up[open_], heights, there[:, axis])
    return along, up, found[..., 0], found[..., 1]
