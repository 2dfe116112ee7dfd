"""Restrictors between a supply of lubricant and the film, and the inflows of a film."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from roughfilm.rom.bearing.supply.patches import Patch
from roughfilm.rom.bearing.supply.tables import Capillary, Orifice, Supply
from roughfilm.rom.cavitation.problem import Inflow, Restrictor

LAMINAR_DROP = 1e-5
"""Pressure drop of an orifice over the pressure of the supply below which its flow is taken as linear."""

MIN_DROP = 1.0
"""The smallest such pressure drop, Pa."""


@dataclass(frozen=True)
class LaminarTube:
    """Laminar flow through a tube, Q = G Δp with the ``conductance`` G, m³/(Pa s)."""

    conductance: float

    def flow(self, drop: float) -> tuple[float, float]:
        """The flow, m³/s, at a pressure drop, Pa, and its derivative, m³/(Pa s)."""
        return self.conductance * drop, self.conductance


@dataclass(frozen=True)
class SharpOrifice:
    """Flow through an orifice, Q = k Δp/(Δp² + Δp₀²)^(1/4), with the sign of Δp; Q = k √Δp where Δp is large.

    Attributes
    ----------
    factor : k = C (π d²/4) √(2/ρ), m³/(s Pa^(1/2)).
    linear : Δp₀, below which the flow is linear, Pa.
    """

    factor: float
    linear: float

    def flow(self, drop: float) -> tuple[float, float]:
        """The flow, m³/s, at a pressure drop, Pa, and its derivative, m³/(Pa s)."""
        square = drop**2 + self.linear**2
        return self.factor * drop * square**-0.25, self.factor * square**-1.25 * (drop**2 / 2 + self.linear**2)


@dataclass(frozen=True)
class GivenFlow:
    """A pump that gives the same ``rate``, m³/s, at any pressure."""

    rate: float

    def flow(self, drop: float) -> tuple[float, float]:  # noqa: ARG002
        """The flow, m³/s, at a pressure drop, Pa, and its derivative, m³/(Pa s)."""
        return self.rate, 0.0


def restrictor_of(supply: Supply, *, viscosity: float, density: float | None, pressure: float) -> Restrictor | None:
    """The restrictor of a supply; None if the film has its pressure.

    Parameters
    ----------
    viscosity : viscosity in a capillary, Pa s.
    density : density in an orifice, kg/m³.
    pressure : pressure of the supply above cavitation pressure, Pa.
    """
    match supply.capillary, supply.orifice, supply.flow:
        case Capillary(diameter=diameter, length=length), _, _:
            return LaminarTube(math.pi * diameter**4 / (128 * viscosity * length))
        case _, Orifice(diameter=diameter, coefficient=coefficient), _:
            assert density is not None
            factor = coefficient * math.pi * diameter**2 / 4 * math.sqrt(2 / density)
            return SharpOrifice(factor, max(LAMINAR_DROP * pressure, MIN_DROP))
        case _, _, float(rate):
            return GivenFlow(rate)
        case _:
            return None


def inflows(
    found: Sequence[Patch],
    supplies: Sequence[Supply],
    *,
    viscosities: Sequence[float],
    densities: Sequence[float | None],
    cavitation_pressure: float,
) -> tuple[Inflow, ...]:
    """The inflows of supplies that lie in rectangles of the film.

    Parameters
    ----------
    found : the rectangle of each supply.
    viscosities, densities : viscosity, Pa s, and density, kg/m³, of what passes the restrictor of each supply.
    cavitation_pressure : cavitation pressure above ambient, Pa.
    """
    made = []
    for supply, patch, viscosity, density in zip(supplies, found, viscosities, densities, strict=True):
        above = 0.0 if supply.pressure is None else supply.pressure - cavitation_pressure
        restrictor = restrictor_of(supply, viscosity=viscosity, density=density, pressure=above)
        depth = math.inf if supply.depth is None else supply.depth
        made.append(Inflow(covers=patch.covers, pressure=above, restrictor=restrictor, depth=depth))
    return tuple(made)
