"""A liquid as the energy equations of a film use it: viscosity and heat over temperature."""

from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array

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
