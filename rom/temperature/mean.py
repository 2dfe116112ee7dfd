"""The temperature over a film, its mean across the film, from the energy equation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.dissipation import Flows, dissipation, film_flows
from roughfilm.rom.temperature.properties import over_heat
from roughfilm.rom.temperature.transport import arrange, carry, extrapolate, limit, straighten, sweep

TOLERANCE = 1e-12
"""Sum of the errors of all balances, over the heat that enters and is generated, at which a solve stops."""

ROUNDED = 1e-10
"""The same where it does not decrease any more, since much more liquid circulates than leaves the film."""

ITERATIONS = 60
"""Largest number of Newton steps."""

MAX_HEATING = 500.0
"""Largest temperature above that of the entering liquid and the walls, K; no law of viscosity holds beyond."""

CLOSED = 1e-8
"""Largest flow that leaves at a node over that through a face, up to which no liquid leaves a film."""

LOWERED = 3
"""Number of Newton steps after which limited slopes only decrease, so that they settle."""

LIMITED = 8
"""Number of Newton steps after which they stay."""

SETTLED = 1e-3
"""Relative error of the balances, with slopes of the last step, below which they stay before."""

UNDERSHOOT = 1e-3
"""Temperature below that of all entering liquid and walls, over the range of temperatures, above which slopes decrease
further, in at most ``2 * LIMITED`` steps."""

CIRCULATION_TOLERANCE = 1e-2
"""Relative residual of the linear system of circulating liquid in one Newton step."""

CIRCULATION_ITERATIONS = 60
"""Largest number of sweeps for it in one Newton step."""

REMEMBERED = 12
"""Largest number of directions that are kept in one step; they take the memory of three fields each."""


@dataclass(frozen=True, kw_only=True)
class Carried:
    """The flows, m³/s at cavitation density, and their heat, W, into a film and out of it at a place, each >= 0.

    Heat is that above the temperature of the supplied liquid; it is negative for colder liquid. In an infinitely wide
    film they are per width.
    """

    flow_in: float
    flow_out: float
    heat_in: float
    heat_out: float


@dataclass(frozen=True, kw_only=True)
class MeanTemperature:
    """The temperature over a film and its heat balance: generated + carried in = carried out + to walls + stored.

    Attributes
    ----------
    temperature : temperature of the liquid at the nodes, K, shape (nx, ny).
    viscosities : viscosities at these temperatures at the cavitation pressure.
    dissipation : power that each node dissipates, W, shape (nx, ny).
    to_walls : heat from each node to the walls, W, shape (nx, ny).
    stored : heat that the nodes of a film with moving walls store, W.
    carried : what flows carry at ``inlet``, ``outlet``, ``sides``, ``gaps`` between films, ``supply_1`` and so on, and
        ``inside`` of the film, where the mass balance has a residual.
    imbalance : relative error of the heat balance of the film.
    outlet_temperature : mean temperature of the liquid that leaves the film, by its flow, K; NaN if none leaves.
    highest : position (x, y) of the largest temperature.
    slopes : limited coefficients of the extrapolation along and across, each of shape (nx, ny).
    """

    temperature: Array
    viscosities: Viscosities
    dissipation: Array
    to_walls: Array
    stored: float
    carried: Mapping[str, Carried]
    imbalance: float
    outlet_temperature: float
    highest: tuple[float, float]
    slopes: tuple[Array, Array]


def mean_temperature(
    solution: Solution,
    liquid: Liquid,
    *,
    entering: float | Array | None = None,
    exchange: float | Array = 0.0,
    wall: float | Array | None = None,
    added_power: float | Array = 0.0,
    carried_over: float = 1.0,
    at_rest: Array | None = None,
    start: Array | None = None,
    slopes: tuple[Array, Array] | None = None,
) -> MeanTemperature:
    """Solve Σ F e(T) = W η(T)/η - U A (T - T_w), the heat balance of every node, for the temperature over a film.

    The flows F of the mass balance carry the heat e(T) = ∫ ρ c dT from node to node. The dissipation W (see
    :func:`roughfilm.rom.temperature.dissipation.dissipation`) is that of the solution, whose flows are fixed while the
    viscosity changes from that of the solution, η, to that at the new temperature, η(T): the shear η(T) u²/h and
    12 η(T) q_p²/h³ of the flow by pressure are both proportional to it. Each balance then increases with the
    temperature of its node, so that the field is unique with first-order fluxes. Newton's method, whose linear systems
    are solved in the order of the flow, converges to it from any start, as η is a convex function of T.

    Films and fields in turn converge to the film that is consistent with its temperature. The new temperature does not
    depend on a factor of all viscosities of a film between pressures of zero, which changes neither its flows nor W/η.
    What remains is their pattern: where it changes the heating at constant viscosity, T', by a fraction δ, the new
    viscosity changes by x/(1 + x) δ with x = -T' d(ln η)/dT, less than δ however large the heating is. (With W fixed,
    a factor f of all viscosities would return as f^-x, and the iteration diverge for x > 1.)

    Second-order accurate where e is smooth along and across the film; first-order at nodes where liquid enters, which
    have the temperature behind half a cell, at extrema and at jumps, for which the extrapolation is limited.

    Parameters
    ----------
    entering : temperature of the liquid that enters at a node from outside, K; by default that of the supply.
    exchange : U, coefficient of the heat transfer to both walls together, W/(m² K).
    wall : T_w, temperature of the walls, K; by default that of the supply.
    added_power : further power that heats the liquid of each node, such as that of asperities in contact, W.
    carried_over : part of the liquid that a film discharges into a gap which enters the next one at most.
    at_rest : viscosity at rest of the temperatures with which the film was solved, Pa s, shape (nx, ny), of a liquid
        that thins with shear: W then changes as the viscosity at rest does. By default η is that of the solution.
    start : temperature from which to start, K, shape (nx, ny).
    slopes : limited coefficients of the extrapolation, of a film near this one; they stay the same but where liquid no
        longer flows straight through a node. By default they follow the temperature of this film.

    Raises
    ------
    ConvergenceError
        If the balances do not meet the tolerance, or the liquid heats by more than ``MAX_HEATING``, as where it
        circulates and gives no heat away. Newton's method approaches the temperature from below, so that it exceeds
        every iterate.

    Source: conservation of energy; linear upwind differences, Warming and Beam 1976, doi:10.2514/3.61457.
    """
    flows = film_flows(solution, carried_over)
    shape = solution.grid.shape
    inlet = np.broadcast_to(liquid.temperature if entering is None else entering, shape)
    walls = np.broadcast_to(liquid.temperature if wall is None else wall, shape)
    lost = np.asarray(exchange * solution.grid.areas)
    at_nodes = solution.problem.at_nodes
    own = solution.problem.viscosity if at_nodes is None else at_nodes.shear
    known = own if at_rest is None else at_rest
    power = dissipation(solution, flows)
    fixed_power, relative_power = np.minimum(power, 0.0) + added_power, np.maximum(power, 0.0) / known
    gained = np.maximum(flows.entering, 0.0) * liquid.heat(inlet)[0]
    order, late = _arranged(flows)
    leaving = np.maximum(-flows.entering, 0.0)
    largest = max(np.abs(flows.along).max(), np.abs(flows.across).max())
    if power.any() and not lost.any() and leaving.max() <= CLOSED * largest:
        raise _runaway(solution, np.unravel_index(int(np.argmax(power)), shape))

    heat = np.array(liquid.heat(inlet if start is None else start)[0])
    properties = over_heat(liquid, heat)
    slope_x, slope_y, face_x, face_y = (np.zeros(shape) for _ in range(4))
    if slopes is not None:
        slope_x, slope_y = (one.copy() for one in slopes)
        straighten(flows.along, flows.across, slope_x, slope_y)
    coldest, warmest = min(inlet.min(), walls.min()), max(inlet.max(), walls.max())
    most = liquid.heat(np.array([warmest + MAX_HEATING]))[0][0]
    kept, limited = flows.stored + leaving, slopes is None
    error = np.inf
    for iteration in range(ITERATIONS):
        highest = np.unravel_index(int(np.argmax(heat)), shape)
        if not np.abs(heat).max() <= most:
            raise _runaway(solution, highest)
        if not properties.contains(heat):
            properties = over_heat(liquid, heat)
        temperature, warming, viscosity, thinning = properties(heat)
        generated, to_walls = relative_power * viscosity + fixed_power, lost * (temperature - walls)
        if limited:
            spacings = solution.grid.spacing_x, solution.grid.spacing_y
            limit(flows.along, flows.across, *spacings, heat, iteration >= LOWERED, slope_x, slope_y)
        extrapolate(flows.along, flows.across, slope_x, slope_y, heat, face_x, face_y)
        balance = kept * heat - gained - generated + to_walls
        carry(flows.along, flows.across, face_x, face_y, balance)
        scale = float((np.abs(gained) + np.abs(generated) + np.abs(to_walls)).sum())
        before, error = error, float(np.abs(balance).sum()) / (scale or 1.0)
        if error <= TOLERANCE or before / 2 < error <= ROUNDED:
            break
        undershoots = temperature.min() < coldest - UNDERSHOOT * (temperature[highest] - coldest)
        limited = limited and iteration < (2 * LIMITED if undershoots else LIMITED if error > SETTLED else 0)
        change = relative_power * thinning - lost * warming
        source = gained + generated - to_walls - change * heat
        linear = (order, flows.along, flows.across, slope_x, slope_y, kept - change)
        _solve(linear, source, late, (heat, face_x, face_y))
    else:
        raise ConvergenceError(
            f"temperature: the heat balances of the film have a relative error of {error:.1e} after {ITERATIONS} "
            f"Newton steps; it must be {TOLERANCE:g}; take other cells, or the model across with walls that take heat",
            outcome=Outcome.STALLED,
            iterations=ITERATIONS,
        )
    carried = _carried(solution, flows, gained, heat)
    stored = float((flows.stored * heat).sum())
    generated_all = float(generated.sum())
    difference = generated_all - float(to_walls.sum()) - stored
    difference += sum(one.heat_in - one.heat_out for one in carried.values())
    return MeanTemperature(
        temperature=temperature,
        viscosities=Viscosities(flow=viscosity, shear=viscosity, carried=np.ones(shape)),
        dissipation=generated,
        to_walls=to_walls,
        stored=stored,
        carried=carried,
        imbalance=abs(difference) / (scale or 1.0),
        outlet_temperature=float((leaving * temperature).sum() / leaving.sum()) if leaving.any() else float("nan"),
        highest=(float(solution.grid.x[highest[0]]), float(solution.grid.y[highest[1]])),
        slopes=(slope_x, slope_y),
    )


def _runaway(solution: Solution, place: tuple[np.intp, ...]) -> ConvergenceError:
    """The error of a film without a steady temperature, at the place of the largest one."""
    x, y = solution.grid.x[place[0]], solution.grid.y[place[1]]
    why = "too little of it leaves the film; lower the speed or the load, supply more lubricant"
    if solution.problem.opening is not None:
        why = "walls that approach displace lubricant to all sides of a place, at which it stays; let them slide faster"
    return ConvergenceError(
        f"temperature: thermal runaway, the liquid at x = {x:.4g} m, y = {y:.4g} m heats by more than "
        f"{MAX_HEATING:g} K, as {why}, or take the model across with walls that take heat",
        outcome=Outcome.DIVERGED,
    )


def _arranged(flows: Flows) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The nodes in the order of the flow, and those whose liquid returns to nodes before them."""
    waiting, stack, done, order, late = (np.zeros(flows.along.size, dtype=np.int64) for _ in range(5))
    arrange(flows.along, flows.across, waiting, stack, done, order, late)
    return order, np.flatnonzero(late)


def _solve(
    linear: tuple[NDArray[Any], ...], source: Array, late: NDArray[np.int64], unknowns: tuple[Array, Array, Array]
) -> None:
    """Solve the linear heat balances for e, e_x and e_y of the nodes.

    One sweep in the order of the flow solves them from the values z of the nodes whose liquid returns, and gives
    A z + g. Generalised conjugate residuals solve (1 - A) z = g; each direction changes all unknowns in proportion.
    Source: Eisenstat, Elman and Schultz 1983, doi:10.1137/0720023.
    """
    before = _returned(unknowns, late)
    sweep(*linear, source, *unknowns)
    residual = _returned(unknowns, late) - before
    least = CIRCULATION_TOLERANCE * np.linalg.norm(residual)
    known: list[tuple[Array, ...]] = []
    for _ in range(CIRCULATION_ITERATIONS):
        if np.linalg.norm(residual) <= least:
            break
        response = tuple(np.zeros_like(source) for _ in unknowns)
        for values, part in zip(response, np.split(residual, len(response)), strict=True):
            values.reshape(-1)[late] = part
        sweep(*linear, np.zeros_like(source), *response)
        direction = residual - _returned(response, late), *response
        for other in known:
            common = direction[0] @ other[0]
            direction = tuple(own - common * one for own, one in zip(direction, other, strict=True))
        size = np.linalg.norm(direction[0])
        if size == 0:  # the liquid returns with all of its heat
            break
        direction = tuple(own / size for own in direction)
        length = direction[0] @ residual
        residual = residual - length * direction[0]
        for values, change in zip(unknowns, direction[1:], strict=True):
            values += length * change
        known = [*known, direction] if len(known) < REMEMBERED else [direction]


def _returned(values: tuple[Array, ...], late: NDArray[np.int64]) -> Array:
    """The values of the nodes whose liquid returns, one after the other."""
    return np.concatenate([one.reshape(-1)[late] for one in values])


def _carried(solution: Solution, flows: Flows, gained: Array, heat: Array) -> dict[str, Carried]:
    """What the flows from and to the outside carry, by place."""
    rest = np.ones(solution.grid.shape, dtype=bool)
    places: dict[str, NDArray[np.bool_]] = {}

    def place(name: str, nodes: NDArray[np.bool_]) -> None:
        places[name] = nodes & rest
        rest[nodes] = False

    between = gaps(solution.problem.shape, solution.grid)
    if between:
        place("gaps", np.isin(np.arange(rest.shape[0]), np.concatenate(between))[:, None] & rest)
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    for number, inflow in enumerate(solution.problem.inflows, start=1):
        place(f"supply_{number}", inflow.covers(x, y))
    ends = np.zeros_like(rest)
    if solution.problem.ends.sides is not None:
        ends[:, [0, -1]] = True
        place("sides", ends)
    if not solution.network.periodic[0]:
        place("inlet", np.arange(rest.shape[0])[:, None] == np.zeros(rest.shape))
        place("outlet", np.arange(rest.shape[0])[:, None] == np.full(rest.shape, rest.shape[0] - 1))
    place("inside", rest.copy())
    flow_in, flow_out = np.maximum(flows.entering, 0.0), np.maximum(-flows.entering, 0.0)
    return {
        name: Carried(
            flow_in=float(flow_in[nodes].sum()),
            flow_out=float(flow_out[nodes].sum()),
            heat_in=float(gained[nodes].sum()),
            heat_out=float((flow_out * heat)[nodes].sum()),
        )
        for name, nodes in places.items()
    }
