"""Corners between an end and an open side at which the pressure jumps, and the flows that are infinite there."""

from dataclasses import dataclass

import numpy as np

from roughfilm.rom.cavitation.balance import CAVITY, FIXED, FLOODED
from roughfilm.rom.cavitation.solve import Solution

PRESSURE_TOLERANCE = 1e-9
"""Relative difference of two pressures up to which they are the same."""


CARRIED = ("outlet_temperature", "effective_temperature")
"""Temperatures that infinite flows of lubricant change."""

PUMPED = ("heat_generated", "heat_to_lubricant")
"""Heats that the pressures at the edges do with infinite flows."""


@dataclass(frozen=True, kw_only=True)
class Jump:
    """A jump of the pressure between an end of the film and the ``side`` "low" or "high", Pa.

    The ``end`` is "inlet" or "outlet", each of which is also a gap between lobes, at the begin and the end of a lobe.
    """

    end: str
    side: str
    difference: float


def differs(pressure: float, other: float) -> bool:
    """Whether two pressures, Pa, differ by more than rounding."""
    return abs(pressure - other) > PRESSURE_TOLERANCE * max(abs(pressure), abs(other))


def jumps(solution: Solution) -> tuple[Jump, ...]:
    """The jumps of the pressure at the corners of a film with open sides.

    At a distance r from a corner, a jump Δp drives the flow h³Δp/(6π η r) per length past the corner from the one edge
    to the other, so that the flows through both are infinite. A starved inlet is at the cavitation pressure; where a
    cavity begins at the inlet, the flow from the side into it is finite.
    """
    ends, last = solution.problem.ends, solution.grid.y.size - 1
    if ends.sides is None:
        return ()
    if solution.problem.shape.idle:
        return _at_gaps(solution, ends.sides)
    if solution.network.periodic[0]:
        return ()
    found = []
    for side, pressure, row in (("low", ends.sides[0], 1), ("high", ends.sides[1], last - 1)):
        flooded = ends.inlet is not None or solution.kind[0, row] == FLOODED
        for end, other in ((("inlet", ends.inlet or 0.0),) if flooded else ()) + (("outlet", ends.outlet),):
            if differs(pressure, other):
                found.append(Jump(end=end, side=side, difference=other - pressure))
    return tuple(found)


def _at_gaps(solution: Solution, sides: tuple[float, float]) -> tuple[Jump, ...]:
    """The jumps at the gaps between lobes, at whose end a lobe begins; the film may rupture before a gap begins."""
    gap = (solution.kind[:, 1:-1] == FIXED).all(axis=1)
    begins, ends = np.flatnonzero(gap & ~np.roll(gap, 1)), np.flatnonzero(gap & ~np.roll(gap, -1))
    found = []
    for side, pressure, row in (("low", sides[0], 1), ("high", sides[1], -2)):
        full = solution.kind[begins - 1, row] != CAVITY
        for end, nodes in (("inlet", ends), ("outlet", begins[full])):
            differences = solution.state.pressure[nodes, row] - pressure
            largest = max(abs(pressure), *np.abs(solution.state.pressure[nodes, row]), 0.0)
            if nodes.size and np.abs(differences).max() > PRESSURE_TOLERANCE * largest:
                found.append(Jump(end=end, side=side, difference=float(differences[np.abs(differences).argmax()])))
    return tuple(found)


def infinite_flows(solution: Solution) -> frozenset[str]:
    """The names of the quantities that are infinite because the pressure jumps at a corner."""
    names: set[str] = set()
    for jump in jumps(solution):
        names |= {f"{jump.end}_flow", f"{jump.end}_flow_per_width", f"side_leakage_{jump.side}", "side_leakage"}
    return frozenset(names)


def unknown_by_infinite_flows(solution: Solution) -> frozenset[str]:
    """The names of the flows that are infinite at corners, and of the temperatures and heats that follow from them."""
    flows = infinite_flows(solution)
    return flows | {*CARRIED, *PUMPED} if flows else flows
