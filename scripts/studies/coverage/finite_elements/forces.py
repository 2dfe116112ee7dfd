"""Forces on the sliding wall from the balance of the discrete equations, which converge faster than the fields."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve as solve_dense

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.coverage.finite_elements.flow import Flow

MASS = np.array([[128, 99, -36, 19], [99, 648, -81, -36], [-36, -81, 648, 99], [19, -36, 99, 128]]) / 1680
"""The integrals of products of the cubics through 0, 1/3, 2/3 and 1, from 0 to 1."""

SAMPLES = 24
"""Number of intervals on each side of a triangle among which the extreme pressures are sought."""


@dataclass(frozen=True, kw_only=True)
class Forces:
    """Forces per area on the sliding wall and its extreme pressures, in η u / Ly."""

    load: float
    friction: float
    pressure_max: float
    pressure_min: float

    @property
    def largest_pressure(self) -> float:
        """The largest magnitude of the pressure."""
        return max(self.pressure_max, -self.pressure_min)


def wall_pressure(flow: Flow) -> tuple[Array, Array]:
    """Return positions and pressures at the nodes of the sliding wall.

    The pressure is the continuous, piecewise cubic function whose integral with each shape is the force on it. The
    viscous normal stress 2 dv/dy is zero on a flat wall that slides along itself.
    """
    top = flow.spaces.top
    x = flow.spaces.nodes[0, top]
    sides = (len(top) - 1) // 3
    count = len(top) - 1  # the last node is the first one
    matrix, force = np.zeros((count, count)), np.zeros(count)
    for side in range(sides):
        own = np.arange(3 * side, 3 * side + 4) % count
        matrix[np.ix_(own, own)] += MASS * (x[3 * side + 3] - x[3 * side])
    np.add.at(force, np.arange(len(top)) % count, -flow.force_y[top])
    pressure = solve_dense(matrix, force, assume_a="pos")
    return x, np.append(pressure, pressure[0])


def forces(flow: Flow, place: float) -> Forces:
    """Return load, friction and extreme pressures of a flow, with p = 0 at a place on the sliding wall."""
    spaces = flow.spaces
    x, pressure = wall_pressure(flow)
    to_polynomial = np.linalg.inv(np.vander(np.linspace(0, 1, 4)))
    side = min(int(np.searchsorted(x[3::3], place)), len(x) // 3 - 1)
    along = (place - x[3 * side]) / (x[3 * side + 3] - x[3 * side])
    pressure = pressure - np.polyval(to_polynomial @ pressure[3 * side : 3 * side + 4], along)
    by_side = np.lib.stride_tricks.sliding_window_view(pressure, 4)[::3]
    between = by_side @ (np.vander(np.linspace(0, 1, SAMPLES + 1), 4) @ to_polynomial).T
    return Forces(
        load=float(np.diff(x[::3]) @ (by_side @ MASS.sum(axis=1))) / spaces.length,
        friction=float(flow.force_x[spaces.top].sum()) / spaces.length,
        pressure_max=max(float(between.max()), 0.0),
        pressure_min=min(float(between.min()), 0.0),
    )
