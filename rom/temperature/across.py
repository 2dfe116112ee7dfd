"""The temperature over a film and across it."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.anderson import AndersonAcceleration
from roughfilm.rom.temperature.basis import Basis, basis
from roughfilm.rom.temperature.equations import (
    Audit,
    Equations,
    Linearised,
    Plane,
    audited,
    equations,
    linearised,
    plane,
    viscosities_across,
)
from roughfilm.rom.temperature.power import Carriers, carriers
from roughfilm.rom.temperature.sweeps import extremes, summarise, sweep
from roughfilm.rom.temperature.walls import FixedWall, SlidingWall, TurningWall, WallCondition, condition

MODES = 8
"""Number of Legendre modes across the film by default."""

TOLERANCE = 1e-4
"""Mean change of the temperature over its range, in the first sweep after viscosities are renewed, at which it stops.

The sweeps after it reduce the error further, to about a tenth.
"""

RESIDUAL_TOLERANCE = 2.5e-9
"""Largest residual of the equations with the last viscosities, over the sum of four heat flows.

These are the power, what enters and what both walls take, so that the balance holds to 1e-8 of the largest one.
"""

RENEWALS = 60
"""Largest number of times that viscosities and equations are renewed."""

SWEEPS = 6
"""Largest number of sweeps with the same equations before viscosities are renewed."""

FALL = 0.2
"""Change of a sweep over that of the first one with the same equations, at which the equations are renewed."""

LAST_FALL = 1e-4
"""The same where the temperature no longer changes, but the equations have a residual."""

PLACES = 65
"""Places across the film between which the largest temperature lies."""

NEAR_PEAK = 0.02
"""Difference from the largest temperature at the points over the range below which a node may have the largest one."""

LEAST_RANGE = 0.01
"""Range of the temperature, K, below which changes and residuals are those over this range."""

WITHOUT_OUTLET = 0.5
"""Residual over the heat flows from which on most of the power of a film finds no way out of it."""

ROUND_OFF = 2048 * float(np.finfo(float).eps)
"""Round-off of the residuals over the heat that the rise of the temperature would conduct across the film."""

ROUND_OFF_OF_OUTLET = 128 * float(np.finfo(float).eps)
"""The same over that heat times its ratio to all heat flows.

A film that conducts much more heat than walls and lubricant take out of it is at the temperature at which the small
heat that leaves, a difference of large ones, is right.
"""

STUCK = 8
"""Number of renewals without a fall of the residual by half after which it counts as one that no longer falls."""

LARGEST_ROUND_OFF = 1e-6
"""Largest round-off of the residuals over the heat flows at which the heat of a film counts as balanced."""

LARGEST_RISE = 1000.0
"""Largest difference from the temperature of the supply, K, before the iteration ends."""

LIMITED_RENEWALS = 12
"""Number of renewals, from the first start on, after which the limited factors of the faces stay the same.

They would keep changing by little where the temperature is uneven, so that the iteration would not converge.
"""

EXTRAPOLATED = 6
"""Number of renewals after which the temperature is extrapolated from those before by Anderson's method.

Streamlines that close, and nodes through which little lubricant flows, need so many renewals: sweeps reduce an error
that circulates by as much as conduction does in one turn alone.
"""

REMEMBERED = 8
"""Number of renewals before from which it is extrapolated."""

RESPONSE_SWEEPS = 12
"""Largest number of sweeps for the first response of a film to the temperature of a turning wall."""

RESPONSE_CHANGE = 0.02
"""Relative change of that response at which these sweeps stop."""


@dataclass(frozen=True, kw_only=True)
class WallHeat:
    """The temperature of a wall at the film, K, and the heat flux into it, W/m², each of shape (nx, ny).

    In a cavity both are those of the streamers; the flux is per area of the wall, filled or not.
    """

    temperature: Array
    flux: Array


@dataclass(frozen=True, kw_only=True)
class HeatBalance:
    """The heat flows of a film, W (W/m if infinitely wide), of a heat that is 0 at the temperature of the liquid.

    dissipation + entering = leaving + sliding_wall + fixed_wall + stored, but for the residual.

    Attributes
    ----------
    dissipation : power of sliding and of the pressures of the supplies, with the viscosities at T.
    entering, leaving : with the lubricant, through ends, sides and supplies.
    sliding_wall, fixed_wall : into the walls.
    stored : with the lubricant that the control volumes take up where walls move, and that spills at sides.
    """

    dissipation: float
    entering: float
    leaving: float
    sliding_wall: float
    fixed_wall: float
    stored: float


@dataclass(frozen=True, kw_only=True)
class Iterate:
    """What an iteration leaves for the next one: properties, factors of faces, the count of renewals, and a response.

    Attributes
    ----------
    heat : heat of a volume at the points, J/m³, shape (nx, ny, N).
    near : properties of the liquid at the temperatures; None if heat and properties are to be evaluated again.
    reach : limited factors of the faces in x and in y.
    renewals : number of renewals of viscosities from the first start on.
    response : change of the heat by the temperature of a turning wall, J/(m³ K); None for other walls.
    slope : change of the heat flow into a turning wall by its temperature, W/K.
    contraction : change of the second sweep with the same equations over that of the first one, measured last.
    """

    heat: Array
    near: Linearised | None
    reach: tuple[Array, Array]
    renewals: int
    response: Array | None
    slope: float
    contraction: float


@dataclass(frozen=True, kw_only=True)
class TemperatureAcross:
    """The temperature over a film and across it.

    Attributes
    ----------
    temperature : temperatures T at the points across, K, shape (nx, ny, N).
    points, weights : positions ζ = z/h of the N Gauss points from the sliding wall, and their weights, which sum to 1.
    mean : mean of T across the film, K, shape (nx, ny).
    carried : mean of T weighted by the size of the velocity along the sliding, K, shape (nx, ny).
    viscosities : viscosities at T at the nodes, at the cavitation pressure.
    sliding_wall, fixed_wall : temperatures of the walls and heat fluxes into them.
    largest : largest temperature of the film, K.
    place : position (x, y, ζ) of the largest temperature.
    balance : heat flows of the film.
    residual : sum of the sizes of all residuals over the power and the sizes of the heat flows in.
    change : mean change of T over its range in the first sweep after viscosities were renewed last.
    settled : whether residual and change meet their tolerances, which ``renewals`` may prevent.
    sweeps : number of sweeps over the film.
    shaft : temperature of a turning wall, K; None for other walls.
    iterate : what a further iteration starts from.
    """

    temperature: Array
    points: Array
    weights: Array
    mean: Array
    carried: Array
    viscosities: Viscosities
    sliding_wall: WallHeat
    fixed_wall: WallHeat
    largest: float
    place: tuple[float, float, float]
    balance: HeatBalance
    residual: float
    change: float
    settled: bool
    sweeps: int
    shaft: float | None
    iterate: Iterate


def temperature_across(
    solution: Solution,
    liquid: Liquid,
    *,
    sliding_wall: SlidingWall,
    fixed_wall: FixedWall,
    entering: float | Array | None = None,
    added_power: Array | None = None,
    carried_over: float = 1.0,
    modes: int = MODES,
    start: TemperatureAcross | None = None,
    tolerance: float = TOLERANCE,
    renewals: int | None = None,
) -> TemperatureAcross:
    """Solve ρc (u ∂T/∂x + v ∂T/∂y + w ∂T/∂z) = k ∂²T/∂z² + η ((∂u/∂z)² + (∂v/∂z)²) in a film of given flows.

    The temperature is a polynomial of degree ``modes`` - 1 in ζ = z/h, in weak form across the film. The flow through
    each face is that of the film, with the profiles of the viscosities at T. The dissipation of a node is that of the
    film, W (:func:`roughfilm.rom.temperature.dissipation.dissipation`), times η_s(T)/η_s: shear and flow by pressure
    both dissipate in proportion to the viscosity while the flows stay, so that films and fields in turn converge as
    those of :func:`roughfilm.rom.temperature.mean.mean_temperature`. In the plane heat is carried with the flow at each
    point, by limited linear upwind values: second-order accurate. Streamers of a cavity fill the whole film thickness
    over a part of the width.

    Parameters
    ----------
    sliding_wall, fixed_wall : conditions at ζ = 0 and ζ = 1.
    entering : temperature of lubricant that enters from outside, K, a number or of shape (nx, ny); by default that of
        the liquid.
    added_power : further power that heats the lubricant of each node, such as that of asperities in contact, W, shape
        (nx, ny); it is distributed across the film as the dissipation.
    carried_over : part of the liquid that a film discharges into a gap which enters the next one at most.
    modes : number N of Legendre modes across, from 2.
    start : a field with the same numbers of nodes and modes from which the iteration starts; its ``iterate`` is of use
        on the same grid alone, and is ignored for other numbers of nodes.
    tolerance : mean change of the temperature over its range, in the first sweep after viscosities are renewed, at
        which it stops.
    renewals : number of renewals of the viscosities after which the iteration stops without meeting the tolerance, for
        a film that changes further; residual and change are those reached.

    Raises
    ------
    InputError
        If there are fewer than two modes, the start has another shape, or a wall does not suit the film.
    ConvergenceError
        If the iteration does not converge.

    Source: Dowson 1962, doi:10.1016/S0020-7403(62)80038-1.
    """
    if renewals is not None and renewals < 1:
        raise InputError(f"renewals: got {renewals}; at least 1 is needed")
    if modes < 2:
        raise InputError(f"modes: got {modes}; at least 2 are needed across the film")
    shape = (*solution.grid.shape, modes)
    if start is not None and start.temperature.shape != shape:
        raise InputError(f"start: got a field of shape {start.temperature.shape}; it must be {shape}")
    given = liquid.temperature if entering is None else entering
    parts, moved = basis(modes), carriers(solution, carried_over)
    if added_power is not None:
        moved = replace(moved, added=added_power)
    temperature = (
        np.broadcast_to(np.asarray(given, dtype=float)[..., None], shape) if start is None else start.temperature
    )
    shaft = float(np.mean(given)) if start is None or start.shaft is None else start.shaft
    both = sliding_wall, fixed_wall
    walls = [condition(wall, solution, moved.filling, liquid.temperature, shaft) for wall in both]
    film = _Film(
        solution=solution,
        liquid=liquid,
        parts=parts,
        moved=moved,
        nodes=plane(solution, liquid, moved.filling, given),
        walls=(walls[0], walls[1]),
        entry=walls[0].outside.copy(),
        turning=isinstance(sliding_wall, TurningWall),
    )
    return _solved(film, np.array(temperature), None if start is None else start.iterate, tolerance, renewals)


@dataclass(frozen=True, kw_only=True)
class _Film:
    """What stays the same during an iteration; the temperature outside of the sliding wall is changed in place."""

    solution: Solution
    liquid: Liquid
    parts: Basis
    moved: Carriers
    nodes: Plane
    walls: tuple[WallCondition, WallCondition]
    entry: Array
    turning: bool


def _solved(
    film: _Film, temperature: Array, before: Iterate | None, tolerance: float, most: int | None
) -> TemperatureAcross:
    """Renew viscosities and equations, and sweep, until the temperature no longer changes."""
    supply = film.liquid.temperature
    if before is not None and before.near is not None:
        heat, near = before.heat.copy(), before.near
    else:
        heat = np.array(np.broadcast_to(film.liquid.heat(temperature)[0], temperature.shape))
        near = linearised(film.liquid, heat, temperature)
    response = np.zeros(temperature.shape) if film.turning else None
    done, reach, slope = 0, None, 0.0
    if before is not None and before.reach[0].shape == temperature.shape:
        done, reach = before.renewals, before.reach if before.renewals >= LIMITED_RENEWALS else None
        if film.turning and before.response is not None:
            response, slope = before.response.copy(), before.slope
    into_wall, sweeps, renewed, change = np.zeros(temperature.shape[:2]), 0, 0, np.inf
    fixed = film.solution, supply, film.moved, film.nodes, film.parts
    known: Equations | None = None
    memory = AndersonAcceleration(remembered=REMEMBERED)
    fall, limit = FALL, RENEWALS if most is None else most
    contraction, stuck, best = np.inf if before is None else before.contraction, 0, np.inf
    low, high = extremes(heat)
    extent = max(high - low, LEAST_RANGE * _capacity(film.liquid))
    while True:
        point = _state(film, heat) if renewed >= EXTRAPOLATED else None
        known = system = equations(*fixed, near, film.walls, heat, reach, known)
        done, renewed = done + 1, renewed + 1
        reach = system.reach if done >= LIMITED_RENEWALS else None
        if response is not None and (slope == 0 or renewed == 2):
            slope = _respond(film, system, response)
        changes = _relaxed(film, system, heat, into_wall, response, slope, fall, contraction, tolerance * extent)
        if len(changes) > 1 and changes[0] > 0:
            contraction = changes[1] / changes[0]
        sweeps, (low, high) = sweeps + len(changes), extremes(heat)
        _check_range(film, heat, max(high, -low) if np.isfinite(changes[-1]) else np.inf, sweeps)
        extent = max(high - low, LEAST_RANGE * _capacity(film.liquid))
        change = changes[0] / extent
        near = linearised(film.liquid, heat, near.near(supply, heat))
        if change <= tolerance or renewed == limit:
            checked = audited(system, film.nodes, film.parts, heat, near.rise(heat), film.walls)
            residual, least, stuck_at = _residual(film, checked, extent / (high - low) if high > low else 1.0)
            stuck, best, fall = 0 if residual < best / 2 else stuck + 1, min(best, residual), LAST_FALL
            least = stuck_at if stuck >= STUCK else least
            if residual <= least or renewed == limit:
                break
        if point is not None:
            _extrapolate(film, memory, point, heat)
            near = linearised(film.liquid, heat, near.near(supply, heat))
    settled = residual <= least and change <= tolerance
    if most is None and not settled:
        remedy = "take more cells, or a lower speed or viscosity"
        if residual >= WITHOUT_OUTLET:
            remedy = "neither walls nor lubricant take so much heat out of it; cool a wall, or supply new lubricant"
        raise ConvergenceError(
            f"temperature across the film: after {sweeps} sweeps it changes by {change:.1e} of its range, with a "
            f"residual of {residual:.1e}, above the tolerances {tolerance:.1e} and {least:.1e}; {remedy}",
            outcome=Outcome.UNFINISHED,
            iterations=sweeps,
        )
    following = Iterate(
        heat=heat,
        near=near,
        reach=system.reach,
        renewals=done,
        response=response,
        slope=slope,
        contraction=contraction,
    )
    return _result(film, system, heat, near, checked, residual, change, settled, sweeps, following)


def _state(film: _Film, heat: Array) -> Array:
    """The heat at all points, and that at the temperature outside of the sliding wall at the first node, J/m³."""
    return np.append(heat, _capacity(film.liquid) * film.walls[0].outside[0, 0])


def _extrapolate(film: _Film, memory: AndersonAcceleration, point: Array, heat: Array) -> None:
    """Extrapolate the heat, and the temperature of a turning wall, from those before and after each renewal.

    A renewal and its sweeps are a map of the heat that is almost affine once the limited factors stay the same.
    Conduction and what flows in and out make it a contraction, whose slow parts, one of each closed streamline, are
    what Anderson's method removes.
    """
    image = _state(film, heat)
    found = memory.following(image - point, image)
    heat[...] = found[:-1].reshape(heat.shape)
    if film.turning:
        film.walls[0].outside[...] = found[-1] / _capacity(film.liquid)


def _check_range(film: _Film, heat: Array, largest: float, sweeps: int) -> None:
    """Raise ConvergenceError if the largest size of a heat is not finite, or beyond all laws of viscosity."""
    if largest <= LARGEST_RISE * _capacity(film.liquid):
        return
    size, grid = np.abs(heat).max(axis=2), film.solution.grid
    i, j = np.unravel_index(int(np.where(np.isfinite(size), size, np.inf).argmax()), size.shape)
    polar = film.solution.problem.shape.polar
    place = f"{np.degrees(grid.x[i]):.4g}° of the angle, radius" if polar else f"x = {grid.x[i]:.4g} m, y ="
    insulated = not any(wall.holds for wall in film.walls)
    remedy = "let a wall take heat, or take heat_balance" if insulated else "lower the speed or the viscosity"
    raise ConvergenceError(
        f"temperature across the film: after {sweeps} sweeps it differs by more than {LARGEST_RISE:g} K from that of "
        f"the supply at {place} {grid.y[j]:.4g} m, where no lubricant is liquid; {remedy}, or lower the jump of the "
        "pressure if edges of the film meet there",
        outcome=Outcome.DIVERGED,
        iterations=sweeps,
    )


def _capacity(liquid: Liquid) -> float:
    """The heat capacity of a volume at the temperature of the supply, J/(m³ K)."""
    return float(np.ravel(liquid.heat(np.array([liquid.temperature]))[1])[0])


def _relaxed(
    film: _Film,
    system: Equations,
    heat: Array,
    into_wall: Array,
    response: Array | None,
    slope: float,
    fall: float,
    contraction: float,
    small: float,
) -> list[float]:
    """Sweep until the mean change has fallen; a turning wall takes the temperature at which it gets no heat.

    The second sweep is left out where the first one changes more than ``small``, so that viscosities are renewed again,
    and where it would change little by the ``contraction`` of the sweeps before.
    """
    changes: list[float] = []
    fallen = False
    while len(changes) < SWEEPS and not fallen:
        changes.append(_sweep(film, system, heat, into_wall))
        once = len(changes) == 1
        fallen = contraction <= fall and changes[0] > small if once else changes[-1] <= fall * changes[0]
        if response is not None and slope < 0:
            step = -float((film.nodes.area * into_wall).sum()) / slope
            heat += step * response
            film.walls[0].outside[...] += step
    return changes


def _sweep(film: _Film, system: Equations, heat: Array, into_wall: Array) -> float:
    """Sweep down the film and back over the rows into which lubricant flows back; returns the mean change, J/m³."""
    back = np.flatnonzero(system.backward)[::-1]
    rows = np.concatenate([np.arange(heat.shape[0]), back])
    parts = (system.along, system.beside, *system.reach, *film.nodes.periodic, *system.solved)
    sliding, size = film.walls[0], film.parts.points.size
    wall = film.moved.filling, sliding.history, film.entry, sliding.outside, into_wall
    return float(sweep(heat, *parts, *wall, rows, np.empty(size), np.empty(size))) / heat.size


def _respond(film: _Film, system: Equations, response: Array) -> float:
    """Sweep the response of the heat to the temperature of a turning wall; returns that of its heat, W/K."""
    inverse, constant, wall, flux, flux_constant, flux_wall = system.solved
    alone = replace(system, solved=(inverse, 0 * constant, wall, flux, 0 * flux_constant, flux_wall))
    unit = replace(film.walls[0], outside=np.ones(flux_wall.shape))
    into_wall, slope, first = np.zeros(flux_wall.shape), -np.inf, not response.any()
    of_unit = replace(film, walls=(unit, film.walls[1]), entry=unit.outside)
    for _ in range(RESPONSE_SWEEPS if first else 1):
        _sweep(of_unit, alone, response, into_wall)
        before, slope = slope, float((film.nodes.area * into_wall).sum())
        if abs(slope - before) <= RESPONSE_CHANGE * abs(slope):
            break
    return slope


def _residual(film: _Film, checked: Audit, wider: float) -> tuple[float, float, float]:
    """The sum of the sizes of the residuals over the power and the heat flows in, and what is allowed of it.

    The second limit is that of residuals that no longer fall: their round-off, or in a film whose temperature varies by
    less than ``LEAST_RANGE``, which is ``wider`` by a factor, that of a film that varies by it.
    """
    wrong, scale = checked.residuals, checked.scale
    if film.turning:
        wrong += abs(float((film.nodes.area * checked.into_sliding).sum()))
    if not scale > 0:
        least = max(RESIDUAL_TOLERANCE, ROUND_OFF * checked.conducted)
        return wrong, least, least
    conducted = checked.conducted / scale
    least = max(RESIDUAL_TOLERANCE, ROUND_OFF * conducted)
    rounded = max(ROUND_OFF_OF_OUTLET * conducted**2, RESIDUAL_TOLERANCE * wider)
    return wrong / scale, least, max(least, min(rounded, LARGEST_ROUND_OFF))


def _result(
    film: _Film,
    system: Equations,
    heat: Array,
    near: Linearised,
    checked: Audit,
    residual: float,
    change: float,
    settled: bool,
    sweeps: int,
    iterate: Iterate,
) -> TemperatureAcross:
    """The fields and the heat balance of a converged iteration."""
    parts, nodes, temperature = film.parts, film.nodes, near.temperature
    mean, carried, peaks, low, high = (np.empty(nodes.area.shape) for _ in range(5))
    written = mean, carried, peaks, low, high
    flows = system.along, system.leaving, system.stored
    leaving, stored = summarise(temperature, heat, *flows, parts.weights, parts.ends, nodes.periodic[0], *written)
    largest, place = _largest(film, temperature, peaks)
    balance = HeatBalance(
        dissipation=checked.power,
        entering=checked.entering,
        leaving=float(leaving),
        sliding_wall=float((nodes.area * checked.into_sliding).sum()),
        fixed_wall=float((nodes.area * checked.into_fixed).sum()),
        stored=float(stored),
    )
    return TemperatureAcross(
        temperature=temperature,
        points=parts.points,
        weights=parts.weights,
        mean=mean,
        carried=carried,
        viscosities=viscosities_across(parts, near.viscosity),
        sliding_wall=WallHeat(temperature=low, flux=film.moved.filling * checked.into_sliding),
        fixed_wall=WallHeat(temperature=high, flux=film.moved.filling * checked.into_fixed),
        largest=largest,
        place=place,
        balance=balance,
        residual=residual,
        change=change,
        settled=settled,
        sweeps=sweeps,
        shaft=film.liquid.temperature + float(film.walls[0].outside[0, 0]) if film.turning else None,
        iterate=iterate,
    )


def _largest(film: _Film, temperature: Array, peaks: Array) -> tuple[float, tuple[float, float, float]]:
    """The largest temperature of the polynomials, K, and its position (x, y, ζ), where lubricant flows.

    Only nodes whose points are almost as hot as the hottest one are searched.
    """
    peaks = np.where(film.moved.flowing, peaks, -np.inf)
    places = np.linspace(0, 1, PLACES)
    least, greatest = extremes(temperature)
    candidates = np.argwhere(peaks >= peaks.max() - NEAR_PEAK * (greatest - least))
    values = temperature[candidates[:, 0], candidates[:, 1]] @ film.parts.values(places).T
    node, place = np.unravel_index(int(values.argmax()), values.shape)
    i, j = candidates[node]
    grid = film.solution.grid
    return float(values.max()), (float(grid.x[i]), float(grid.y[j]), float(places[place]))
