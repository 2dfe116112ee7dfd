"""The vertices of the mesh of a cell in plan: columns that meet both walls at right angles, and layers between them."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.foamcases.pocket.card import layers_of
from roughfilm.foamcases.pocket.plan.mesh.columns import Sides, sides_of
from roughfilm.foamcases.pocket.plan.mesh.coordinates import Coordinates, harmonic
from roughfilm.foamcases.pocket.plan.mesh.hexahedra import upright
from roughfilm.rom.pocket.plan.plan import Plan

LEAN = 1.0
"""Share of the way from a vertical column to a line of constant harmonic coordinates; verification takes 0 as well."""

STRAIGHTENING = 0.7
"""Factor by which the lean of columns is reduced where cells fold, as often as they do."""

LEAST_SHARE = 0.05
"""Share of its lean below which a column becomes vertical."""

LEAST_AREA = 0.1
"""Least ratio of areas in the plane of coordinates and in space in a Newton step."""

SAMPLES_PER_LAYER = 3
"""Number of places for each layer at which a column is followed."""

STEPS = 30
"""Largest number of Newton steps in which a column is followed from one layer to the next."""

FOLLOWED = 1e-10
"""Error of the coordinates at which a column is followed, in film thicknesses."""


def vertices_of(plan: Plan, resolution: int) -> Array:
    """The corners of the cells, shape (nx + 1, ny + 1, layers + 1, 3), in film thicknesses.

    Layers count from the wall at rest to the sliding wall, z = 1, on which the faces of the columns are straight lines
    along x and y. Below it a column follows the line of constant harmonic coordinates, so that it meets both walls at
    right angles. Where cells would fold, at walls that are steep compared with the size of the cells, columns lean
    less. Layers divide the film evenly. The vertices are periodic in both directions; if the plan is mirrored, they are
    symmetric about y = 0.

    Parameters
    ----------
    plan : the gap over the cell.
    resolution : number of columns along x; there are as many per length along y, and a fifth as many layers.
    """
    sides, layers = sides_of(plan, resolution), layers_of(resolution)
    film = plan.film

    def thickness(x: Array, y: Array) -> Array:
        return np.asarray(plan.thickness(x * film, y * film) / film)

    grid = np.stack(np.meshgrid(sides.x, sides.y, indexing="ij"), axis=-1)
    columns = _columns(harmonic(sides.x, sides.y, thickness(grid[..., 0], grid[..., 1])), grid, layers)
    vertical = np.zeros_like(columns)
    vertical[..., 2] = np.linspace(1, 0, layers + 1)
    share = np.full(grid.shape[:2], LEAN)
    while True:
        taken = vertical + share[..., None, None] * (columns - vertical)
        vertices = _periodic(
            np.concatenate([grid[:, :, None] + taken[..., :2], taken[..., 2:]], axis=-1), sides, mirrored=plan.mirrored
        )
        vertices[..., 2] = 1 - vertices[..., 2] * thickness(vertices[..., 0], vertices[..., 1])
        folded: Mask = np.asarray(~upright(vertices).all(axis=2))
        if not folded.any():
            return vertices
        share = _straightened(share, folded)


def _columns(coordinates: Coordinates, grid: Array, layers: int) -> Array:
    """The columns at the layers: displacements along x and y, and s = (1 - z)/h; shape (nx + 1, ny + 1, layers + 1, 3).

    A column is followed from the sliding wall down at more places than there are layers, and divided evenly in ζ by
    linear interpolation between them.
    """
    target, places = grid + coordinates.displacement(0.0), grid
    samples = np.linspace(0, 1, SAMPLES_PER_LAYER * layers + 1)
    found, heights = np.zeros((*grid.shape[:2], samples.size, 3)), np.ones((*grid.shape[:2], samples.size))
    for number, s in enumerate(samples[1:], 1):
        places = _followed(coordinates, s, target, places)
        found[:, :, number, :2], found[:, :, number, 2] = places - grid, s
        heights[:, :, number] = _bilinear(coordinates, coordinates.height(s), places)[0][..., 0]
    heights = np.minimum.accumulate(heights, axis=2)
    heights[:, :, -1] = 0
    columns = np.zeros((*grid.shape[:2], layers + 1, 3))
    columns[:, :, 0] = found[:, :, -1]
    for layer in range(1, layers):
        height = layer / layers
        above = np.clip((heights > height).sum(axis=2) - 1, 0, samples.size - 2)[..., None]
        high, low = (np.take_along_axis(heights, above + step, axis=2) for step in (0, 1))
        part = np.divide(high - height, high - low, out=np.zeros_like(high), where=high > low)
        upper, lower = (np.take_along_axis(found, (above + step)[..., None], axis=2)[:, :, 0] for step in (0, 1))
        columns[:, :, layer] = upper + part * (lower - upper)
    return columns


def _straightened(share: Array, folded: Mask) -> Array:
    """The share of their lean that columns keep, less at the corners of folded cells and beside them."""
    corners = np.zeros(folded.shape, dtype=bool)
    for shift in ((0, 0), (1, 0), (0, 1), (1, 1)):
        corners |= np.roll(folded, shift, axis=(0, 1))
    kept = np.where(corners, STRAIGHTENING * share[:-1, :-1], share[:-1, :-1])
    kept[kept < LEAST_SHARE] = 0
    for axis in range(2):
        kept = np.minimum(kept, (np.roll(kept, 1, axis) + 2 * kept + np.roll(kept, -1, axis)) / 4)
    return np.pad(kept, ((0, 1), (0, 1)), mode="wrap")


def _followed(coordinates: Coordinates, s: float, target: Array, places: Array) -> Array:
    """The positions at s with the coordinates ``target``, by Newton's method from those of the layer above."""
    displacement = coordinates.displacement(s)
    for _ in range(STEPS):
        value, slopes = _bilinear(coordinates, displacement, places)
        missing = target - places - value
        if np.abs(missing).max() < FOLLOWED:
            break
        (xx, xy), (yx, yy) = (1 + slopes[..., 0, 0], slopes[..., 0, 1]), (slopes[..., 1, 0], 1 + slopes[..., 1, 1])
        area = np.maximum(xx * yy - xy * yx, LEAST_AREA)
        ahead, aside = missing[..., 0], missing[..., 1]
        places = places + np.stack([yy * ahead - xy * aside, xx * aside - yx * ahead], axis=-1) / area[..., None]
    return places


def _bilinear(coordinates: Coordinates, values: Array, places: Array) -> tuple[Array, Array]:
    """Periodic nodal values (nx + 1, ny + 1, 2) at places (..., 2): the values, and their slopes (..., 2, 2)."""
    indices, fractions, steps = [], [], []
    for axis, nodes in enumerate((coordinates.x, coordinates.y)):
        within = nodes[0] + (places[..., axis] - nodes[0]) % (nodes[-1] - nodes[0])
        index = np.clip(np.searchsorted(nodes, within, side="right") - 1, 0, nodes.size - 2)
        step = nodes[index + 1] - nodes[index]
        indices.append(index)
        steps.append(step[..., None])
        fractions.append(((within - nodes[index]) / step)[..., None])
    (i, j), (a, b) = indices, fractions
    start, along, across = values[i, j], values[i + 1, j], values[i, j + 1]
    both = values[i + 1, j + 1] - along - across + start
    found = start + a * (along - start) + b * (across - start) + a * b * both
    slopes = np.stack([(along - start + b * both) / steps[0], (across - start + a * both) / steps[1]], axis=-1)
    return found, slopes


def _periodic(places: Array, sides: Sides, *, mirrored: bool) -> Array:
    """Positions, (nx + 1, ny + 1, ..., 3), with exact copies at the ends of the period; symmetric if ``mirrored``."""
    length, breadth = (side[-1] - side[0] for side in (sides.x, sides.y))
    if mirrored:
        places = (places + places[:, ::-1] * np.array([1, -1, 1])) / 2
        for row in (0, places.shape[1] // 2):
            places[:, row, ..., 1] = sides.y[row]
    places[-1], places[:, -1] = places[0] + [length, 0, 0], places[:, 0] + [0, breadth, 0]
    places[-1, -1] = places[0, 0] + [length, breadth, 0]
    return places
