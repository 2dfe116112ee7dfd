"""The mean temperatures of a film whose walls take no heat."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm, Mixture, hottest, start_of
from roughfilm.rom.bearing.thermal.field.mixing import FIRST_SLOPE, at_mixture, new_lubricant, replaced, returning
from roughfilm.rom.bearing.thermal.field.solve import solve_heated
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.temperature.mean import MeanTemperature, mean_temperature


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
        new = new_lubricant(scene, solution, liquid.temperature)
        cooled, back = replaced(scene, solution, liquid), returning(scene, solution, new)

        def temperatures(inlet: float | None, known: MeanTemperature | None) -> MeanTemperature:
            entering = new if inlet is None or back is None else np.where(back.inlet, inlet, new)
            start = start_of(near, solution) if known is None else known.temperature
            return mean_temperature(solution, liquid, entering=entering, exchange=cooled, wall=new, start=start)

        mixture = None
        if back is None:
            found = temperatures(None, None)
        else:
            known = None if near is None else near.inlet
            first, slope = (back.new, FIRST_SLOPE * back.share) if known is None else (known.temperature, known.slope)
            found, inlet, slope = at_mixture(
                temperatures, lambda one: back.mixture(liquid, one.temperature), first, slope, None
            )
            mixture = Mixture(temperature=inlet, slope=slope)
        generated = float(found.dissipation.sum())
        return HeatedFilm(
            grid=solution.grid,
            temperature=found.temperature,
            viscosities=found.viscosities,
            highest=float(found.temperature.max()),
            place=hottest(found.temperature, solution.grid),
            inlet=mixture,
            outlet=None if np.isnan(found.outlet_temperature) else found.outlet_temperature,
            generated=generated,
            to_lubricant=generated - found.stored,
            to_fixed_wall=0.0,
            to_sliding_wall=0.0,
            imbalance=found.imbalance,
        )


solve_adiabatic = partial(solve_heated, heating=AdiabaticWalls)
"""The solver of the model ``adiabatic``."""
