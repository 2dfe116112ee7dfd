"""The thermal boundary conditions of the two walls of a film."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.solve import Solution


@dataclass(frozen=True)
class InsulatedWall:
    """A wall that takes no heat."""


@dataclass(frozen=True, kw_only=True)
class WallAtTemperature:
    """A wall at a given temperature.

    Attributes
    ----------
    temperature : temperature, K, a number or of shape (nx, ny).
    """

    temperature: float | Array


@dataclass(frozen=True, kw_only=True)
class ConductingWall:
    """A wall that conducts heat to surroundings, q = (T - T_a)/R.

    Attributes
    ----------
    resistance : R = d/k + 1/α of a layer of thickness d, conductivity k and heat transfer coefficient α, K m²/W; >= 0.
    surroundings : temperature T_a of the surroundings, K, a number or of shape (nx, ny).
    """

    resistance: float
    surroundings: float | Array


@dataclass(frozen=True)
class TurningWall:
    """A sliding wall that passes the whole film: its temperature is uniform, and in sum the film gives it no heat."""


@dataclass(frozen=True, kw_only=True)
class SlidingHalfSpace:
    """A sliding wall that is thick against the depth of its heated layer, T = T_in + ∫ q(x') dx'/√(π k ρc u (x - x')).

    Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids, 2nd edition, section 2.9.

    Attributes
    ----------
    conductivity : k, W/(m K).
    heat_capacity : ρc, heat capacity of a volume, J/(m³ K).
    temperature : temperature T_in at which the wall enters the film, K.
    """

    conductivity: float
    heat_capacity: float
    temperature: float


NO_WALL = 1e9
"""Resistance of a wall in a gap between films, K m²/W, through which hardly any heat passes."""

FixedWall = InsulatedWall | WallAtTemperature | ConductingWall
SlidingWall = FixedWall | TurningWall | SlidingHalfSpace


@dataclass(frozen=True, kw_only=True)
class WallCondition:
    """The condition a (T - T₀ - T_a) = b q of a wall, with the heat flux q from the lubricant into the wall, W/m².

    Attributes
    ----------
    holds : a, 1, or 0 for a wall that takes no heat.
    resistance : b, K m²/W, shape (nx, ny).
    outside : T_a, the temperature outside above that of the supply T₀, K, shape (nx, ny).
    history : for a half-space, M in T_a = T_in + M q of the nodes upstream, shape (nx, nx); else of shape (0, 0).
    """

    holds: float
    resistance: Array
    outside: Array
    history: Array


def condition(
    wall: SlidingWall, solution: Solution, filling: Array, supply: float, temperature: float
) -> WallCondition:
    """The condition of a wall on the grid of a film; in gaps between films no heat passes it.

    Parameters
    ----------
    supply : temperature T₀ of the supplied liquid, K.
    filling : part of the width that streamers of a cavity fill, 1 in the film, shape (nx, ny).
    temperature : temperature from which the search for that of a turning wall starts, K.

    Raises
    ------
    InputError
        If a resistance is negative, or a half-space slides past a film without an inlet or does not slide.
    """
    match wall:
        case InsulatedWall():
            return _uniform(solution, 0.0, 1.0, 0.0)
        case WallAtTemperature():
            return _uniform(solution, 1.0, 0.0, wall.temperature - supply)
        case TurningWall():
            return _uniform(solution, 1.0, 0.0, temperature - supply)
        case ConductingWall():
            if not 0 <= wall.resistance < np.inf:
                raise InputError(f"wall.resistance: got {wall.resistance:g} K m²/W; it must be finite and >= 0")
            return _uniform(solution, 1.0, wall.resistance, wall.surroundings - supply)
    history = heating_of_half_space(wall, solution)
    return WallCondition(
        holds=1.0,
        resistance=np.diag(history)[:, None] * filling,
        outside=np.full(solution.grid.shape, wall.temperature - supply),
        history=np.tril(history, -1),
    )


def heating_of_half_space(wall: SlidingHalfSpace, solution: Solution) -> Array:
    """M in T = T_in + M q at the nodes along a row, K m²/W, lower triangular, shape (nx, nx).

    The flux q is linear between nodes, and the integrals over the intervals are exact: second-order accurate. The first
    node has the mean temperature of its half cell. In polar coordinates the radius cancels.

    Raises
    ------
    InputError
        If the film has no inlet, or the wall does not slide.
    """
    x, speed = solution.grid.x, solution.problem.speed
    if solution.network.periodic[0] or not speed > 0:
        raise InputError(
            f"sliding_wall: got a half-space at the speed {speed:g} past a film "
            f"{'without' if solution.network.periodic[0] else 'with'} an inlet; it must slide past a film with one, "
            "else take a turning wall"
        )
    far = np.maximum(x[:, None] - x[:-1], 0.0)
    near = np.maximum(x[:, None] - x[1:], 0.0)
    first = 2 * (np.sqrt(far) - np.sqrt(near))
    second = 2 / 3 * (far**1.5 - near**1.5)
    length = np.diff(x)
    heating = np.zeros((x.size, x.size))
    heating[:, :-1] += (second - near * first) / length
    heating[:, 1:] += np.where(far > 0, far * first - second, 0.0) / length
    heating[0, 0] = 4 / 3 * np.sqrt(length[0] / 2)
    return np.asarray(heating / np.sqrt(np.pi * wall.conductivity * wall.heat_capacity * speed))


def _uniform(solution: Solution, holds: float, resistance: float, outside: float | Array) -> WallCondition:
    shape = solution.grid.shape
    values = np.full(shape, resistance)
    for nodes in gaps(solution.problem.shape, solution.grid):
        values[nodes[1:-1]] = NO_WALL
    return WallCondition(
        holds=holds,
        resistance=values,
        outside=np.full(shape, outside),
        history=np.zeros((0, 0)),
    )
