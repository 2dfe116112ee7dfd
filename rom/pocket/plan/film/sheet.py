"""The staggered grid of a film over a cell in plan."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.pocket.plan.grid import columns_across
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.thin_film.columns import columns
from roughfilm.rom.thin_film.gap import Gap

RIM_DENSITY = 4.0
"""Density of nodes at the rims of dimples over that far from one; the preconditioner is for almost equal cells."""

MAX_CELLS = 65_536
"""Largest number of cells of a grid; a linear system takes about 12 kB for each."""

CENTRAL = 0.75
"""Weight of the central interpolation in the reconstruction of second order, as in the scheme LUST of OpenFOAM."""

ROWS = 6
"""Number of lengths and weights of an axis."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """The places of pressures and velocities over a periodic cell, in film thicknesses.

    Pressures lie at the nodes (x_i, y_j) of a rectangular grid, velocities along x halfway to the node ahead along x,
    and velocities along y halfway to the node ahead along y. A place has its momentum cell around it, which is bounded
    by nodes along its own axis and by places halfway between nodes along the other one.

    Attributes
    ----------
    x, y : positions of the nodes, both ends of the period included, shapes (nx + 1,) and (ny + 1,).
    thickness : film thickness at the places of u and of v, at the nodes, and halfway along both axes, (4, nx, ny).
    rows : for each axis the distances to the node ahead, the distances between the places halfway behind and ahead of a
        node, and the weights of the second cell in a reconstruction from one side: to a node from behind and from
        ahead, halfway between nodes from behind and from ahead. Shape (2, 6, max(nx, ny)), padded with zeros.
    central : weight of the central interpolation in a reconstruction.
    """

    x: Array
    y: Array
    thickness: Array
    rows: Array
    central: float

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of nodes along and across."""
        return self.x.size - 1, self.y.size - 1

    @property
    def ahead(self) -> tuple[Array, Array]:
        """The distances to the next node along x, shape (nx, 1), and along y, shape (ny,)."""
        nx, ny = self.shape
        return self.rows[0, 0, :nx, None], self.rows[1, 0, :ny]

    @property
    def around(self) -> tuple[Array, Array]:
        """The lengths of the cells around the nodes along x, shape (nx, 1), and along y, shape (ny,)."""
        nx, ny = self.shape
        return self.rows[0, 1, :nx, None], self.rows[1, 1, :ny]

    @property
    def areas(self) -> tuple[Array, Array, Array]:
        """The areas of the cells of u, of v and of the nodes, shape (nx, ny)."""
        (ahead_x, ahead_y), (around_x, around_y) = self.ahead, self.around
        return ahead_x * around_y, around_x * ahead_y, around_x * around_y


def sheet(plan: Plan, resolution: int, *, second_order: bool = True) -> Sheet:
    """The grid with about ``resolution`` cells along the period and as many across per length, denser at rims.

    The places at which outlines of dimples begin and end are nodes. The reconstruction of second order is ``CENTRAL``
    times the central one and the rest times that from two cells upstream; that of first order takes one cell.

    Raises
    ------
    InputError
        If the cell is so broad that it needs more than ``MAX_CELLS`` cells.
    """
    across = columns_across(plan, resolution)
    if resolution * across > MAX_CELLS:
        raise InputError(
            f"resolution: got {resolution} columns along a cell that need {across} across it; film and film_slope take "
            f"at most {MAX_CELLS} in all, take a lower resolution or a part of the cell as its period"
        )
    return sheet_of(
        plan,
        _nodes(plan.film, plan.length, plan.breaks_x, resolution),
        _nodes(plan.film, plan.breadth, plan.breaks_y, across),
        second_order=second_order,
        central=CENTRAL if second_order else 0.0,
    )


def sheet_of(plan: Plan, x: Array, y: Array, *, second_order: bool = True, central: float = CENTRAL) -> Sheet:
    """The grid with given nodes, in film thicknesses, both ends of the period included."""
    halfway_x, halfway_y = ((places[1:] + places[:-1]) / 2 for places in (x, y))

    def thickness(along: Array, other: Array) -> Array:
        return np.asarray(plan.thickness(along[:, None] * plan.film, other * plan.film) / plan.film)

    rows = np.zeros((2, ROWS, max(x.size, y.size) - 1))
    for axis, places in enumerate((x, y)):
        rows[axis, :, : places.size - 1] = _rows(np.diff(places), second_order=second_order)
    return Sheet(
        x=x,
        y=y,
        thickness=np.stack(
            [
                thickness(halfway_x, y[:-1]),
                thickness(x[:-1], halfway_y),
                thickness(x[:-1], y[:-1]),
                thickness(halfway_x, halfway_y),
            ]
        ),
        rows=rows,
        central=central,
    )


def _nodes(film: float, period: float, breaks: tuple[float, ...], number: int) -> Array:
    """The positions of about ``number`` + 1 nodes over a period, in film thicknesses."""
    ends = -period / 2, period / 2
    inner = tuple(place for place in breaks if ends[0] < place < ends[1])
    gap = Gap(film=film, breaks=(ends[0], *inner, ends[1]), corners=breaks, thickness=np.zeros_like)
    return columns(gap, number, corner_density=RIM_DENSITY)


def _rows(lengths: Array, *, second_order: bool) -> Array:
    """The ``rows`` of an axis whose nodes have these distances."""
    before, after = np.roll(lengths, 1), np.roll(lengths, -1)
    weights = [
        lengths / (lengths + before),
        lengths / (lengths + after),
        lengths / (2 * before),
        before / (2 * lengths),
    ]
    return np.stack([lengths, (lengths + before) / 2, *(weight * second_order for weight in weights)])
