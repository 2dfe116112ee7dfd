"""Stiffness and damping of a film: the forces on its wall for small motions about an equilibrium."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, trial_at
from roughfilm.rom.cavitation.motion.film import MovingFilm


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


def coefficients(film: MovingFilm, at: Instant, *, speed: float) -> Coefficients:
    """The stiffness and damping of a steady film, from the derivatives of Newton's method.

    With the balances R(u, q) + ∂m(u, q)/∂t = 0 of the unknowns u, where m is the volume at the nodes, a motion
    q + δq exp(iωt) changes the unknowns by δu = (u₀ + iω u₁ + …) δq with

        u₀ = -A⁻¹ ∂R/∂q,    u₁ = -A⁻¹ (∂m/∂q + ∂m/∂u u₀),    A = ∂R/∂u,

    and the force ∫ p ∂h/∂q dA accordingly. The fronts of the film move with it, cavities are included: where they
    begin, p = ∂p/∂n = 0 holds for the moving front, and what they carry reaches the films behind them. The pressure
    behind a restrictor changes too. Derivatives by q are central differences, of second order.

    Source: Lund and Thomsen 1978 for the linearisation; the volume of cavities after Elrod 1981,
    doi:10.1115/1.3251669.
    """
    count = at.place.size
    nothing = np.zeros((count, count))
    drive = Drive(speed=speed, force=np.zeros(count), stiffness=nothing, free=np.ones(count, dtype=bool))
    trial = trial_at(film, at, drive).sample().evaluate()
    areas, thickness = film.grid.areas, trial.faces.thickness
    gap, rate = film.gap(thickness), film.gap_rate(thickness)
    excess, slope = film.problem.compression(trial.pressure)
    by_unknown = areas * gap * np.where(trial.kind == FILM, slope, np.where(trial.kind == CAVITY, 1.0, 0.0))
    by_place = (areas * rate * (trial.fill + excess))[..., None] * film.at_nodes
    still = trial.respond(-trial.by_coordinates(central=True))
    moving = trial.respond(-(by_place + by_unknown[..., None] * still.change))
    stiffness = trial.contact.stiffness - trial.force_of(still)
    return Coefficients(stiffness=stiffness, damping=-trial.force_of(moving))
