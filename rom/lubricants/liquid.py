"""A liquid as the energy equations of a film use it: viscosity and heat over temperature."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array

MAX_STEPS = 100
"""Largest number of steps in which a temperature is sought; each halves an interval at least."""

HIGHEST = 1e9
"""Highest temperature that is sought, K."""

OverTemperature = Callable[[Array], tuple[Array, Array]]
"""property(T), a property and its derivative over temperatures, K, each of their shape."""


@dataclass(frozen=True, kw_only=True)
class Liquid:
    """A liquid at the cavitation pressure over the temperature T, K.

    Attributes
    ----------
    temperature : temperature T₀ of the supplied liquid, K.
    viscosity : η, Pa s, and dη/dT.
    heat : ∫ ρ c dT from T₀, J/m³, and ρ c, J/(m³ K), of a volume that is measured at T₀.
    conductivity : thermal conductivity k, W/(m K).
    """

    temperature: float
    viscosity: OverTemperature
    heat: OverTemperature
    conductivity: float

    def temperature_of(self, heat: Array) -> Array:
        """The temperatures, K, at which a volume contains heat, J/m³, more than at T₀; shape of ``heat``.

        It inverts :attr:`heat` by Newton's method, and by halving where that leaves the interval that contains the
        temperature, to rounding.

        Examples
        --------
        >>> def constant(temperature):
        ...     return 1.7e6 * (temperature - 313.15), np.full_like(temperature, 1.7e6)
        >>> liquid = Liquid(temperature=313.15, viscosity=constant, heat=constant, conductivity=0.13)
        >>> float(liquid.temperature_of(np.array([34e6]))[0])
        333.15
        """
        capacity = self.heat(np.array([self.temperature]))[1][0]
        found = self.temperature + heat / capacity
        low, high = np.zeros_like(found), np.full_like(found, HIGHEST)
        for _ in range(MAX_STEPS):
            value, slope = self.heat(found)
            error = value - heat
            low, high = np.where(error < 0, found, low), np.where(error > 0, found, high)
            step = error / slope
            if (np.abs(step) <= 1e-14 * found).all():
                break
            better = found - step
            inside = (better >= low) & (better <= high)
            found = np.where(inside, better, (low + high) / 2)
        return np.asarray(found)
