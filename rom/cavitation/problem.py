"""A film to be solved: its shape, sliding speed, lubricant and boundary conditions."""

from dataclasses import dataclass, field, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.shape import Shape, Thickness
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.laws import Compressibility, Piezoviscosity
from roughfilm.rom.lubricants.viscosity import ConstantViscosity


@dataclass(frozen=True, kw_only=True)
class Problem:
    """Flow of one lubricant between a shaped wall and a flat sliding one, whose filling does not change in time.

    Attributes
    ----------
    shape : the film.
    ends : boundary conditions; the inlet is the end from which the sliding wall carries lubricant in.
    speed : speed of the sliding wall, m/s, or rad/s where x is an angle; negative towards decreasing x.
    viscosity : η0, viscosity at the cavitation pressure, Pa s.
    compressibility, piezoviscosity : density and viscosity over pressure.
    opening : opening(x, y), the velocity ∂h/∂t at which the walls part, m/s, vectorised; None if they do not.
    """

    shape: Shape
    ends: Ends
    speed: float
    viscosity: float
    compressibility: Compressibility = field(default_factory=Incompressible)
    piezoviscosity: Piezoviscosity = field(default_factory=ConstantViscosity)
    opening: Thickness | None = None

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa."""
        return self.compressibility.compression(pressure)

    def mobility(self, pressure: Array) -> tuple[Array, Array]:
        """φ = θ η0/η and dφ/dp, 1/Pa."""
        excess, excess_slope = self.compressibility.compression(pressure)
        fluidity, fluidity_slope = self.piezoviscosity.fluidity(pressure, self.viscosity)
        return (1 + excess) * fluidity, excess_slope * fluidity + (1 + excess) * fluidity_slope

    @property
    def initial_compressibility(self) -> float:
        """dθ/dp at the cavitation pressure, 1/Pa."""
        return float(self.compressibility.compression(np.zeros(1))[1][0])


def unchanging(problem: Problem) -> Problem:
    """The same film with a lubricant of constant density and viscosity."""
    return replace(problem, compressibility=Incompressible(), piezoviscosity=ConstantViscosity())
