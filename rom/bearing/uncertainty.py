"""The uncertainty of the quantities of a film, from coarser grids, the residual and the flow factors."""

from collections.abc import Mapping
from itertools import pairwise

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.quantities import Outputs
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import Solution

POSITIONS = ("film_start", "rupture", "cavitated_fraction")
"""Quantities that follow the nodes, with an uncertainty of at least a cell."""

GRID_SAFETY_FACTOR = 3.0
"""Safety factor of an error estimated from two grids (Roache 1994, doi:10.1115/1.2910291)."""


def uncertainties(
    scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity], outputs: Outputs
) -> dict[str, float]:
    """The uncertainty of each quantity in its unit; empty without a coarser grid.

    It is the sum of ``GRID_SAFETY_FACTOR``/3 times the larger of the last change between grids and a quarter of the
    change before (second order), the residual accumulated over the cells, and the contribution of the flow factors.
    """
    grids = grid_sequence(solution)
    if len(grids) == 1:
        return {}
    cells = solution.grid.x.size
    values = [quantities, *(outputs.quantities(scene, grid) for grid in grids[1:])]
    averaged = solution.problem.shape.roughness is not None
    of_factors = outputs.factor_uncertainties(scene, solution, quantities) if averaged else {}
    result = {}
    for name, quantity in quantities.items():
        known = [level[name].value for level in values if name in level]
        if name in values[1]:
            change = max(abs(fine - coarse) / 4**n for n, (fine, coarse) in enumerate(pairwise(known)))
            least = 1 / cells if name in POSITIONS else 0.0
            result[name] = max(GRID_SAFETY_FACTOR * change / 3, least) + abs(quantity.value) * solution.residual * cells
            result[name] += of_factors.get(name, 0.0)
    return result


def grid_sequence(solution: Solution) -> tuple[Solution, ...]:
    """A solution and those on grids about half and a quarter as fine, as far as they exist."""
    grids = [solution]
    while (coarser := grids[-1].coarser) is not None and coarser.grid.x.size <= 0.75 * grids[-1].grid.x.size:
        grids.append(coarser)
    return tuple(grids)
