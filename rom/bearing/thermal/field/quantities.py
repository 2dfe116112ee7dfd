"""The quantities, fields and uncertainties of a film with temperatures."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.units import ZERO_CELSIUS, Quantity
from roughfilm.rom.bearing.quantities import Fields, Outputs, scene_positions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.asperity_friction import with_friction
from roughfilm.rom.bearing.thermal.field.coupling import FIELD_TOLERANCE, Heating
from roughfilm.rom.bearing.thermal.field.films import HeatedSolution
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm
from roughfilm.rom.bearing.thermal.field.hot_spots import circulating_uncertainty, keeps_its_heat
from roughfilm.rom.bearing.thermal.field.residual import iteration
from roughfilm.rom.bearing.thermal.leading import leading_input, leading_warning
from roughfilm.rom.bearing.uncertainty import HOTTEST_PLACE
from roughfilm.rom.cavitation.grid import film_areas
from roughfilm.rom.cavitation.solve import Solution

HIGHEST = "temperature_max"

CIRCULATES = (
    f"{HIGHEST}: unknown uncertainty, as it grows with the resolution: lubricant turns around the bore more than once "
    "before it leaves, and gives off no heat; take across with heat.fixed_wall or heat.sliding_wall"
)
"""Warning about the largest temperature of lubricant that circulates."""

SLOWEST = 0.9
"""Contraction above which the error that an iteration leaves is not extrapolated farther."""


@dataclass(frozen=True)
class HeatedOutputs:
    """The functions that evaluate a film with temperatures.

    Attributes
    ----------
    base : those of the isothermal film.
    heating : the energy equation, for films that have no temperatures yet.
    """

    base: Outputs
    heating: Heating[HeatedFilm]

    @property
    def outputs(self) -> Outputs:
        """These functions."""
        return Outputs(
            quantities=self.quantities,
            factor_uncertainties=self.factor_uncertainties,
            fields=self.fields,
            iteration_uncertainties=iteration_uncertainties,
            warnings=self.warnings,
            details=details,
            of_finest=self.of_finest,
            estimates=(*self.base.estimates, HIGHEST),
        )

    def heated(self, solution: Solution) -> HeatedFilm:
        """The temperatures of a film."""
        if isinstance(solution, HeatedSolution):
            known: HeatedFilm = solution.heated
            return known
        return self.heating(solution, None)

    def quantities(self, scene: Bearing, solution: Solution) -> dict[str, Quantity]:
        """The quantities of the isothermal model, and temperatures and heat flows.

        ``temperature_max`` is the highest temperature in the film, at ``temperature_max_x`` and ``temperature_max_y``;
        ``temperature_mean`` the mean over the film, ``inlet_temperature`` that of the mixture of new and hot lubricant
        at the inlet, and ``outlet_temperature`` that of the lubricant that leaves, by its flow. The power
        ``heat_generated`` is that of friction and of the pressures at the edges; ``heat_to_lubricant``,
        ``heat_to_fixed_wall`` and ``heat_to_sliding_wall`` take it away. ``shaft_temperature`` is that of a shaft that
        turns.
        """
        found = self.heated(solution)
        return self.base.quantities(with_friction(scene, found.friction), solution) | _quantities(solution, found)

    def factor_uncertainties(
        self, scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity]
    ) -> dict[str, float]:
        """The uncertainties that flow factors and contact pressures cause.

        A heating grows with the friction and falls with the flow of the lubricant that takes it away.
        """
        found = self.heated(solution)
        scene, heated = with_friction(scene, found.friction), _quantities(solution, found)
        plain = {name: one for name, one in quantities.items() if name not in heated}
        own = dict(self.base.factor_uncertainties(scene, solution, plain))
        relative = sum(
            max((own[name] / abs(one.value) for name, one in plain.items() if part in name and one.value), default=0.0)
            for part in ("power_loss", "flow")
        )
        supplied = scene.lubricant.liquid.temperature - ZERO_CELSIUS
        for name, one in heated.items():
            size = one.value - supplied if one.unit == "degC" else 0.0 if name in HOTTEST_PLACE else one.value
            own[name] = relative * abs(size)
        return own

    def fields(self, scene: Bearing, solution: Solution) -> Fields:
        """The fields of the isothermal model, temperatures, °C, and the viscosity under pressure, Pa s."""
        found, problem = self.heated(solution), solution.problem
        own = problem.viscosity if problem.at_nodes is None else problem.at_nodes.flow
        return {
            **self.base.fields(scene, solution),
            "temperature": (found.temperature - ZERO_CELSIUS, "degC"),
            **{name: (values - ZERO_CELSIUS, "degC") for name, values in found.walls.items()},
            "viscosity": (np.asarray(own / problem.fluidity(solution.state.pressure)[0]), "Pa*s"),
        }

    def of_finest(self, scene: Bearing, solution: Solution) -> Mapping[str, Quantity]:
        """The estimates of the isothermal model, with the friction of asperities at the temperature of the film."""
        return self.base.of_finest(with_friction(scene, self.heated(solution).friction), solution)

    def warnings(self, scene: Bearing, solution: Solution) -> list[str]:
        """Warnings about hot films, about the input on which they depend most, and about their iteration."""
        changes = solution.changes if isinstance(solution, HeatedSolution) else (0.0,)
        apart = [
            f"temperature: the viscosity of the film and that at its temperatures still differ by {changes[-1]:.1e} "
            f"after {len(changes)} films, above the tolerance of {FIELD_TOLERANCE:.0e}; take more cells"
        ]
        temperature = self.heated(solution).temperature
        hot = scene.lubricant.hot(float(temperature.max()))
        unsettled = apart if changes[-1] > FIELD_TOLERANCE else []
        found = self.heated(solution)
        scene = with_friction(scene, found.friction)
        if not (found.to_fixed_wall or found.to_sliding_wall):
            mean = float(temperature.mean())
            plain, liquid = self.base.quantities(scene, solution), scene.lubricant.liquid
            leading = leading_input(scene, solution, plain, liquid, mean, insulated=True)
            unsettled = [*unsettled, *leading_warning(leading)]
        circulates = isinstance(solution, HeatedSolution) and keeps_its_heat(solution)
        return [*self.base.warnings(scene, solution), *hot, *unsettled, *([CIRCULATES] if circulates else [])]


def _quantities(solution: Solution, found: HeatedFilm) -> dict[str, Quantity]:
    """The temperatures, °C, and heat flows of a film."""
    grid, shape = solution.grid, solution.problem.shape
    i, j = int(np.abs(grid.x - found.place[0]).argmin()), int(np.abs(grid.y - found.place[1]).argmin())
    areas = film_areas(shape, grid)
    degrees = {
        HIGHEST: found.highest,
        "temperature_mean": float((areas * found.temperature).sum() / areas.sum()),
        "inlet_temperature": None if found.inlet is None else found.inlet.temperature,
        "outlet_temperature": found.outlet,
        "shaft_temperature": found.shaft,
    }
    heats = {
        "heat_generated": found.generated,
        "heat_to_lubricant": found.to_lubricant,
        "heat_to_fixed_wall": found.to_fixed_wall,
        "heat_to_sliding_wall": found.to_sliding_wall,
    }
    suffix, unit = ("_per_width", "W/m") if shape.wide else ("", "W")
    values = {name: (value - ZERO_CELSIUS, "degC") for name, value in degrees.items() if value is not None}
    values |= {f"{name}{suffix}": (value, unit) for name, value in heats.items() if value is not None}
    values["temperature_max_x"] = float(scene_positions(solution)[i]), "rad" if shape.polar else "m"
    if not shape.wide:
        values["temperature_max_y"] = float(grid.y[j]), "m"
    return {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def iteration_uncertainties(
    _scene: Bearing, levels: Sequence[Solution], quantities: Mapping[str, Quantity]
) -> dict[str, float]:
    """The uncertainty of each quantity that the iteration of film and temperatures leaves, in its unit.

    An error of ln η changes loads, friction and flows by as much relative to them, and temperatures by that over the
    change of ln η with T; the largest temperature is that of one node, and another one may be warmer on a finer grid
    (:func:`roughfilm.rom.bearing.thermal.field.hot_spots.circulating_uncertainty`). Positions of nodes are uncertain by
    a cell.

    Parameters
    ----------
    levels : the films on their grids, the finest first.
    """
    solution = levels[0]
    if not isinstance(solution, HeatedSolution):
        return {}
    contraction, grid, thinning = min(solution.contraction, SLOWEST), solution.grid, _thinning(solution)
    left = solution.changes[-1] * max(contraction / (1 - contraction), 1.0)
    hotter = circulating_uncertainty(levels)
    special = {
        HIGHEST: solution.largest / thinning + hotter,
        "temperature_max_x": float(grid.spacing_x.max()) if math.isfinite(hotter) else math.inf,
        "temperature_max_y": float(grid.spacing_y.max()) if math.isfinite(hotter) else math.inf,
    }
    return {
        name: special.get(name, left / thinning if one.unit == "degC" else left * abs(one.value))
        for name, one in quantities.items()
    }


def _thinning(solution: HeatedSolution) -> float:
    """The mean change of -ln η with T in the film, 1/K."""
    temperature, viscosity = solution.heated.temperature, solution.heated.viscosities.flow
    rise = float(np.ptp(temperature))
    change = float(np.ptp(np.log(viscosity)))
    return change / rise if rise and change else 1.0


def details(solution: Solution) -> dict[str, float]:
    """The numbers of the iteration of film and temperatures, for the numerics of a result.

    They are those of :func:`roughfilm.rom.bearing.thermal.field.residual.iteration`, ``energy_imbalance``, the error of
    the heat balance, and ``heated_films``, the number of films on the grid.
    """
    if not isinstance(solution, HeatedSolution):
        return {}
    return {
        **iteration(solution),
        "energy_imbalance": solution.heated.imbalance,
        "heated_films": float(len(solution.changes)),
    }
