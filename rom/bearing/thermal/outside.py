"""Temperatures of a bearing outside of the range of its lubricant, and of models whose walls take no heat."""

from collections.abc import Mapping, Sequence

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import IN_A_MACHINE, leaves_through_the_wall
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.ladder.result import Result

OF_FILM = ("effective_temperature", "inlet_temperature", "outlet_temperature", "temperature_max")
"""The quantities that are temperatures of the lubricant, °C."""

IN_CONTACT = 3.0
"""Film thickness over the rms height up to which asperities carry most of a load."""

MAX_HEATING = 100.0
"""Heating of all lubricant that sliding carries, K, above which it cannot be what takes the heat of asperities away."""


def outside_of_lubricant(scene: Bearing, result: Result | None = None) -> tuple[str, ...]:
    """The sentence that the lubricant leaves the range of its law of viscosity; none inside of it.

    Parameters
    ----------
    result : the solution, whose film and flows count; without it the lubricant counts as it is supplied.
    """
    if result is None:
        return outside_at(scene, {})
    known = {name: quantity.value for name, quantity in result.quantities.items()}
    field = result.fields.get("temperature")
    return outside_at(scene, known, () if field is None else [float(field.values.min())])


def outside_at(scene: Bearing, values: Mapping[str, float], others: Sequence[float] = ()) -> tuple[str, ...]:
    """The same of lubricant as it is supplied, at the temperatures among the values of quantities, and at others, °C.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    values : values by the name of the quantity, those of ``OF_FILM`` in °C.
    """
    if scene.lubricant.temperature is None:
        return ()
    degrees = [*(values[name] for name in OF_FILM if name in values), *others]
    found = [scene.lubricant.temperature, *(one + ZERO_CELSIUS for one in degrees)]
    return tuple(scene.lubricant.beyond(min(found), max(found)))


def heat_that_stays(scene: Bearing, model: Model[Bearing]) -> tuple[str, ...]:
    """The sentence on asperities whose heat no flow can take away, of a model whose walls take no heat.

    Under a pressure p the asperities make the power μ p u of an area, and sliding carries lubricant u h/2 of a width,
    which this heats by 2 μ p L/(ρ c h).
    """
    lubricant, heat = scene.lubricant, scene.heat or Heat()
    across = Effect.TEMPERATURE_ACROSS in model.keeps
    cooled = across and (not heat.insulated or leaves_through_the_wall(scene))
    if Effect.TEMPERATURE_FIELD not in model.keeps or cooled or lubricant.lacking:
        return ()
    if scene.asperities is None or scene.roughness is None or scene.load_pressure is None:
        return ()
    try:
        film = expected_scene(scene).geometry.thinnest
    except (InputError, ConvergenceError):
        return ()
    volume = float(lubricant.heat_at(np.array([lubricant.liquid.temperature]))[1][0])
    width, speed = scene.geometry.width or 1.0, abs(scene.motion.speed)
    carried, still = volume * speed * film * width / 2, IN_A_MACHINE * scene.nominal_area
    rise = scene.boundary_friction * scene.load_pressure * scene.nominal_area * speed / carried if carried else 0.0
    if film > IN_CONTACT * scene.roughness.rms or rise < MAX_HEATING or carried > still:
        return ()
    return (
        f"temperature: asperities heat all lubricant that sliding carries by {rise:.2g} K, above {MAX_HEATING:g} K, so "
        "that the walls take most heat, and those of this model take none; give heat.fixed_wall or heat.sliding_wall "
        "for across, or take heat_balance",
    )
