"""The uncertainty of the quantities of a film, from coarser grids, the balance of its flows and the flow factors."""

import math
from collections.abc import Mapping, Sequence

from scipy.optimize import brentq

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.quantities import EXACT
from roughfilm.rom.cavitation.balance import FILM
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

IMBALANCE_FACTOR = 10.0
"""Relative error of a quantity over the relative error of the flow along the film."""

POSITIONS = ("film_start", "rupture")
"""Quantities that are positions x/L."""

MIN_CELLS_OF_POSITIONS = 15
"""Number of cells along a side below which a grid does not show where a film begins or ends: it may lack the film."""

LEAST_FILM = "film_min"
"""Quantity that is exact for a given film, and uncertain for one that is sought."""

FLOW_UNIT = "m^3/s"
"""Unit of the flows through the edges of a film with a width."""


def uncertainties(
    levels: Sequence[tuple[Solution, Mapping[str, Quantity]]],
    of_factors: Mapping[str, float],
    balance: float | None = None,
) -> dict[str, float]:
    """The uncertainty of each quantity in its unit, infinite if unknown; empty without a coarser grid.

    It is the sum of that of the grid, ``IMBALANCE_FACTOR`` times the relative error of the flow along the film (of a
    flow, relative to the largest flow), the relative error of the load, and the contribution of the flow factors.
    Positions without a film are unknown.

    Parameters
    ----------
    levels : the film and its quantities, the finest grid first.
    of_factors : uncertainties that come from flow factors and contact pressures, by quantity.
    balance : relative error of the load for which the film was sought; None for a given film, whose thickness is exact.
    """
    if len(levels) == 1:
        return {}
    solution, quantities = levels[0]
    cells, values = [cells_of(grid) for grid, _ in levels], [level for _, level in levels]
    unknown = infinite_flows(solution) | (frozenset() if (solution.kind == FILM).any() else frozenset(POSITIONS))
    largest_flow = max((abs(one.value) for one in quantities.values() if one.unit == FLOW_UNIT), default=0.0)
    result = {}
    for name, quantity in quantities.items():
        known = {count: level[name].value for count, level in zip(cells, values, strict=True) if name in level}
        size = largest_flow if quantity.unit == FLOW_UNIT else abs(quantity.value)
        if name in EXACT and not (name == LEAST_FILM and balance is not None):
            result[name] = 0.0
        elif name in unknown:
            result[name] = math.inf
        elif len(known) > 1:
            if name in POSITIONS:
                known = _positions(known, ring=solution.network.periodic[0])
            of_grid = grid_uncertainty([*known], [*known.values()])
            of_balance = size * (IMBALANCE_FACTOR * solution.imbalance + (balance or 0.0))
            result[name] = of_grid + of_balance + of_factors.get(name, 0.0)
    return result


def _positions(known: Mapping[float, float], *, ring: bool) -> dict[float, float]:
    """Positions on the finest two grids and those with ``MIN_CELLS_OF_POSITIONS``, on a ring by the nearest turn."""
    (finest, place), *others = known.items()
    near = {
        cells: place + math.remainder(other - place, 1.0) if ring else other
        for number, (cells, other) in enumerate(others)
        if number == 0 or cells >= MIN_CELLS_OF_POSITIONS
    }
    return {finest: place, **near}


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
