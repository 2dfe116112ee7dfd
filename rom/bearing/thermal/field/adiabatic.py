"""The mean temperatures of a film whose walls take no heat."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import mean_gap
from roughfilm.rom.bearing.thermal.field.asperity_friction import asperity_friction
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm, hottest, start_of
from roughfilm.rom.bearing.thermal.field.mixing import (
    SETTLED,
    is_seen_from_inside,
    replaced,
    seen_from_inside,
    with_entering,
)
from roughfilm.rom.bearing.thermal.field.solve import solve_heated
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.shear_thinning.film import thinned
from roughfilm.rom.temperature.dissipation import dissipation, film_flows
from roughfilm.rom.temperature.mean import MeanTemperature, mean_temperature

FREE_FILMS = 3
"""Number of films on a grid after which limited slopes of the temperature stay the same.

They would keep changing where the temperature is uneven or liquid circulates, so that films and temperatures would not
converge.
"""


@dataclass(frozen=True)
class AdiabaticWalls:
    """The mean energy equation of the films of a scene.

    Attributes
    ----------
    scene : the bearing.
    """

    scene: Bearing

    def __call__(self, solution: Solution, near: HeatedFilm | None) -> HeatedFilm:
        """The temperatures of a film, from those of a film near it.

        Raises
        ------
        ConvergenceError
            If the temperatures or the mixture at the inlet do not converge.
        """
        scene, liquid = self.scene, self.scene.lubricant.liquid
        before = near if near is not None and near.temperature.shape == solution.grid.shape else None
        slopes = before.slopes if before is not None and before.films >= FREE_FILMS else None
        boundary, at_rest = asperity_friction(scene, solution, near), viscosity_at_rest(scene, solution, near)
        at_rest, at_end = kept_at_end(solution, at_rest)
        cooled = replaced(scene, solution, liquid)

        def temperatures(entering: Array, last: MeanTemperature | None) -> MeanTemperature:
            return mean_temperature(
                solution,
                liquid,
                entering=entering,
                exchange=cooled,
                wall=entering,
                carried_over=(scene.heat or Heat()).carried_over,
                added_power=at_end if boundary is None else at_end + boundary.power,
                at_rest=at_rest,
                start=start_of(near, solution) if last is None else last.temperature,
                slopes=slopes,
            )

        found, mixture = with_entering(scene, solution, near, temperatures, lambda one: one.temperature)
        viscosities, stress = with_thinning(scene, solution, found, near)
        viscosities = seen_from_inside(viscosities, solution)
        generated = float(found.dissipation.sum())
        highest, place = hottest(found.temperature, solution)
        return HeatedFilm(
            grid=solution.grid,
            temperature=found.temperature,
            viscosities=viscosities,
            highest=highest,
            place=place,
            inlet=mixture,
            outlet=None if np.isnan(found.outlet_temperature) else found.outlet_temperature,
            generated=generated,
            to_lubricant=_taken(found),
            imbalance=found.imbalance,
            friction=None if boundary is None else boundary.friction,
            start=stress,
            settled=mixture is None or abs(mixture.error) <= SETTLED,
            slopes=found.slopes,
            films=1 if before is None else before.films + 1,
        )


def _taken(found: MeanTemperature) -> float:
    """The heat that the lubricant takes away, W: in its flows, stored where walls move, and replaced in grooves."""
    carried = sum(one.heat_out - one.heat_in for one in found.carried.values())
    return carried + found.stored + float(found.to_walls.sum())


def viscosity_at_rest(scene: Bearing, solution: Solution, near: HeatedFilm | None) -> Array | None:
    """The viscosity at rest at the temperatures of ``near``, with which a film that thins with shear was solved.

    None of a lubricant that does not thin, and of a film with the viscosity of the scene.
    """
    liquid = scene.lubricant.liquid
    if scene.lubricant.shear_thinning is None or solution.problem.at_nodes is None:
        return None
    known = start_of(near, solution)
    return liquid.viscosity(np.full(solution.grid.shape, liquid.temperature) if known is None else known)[0]


def kept_at_end(solution: Solution, at_rest: Array | None) -> tuple[Array | None, Array | float]:
    """The viscosity at rest, and the power of an end with the viscosity before it, W, which does not change with T."""
    own = solution.problem.at_nodes
    if own is None or not is_seen_from_inside(solution):
        return at_rest, 0.0
    known, power = np.array(own.shear if at_rest is None else at_rest), np.zeros(solution.grid.shape)
    known[-1] = np.inf
    power[-1] = np.maximum(dissipation(solution, film_flows(solution))[-1], 0.0)
    return known, power


def with_thinning(
    scene: Bearing, solution: Solution, found: MeanTemperature, near: HeatedFilm | None
) -> tuple[Viscosities, Array | None]:
    """The viscosities at the temperatures of a film, with its shear thinning, and the stress that this gives."""
    law, start = scene.lubricant.shear_thinning, None if near is None else near.start
    if law is None:
        return found.viscosities, None
    sheared = thinned(
        solution,
        law.curve(scene.lubricant.viscosity),
        viscosity=scene.lubricant.liquid.viscosity(found.temperature)[0],
        gap=mean_gap(solution),
        start=start if isinstance(start, np.ndarray) and start.shape[:2] == solution.grid.shape else None,
    )
    return sheared.viscosities, sheared.stress


solve_adiabatic = partial(solve_heated, heating=AdiabaticWalls)
"""The solver of the model ``adiabatic``."""
