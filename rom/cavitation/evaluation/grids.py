"""The uncertainty of a value of a film from those on coarser grids."""

import math
from collections.abc import Sequence

from scipy.optimize import brentq

from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE
from roughfilm.rom.cavitation.solve import Solution

ORDERS = (1.0, 2.0)
"""Smallest and largest order at which an error is taken to decrease with the size of the cells."""

GRID_SAFETY_FACTOR = 1.5
"""Uncertainty over the largest of the errors that differences to coarser grids give."""

COARSE_SAFETY_FACTOR = 4.0
"""The same with a single difference, or with a finest grid below ``MIN_CELLS``: they may be small by chance."""

MIN_CELLS = 50
"""Number of cells along a side from which on ``GRID_SAFETY_FACTOR`` holds."""

MAX_GRID_RATIO = 0.75
"""Cells of a grid over those of the next finer one, up to which their difference is used."""


def grid_uncertainty(cells: Sequence[float], values: Sequence[float]) -> float:
    """The uncertainty of a value on a grid from those on coarser grids, in the unit of the values.

    With an error C h^p, the difference to a grid with the cells n_k instead of n is the error times (n/n_k)^p - 1. The
    uncertainty is a safety factor times the largest error that any of the differences gives. The order p is the
    smallest observed on three successive grids, within ``ORDERS``; values that oscillate, and two grids, have the
    lowest order.

    Parameters
    ----------
    cells : numbers of cells along a side, from fine to coarse; at least two.
    values : the value on each grid.

    Source: Roache 1994, doi:10.1115/1.2910291, for the order and the safety factor.
    """
    triples = range(len(values) - 2)
    order = min((observed_order(cells[n : n + 3], values[n : n + 3]) for n in triples), default=ORDERS[0])
    errors = [float(abs(values[0] - values[n]) / ((cells[0] / cells[n]) ** order - 1)) for n in range(1, len(values))]
    fine = len(errors) > 1 and cells[0] >= MIN_CELLS
    return (GRID_SAFETY_FACTOR if fine else COARSE_SAFETY_FACTOR) * max(errors)


def observed_order(cells: Sequence[float], values: Sequence[float]) -> float:
    """The order p, within ``ORDERS``, for which (f₂ - f₁)/(f₁ - f₀) = (h₂^p - h₁^p)/(h₁^p - h₀^p) of three grids."""
    last, before = values[1] - values[0], values[2] - values[1]
    if last == before == 0:
        return ORDERS[1]

    def excess(order: float) -> float:
        """A number below zero if the differences decrease with a higher order than this."""
        h0, h1, h2 = (n**-order for n in cells)
        return float(last * (h2 - h1) - before * (h1 - h0))

    sign = math.copysign(1.0, before)
    if last * before <= 0 or sign * excess(ORDERS[0]) >= 0:
        return ORDERS[0]
    if sign * excess(ORDERS[1]) <= 0:
        return ORDERS[1]
    return float(brentq(excess, *ORDERS))


def grid_sequence(solution: Solution) -> tuple[Solution, ...]:
    """A solution and those on coarser grids, as far as they exist."""
    grids = [solution]
    while (coarser := grids[-1].coarser) is not None and cells_of(coarser) <= MAX_GRID_RATIO * cells_of(grids[-1]):
        grids.append(coarser)
    return tuple(grids)


def cells_of(solution: Solution) -> float:
    """The number of cells along a side, in the plane the geometric mean of both sides."""
    sides = [count for count in solution.grid.shape if count > 1]
    return float(math.prod(sides) ** (1 / len(sides)))


def grid_warnings(solution: Solution) -> list[str]:
    """Warnings about a grid that is too coarse for the features of the wall."""
    shape, grid = solution.problem.shape, solution.grid
    warnings = []
    for name, feature, spacing in zip(("along", "across"), shape.finest, (grid.spacing_x, grid.spacing_y), strict=True):
        cells = feature / spacing.max() if spacing.max() > 0 else math.inf
        if cells < 0.99 * CELLS_PER_FEATURE:
            warnings.append(
                f"the shortest feature of the wall {name} the sliding direction has {cells:.2g} cells; take at least "
                f"{CELLS_PER_FEATURE / cells:.2g} times the resolution"
            )
    return warnings
