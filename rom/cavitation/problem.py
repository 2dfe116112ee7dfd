"""A film to be solved: its shape, sliding speed, lubricant, boundary conditions and inflows."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.fluid import Viscosities, ViscosityField
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.shape import Shape, Thickness
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.laws import Compressibility, Piezoviscosity
from roughfilm.rom.lubricants.viscosity import ConstantViscosity


class Restrictor(Protocol):
    """The resistance between a supply of lubricant and the film."""

    def flow(self, drop: float) -> tuple[float, float]:
        """The flow, m³/s, at a pressure drop, Pa, and its derivative, m³/(Pa s)."""
        ...


Covers = Callable[[Array, Array], NDArray[np.bool_]]
"""covers(x, y), whether positions lie in a part of the film, vectorised."""


@dataclass(frozen=True, kw_only=True)
class Inflow:
    """A part of the film in which the pressure is uniform, since lubricant is supplied there.

    Attributes
    ----------
    covers : covers(x, y), whether positions lie in it, vectorised.
    pressure : pressure of the supply above cavitation pressure, Pa.
    restrictor : resistance between the supply and the film; without one the film has the pressure of the supply.
    depth : depth d below the wall around it, m; the friction inside is that of a closed recess, 4ηu/(h + d).
    """

    covers: Covers
    pressure: float
    restrictor: Restrictor | None = None
    depth: float = math.inf


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
    inflows : parts of the film in which lubricant is supplied.
    viscosities : viscosities(x, y), those at the cavitation pressure; None if they are ``viscosity`` everywhere.
    at_nodes : these viscosities at the nodes of a grid, shape (nx, ny), of a problem on that grid.
    """

    shape: Shape
    ends: Ends
    speed: float
    viscosity: float
    compressibility: Compressibility = field(default_factory=Incompressible)
    piezoviscosity: Piezoviscosity = field(default_factory=ConstantViscosity)
    opening: Thickness | None = None
    inflows: tuple[Inflow, ...] = ()
    viscosities: ViscosityField | None = None
    at_nodes: Viscosities | None = None

    def on(self, grid: Grid) -> "Problem":
        """The problem on a grid, with the viscosities at its nodes."""
        if self.viscosities is None:
            return self
        return replace(self, at_nodes=self.viscosities(*np.meshgrid(grid.x, grid.y, indexing="ij")))

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa."""
        return self.compressibility.compression(pressure)

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """η0/η and its derivative, 1/Pa, with the viscosity η0 of the place at the cavitation pressure."""
        return self.piezoviscosity.fluidity(pressure, self.viscosity if self.at_nodes is None else self.at_nodes.flow)

    def mobility(self, pressure: Array) -> tuple[Array, Array]:
        """φ = θ η0/η and dφ/dp, 1/Pa."""
        excess, excess_slope = self.compressibility.compression(pressure)
        fluidity, fluidity_slope = self.fluidity(pressure)
        return (1 + excess) * fluidity, excess_slope * fluidity + (1 + excess) * fluidity_slope

    @property
    def initial_compressibility(self) -> float:
        """dθ/dp at the cavitation pressure, 1/Pa."""
        return float(self.compressibility.compression(np.zeros(1))[1][0])


def unchanging(problem: Problem) -> Problem:
    """The same film with a lubricant of constant density and viscosity."""
    return replace(problem, compressibility=Incompressible(), piezoviscosity=ConstantViscosity())
