"""The input on which the temperature of a film depends most."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.rounding import share
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import IN_A_MACHINE, Exchange, exchange_of, temperatures
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid

WARMER_SUPPLY = 5.0
"""Change of the temperature of the supplied lubricant whose effect is compared with those of other inputs, K."""

NOTABLE = 0.2
"""Relative change of the viscosity by one input from which on it is named."""

STILL_AIR = f"{IN_A_MACHINE:g} W/(m² K) over the nominal area, as of a bearing in still air (DIN 31652)"


def leading_input(
    scene: Bearing,
    solution: Solution,
    quantities: Mapping[str, Quantity],
    liquid: Liquid,
    temperature: float,
    *,
    insulated: bool = False,
) -> str:
    """The input on which the temperature depends most, with the changes of temperature and viscosity; "" if small.

    The inputs are the temperature of the supply, 5 K warmer, half of ``heat.carried_over``, and half of the heat
    transfer to the surroundings or, where it is missing, that of a bearing in still air. Each changes the temperature
    that the heat of the given film brings about; as the friction follows the viscosity, the film at which the heat is
    balanced changes by that over 1 + |d ln η/dT| (T - T_supply). Where the bearing gives off heat whose transfer is not
    given, this input is named.

    Parameters
    ----------
    scene : the bearing at its film.
    solution, quantities : the film, with its flows and its power.
    liquid : the lubricant as it is supplied.
    temperature : temperature of the film, K.
    insulated : whether the model takes walls that take no heat, whatever the scene gives.
    """
    if insulated:
        none = (scene.heat or Heat()).model_copy(update={"heat_transfer": None, "area": None})
        scene = scene.model_copy(update={"heat": none})
    exchange = exchange_of(scene, solution, quantities, liquid.temperature)
    try:
        found = temperatures(exchange, liquid)
        varied = {
            words: temperatures(other, liquid).effective
            for words, other in _varied(scene, solution, quantities, liquid, exchange, insulated=insulated)
        }
    except ConvergenceError:
        return ""
    if found.estimated:
        capacity = float(liquid.heat(np.array([liquid.temperature]))[1][0]) * exchange.renewed
        unit = "W/(m K)" if scene.wide else "W/K"
        little = f"the flow of new lubricant takes away {capacity:.2g} {unit}"
        still = f"{STILL_AIR}, {IN_A_MACHINE * exchange.area:.2g} {unit}"
        if insulated:
            return f"{little}, less than {still}, but the walls take no heat; take heat_balance"
        return _missing(f"{little} only", still)
    viscosity, slope = (float(one[0]) for one in liquid.viscosity(np.array([temperature])))
    sensitivity = -slope / viscosity
    follows = 1 + max(sensitivity * (temperature - liquid.temperature), 0.0)
    changes = {words: (effective - found.effective) / follows for words, effective in varied.items()}
    words, change = max(changes.items(), key=lambda pair: abs(pair[1]))
    thicker = float(np.expm1(-sensitivity * change))
    if abs(thicker) < NOTABLE:
        return ""
    direction = "colder" if change < 0 else "warmer"
    lubricant = f"{share(abs(thicker))} {'more' if thicker > 0 else 'less'} viscous"
    return f"it depends most on {words}, the film is about {abs(change):.2g} K {direction}, {lubricant}"


def leading_warning(leading: str, where: str = "") -> tuple[str, ...]:
    """The warning on the input that :func:`leading_input` gives, and where it is so; () without one."""
    return (f"temperature: {where}{leading}",) if leading else ()


def leading_in_series(
    transfers: Sequence[float], places: str, leading: Sequence[tuple[str, str]] = ()
) -> tuple[str, ...]:
    """The warnings on the inputs on which the temperatures of a series depend most; () without any.

    Parameters
    ----------
    transfers : heat transfer to the surroundings that is estimated at each point, W/K; 0 where none is.
    places : the points in words, such as "speeds".
    leading : places, such as "at 3000 rpm", with the input on which the temperature depends there, that of interest
        first; the first one with such an input is named.
    """
    some = sum(1 for one in transfers if one)
    missing = _missing("the flow of new lubricant takes away less", STILL_AIR) if some else ""
    where, words = next(((where, words) for where, words in leading if words), ("", ""))
    return (
        *leading_warning(missing, f"at {some} of {len(transfers)} {places} "),
        *leading_warning(words, f"{where} "),
    )


def _missing(little: str, still: str) -> str:
    """That a temperature depends on a heat transfer that is missing, and by how much the uncertainty takes it."""
    return (
        f"it depends most on heat.heat_transfer and heat.area, which are missing: {little}, so that the bearing gives "
        f"off {still}; the uncertainty contains a factor of two of it"
    )


def _varied(
    scene: Bearing,
    solution: Solution,
    quantities: Mapping[str, Quantity],
    liquid: Liquid,
    exchange: Exchange,
    *,
    insulated: bool,
) -> Iterator[tuple[str, Exchange]]:
    """The exchange of heat with one input changed, and that input in words."""
    warmer = tuple((flow, temperature + WARMER_SUPPLY) for flow, temperature in exchange.new)
    around = exchange.surroundings + (WARMER_SUPPLY if scene.heat is None or scene.heat.surroundings is None else 0.0)
    key = "lubricant.temperature" if not scene.supply else "the temperature of the supply"
    yield f"{key}: {WARMER_SUPPLY:g} K warmer", replace(exchange, new=warmer, surroundings=around)
    heat = scene.heat or Heat()
    if exchange.carried and heat.carried_over:
        half = heat.model_copy(update={"carried_over": heat.carried_over / 2})
        other = exchange_of(scene.model_copy(update={"heat": half}), solution, quantities, liquid.temperature)
        yield f"heat.carried_over: with {half.carried_over:g} in place of {heat.carried_over:g}", other
    if exchange.conductance is None:
        where = "the walls, which take no heat" if insulated else "heat.heat_transfer and heat.area, which are missing"
        yield f"{where}: with {STILL_AIR}", replace(exchange, conductance=IN_A_MACHINE * exchange.area)
    elif exchange.conductance:
        yield "heat.heat_transfer: with half of it", replace(exchange, conductance=exchange.conductance / 2)
