"""Newton's method for the flow of a film in plan at one Reynolds number."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow, Velocities
from roughfilm.rom.pocket.plan.film.krylov import minimal_residual
from roughfilm.rom.pocket.plan.film.parallel import ParallelFilm
from roughfilm.rom.pocket.plan.film.sheet import Sheet
from roughfilm.rom.thin_film.basis import Basis
from roughfilm.rom.thin_film.newton import NEWTON_STEPS

MAX_PRODUCTS = 360
"""Largest number of products with the matrix in a Newton step."""

FORCING = (1e-3, 1e-2)
"""Smallest and largest tolerance of the linear system of a Newton step, relative to its right-hand side."""

TOLERANCE_SHARE = 0.1
"""Tolerance of the last linear system over the tolerance of Newton's method."""


@dataclass(frozen=True, kw_only=True)
class LinearFilm:
    """The equations of a film, linear about a flow, with their preconditioner and the residual of the flow."""

    film: Film
    parallel: ParallelFilm
    flow: SheetFlow
    velocities: Velocities
    residual: float

    def response(self, imbalance: Array, *, tolerance: float) -> tuple[SheetFlow | None, int]:
        """The change of the flow that removes an imbalance, None if it is not found, and the number of products.

        The imbalance is a flat vector.
        """
        shape = self.flow.shape

        def changed(vector: Array) -> Array:
            return self.film.change(self.velocities, SheetFlow(flat=vector, shape=shape)).flat

        def preconditioned(vector: Array) -> Array:
            return self.parallel.solve(SheetFlow(flat=vector, shape=shape)).flat

        found = minimal_residual(
            changed, -imbalance, preconditioner=preconditioned, tolerance=tolerance, most=MAX_PRODUCTS
        )
        change = SheetFlow(flat=found.solution, shape=shape) if found.residual <= tolerance else None
        return change, found.products


def attempt(
    sheet: Sheet, basis: Basis, reynolds_number: float, flow: SheetFlow, tolerance: float
) -> tuple[SheetFlow, LinearFilm | None, int, int]:
    """The flow at one Reynolds number, its linear equations (None without convergence), and its cost.

    The cost is the number of steps and that of products with their matrices. The tolerance of the linear systems
    decreases with the residual.
    """
    film = Film(sheet=sheet, basis=basis, reynolds_number=reynolds_number)
    parallel, least, steps = ParallelFilm.of(film), np.inf, 0
    total = 0
    while True:
        velocities = film.velocities(flow)
        imbalance = film.imbalance(flow, velocities)
        residual = float(np.abs(imbalance.flat).max() / film.force(flow, velocities))
        linear = LinearFilm(film=film, parallel=parallel, flow=flow, velocities=velocities, residual=residual)
        if residual <= tolerance and steps:
            return flow, linear, steps, total
        if not residual < 100 * least or steps == NEWTON_STEPS:
            return flow, None, steps, total
        least = min(least, residual)
        forcing = min(max(TOLERANCE_SHARE * max(residual, tolerance / residual), FORCING[0]), FORCING[1])
        change, products = linear.response(imbalance.flat, tolerance=forcing)
        total += products
        if change is None:
            return flow, None, steps, total
        flow, steps = SheetFlow(flat=flow.flat + change.flat, shape=flow.shape), steps + 1
