"""Uncertainties of the fronts of cavities on a grid, from its nodes alone."""

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.cavitation.solve import Solution

CELLS_OF_HIDDEN_CAVITY = 2.0
"""Largest length along the sliding, in cells, of a cavity that a grid does not show before an end of a film."""

FRACTION_OF_CELL = 0.1
"""Uncertainty of the place of a front between two nodes over their distance."""


def fraction_at_fronts(solution: Solution) -> float:
    """The area of the nodes in cavities beside a film, over the area of the film.

    On two grids a front may lie between the same nodes; on each of them the cavity is known to these nodes only.
    """
    film = solution.kind == FILM
    beside = np.zeros_like(film)
    for axis in (0, 1):
        for step in (1, -1):
            beside |= _from(film, axis, step, periodic=solution.network.periodic[axis])
    return _fraction(solution, beside & (solution.kind == CAVITY))


def _from(nodes: NDArray[np.bool_], axis: int, step: int, *, periodic: bool) -> NDArray[np.bool_]:
    """Whether the neighbour of each node along an axis is one of some nodes."""
    moved = np.roll(nodes, step, axis=axis)
    if not periodic:
        moved[(0 if step == 1 else -1, slice(None)) if axis == 0 else (slice(None), 0 if step == 1 else -1)] = False
    return moved


def hidden_cavities(solution: Solution) -> Array:
    """The growth of the film thickness over a cell, relative, where a film may rupture before its end; else 0.

    A film ends at the cavitation pressure in an outlet, a gap or a supply. Where it grows thicker towards it, a cavity
    that is shorter than a cell may lie before this end, in which the liquid fills 1 - g of the film for the growth g.
    """
    kind, pressure, grid = solution.kind, solution.state.pressure, solution.grid
    thickness = solution.problem.shape.thickness(*np.meshgrid(grid.x, grid.y, indexing="ij"))
    thicker = np.roll(thickness, -1, axis=0)
    ends = _from(kind >= FIXED, 0, -1, periodic=solution.network.periodic[0]) & (np.roll(pressure, -1, axis=0) <= 0)
    ends &= (kind == FILM) & (pressure >= 0) & (thicker > thickness)
    return np.where(ends, 1 - np.divide(thickness, thicker, out=np.ones_like(thickness), where=thicker > 0), 0.0)


def front_uncertainties(solution: Solution, least_ratio: float) -> dict[str, float]:
    """The least uncertainties of ``cavitated_fraction``, ``rupture`` and ``theta_min`` that the nodes of a grid allow.

    A front is placed between its nodes to ``FRACTION_OF_CELL``. Where the grid may hide a cavity before an end of the
    film, it may rupture up to ``CELLS_OF_HIDDEN_CAVITY`` cells before it, and the density ratio there is less than 1 by
    the growth of the film over these cells.

    Parameters
    ----------
    least_ratio : least density ratio of the film on the grid.
    """
    growth = hidden_cavities(solution)
    hidden = growth > 0
    spacing, length = solution.grid.spacing_x, solution.problem.shape.length
    cells = CELLS_OF_HIDDEN_CAVITY * float(spacing[hidden.any(axis=1)].max(initial=0.0))
    near = FRACTION_OF_CELL * float(spacing.max()) if (solution.kind == CAVITY).any() else 0.0
    return {
        "cavitated_fraction": fraction_at_fronts(solution) + _fraction(solution, hidden),
        "rupture": max(cells, near) / length,
        "theta_min": max(0.0, least_ratio - max(0.0, 1 - CELLS_OF_HIDDEN_CAVITY * float(growth.max()))),
    }


def _fraction(solution: Solution, nodes: NDArray[np.bool_]) -> float:
    areas = solution.grid.areas
    return float(areas[nodes].sum() / (solution.problem.shape.film_fraction * areas.sum()))
