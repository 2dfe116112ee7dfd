"""The temperature of a film in time, as one more unknown of a march."""

import math
from typing import Protocol

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm


class Warming(Protocol):
    """How the temperature T of a film follows its flow: τ dT/dt = T_eq - T, where T_eq depends on the film."""

    @property
    def time_constant(self) -> float:
        """The time constant τ, s; 0 for a film whose temperature is T_eq at all times."""
        ...

    @property
    def coldest(self) -> float:
        """The lowest temperature of what takes the heat of the film away, K, below which no film cools."""
        ...

    def film(self, film: MovingFilm, temperature: float) -> MovingFilm:
        """The film whose liquid has the viscosity at a temperature, K."""
        ...

    def balanced(self, time: float, instant: Instant, velocity: Array, temperature: float, *, turned: bool) -> float:
        """T_eq, K, of a film whose liquid has a temperature, K.

        Parameters
        ----------
        time : time, s.
        velocity : velocities of the coordinates.
        turned : whether the wall slides towards decreasing x.
        """
        ...

    def slope(self, balanced: float, temperature: float) -> float:
        """About dT_eq/dT where the film is at a temperature, K; at most 0."""
        ...

    def sensitivity(self, temperature: float) -> float:
        """|d ln η/dT| at a temperature, K."""
        ...


def expected(times: tuple[float, ...], temperatures: tuple[float, ...], time: float, coldest: float) -> float:
    """The temperature at a time, K, from those at one or two times before, the latest first: linear, or constant.

    It is not below the lowest that a film can have or had: without a time constant temperatures jump from step to step.
    """
    if len(times) < 2:
        return temperatures[0]
    slope = (temperatures[0] - temperatures[1]) / (times[0] - times[1])
    return max(temperatures[0] + slope * (time - times[0]), min(coldest, *temperatures))


def following(warming: Warming, balanced: float, temperature: float, rate: float, memory: float) -> float:
    """The temperature T₊ at the end of a step, K: τ (a T₊ - s) = T_eq + S (T₊ - T) - T₊ with the slope S of T_eq.

    Parameters
    ----------
    balanced : T_eq of the film at the temperature T.
    temperature : T, K.
    rate, memory : a, 1/s, and s, K/s, of dT/dt ≈ a T₊ - s.
    """
    slope, tau = warming.slope(balanced, temperature), warming.time_constant
    return (tau * memory + balanced - slope * temperature) / (tau * rate + 1 - slope)


UNKNOWN = math.nan
"""Temperature of a film that has none."""
