"""Stiffness and damping of a film: the forces on its wall for small motions about an equilibrium."""

from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY, FIXED
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, Response, Trial, trial_at
from roughfilm.rom.cavitation.motion.film import MovingFilm

Impedance = NDArray[np.complex128]
"""Z = K + iωB of coordinates, shape (coordinates, coordinates), N/m (N, N m where a coordinate is an angle)."""


@dataclass(frozen=True, kw_only=True)
class Coefficients:
    """The force δF = -K δq - B δq̇ of a film and of contact on its coordinates, for slow small motions of all of them.

    Attributes
    ----------
    stiffness : K, shape (coordinates, coordinates), N/m (N, N m where a coordinate is an angle).
    damping : B of the same shape, N s/m.
    """

    stiffness: Array
    damping: Array


class SmallMotion:
    """A steady film whose wall moves by δq exp(iωt), from the derivatives of Newton's method.

    With the balances R(u, q) + ∂m(u, q)/∂t = 0 of the unknowns u, where m is the volume at the nodes, the unknowns
    change by δu exp(iωt) and the force by -Z δq exp(iωt) with

        (A + iω ∂m/∂u) δu = -(∂R/∂q + iω ∂m/∂q) δq,    A = ∂R/∂u,

    to the first order in δq, at every ω. The fronts of the film move with it, cavities are included: where they begin,
    p = ∂p/∂n = 0 holds for the moving front, and what they carry reaches the films behind them after the time that it
    takes. The pressure behind a restrictor changes too. Derivatives by q are central differences, of second order.

    Parameters
    ----------
    film : the film.
    at : its steady state.
    speed : speed of the sliding wall, m/s, at least 0.

    Source: Lund and Thomsen 1978 for the linearisation; the volume of cavities after Elrod 1981,
    doi:10.1115/1.3251669.
    """

    def __init__(self, film: MovingFilm, at: Instant, *, speed: float) -> None:
        count = at.place.size
        nothing = np.zeros((count, count))
        drive = Drive(speed=speed, force=np.zeros(count), stiffness=nothing, free=np.ones(count, dtype=bool))
        self.trial: Trial = trial_at(film, at, drive).sample().evaluate()
        trial, areas, thickness = self.trial, film.grid.areas, self.trial.faces.thickness
        gap, rate = film.gap(thickness), film.gap_rate(thickness)
        excess, slope = film.problem.compression(trial.pressure)
        self.by_unknown = areas * gap * np.where(trial.kind == CAVITY, 1.0, slope)
        self.by_place = (areas * rate * (trial.fill + excess))[..., None] * film.at_nodes
        self.steady = trial.by_coordinates(central=True)

    @property
    def has_memory(self) -> bool:
        """Whether the film stores liquid apart from its thickness; else Z = K + iωB with one K and one B at every ω."""
        return bool(self.by_unknown[self.trial.kind < FIXED].any())

    @cached_property
    def _still(self) -> Response:
        """The changes by a displacement at rest."""
        return self.trial.respond(-self.steady)

    @cached_property
    def slow(self) -> Coefficients:
        """K and B in the limit of slow motions.

        With δu = (u₀ + iω u₁ + …) δq, u₀ = -A⁻¹ ∂R/∂q and u₁ = -A⁻¹ (∂m/∂q + ∂m/∂u u₀).
        """
        trial = self.trial
        moving = trial.respond(-(self.by_place + self.by_unknown[..., None] * self._still.change))
        stiffness = trial.contact.stiffness - trial.force_of(self._still)
        return Coefficients(stiffness=stiffness, damping=-trial.force_of(moving))

    def impedance(self, frequency: float) -> Impedance:
        """Z(ω) = K(ω) + iω B(ω) of all coordinates.

        Parameters
        ----------
        frequency : ω, rad/s, at least 0.
        """
        if not self.has_memory:
            return self.slow.stiffness + 1j * frequency * self.slow.damping
        trial = copy(self.trial)
        trial.linear = replace(trial.linear, centre=trial.linear.centre + 1j * frequency * self.by_unknown)
        trial.factors = None
        response = trial.respond(-(self.steady + 1j * frequency * self.by_place))
        return np.asarray(trial.contact.stiffness - trial.force_of(response), dtype=np.complex128)


def coefficients(film: MovingFilm, at: Instant, *, speed: float) -> Coefficients:
    """The stiffness and damping of a steady film for slow motions, see :class:`SmallMotion`."""
    return SmallMotion(film, at, speed=speed).slow
