"""Triangles with curved sides that fit a gap with grooves, finer near the corners of the wall."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree
from skfem import MeshTri1, MeshTri2

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.coverage.finite_elements.wall import Groove, Indices, Wall

CORNER_CELL = 0.25
"""Length of a cell at a corner of the wall before it is divided, in film thicknesses."""

CORNER_LEVELS = 5
"""Number of times that triangles at re-entrant corners of the wall are divided."""

BREAK_CELL = 0.15
"""Length of a cell where only the curvature of the wall jumps, in film thicknesses."""

GROWTH = 0.13
"""Increase of the length of a cell over the distance to the nearest break."""

CELLS_OF_PIECE = 8.0
"""Least number of cells on each smooth piece of a groove."""

HIGHEST_CELL = 0.25
"""Largest height of a cell in the film outside the grooves."""

SAMPLES = 400
"""Number of points by which lengths along a piece of the wall are measured."""

ROW = 0.35
"""Largest height of a cell in a groove, in film thicknesses."""

SAME_PLACE = 1e-9
"""Distance over the period below which two positions are equal."""

CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
"""Corners of a cell of a grid, counterclockwise."""


def graded(length: float, starts: tuple[float, float], most: float, level: float) -> Array:
    """Return the ends of the cells of a line from 0 to ``length``, which grow with the distance to its ends.

    The length of a cell is about min(start + GROWTH r, most) / level, with ``starts`` those at both ends.
    """
    s = length * (1 - np.cos(np.linspace(0, np.pi, SAMPLES))) / 2
    cell = np.minimum(np.minimum(starts[0] + GROWTH * s, starts[1] + GROWTH * (length - s)), most)
    number = np.concatenate([[0.0], np.cumsum(np.diff(s) * (1 / cell[1:] + 1 / cell[:-1]) / 2)])
    cells = max(int(np.ceil(number[-1] * level)), 1)
    return np.asarray(np.interp(np.linspace(0, number[-1], cells + 1), number, s))


@dataclass(frozen=True, kw_only=True)
class Block:
    """A groove below the line y = 0: each point of that line is connected to a point of the wall by a straight line.

    Attributes
    ----------
    groove : its wall.
    along : weighted length along the wall at ``places``, from 0 to 1.
    places : positions x of points of the wall.
    """

    groove: Groove
    along: Array
    places: Array

    def at(self, along: Array, down: Array) -> Array:
        """Return points, shape (2, n): ``along`` from 0 to 1 between the edges, ``down`` from 0 to 1 to the wall."""
        first, last = self.groove.breaks[0], self.groove.breaks[-1]
        x = np.interp(along, self.along, self.places)
        surface = first + (last - first) * along
        return np.stack([surface + down * (x - surface), -down * self.groove.depth(x)])

    def quality(self) -> float:
        """Return the least sine of the angle between the wall and the lines that end there."""
        middle = (self.along[1:] + self.along[:-1]) / 2
        wall = np.diff(self.at(self.along, np.ones_like(self.along)))
        line = self.at(middle, np.ones_like(middle)) - self.at(middle, np.zeros_like(middle))
        sine = (wall[1] * line[0] - wall[0] * line[1]) / np.hypot(*wall) / np.hypot(*line)
        return float(sine.min())


WEIGHTS = (1.0, 0.5, 0.25, 0.1, 0.0)
"""Weights of the height in the length along a wall: with 1 it is the arc length, with 0 the lines are vertical."""


def block_of(groove: Groove) -> Block:
    """Return the lines of a groove that are least oblique, among those of some weights."""
    share = (1 - np.cos(np.linspace(0, np.pi, SAMPLES))) / 2
    places = np.concatenate([[groove.breaks[0]], *((a + (b - a) * share)[1:] for a, b in pairwise(groove.breaks))])
    depth = groove.depth(places)
    depth[[0, -1]] = 0.0
    blocks = []
    for weight in WEIGHTS:
        along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(places), weight * np.diff(depth)))])
        blocks.append(Block(groove=groove, along=along / along[-1], places=places))
    return max(blocks, key=Block.quality)


def columns_of(block: Block, level: float) -> Array:
    """Return the positions of the columns of a groove along its block, from 0 to 1."""
    groove = block.groove
    length = np.hypot(np.diff(block.places), np.diff(groove.depth(block.places)))
    arc = np.concatenate([[0.0], np.cumsum(length)])
    found = [np.zeros(1)]
    ends = np.interp(groove.breaks, block.places, arc)
    for number, (first, last) in enumerate(pairwise(ends)):
        starts = [start_cell(groove, place, last - first) for place in groove.breaks[number : number + 2]]
        s = first + graded(last - first, (starts[0], starts[1]), (last - first) / CELLS_OF_PIECE, level)
        found.append(np.interp(s[1:], arc, block.along))
    columns = np.concatenate(found)
    columns[-1] = 1.0
    return columns


def start_cell(groove: Groove, place: float, length: float) -> float:
    """Return the length of a cell at a break of a groove."""
    return min(CORNER_CELL if place in groove.corners else BREAK_CELL, length / 4)


def columns_of_film(wall: Wall, blocks: Sequence[Block], level: float) -> tuple[Array, list[tuple[int, Array]]]:
    """Return the positions of all columns, and by groove the number of its first one with their places in its block."""
    x, own = np.array([-wall.length / 2]), []
    starts = boundary_cells(wall)
    before = starts[0]
    for block in (*blocks, None):
        land = (wall.length / 2 if block is None else block.groove.breaks[0]) - x[-1]
        if land > SAME_PLACE * wall.length:
            after = starts[1] if block is None else start_cell(block.groove, block.groove.breaks[0], np.inf)
            x = np.append(x, x[-1] + graded(land, (min(before, land / 4), min(after, land / 4)), land, level)[1:])
        if block is not None:
            columns = columns_of(block, level)
            own.append((len(x) - 1, columns))
            x = np.append(x, block.at(columns, np.zeros_like(columns))[0][1:])
            before = start_cell(block.groove, block.groove.breaks[-1], np.inf)
    return x, own


def boundary_cells(wall: Wall) -> tuple[float, float]:
    """Return the lengths of the first and the last cell of the period, by the nearest groove beyond its ends."""
    if not wall.grooves:
        return np.inf, np.inf
    first, last = wall.grooves[0], wall.grooves[-1]
    beyond = first.breaks[0] + wall.length / 2, wall.length / 2 - last.breaks[-1]
    return (
        start_cell(last, last.breaks[-1], np.inf) + GROWTH * beyond[1],
        start_cell(first, first.breaks[0], np.inf) + GROWTH * beyond[0],
    )


@dataclass(frozen=True, kw_only=True)
class Placed:
    """Triangles whose corners have a place in the block of a groove if they lie below y = 0.

    Attributes
    ----------
    mesh : the triangles with straight sides.
    blocks : the grooves.
    block : number of the block of every corner, shape (n,); -1 in the film.
    along, down : place in its block, shape (n,).
    """

    mesh: MeshTri1
    blocks: Sequence[Block]
    block: Indices
    along: Array
    down: Array

    def middles(self) -> tuple[Array, Indices, Array, Array]:
        """Return the middles of all sides, shape (2, m), and their numbers of block, ``along`` and ``down``."""
        ends = self.mesh.facets
        points, number = self.mesh.p[:, ends].mean(axis=1), self.block[ends].max(axis=0)
        places = np.zeros((2, ends.shape[1]))
        for n, block in enumerate(self.blocks):
            own = np.flatnonzero(number == n)
            first, last = block.groove.breaks[0], block.groove.breaks[-1]
            below = self.block[ends[:, own]] == n
            above = (self.mesh.p[0, ends[:, own]] - first) / (last - first)
            along = np.where(below, self.along[ends[:, own]], above)
            down = np.where(below, self.down[ends[:, own]], 0.0)
            edge = ~below & ((above < SAME_PLACE) | (above > 1 - SAME_PLACE))
            down = np.where(edge, down[::-1], down)
            places[:, own] = along.mean(axis=0), down.mean(axis=0)
            points[:, own] = block.at(*places[:, own])
        return points, number, places[0], places[1]

    def refined(self, at: Array) -> "Placed":
        """Return the triangles after those with a corner at one of these points, shape (2, n), have been divided."""
        apart = np.hypot(*(self.mesh.p[:, None] - at[:, :, None])).min(axis=0)
        near = np.flatnonzero(apart < SAME_PLACE)
        finer = self.mesh.refined(np.flatnonzero(np.isin(self.mesh.t, near).any(axis=0)))
        count = self.mesh.p.shape[1]
        straight = self.mesh.p[:, self.mesh.facets].mean(axis=1)
        side = cKDTree(straight.T).query(finer.p[:, count:].T)[1]
        points, *place = (one[..., side] for one in self.middles())
        block, along, down = (
            np.append(old, new) for old, new in zip((self.block, self.along, self.down), place, strict=True)
        )
        mesh = MeshTri1(np.hstack([self.mesh.p, points]), np.ascontiguousarray(finer.t))
        return Placed(mesh=mesh, blocks=self.blocks, block=block, along=along, down=down)

    def curved(self) -> MeshTri2:
        """Return the triangles with sides that are parabolas."""
        curved = MeshTri2.from_mesh(self.mesh)
        curved.doflocs[:, curved.dofs.facet_dofs[0]] = self.middles()[0]
        return curved


def fitted_mesh(wall: Wall, level: float) -> MeshTri2:
    """Return the mesh of the gap above a wall; the number of cells in each direction grows with ``level``.

    The film 0 <= y <= 1 above the land is divided into rectangles, each groove below y = 0 into quadrilaterals between
    lines from y = 0 to the wall, and at both edges into triangles. Quadrilaterals are halved. The triangles at
    re-entrant corners of the wall are divided again and again. Sides along the wall are parabolas through three points
    of it.
    """
    blocks = [block_of(groove) for groove in wall.grooves]
    x, own = columns_of_film(wall, blocks, level)
    y = graded(1.0, (HIGHEST_CELL, HIGHEST_CELL), HIGHEST_CELL, level)
    film = np.arange(len(x) * len(y)).reshape(len(x), len(y))
    points = [np.stack(np.broadcast_arrays(x[:, None], y)).reshape(2, -1)]
    triangles = [halves(film)]
    placed = [(np.full(film.size, -1), np.zeros(film.size), np.zeros(film.size))]
    count = film.size
    for number, (block, (first, columns)) in enumerate(zip(blocks, own, strict=True)):
        rows = np.linspace(0, 1, rows_of(block, level) + 1)
        here = np.empty((len(columns), len(rows)), dtype=int)
        here[:, 0] = film[first : first + len(columns), 0]
        here[[0, -1], 1:] = here[[0, -1], :1]
        along, down = (one[1:-1, 1:].ravel() for one in np.broadcast_arrays(columns[:, None], rows))
        here[1:-1, 1:] = count + np.arange(along.size).reshape(len(columns) - 2, -1)
        count += along.size
        points.append(block.at(along, down))
        triangles.append(halves(here[:, ::-1]))
        placed.append((np.full(along.size, number), along, down))
    found = Placed(
        mesh=MeshTri1(np.hstack(points), np.hstack(triangles)),
        blocks=blocks,
        block=np.concatenate([one[0] for one in placed]),
        along=np.concatenate([one[1] for one in placed]),
        down=np.concatenate([one[2] for one in placed]),
    )
    places = [(groove, np.array(groove.sharp_corners())) for groove in wall.grooves]
    sharp = [np.stack([x, -groove.depth(x)]) for groove, x in places if x.size]
    for _ in range(round(CORNER_LEVELS * (1 + np.log2(level))) if sharp else 0):
        found = found.refined(np.hstack(sharp))
    return found.curved()


def rows_of(block: Block, level: float) -> int:
    """Return the number of cells from y = 0 to the wall of a groove."""
    return max(int(np.ceil(level)), int(np.ceil(level * block.groove.depth(block.places).max() / ROW)))


def halves(grid: Indices) -> Indices:
    """Return the triangles, shape (3, n), of a grid of numbers of points; those with two equal corners are left out."""
    a, b, c, d = (grid[i : len(grid) - 1 + i, j : grid.shape[1] - 1 + j].ravel() for i, j in CORNERS)
    found = np.hstack([np.stack([a, b, c]), np.stack([a, c, d])])
    distinct = (found[0] != found[1]) & (found[1] != found[2]) & (found[0] != found[2])
    return np.asarray(found[:, distinct])
