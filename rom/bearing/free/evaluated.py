"""The quantities of a film whose wall moves freely, on its grids, with what flow factors and contact pressures add."""

from collections.abc import Mapping
from dataclasses import dataclass

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.equilibrium.grids import FILM_RESIDUAL, FILM_STEP, converted
from roughfilm.rom.bearing.free.lay import lay_error
from roughfilm.rom.bearing.free.solve import FreeSolution, closer, placed
from roughfilm.rom.bearing.quantities import Outputs
from roughfilm.rom.cavitation.solve import Solution

ONE_SIDED = ("side_leakage_low", "side_leakage_high")
"""Quantities that a cross flow changes with its sign."""


@dataclass(frozen=True, kw_only=True)
class Evaluated:
    """The film and its quantities on each grid, the finest first, and uncertainties of flow factors and contact."""

    levels: tuple[tuple[Solution, Mapping[str, Quantity]], ...]
    of_factors: Mapping[str, float]


def evaluated(free: FreeSolution, outputs: Outputs, *, known_from: float | None = None) -> Evaluated:
    """Evaluate a film; under a load the uncertainties of factors include the motion of the wall that they cause.

    Parameters
    ----------
    outputs : the functions that evaluate the film.
    known_from : the film thickness from which the flow factors are known, m; None if they are known for any.
    """
    scenes, solutions = free.scenes, free.solutions
    levels = tuple((solution, outputs.quantities(at, solution)) for at, solution in zip(scenes, solutions, strict=True))
    if solutions[0].problem.shape.roughness is None:
        return Evaluated(levels=levels, of_factors={})
    compared = min(1, len(levels) - 1)
    at, (solution, quantities) = scenes[compared], levels[compared]
    known = at if known_from is None else at.moved(at.geometry.at_film(known_from))
    one, instant = free.films[compared], free.instants[compared]
    own = outputs.factor_uncertainties(known, solution, quantities)
    even, odd = (lay_error(solution, even=one.solved.halved), lay_error(solution, even=False))
    of_factors = {
        name: value + (odd if name in ONE_SIDED else even) * abs(quantities[name].value) for name, value in own.items()
    }
    if one.scene.load is not None:
        step = FILM_STEP * one.solved.room(instant.place)
        moved = closer(one, instant, -step, tolerance=FILM_RESIDUAL)
        others = outputs.quantities(placed(one, moved), one.solution(moved))
        values, near = ({name: one.value for name, one in of.items()} for of in (quantities, others))
        of_factors = converted(of_factors, values, near, step)
    return Evaluated(levels=levels, of_factors=of_factors)
