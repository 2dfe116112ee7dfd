"""The uncertainty of the quantities of a film, from coarser grids, the balance of its flows and the flow factors."""

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.corners import unknown_by_infinite_flows
from roughfilm.rom.bearing.quantities import EXACT, scene_positions
from roughfilm.rom.cavitation.balance import FILM
from roughfilm.rom.cavitation.evaluation.flows import IMBALANCE_FACTOR
from roughfilm.rom.cavitation.evaluation.fronts import front_uncertainties
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_uncertainty
from roughfilm.rom.cavitation.solve import Solution

POSITIONS = ("film_start", "rupture")
"""Quantities that are positions x/L."""

HOTTEST_PLACE = ("temperature_max_x", "temperature_max_y")
"""Quantities that are the position of the highest temperature."""

MIN_CELLS_OF_POSITIONS = 15
"""Number of cells along a side below which a grid does not show where a film begins or ends: it may lack the film."""

MOMENTS = ("moment_x", "moment_y")
"""Quantities whose round-off is that of the load; of a pad in equilibrium they are those of the scene."""

ANGLES = ("attitude_angle", "film_min_angle")
"""Quantities that are angles, degrees."""

HALF_TURN = 180.0
"""Uncertainty of an angle, degrees, from which on it is unknown."""

LEAST_FILM = "film_min"
"""Quantity that is exact for a given film, and uncertain for one that is sought."""

FLOW_UNIT = "m^3/s"
"""Unit of the flows through the edges of a film with a width."""


def uncertainties(
    levels: Sequence[tuple[Solution, Mapping[str, Quantity]]],
    of_factors: Mapping[str, float],
    balance: float | None = None,
    *,
    exact: Collection[str] = EXACT,
    apart: Mapping[str, float] | None = None,
) -> dict[str, float]:
    """The uncertainty of each quantity in its unit, infinite if unknown; empty without a coarser grid.

    It is the sum of that of the grid, at least that of fronts between its nodes, ``IMBALANCE_FACTOR`` times the
    relative error of the flow along the film (of a flow, relative to the largest flow), the relative error of the load
    (of a moment, relative to the load times the size of the film), and the contribution of the flow factors. Positions
    without a film are unknown. The highest temperature lies inside of the film, wherever it is.

    Parameters
    ----------
    levels : the film and its quantities, the finest grid first.
    of_factors : uncertainties that come from flow factors and contact pressures, by quantity.
    balance : relative error of the load for which the film was sought; None for a given film, whose thickness is exact.
    exact : quantities that have no error of the grid.
    apart : smallest difference of a quantity on the finest two grids, in its unit, and its least uncertainty.
    """
    if len(levels) == 1:
        return {}
    solution, quantities = levels[0]
    cells, values = [cells_of(grid) for grid, _ in levels], [level for _, level in levels]
    unknown = unknown_by_infinite_flows(solution)
    unknown |= frozenset() if (solution.kind == FILM).any() else frozenset(POSITIONS)
    largest_flow = max((abs(one.value) for one in quantities.values() if one.unit == FLOW_UNIT), default=0.0)
    arm = abs(quantities["load"].value) * float(solution.grid.areas.sum()) ** 0.5 if "load" in quantities else 0.0
    least = front_uncertainties(solution, quantities["theta_min"].value) if "theta_min" in quantities else {}
    moved, result = apart or {}, {}
    for name, quantity in quantities.items():
        known = {count: level[name].value for count, level in zip(cells, values, strict=True) if name in level}
        size = largest_flow if quantity.unit == FLOW_UNIT else arm if name in MOMENTS else abs(quantity.value)
        if name in exact and not (name == LEAST_FILM and balance is not None):
            result[name] = 0.0
        elif name in unknown:
            result[name] = math.inf
        elif len(known) > 1:
            if len(known) == 2:
                known = _apart(known, moved.get(name, 0.0))
            if name in POSITIONS:
                known = _positions(known, ring=solution.network.periodic[0])
            of_grid = max(grid_uncertainty([*known], [*known.values()]), least.get(name, 0.0), moved.get(name, 0.0))
            of_balance = size * (IMBALANCE_FACTOR * solution.imbalance + (balance or 0.0))
            result[name] = of_grid + of_balance + of_factors.get(name, 0.0)
            if name in HOTTEST_PLACE:
                result[name] = min(result[name], _farthest(solution, name, quantity.value))
    return result | dict.fromkeys(beyond_half_a_turn(result), math.inf)


def beyond_half_a_turn(uncertainty: Mapping[str, float]) -> list[str]:
    """The angles whose uncertainty is half a turn or more, so that they are unknown, and the place at such an angle.

    Parameters
    ----------
    uncertainty : uncertainties by quantity, those of angles in degrees.
    """
    names = [name for name in ANGLES if uncertainty.get(name, 0.0) >= HALF_TURN]
    places = {"film_min_angle": "film_min_x"}
    return names + [places[name] for name in names if places.get(name) in uncertainty]


def _farthest(solution: Solution, name: str, place: float) -> float:
    """The largest distance of a node from a position along x or y, in a film without ends by the nearest turn."""
    along = name == HOTTEST_PLACE[0]
    if along and solution.network.periodic[0]:
        return float(solution.grid.spacing_x.sum()) / 2
    positions = scene_positions(solution) if along else solution.grid.y
    return float(np.abs(positions - place).max())


def _apart(known: Mapping[float, float], least: float) -> dict[float, float]:
    """Values on two grids that differ at least by ``least``."""
    (finest, value), (coarser, other) = known.items()
    return {finest: value, coarser: other if abs(other - value) >= least else value + least}


def _positions(known: Mapping[float, float], *, ring: bool) -> dict[float, float]:
    """Positions on the finest two grids and those with ``MIN_CELLS_OF_POSITIONS``, on a ring by the nearest turn."""
    (finest, place), *others = known.items()
    near = {
        cells: place + math.remainder(other - place, 1.0) if ring else other
        for number, (cells, other) in enumerate(others)
        if number == 0 or cells >= MIN_CELLS_OF_POSITIONS
    }
    return {finest: place, **near}
