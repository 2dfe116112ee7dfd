"""The interface of a lubricant that the solvers use, and viscosities that vary over a film and across it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from roughfilm.contact.foundation.arrays import Array


class Fluid(Protocol):
    """Density and viscosity over pressure; arrays have the shape of ``pressure``, Pa above cavitation pressure."""

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa."""
        ...

    def mobility(self, pressure: Array) -> tuple[Array, Array]:
        """φ = θ η0/η and dφ/dp, 1/Pa."""
        ...


@dataclass(frozen=True, kw_only=True)
class Viscosities:
    """The viscosities of a film at positions, each of their shape, at the cavitation pressure.

    With the viscosity η(z) at the distance z from the sliding wall, F₀ = ∫ dz/η, F₁ = ∫ z dz/η and
    F₂ = ∫ z² dz/η - F₁²/F₀ over the film thickness h, a film carries s u h/2 - h³/(12 η_p) ∂p/∂x along the sliding and
    -h³/(12 η_p) ∂p/∂y across it. The stress on the sliding wall against its motion is η_s u/h + s h/2 ∂p/∂x. Where η is
    uniform across the film, both viscosities are η, and s = 1. Source: Dowson 1962,
    doi:10.1016/S0020-7403(62)80038-1.

    Attributes
    ----------
    flow : η_p = h³/(12 F₂), of the flow by pressure, Pa s.
    shear : η_s = h/F₀, of the shear by sliding, Pa s.
    carried : s = 2 F₁/(h F₀), the flow by sliding over u h/2.
    """

    flow: Array
    shear: Array
    carried: Array


ViscosityField = Callable[[Array, Array], Viscosities]
"""viscosities(x, y), those at positions, vectorised."""
