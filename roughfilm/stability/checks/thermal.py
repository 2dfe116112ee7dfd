"""The heat balance of a film, recomputed from its flows, pressures and temperatures, and the laws of temperatures."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm
from roughfilm.rom.bearing.thermal.tables import Conducting, GivenTemperature, HalfSpace, Turning
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.temperature.dissipation import film_flows

BALANCE = 1e-8
"""Allowed error of the heat balance of a film over its heat flows, unless the result states a larger one."""

LARGEST_STATED = 1e-6
"""Largest error of the heat balance that a result may state."""

UNDERSHOOT = 2e-3
"""Allowed temperature below all that enters and all walls, over the range of temperatures."""

UNEVEN = 2e-3
"""Allowed difference of ln η at mirrored nodes of a symmetric film: twice that at which an iteration stops."""

ROUNDED = 1e-6
"""Differences of temperatures that do not count, K."""


@dataclass(frozen=True, kw_only=True)
class HeatErrors:
    """The errors of the heat of a film over the sum of the sizes of its heat flows.

    Attributes
    ----------
    balance : generated + carried in - carried out - to the walls.
    work : generated less the work of friction and of the pressures at which lubricant enters and leaves.
    """

    balance: float
    work: float


def heat_errors(scene: Bearing, result: Result, solution: Solution, heated: HeatedFilm) -> HeatErrors:
    """The errors of the heat of a film whose temperatures vary, from its flows and the heat e(T) = ∫ ρ c dT of each.

    Lubricant enters with the temperature of the supply or that of the mixture at the inlet. It leaves with that of its
    node, or, where the temperature varies across the film, with the mean by its flow, ``outlet``.
    """
    liquid, zero = scene.lubricant.liquid, 0.0
    flows = film_flows(solution, 1.0 if scene.heat is None else scene.heat.carried_over)
    net = flows.entering
    entering, leaving = np.maximum(net, zero), np.maximum(-net, zero)
    warm = np.full(net.shape, liquid.temperature)
    if heated.inlet is not None:
        warm[0] = heated.inlet.temperature
    carried_in = float((entering * liquid.heat(warm)[0]).sum())
    if heated.to_sliding_wall is None:
        carried_out = float((leaving * liquid.heat(heated.temperature)[0]).sum())
    else:
        outlet = liquid.temperature if heated.outlet is None else heated.outlet
        carried_out = float(leaving.sum() * liquid.heat(np.array([outlet]))[0][0])
        carried_out += float((flows.stored * liquid.heat(heated.temperature)[0]).sum())
    walls = (heated.to_fixed_wall or 0.0, heated.to_sliding_wall or 0.0)
    work = result["power_loss_per_width" if solution.problem.shape.wide else "power_loss"].value
    work += float((solution.state.pressure * net).sum())
    heats = (heated.generated, carried_in, carried_out, *walls)
    scale = sum(abs(one) for one in heats) or 1.0
    balance = heated.generated + carried_in - carried_out - sum(walls)
    return HeatErrors(balance=abs(balance) / scale, work=abs(heated.generated - work) / (abs(work) or 1.0))


def broken_field(
    scene: Bearing, result: Result, solution: Solution, heated: HeatedFilm, *, even: bool
) -> Iterator[str]:
    """The laws that the temperatures of a film violate, in words.

    Parameters
    ----------
    even : whether the film is symmetric about the middle of its width.
    """
    errors, details = heat_errors(scene, result, solution, heated), result.numerics.details
    if errors.balance > max(BALANCE, details["energy_imbalance"]):
        yield f"the heat of the film has an error of {errors.balance:.2g}"
    if details["energy_imbalance"] > LARGEST_STATED:
        yield f"the heat balance is stated with an error of {details['energy_imbalance']:.2g}"
    allowed = details["largest_viscosity_change"] + BALANCE  # the power of each node is proportional to its viscosity
    if errors.work > allowed:
        yield f"the heat differs from the work by {errors.work:.2g}, allowed {allowed:.2g}"
    temperature = result.fields["temperature"].values
    least, slack = float(temperature.min()), UNDERSHOOT * float(np.ptp(temperature)) + ROUNDED
    if least < coldest(scene) - ZERO_CELSIUS - slack:
        yield f"{least:.5g} degC is colder than all that enters"
    values = {name: result[name].value for name in ("temperature_mean", "temperature_max")}
    if not values["temperature_mean"] <= values["temperature_max"] + slack:
        yield "the mean temperature is above the largest one"
    if even and (difference := _unevenness(temperature, result.fields["viscosity"].values)) > UNEVEN:
        yield f"the viscosities of a symmetric film differ by {difference:.2g} between its halves"


def coldest(scene: Bearing) -> float:
    """The lowest temperature of the supplied lubricant and of the walls of a scene, K."""
    known = [scene.lubricant.liquid.temperature]
    for wall in () if scene.heat is None else (scene.heat.fixed_wall, scene.heat.sliding_wall):
        if isinstance(wall, GivenTemperature | Turning | HalfSpace) and wall.temperature is not None:
            known.append(wall.temperature)
        if isinstance(wall, Conducting) and wall.surroundings is not None:
            known.append(wall.surroundings)
    return min(known)


def _unevenness(temperature: Array, viscosity: Array) -> float:
    """The largest difference of ln η between mirrored nodes that their temperatures cause."""
    different = np.abs(temperature - temperature[:, ::-1]) > ROUNDED
    return float(np.abs(np.log(viscosity / viscosity[:, ::-1]))[different].max(initial=0.0))


def broken_totals(result: Result) -> Iterator[str]:
    """The laws that the heat flows and temperatures of a film with one temperature violate, in words."""
    value = {name: one.value for name, one in result.quantities.items()}
    generated = value["heat_generated"]
    error = abs(generated - value["heat_to_lubricant"] - value["heat_to_surroundings"]) / (abs(generated) or 1.0)
    if error > BALANCE:
        yield f"the heat of the film has an error of {error:.2g}"
    inlet, outlet = value["inlet_temperature"], value["outlet_temperature"]
    effective, slack = value["effective_temperature"], result.numerics.details["heat_balance"] + 1e-3
    if not min(inlet, outlet) - slack <= effective <= max(inlet, outlet) + slack:
        yield "the temperature of the film is not between those of inlet and outlet"
    if value["heat_to_surroundings"] == 0 and abs(effective - (inlet + outlet) / 2) > slack:
        yield "the temperature of the film is not the mean of inlet and outlet"
