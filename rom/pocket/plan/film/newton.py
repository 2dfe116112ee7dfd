"""Newton's method for the flow of a film in plan at one Reynolds number."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.basis import Basis
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow, Velocities
from roughfilm.rom.pocket.plan.film.krylov import minimal_residual
from roughfilm.rom.pocket.plan.film.parallel import ParallelFilm
from roughfilm.rom.pocket.plan.film.sheet import Sheet

NEWTON_STEPS = 12
"""Largest number of Newton steps at one Reynolds number."""

MAX_PRODUCTS = 240
"""Largest number of products with the matrix in a Newton step."""

FORCING = (1e-4, 1e-2)
"""Smallest and largest tolerance of the linear system of a Newton step, relative to its right-hand side."""

TOLERANCE_SHARE = 0.1
"""Tolerance of the last linear system over the tolerance of Newton's method."""

RESPONSE_TOLERANCE = 1e-6
"""Tolerance of the linear response to a force, relative to the force."""


@dataclass(frozen=True, kw_only=True)
class LinearFilm:
    """The equations of a film, linear about a flow, with their preconditioner."""

    film: Film
    parallel: ParallelFilm
    flow: SheetFlow
    velocities: Velocities

    def response(self, imbalance: Array, *, tolerance: float) -> SheetFlow | None:
        """The change of the flow that removes an imbalance, given as a flat vector; None if it is not found."""
        shape = self.flow.shape

        def changed(vector: Array) -> Array:
            return self.film.change(self.velocities, SheetFlow(flat=vector, shape=shape)).flat

        def preconditioned(vector: Array) -> Array:
            return self.parallel.solve(SheetFlow(flat=vector, shape=shape)).flat

        found = minimal_residual(
            changed, -imbalance, preconditioner=preconditioned, tolerance=tolerance, most=MAX_PRODUCTS
        )
        return SheetFlow(flat=found.solution, shape=shape) if found.residual <= tolerance else None


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A flow, its linear equations if it converged, its residual and the number of Newton steps."""

    flow: SheetFlow
    linear: LinearFilm | None
    residual: float
    steps: int


def newton(sheet: Sheet, basis: Basis, reynolds_number: float, flow: SheetFlow | None, tolerance: float) -> Solved:
    """The flow at one Reynolds number from that at another one, or from shear alone.

    The linear systems are solved the better the smaller the residual is.
    """
    film = Film(sheet=sheet, basis=basis, reynolds_number=reynolds_number)
    parallel, least, residual = ParallelFilm.of(film), np.inf, np.inf
    flow = flow or film.still()
    for steps in range(NEWTON_STEPS + 1):
        velocities = film.velocities(flow)
        imbalance = film.imbalance(flow, velocities)
        residual = float(np.abs(imbalance.flat).max() / film.force(flow, velocities))
        linear = LinearFilm(film=film, parallel=parallel, flow=flow, velocities=velocities)
        if residual <= tolerance and steps:
            return Solved(flow=flow, linear=linear, residual=residual, steps=steps)
        if not residual < 100 * least or steps == NEWTON_STEPS:
            break
        least = min(least, residual)
        forcing = min(max(TOLERANCE_SHARE * max(residual, tolerance / residual), FORCING[0]), FORCING[1])
        change = linear.response(imbalance.flat, tolerance=forcing)
        if change is None:
            break
        flow = SheetFlow(flat=flow.flat + change.flat, shape=flow.shape)
    return Solved(flow=flow, linear=None, residual=residual, steps=steps)
