"""The temperatures over a film and across it, between the walls of a scene."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import mean_gap
from roughfilm.rom.bearing.thermal.exchange import conductance_of, leaves_through_the_wall
from roughfilm.rom.bearing.thermal.field.asperity_friction import asperity_friction
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm
from roughfilm.rom.bearing.thermal.field.mixing import (
    SETTLED,
    flows_back,
    is_fine,
    power_of_end,
    seen_from_inside,
    temperature_of,
    with_entering,
)
from roughfilm.rom.bearing.thermal.field.nodal import between_nodes
from roughfilm.rom.bearing.thermal.field.solve import solve_heated
from roughfilm.rom.bearing.thermal.tables import Adiabatic, Conducting, GivenTemperature, HalfSpace, Heat, Turning
from roughfilm.rom.cavitation.grid import film_areas
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.shear_thinning.film import thinned_profiles
from roughfilm.rom.temperature.across import MODES, TemperatureAcross, temperature_across
from roughfilm.rom.temperature.basis import basis
from roughfilm.rom.temperature.dissipation import film_flows
from roughfilm.rom.temperature.walls import (
    ConductingWall,
    FixedWall,
    InsulatedWall,
    SlidingHalfSpace,
    SlidingWall,
    TurningWall,
    WallAtTemperature,
)

TOLERANCE = 1e-5
"""Mean change of the temperature over its range at which its iteration stops, as that of film and temperature."""

RENEWALS = 1
"""Number of renewals of the viscosities across each film of a fine grid, since the film changes anyway.

The equilibrium of a wall that moves freely costs more than the temperatures, which are then those of each film.
"""

RENEWALS_BACK = 3
"""The same where lubricant flows back into the end of a film, where the temperature follows the film slowly."""

PATIENCE = 15
"""Number of films on a grid after which the temperatures of each film are iterated to the end.

Lubricant that circulates needs many renewals, whose slow change would otherwise look like that of the films.
"""


STAYS = (
    "temperature: thermal runaway between walls that take no heat, as walls that approach displace lubricant to all "
    "sides of a place, at which it stays; let them slide faster, give heat.fixed_wall or heat.sliding_wall, which take "
    "heat, or take heat_balance or roughfilm march"
)
"""Why the temperature of a film has no steady values, and the remedy."""


@dataclass(frozen=True)
class BetweenWalls:
    """The energy equation across the films of a scene.

    Attributes
    ----------
    scene : the bearing.
    """

    scene: Bearing

    def __call__(self, solution: Solution, near: HeatedFilm | None) -> HeatedFilm:
        """The temperatures of a film, from those of a film near it.

        Raises
        ------
        InputError
            If a wall does not suit the film.
        ConvergenceError
            If the temperatures or the mixture at the inlet do not converge, or walls that take no heat approach each
            other so fast that the lubricant of a place stays there and has no steady temperature.
        """
        try:
            return self._heated(solution, near)
        except (InputError, ConvergenceError):
            insulated = all(isinstance(wall, InsulatedWall) for wall in walls_of(self.scene, 0.0, solution))
            if self.scene.motion.approach <= 0 or not insulated:
                raise
            raise ConvergenceError(STAYS, outcome=Outcome.DIVERGED) from None

    def _heated(self, solution: Solution, near: HeatedFilm | None) -> HeatedFilm:
        scene, liquid, heat = self.scene, self.scene.lubricant.liquid, self.scene.heat or Heat()
        boundary = asperity_friction(scene, solution, near)
        sliding, fixed = walls_of(scene, liquid.temperature, solution)
        thins = scene.lubricant.shear_thinning is not None
        sheared, start = sheared_liquid(scene, solution), _start(near, solution, thins=thins)
        same = start is not None and near is not None and near.temperature.shape == solution.grid.shape
        films = near.films + 1 if same and near is not None else 1
        rough = is_fine(near, solution) and not isinstance(scene.geometry, MovingWall) and films <= PATIENCE
        renewals = (RENEWALS_BACK if flows_back(solution) else RENEWALS) if rough else None
        at_end = power_of_end(solution, start.viscosities.shear) if start is not None and same else None
        added = [one for one in (at_end, None if boundary is None else boundary.power) if one is not None]

        def temperatures(entering: Array, last: TemperatureAcross | None) -> TemperatureAcross:
            return temperature_across(
                solution,
                sheared,
                sliding_wall=sliding,
                fixed_wall=fixed,
                entering=entering,
                carried_over=heat.carried_over,
                added_power=sum(added[1:], added[0]) if added else None,
                start=start if last is None else last,
                tolerance=TOLERANCE,
                renewals=renewals,
            )

        found, mixture = with_entering(scene, solution, near, temperatures, lambda one: one.carried)
        balance, flows = found.balance, film_flows(solution, heat.carried_over)
        leaving = float(np.maximum(-flows.entering, 0.0).sum())
        spilled = balance.stored - float((flows.stored * liquid.heat(found.mean)[0]).sum())
        turning = heat.sliding_wall
        given = turning.temperature if isinstance(turning, Turning) else None
        return HeatedFilm(
            grid=solution.grid,
            temperature=found.mean,
            viscosities=seen_from_inside(found.viscosities, solution),
            highest=found.largest,
            place=found.place[:2],
            inlet=mixture,
            outlet=temperature_of(liquid, (balance.leaving + spilled) / leaving) if leaving > 0 else None,
            generated=balance.dissipation,
            to_lubricant=balance.leaving - balance.entering + balance.stored,
            to_fixed_wall=balance.fixed_wall,
            to_sliding_wall=balance.sliding_wall,
            imbalance=found.residual,
            shaft=found.shaft if given is None else given,
            friction=None if boundary is None else boundary.friction,
            walls={
                "sliding_wall_temperature": found.sliding_wall.temperature,
                "fixed_wall_temperature": found.fixed_wall.temperature,
            },
            start=found,
            films=films,
            settled=found.settled and (mixture is None or abs(mixture.error) <= SETTLED),
        )


def sheared_liquid(scene: Bearing, solution: Solution) -> Liquid:
    """The lubricant with the viscosities of its shear at the points across a film, for the temperatures there.

    The flow of the film stays the same; its profile is that of the law at the viscosities at rest of the temperatures.
    """
    liquid, law = scene.lubricant.liquid, scene.lubricant.shear_thinning
    if law is None:
        return liquid
    curve, gap, parts = law.curve(scene.lubricant.viscosity), mean_gap(solution), basis(MODES)
    stress: Array | None = None

    def viscosity(temperature: Array) -> tuple[Array, Array]:
        nonlocal stress
        eta, slope = liquid.viscosity(temperature)
        found, stress = thinned_profiles(solution, curve, eta, (parts.points, parts.weights), gap=gap, start=stress)
        return found, slope * found / eta

    return replace(liquid, viscosity=viscosity)


def _start(near: HeatedFilm | None, solution: Solution, *, thins: bool) -> TemperatureAcross | None:
    """The temperatures across a film at the nodes of another one; None without a film.

    The viscosities of a lubricant that ``thins`` with shear change with the film.
    """
    if near is None:
        return None
    known = near.start
    assert isinstance(known, TemperatureAcross)
    if known.temperature.shape[:2] == solution.grid.shape:
        return replace(known, iterate=replace(known.iterate, near=None)) if thins else known
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    layers = np.moveaxis(known.temperature, -1, 0)
    moved = between_nodes(layers, near.grid, solution.problem.shape.joined, x.ravel(), y.ravel())
    temperature = np.ascontiguousarray(moved.reshape(-1, *x.shape).transpose(1, 2, 0))
    fresh = replace(known.iterate, near=None, renewals=0, response=None)
    return replace(known, temperature=temperature, iterate=fresh)


def walls_of(scene: Bearing, supplied: float, solution: Solution) -> tuple[SlidingWall, FixedWall]:
    """The sliding and the fixed wall of the film of a scene.

    A fixed wall through which the heat transfer of the bearing passes has it evenly over its area
    (:func:`roughfilm.rom.bearing.thermal.exchange.leaves_through_the_wall`).

    Parameters
    ----------
    supplied : temperature of the supplied lubricant, K.
    solution : the film.
    """
    heat = scene.heat or Heat()
    sliding, fixed = _sliding_wall(heat.sliding_wall, supplied), _fixed_wall(heat.fixed_wall, supplied)
    conductance = conductance_of(scene) if leaves_through_the_wall(scene) else None
    if conductance is None:
        return sliding, fixed
    area = float(film_areas(solution.problem.shape, solution.grid).sum())
    around = supplied if heat.surroundings is None else heat.surroundings
    return sliding, ConductingWall(resistance=area / conductance, surroundings=around)


def _sliding_wall(
    wall: Adiabatic | GivenTemperature | Conducting | Turning | HalfSpace, supplied: float
) -> SlidingWall:
    match wall:
        case Turning(temperature=None):
            return TurningWall()
        case Turning(temperature=float(temperature)):
            return WallAtTemperature(temperature=temperature)
        case HalfSpace():
            return SlidingHalfSpace(
                conductivity=wall.conductivity,
                heat_capacity=wall.density * wall.heat_capacity,
                temperature=supplied if wall.temperature is None else wall.temperature,
            )
        case Adiabatic() | GivenTemperature() | Conducting():
            return _fixed_wall(wall, supplied)
    raise AssertionError(wall)


def _fixed_wall(wall: Adiabatic | GivenTemperature | Conducting, supplied: float) -> FixedWall:
    match wall:
        case GivenTemperature():
            return WallAtTemperature(temperature=wall.temperature)
        case Conducting():
            layer = 0.0
            if wall.thickness is not None:
                assert wall.conductivity is not None
                layer = wall.thickness / wall.conductivity
            behind = 0.0 if wall.heat_transfer is None else 1 / wall.heat_transfer
            surroundings = supplied if wall.surroundings is None else wall.surroundings
            return ConductingWall(resistance=layer + behind, surroundings=surroundings)
        case _:
            return InsulatedWall()


solve_across = partial(solve_heated, heating=BetweenWalls)
"""The solver of the model ``across``."""
