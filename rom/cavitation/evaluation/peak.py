"""The largest pressure of a film between the nodes of its grid."""

from collections.abc import Sequence

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import FILM
from roughfilm.rom.cavitation.solve import Solution


def peak_pressure(solution: Solution) -> float:
    """The largest pressure above cavitation pressure, Pa: of a parabola through the highest node and its neighbours.

    p + gᵀ(-H)⁻¹g/2 with the central differences g and H, in the directions in which the highest node lies inside a film
    with equal cells. At a break of the film thickness the pressure may have a kink; the highest node then is the peak.
    """
    pressure, nodes = solution.state.pressure, solution.grid
    shape, (i, j) = solution.problem.shape, (int(at) for at in np.unravel_index(np.argmax(pressure), pressure.shape))
    top = float(pressure[i, j])
    ways = [
        _smooth(place, at, spacing, breaks, periodic=periodic)
        for place, at, spacing, breaks, periodic in (
            (nodes.x, i, nodes.spacing_x, shape.breaks, solution.network.periodic[0]),
            (nodes.y, j, nodes.spacing_y, shape.steps_across, solution.network.periodic[1]),
        )
    ]
    around = pressure.take(range(i - 1, i + 2), axis=0, mode="wrap").take(range(j - 1, j + 2), axis=1, mode="wrap")
    film = solution.kind.take(range(i - 1, i + 2), axis=0, mode="wrap").take(range(j - 1, j + 2), axis=1, mode="wrap")
    if not (film[1 - ways[0] : 2 + ways[0], 1 - ways[1] : 2 + ways[1]] == FILM).all():
        return top
    slope = np.array([around[2, 1] - around[0, 1], around[1, 2] - around[1, 0]]) / 2
    mixed = (around[2, 2] - around[2, 0] - around[0, 2] + around[0, 0]) / 4
    bend = np.array(
        [
            [2 * top - around[2, 1] - around[0, 1], -mixed],
            [-mixed, 2 * top - around[1, 2] - around[1, 0]],
        ]
    )
    slope, bend = slope[ways], bend[np.ix_(ways, ways)]
    if not (slope.any() and np.linalg.eigvalsh(bend).min() > 0):
        return top
    offset = np.linalg.solve(bend, slope)
    return top + float(slope @ offset) / 2 if np.abs(offset).max() <= 1 else top


def _smooth(places: Array, at: int, spacing: Array, breaks: Sequence[float], *, periodic: bool) -> bool:
    """Whether a node lies between two equal cells and at no break."""
    if places.size < 3 or not (periodic or 0 < at < places.size - 1):
        return False
    before, after = spacing[at - 1], spacing[at]
    return bool(abs(before - after) <= 1e-6 * after and (np.abs(places[at] - np.array(breaks)) > 1e-6 * after).all())
