"""The heat that a film generates, and the lubricant and surroundings that take it away, for one temperature."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.quantities import boundary_flows
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.cavitation.evaluation.flows import flow_across, flow_along
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.dissipation import passed_on

SMALL_FLOW = 1e-12
"""New lubricant over all lubricant that enters a film below which it carries no heat."""

STEPS, SETTLED = 60, 1e-13
"""Largest number of steps in which the temperature of the outflow is sought, and relative change at which they end."""

IN_A_MACHINE = 300.0
"""Heat transfer from a bearing to its surroundings over its nominal area where none is given, W/(m² K): by DIN 31652-1
and ISO 7902-1 15 to 20 W/(m² K) over a surface of 15 to 20 times the nominal area, 225 to 400 W/(m² K). Lasche measured
35 + 0.44 (T - T_a)/K in W/(m² K) over the running surface, 140 to 180 over the nominal area at 20 to 50 K (Arnold, Die
Gleichstrommaschine 1, chapter 27). Half and twice of it, ``ESTIMATED``, contain nearly all of both."""

ESTIMATED = (0.5, 2.0)
"""Ends of the range of the heat transfer to still air over ``IN_A_MACHINE``."""

NEAR = 1e-3
"""Difference of two temperatures below which the mean heat capacity between them is that at one of them, K."""

SERIES_BELOW, TERMS = 0.5, 16
"""Number of transfer units below which the mean of a profile is summed as a series, and the number of its terms."""


@dataclass(frozen=True, kw_only=True)
class Exchange:
    """The heat of a film and what takes it away; of an infinitely wide film per width.

    Attributes
    ----------
    power : mechanical power that becomes heat, W: friction, squeeze, and what the supply pressure pumps.
    new : flows of lubricant that enters from outside, m³/s, each with its temperature, K.
    carried : flow of hot lubricant that enters the film again, m³/s.
    conductance : heat transfer coefficient times area from the bearing to its surroundings, W/K; None if none is given.
    surroundings : temperature of the surroundings, K.
    area : nominal area, m² (m if infinitely wide), by which the heat transfer is estimated where none is given.
    """

    power: float
    new: tuple[tuple[float, float], ...]
    carried: float
    conductance: float | None
    surroundings: float
    area: float

    @property
    def renewed(self) -> float:
        """The flow of new lubricant, m³/s."""
        return sum(flow for flow, _ in self.new)

    @property
    def flows(self) -> bool:
        """Whether new lubricant takes heat away."""
        return self.renewed > SMALL_FLOW * (self.renewed + self.carried)


@dataclass(frozen=True, kw_only=True)
class Temperatures:
    """The temperatures of a film with one effective temperature.

    Attributes
    ----------
    effective : temperature for which the heat is balanced, K: the mean along the film from inlet to outlet.
    inlet : temperature of the mixture of new and recirculated lubricant at the inlet, K.
    outlet : temperature of the lubricant that leaves, K.
    to_lubricant, to_surroundings : heat that the lubricant takes away, and the surroundings, W.
    estimated : heat transfer to the surroundings that is estimated as none is given, W/K; 0 where the flow takes away
        more than this.
    """

    effective: float
    inlet: float
    outlet: float
    to_lubricant: float
    to_surroundings: float
    estimated: float = 0.0


def temperatures(exchange: Exchange, liquid: Liquid, *, part: float = 1.0) -> Temperatures:
    """The temperatures that the heat of a film brings about, along which its power P and its heat transfer are uniform.

    With the heat e(T) = ∫ ρ c dT of a volume, new lubricant Q_k at T_k and the recirculated flow Q_r, which leaves and
    enters again, the whole flow Q = Σ Q_k + Q_r has along the film, s = 0 to 1,

        Q de/ds = P - G (T - T_a),    Q e(T_in) = Σ Q_k e(T_k) + Q_r e(T_out),

    where G is the heat transfer coefficient times the area. With the mean heat capacity C of the flow from inlet to
    outlet and N = G/C transfer units, the profile is an exponential towards T_a + P/G:

        T_out = T_in + δ (1 - exp(-N))/N,    T_e = T_in + δ (1 - (1 - exp(-N))/N)/N,    δ = (P - G (T_in - T_a))/C.

    Its mean T_e is the temperature of the film, and G (T_e - T_a) leaves to the surroundings. Nothing leaves colder
    than both what enters and the surroundings. Without heat transfer T_e = (T_in + T_out)/2, and without new lubricant
    T_e = T_a + P/G.

    Where no heat transfer is given, none is counted as long as the flow of new lubricant can take away as much heat a
    kelvin as a bearing gives off to still air; a smaller flow takes away what it can, and the bearing the rest of that:
    G = max(``IN_A_MACHINE`` times the nominal area - ρ c Σ Q_k, 0).

    Parameters
    ----------
    exchange : power and flows of the film.
    liquid : its lubricant over temperature.
    part : the heat transfer to still air over ``IN_A_MACHINE``; no effect where a heat transfer is given.

    Raises
    ------
    ConvergenceError
        If the heat belongs to no temperature.

    Source: DIN 31652-1 and ISO 7902-1, for one temperature of the film and the heat transfer to the surroundings.
    """
    conductance, estimated = exchange.conductance, 0.0
    if conductance is None:
        capacity = float(liquid.heat(np.array([liquid.temperature]))[1][0]) * exchange.renewed
        conductance = estimated = max(part * IN_A_MACHINE * exchange.area - capacity, 0.0)
    if not exchange.flows:
        only = exchange.surroundings + exchange.power / conductance
        return Temperatures(
            effective=only,
            inlet=only,
            outlet=only,
            to_lubricant=0.0,
            to_surroundings=exchange.power,
            estimated=estimated,
        )
    inlet, outlet, effective = _along(exchange, liquid, conductance)
    to_surroundings = conductance * (effective - exchange.surroundings)
    return Temperatures(
        effective=effective,
        inlet=inlet,
        outlet=outlet,
        to_lubricant=exchange.power - to_surroundings,
        to_surroundings=to_surroundings,
        estimated=estimated,
    )


def _along(exchange: Exchange, liquid: Liquid, conductance: float) -> tuple[float, float, float]:
    """The temperatures at the inlet and the outlet and their mean along the film, K.

    The outlet is that of the profile, or with few transfer units the one of the whole balance, P - G (T_e - T_a) -
    Σ Q_k (e(T_out) - e(T_k)) = 0, which keeps its digits where nearly all lubricant recirculates.
    """
    whole = exchange.renewed + exchange.carried
    new = sum(flow * _heat(liquid, temperature) for flow, temperature in exchange.new) / exchange.renewed
    again = exchange.carried / whole
    outlet = float(liquid.temperature_of(np.array([new]))[0])
    for _ in range(STEPS):
        leaving, slope = (float(one[0]) for one in liquid.heat(np.array([outlet])))
        mixed = new + again * (leaving - new)
        inlet = float(liquid.temperature_of(np.array([mixed]))[0])
        apart = outlet - inlet
        capacity = whole * ((leaving - mixed) / apart if abs(apart) > NEAR else slope)
        units = conductance / capacity
        rise = (exchange.power - conductance * (inlet - exchange.surroundings)) / capacity
        effective = inlet + rise * _mean_rise(units)
        if units > 1:
            step = (rise * _mean_decay(units) - apart) / (1 - again * math.exp(-units))
        else:
            balance = exchange.power - conductance * (effective - exchange.surroundings)
            balance -= exchange.renewed * (leaving - new)
            step = balance / (exchange.renewed * slope + conductance * again * _mean_decay(units))
        outlet += step
        if not abs(outlet) < math.inf:
            break
        if abs(step) <= SETTLED * abs(outlet):
            return inlet, outlet, effective
    raise ConvergenceError(
        f"heat: {exchange.power:.4g} W belongs to no temperature of the lubricant; check lubricant.heat_capacity"
    )


def _mean_decay(units: float) -> float:
    """The mean (1 - exp(-N))/N of exp(-N s) over s from 0 to 1."""
    return -math.expm1(-units) / units if units > 0 else 1.0


def _mean_rise(units: float) -> float:
    """The mean (1 - (1 - exp(-N))/N)/N of (1 - exp(-N s))/N over s from 0 to 1, without loss of digits."""
    if units >= SERIES_BELOW:
        return (1 - _mean_decay(units)) / units
    return sum((-units) ** power / math.factorial(power + 2) for power in range(TERMS))


def _heat(liquid: Liquid, temperature: float) -> float:
    return float(liquid.heat(np.array([temperature]))[0][0])


def exchange_of(
    scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity], supply_temperature: float
) -> Exchange:
    """The heat of a film and the flows that take it away, from its solution.

    The power is that of friction, of walls that approach each other, and of the pressures at which lubricant enters and
    leaves, Σ p Q. Lubricant that a restrictor throttles enters with the heat that this releases. New lubricant enters
    through the inlet, open sides and supplies, each where it flows in; what walls displace that approach each other has
    come in at the supply temperature. Recirculated is, of a ring or a shaft, ``heat.carried_over`` times the
    flow out at the end, as far as the inlet takes it; of films with gaps between them the same in each row of nodes of
    each gap (:func:`roughfilm.rom.temperature.dissipation.passed_on`); of a film without an end the least flow along
    anywhere, and behind supplies ``heat.carried_over`` of it. Of a single pad nothing recirculates.
    The conductance is None where the scene gives no heat transfer or no area.

    Parameters
    ----------
    scene : the bearing at its film.
    solution : the film.
    quantities : the quantities of the film.
    supply_temperature : temperature of the supplied lubricant, K.

    Raises
    ------
    InputError
        If the heat transfer of the scene is incomplete, or that of a bearing whose number of pieces is unknown.
    """
    heat, lubricant = scene.heat or Heat(), scene.lubricant
    wide = solution.problem.shape.wide

    def flow(name: str) -> float:
        quantity = quantities.get(f"{name}_per_width" if wide else name)
        return 0.0 if quantity is None else quantity.value

    inlet, outlet = flow("inlet_flow"), flow("outlet_flow")
    displaced = flow("displaced_flow")
    low, high = (0.0, 0.0) if wide else (flow("side_leakage_low"), flow("side_leakage_high"))
    supplied = [flow(f"supply_{number}_flow") for number in range(1, len(scene.supply) + 1)]
    drawn_low, drawn_high = _drawn_through_sides(solution)
    new = [(max(drawn_low, -low, 0.0) + max(drawn_high, -high, 0.0), supply_temperature)]
    new += [
        (max(amount, 0.0), supply_temperature if supply.temperature is None else supply.temperature)
        for amount, supply in zip(supplied, scene.supply, strict=True)
    ]
    new.append((max(displaced, 0.0), supply_temperature))
    carried, between = 0.0, boundary_flows(solution).gaps
    if ("inlet_flow_per_width" if wide else "inlet_flow") not in quantities:
        carried = max(float(flow_along(solution).sum(axis=1).min()), 0.0)
        if scene.supply:
            drained = (1 - heat.carried_over) * carried
            weight = sum(amount for amount, _ in new[1:-1])
            mean = sum(amount * temperature for amount, temperature in new[1:-1]) / weight if weight else None
            new.append((drained, supply_temperature if mean is None else mean))
            carried -= drained
    else:
        at_inlet = scene.boundary.inlet.temperature
        fresh = supply_temperature if at_inlet is None else at_inlet
        for leaving, entering in between or ((np.array([outlet]), np.array([inlet])),):
            again, into = 0.0, float(np.maximum(entering, 0.0).sum())
            if isinstance(scene.geometry, Ring | Shaft):
                again = float(passed_on(leaving, entering, heat.carried_over).sum())
            new.append((into - again, fresh))
            new.append((float(np.maximum(-leaving, 0.0).sum()), fresh if between else supply_temperature))
            carried += again
    sides, at_end = scene.boundary.sides, scene.ends.outlet + lubricant.cavitation_pressure
    pumped = scene.inlet_pressure * inlet - (scene.inlet_pressure if between else at_end) * outlet
    pumped -= sides.low * low + sides.high * high
    for number, (amount, supply) in enumerate(zip(supplied, scene.supply, strict=True), start=1):
        pressure = quantities[f"supply_{number}_pressure"].value if supply.pressure is None else supply.pressure
        pumped += pressure * amount
    return Exchange(
        power=quantities["power_loss_per_width" if wide else "power_loss"].value + _squeeze(scene, solution) + pumped,
        new=tuple((amount, temperature) for amount, temperature in new if amount > 0),
        carried=carried,
        conductance=conductance_of(scene),
        surroundings=supply_temperature if heat.surroundings is None else heat.surroundings,
        area=scene.nominal_area,
    )


def _drawn_through_sides(solution: Solution) -> tuple[float, float]:
    """The flows that enter through the sides at the lowest and the highest y, where they enter, m³/s."""
    if solution.problem.ends.sides is None:
        return 0.0, 0.0
    across = flow_across(solution)
    inside = np.ones(across.shape[0], dtype=bool)
    for nodes in gaps(solution.problem.shape, solution.grid):
        inside[nodes] = False
    if not solution.network.periodic[0]:
        inside[[0, -1]] = False
    return float(np.maximum(across[inside, 0], 0.0).sum()), float(np.maximum(-across[inside, -2], 0.0).sum())


def _squeeze(scene: Bearing, solution: Solution) -> float:
    """The power -∫ p ∂h/∂t dA of walls that approach each other, W."""
    opening, grid = solution.problem.opening, solution.grid
    if opening is None:
        return 0.0
    rate = opening(*np.meshgrid(grid.x, grid.y, indexing="ij"))
    pressure = solution.state.pressure + scene.lubricant.cavitation_pressure
    return -float((grid.areas * pressure * rate).sum())


def conductance_of(scene: Bearing) -> float | None:
    """The heat transfer coefficient times the area of one piece of the bearing, W/K; None if they are not given.

    Raises
    ------
    InputError
        If they are given for a bearing whose number of pieces is unknown.
    """
    heat = scene.heat or Heat()
    if heat.heat_transfer is None or heat.area is None:
        return None
    if scene.wide or scene.pieces is None:
        what = "an infinitely wide bearing" if scene.wide else "pads of an unknown number"
        remedy = "geometry.width" if scene.wide else "geometry.pads"
        raise InputError(f"heat.area: got one for {what}; give {remedy}, or leave heat_transfer and area out")
    return heat.heat_transfer * heat.area / scene.pieces


def leaves_through_the_wall(scene: Bearing) -> bool:
    """Whether the heat transfer of a bearing is that of its fixed wall: it is given, and neither wall takes heat."""
    heat = scene.heat or Heat()
    return heat.insulated and heat.heat_transfer is not None and not scene.wide and scene.pieces is not None


def coldest(scene: Bearing, supply_temperature: float) -> float:
    """The lowest temperature, K, of what takes the heat of a film away, below which no film cools."""
    known = [scene.boundary.inlet.temperature, *(one.temperature for one in scene.supply)]
    known.append(None if scene.heat is None else scene.heat.surroundings)
    return min([supply_temperature, *(one for one in known if one is not None)])
