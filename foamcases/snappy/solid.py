"""Make the solids that snappyHexMesh cuts out of a block from the walls of a gap, repeated beyond the period."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.meshes.mesh import Mesh, in_triangles
from roughfilm.rom.meshes.walls_mesh import GapPart, wall_mesh
from roughfilm.rom.rough_gap.walls import Walls

MARGIN_FRACTION = 0.25
"""Length by which the solid extends beyond the period on each side, over the period."""

POINT_OFFSET = (0.37, 0.31, 0.43)
"""Offset of the point in the liquid from the middle of the widest gap, over the sides of a cell."""


@dataclass(frozen=True, kw_only=True)
class Box:
    """A period of space as a box of equal cells, before the solid is cut out of it.

    Attributes
    ----------
    size : lengths along x and y, which begin at 0.
    bottom, top : least and greatest z.
    cells : numbers of cells along x, y and z.
    """

    size: tuple[float, float]
    bottom: float
    top: float
    cells: tuple[int, int, int]

    @property
    def vertices(self) -> Array:
        """The corners of the cells, shape (nx + 1, ny + 1, nz + 1, 3)."""
        ends = (0.0, self.size[0]), (0.0, self.size[1]), (self.bottom, self.top)
        axes = [np.linspace(*end, count + 1) for end, count in zip(ends, self.cells, strict=True)]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)

    @property
    def steps(self) -> Array:
        """The lengths of a cell along x, y and z, shape (3,)."""
        return np.asarray([*self.size, self.top - self.bottom]) / self.cells


@dataclass(frozen=True, kw_only=True)
class Carved:
    """A box, the triangles of the solid in it, and a point in the liquid, all in one unit of length."""

    box: Box
    solid: Mesh
    inside: tuple[float, float, float]


def repeated(solid: Mesh, size: tuple[float, float]) -> Mesh:
    """The triangles of one period, and those of neighbouring periods within ``MARGIN_FRACTION`` of the period."""
    surface = in_triangles(solid)
    shifts = [np.array([i * size[0], j * size[1], 0.0]) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    points = np.concatenate([surface.points + shift for shift in shifts])
    count = len(surface.points)
    cells = np.concatenate([surface.cells + n * count for n in range(len(shifts))])
    whole = Mesh(points=points, cell_type=surface.cell_type, cells=cells)
    near = np.ones(len(points), dtype=bool)
    for axis, length in enumerate(size):
        near &= (points[:, axis] >= -MARGIN_FRACTION * length) & (points[:, axis] <= (1 + MARGIN_FRACTION) * length)
    return whole.kept(np.asarray(near[cells].any(axis=1)))


def carved(walls: Walls, unit: float, layers: int) -> Carved:
    """The box and the solid of the gap between walls, with cells whose sides are about 1/``layers``.

    A gap narrower than about half a cell is cut away with the solid; the shape of the rest is resolved to second order.
    Where the walls touch, the lower one is raised two cells above the upper one, so that it cuts the block completely.
    A flat upper wall is the top of the box.

    Parameters
    ----------
    walls : heights of the walls.
    unit : unit of length, m.
    layers : number of cells per unit of length.
    """
    length, width = (side / unit for side in walls.size)
    step = 1 / layers
    lowest, highest = float(walls.lower.min()) / unit, float(walls.upper.max()) / unit
    top = highest if walls.slides else highest + 2 * step
    down = int(np.ceil((top - lowest) / step)) + 2
    box = Box(
        size=(length, width),
        bottom=top - down * step,
        top=top,
        cells=(max(2, round(length / step)), max(2, round(width / step)), down),
    )
    raised = Walls(
        lower=np.where(walls.gap > 0, walls.lower, walls.upper + 2 * step * unit),
        upper=walls.upper,
        spacing=walls.spacing,
    )
    parts = (GapPart.LOWER,) if walls.slides else (GapPart.LOWER, GapPart.UPPER)
    sheets = [repeated(wall_mesh(raised, part), walls.size) for part in parts]
    i, j = np.unravel_index(walls.gap.argmax(), walls.gap.shape)
    middle = (walls.lower[i, j] + walls.upper[i, j]) / 2
    x, y, z = np.array([i * walls.spacing[0], j * walls.spacing[1], middle]) / unit + POINT_OFFSET * box.steps
    return Carved(box=box, solid=_scaled(_together(sheets), 1 / unit), inside=(x % length, y % width, z))


def _together(meshes: list[Mesh]) -> Mesh:
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    return Mesh(
        points=np.concatenate([mesh.points for mesh in meshes]),
        cell_type=meshes[0].cell_type,
        cells=np.concatenate([mesh.cells + start for mesh, start in zip(meshes, starts[:-1], strict=True)]),
    )


def _scaled(mesh: Mesh, factor: float) -> Mesh:
    return Mesh(points=mesh.points * factor, cell_type=mesh.cell_type, cells=mesh.cells)
