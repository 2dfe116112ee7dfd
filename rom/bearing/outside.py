"""The ways in which a bearing, or its film, is outside the range of all models: turbulence, and a gas as a liquid."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.grid import film_areas
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.parts.gas import compressibility_of_gas, is_gas
from roughfilm.rom.parts.laminar import pressure_turbulence, shear_turbulence, taylor_vortices
from roughfilm.rom.parts.surroundings import ATMOSPHERE

DENSEST = 1000.0
"""Density of a liquid without one, kg/m³: oils are less dense, so that a film that is laminar with it is laminar."""

GAS_DENSITY = 1.2
"""Density of a gas without one at ambient pressure, kg/m³: that of air."""

EXPECTED_PRESSURE = 0.1
"""Pressure of a film over 6ηuL/h² that is expected before it is solved."""

AT_CORNERS = 0.01
"""Part of the area of a film whose flow by pressure is not judged: it grows without limit at corners of supplies."""


@dataclass(frozen=True, kw_only=True)
class ReynoldsNumbers:
    """The Reynolds numbers of a film.

    Attributes
    ----------
    shear : largest ρuh/η of the full film, with the local density and viscosity.
    pressure : largest ρq/η of the flow q by pressure per width, but for ``AT_CORNERS`` of the area.
    clearance : largest ρuc/η with the clearance c of a shaft; NaN without a shaft.
    """

    shear: float
    pressure: float
    clearance: float = math.nan


def film_outside(scene: Bearing, solution: Solution) -> tuple[str, ...]:
    """The sentences on a film that is outside the range of laminar flow, or that takes a gas as a liquid.

    Parameters
    ----------
    scene : the bearing at the film of the solution.
    solution : the film.
    """
    numbers, fixed = reynolds_numbers(scene, solution), isinstance(solution.problem.compressibility, Incompressible)
    highest = float(np.abs(solution.state.pressure + scene.lubricant.cavitation_pressure).max())
    return (*turbulence(scene, numbers), *(gas_as_liquid(scene, highest) if fixed else ()))


def channel_outside(scene: Bearing, thickness: Array, flow: float, pressure: Array) -> tuple[str, ...]:
    """The same of the full film of an infinitely wide pad with a liquid of constant density and viscosity.

    Parameters
    ----------
    scene : the pad.
    thickness : film thickness h along it, m.
    flow : flow q through it along the sliding, m²/s, negative against it; that by pressure is q - uh/2.
    pressure : pressures above ambient, Pa.
    """
    speed, kinematic = abs(scene.motion.speed), density(scene) / scene.lubricant.viscosity
    numbers = ReynoldsNumbers(
        shear=kinematic * speed * float(thickness.max()),
        pressure=kinematic * float(np.abs(flow - speed * thickness / 2).max()),
    )
    return (*turbulence(scene, numbers), *gas_as_liquid(scene, float(np.abs(pressure).max())))


def scene_outside(scene: Bearing, model: Model[Bearing]) -> tuple[str, ...]:
    """The sentences on a scene that is surely outside the range of a model, before it is solved.

    They are those of the minimum film thickness, at the viscosity of the supplied lubricant.
    """
    try:
        scene = expected_scene(scene)
    except (InputError, ConvergenceError):
        return ()
    geometry, per_film = scene.geometry, density(scene) * abs(scene.motion.speed) / scene.lubricant.viscosity
    clearance = per_film * geometry.clearance if isinstance(geometry, Shaft) else math.nan
    numbers = ReynoldsNumbers(shear=per_film * geometry.thinnest, pressure=0.0, clearance=clearance)
    gas = gas_as_liquid(scene, EXPECTED_PRESSURE * scene.pressure_unit) if model.outside else ()
    return (*turbulence(scene, numbers), *gas)


def density(scene: Bearing) -> float:
    """The density at the cavitation pressure, kg/m³: that of the scene, or ``DENSEST``, or that of air for a gas."""
    lubricant = scene.lubricant
    if lubricant.density is not None:
        return lubricant.density
    if not is_gas(None, lubricant.viscosity):
        return DENSEST
    ambient = np.array([0.0 - lubricant.cavitation_pressure])
    return GAS_DENSITY / float(1 + lubricant.compressibility.compression(ambient)[0][0])


def reynolds_numbers(scene: Bearing, solution: Solution) -> ReynoldsNumbers:
    """The Reynolds numbers of a film."""
    problem, grid, thickness = solution.problem, solution.grid, solution.faces.thickness
    pressure = solution.state.pressure
    excess, (fluidity, _) = problem.compression(pressure)[0], problem.fluidity(pressure)
    viscosity = (problem.viscosity if problem.at_nodes is None else problem.at_nodes.flow) / fluidity
    kinematic = density(scene) / viscosity
    areas = film_areas(problem.shape, grid)
    full = (solution.kind != CAVITY) & (areas > 0)
    sliding = abs(problem.speed) * grid.radius * kinematic * (1 + excess)
    driven = kinematic * _driven(solution)
    geometry = scene.geometry
    return ReynoldsNumbers(
        shear=_largest((sliding * thickness)[full]),
        pressure=_largest_but_corners(driven[full], areas[full]),
        clearance=_largest(sliding[full]) * geometry.clearance if isinstance(geometry, Shaft) else math.nan,
    )


def _driven(solution: Solution) -> Array:
    """The flow by pressure per width at the nodes at cavitation density, m²/s: the mean of the faces around each."""
    grid, network, pressure = solution.grid, solution.network, solution.state.pressure
    east, north = network.conductance(solution.problem.mobility(pressure)[0])
    along = east * (pressure - np.roll(pressure, -1, axis=0)) / grid.volume_y
    across = north * (pressure - np.roll(pressure, -1, axis=1)) / (grid.volume_x[:, None] * grid.radius)
    return np.hypot(_at_nodes(along, 0, network.periodic[0]), _at_nodes(across, 1, network.periodic[1]))


def _at_nodes(flow: Array, axis: int, periodic: bool) -> Array:
    """The larger flow of the two faces at each node along an axis."""
    flow = np.abs(flow)
    before = np.roll(flow, 1, axis=axis)
    if not periodic:
        flow, before = flow.copy(), before.copy()
        np.moveaxis(flow, axis, 0)[-1] = 0.0
        np.moveaxis(before, axis, 0)[0] = 0.0
    return np.asarray(np.maximum(flow, before))


def _largest(values: Array) -> float:
    return float(values.max()) if values.size else 0.0


def _largest_but_corners(values: Array, areas: Array) -> float:
    """The largest value but for ``AT_CORNERS`` of the area, where values are larger."""
    if not values.size:
        return 0.0
    order = np.argsort(values)[::-1]
    beyond = np.cumsum(areas[order]) > AT_CORNERS * areas.sum()
    return float(values[order[int(np.argmax(beyond))]])


def turbulence(scene: Bearing, numbers: ReynoldsNumbers) -> tuple[str, ...]:
    """The sentences on Reynolds numbers above the limits of laminar flow."""
    geometry = scene.geometry
    found = [*shear_turbulence(numbers.shear), *pressure_turbulence(numbers.pressure)]
    if isinstance(geometry, Shaft):
        found += taylor_vortices(numbers.clearance, geometry.radius, geometry.clearance)
    if not found or scene.lubricant.density is not None:
        return tuple(found)
    taken = f"{GAS_DENSITY:g} kg/m³ at ambient" if is_gas(None, scene.lubricant.viscosity) else f"{DENSEST:g} kg/m³"
    return tuple(f"{one} (with a density of {taken}, as lubricant.density is missing)" for one in found)


def gas_as_liquid(scene: Bearing, pressure: float, film: float | None = None) -> tuple[str, ...]:
    """The sentence on a gas that a model takes as incompressible.

    Parameters
    ----------
    scene : the bearing.
    pressure : largest difference of the pressure from ambient, Pa.
    film : minimum film thickness, m; by default that of the scene.
    """
    lubricant = scene.lubricant
    if film is None:
        scale = scene.pressure_unit
    else:
        scale = 6 * lubricant.viscosity * abs(scene.motion.speed) * scene.geometry.length / film**2
    number = scale / ATMOSPHERE
    return compressibility_of_gas(lubricant.density, lubricant.viscosity, pressure, ATMOSPHERE, number)
