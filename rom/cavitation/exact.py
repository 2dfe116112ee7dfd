"""Reference solution of one film region of an infinitely wide bearing, as an ordinary differential equation."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.problem import Problem

RELATIVE_TOLERANCE = 1e-13
"""Relative tolerance of the integration."""

ABSOLUTE_TOLERANCE = 1e-16
"""Absolute tolerance of the integration, over the unit of pressure."""

SAMPLES = 4000
"""Number of positions among which the narrowest one is sought before it is refined."""

MAX_DOUBLINGS = 60
"""Largest number of doublings of the flow until it exceeds that of the inlet pressure."""

UNBOUNDED_EXCESS = 1.0
"""Excess pressure at the inlet, over its unit, assigned to a flow whose film has no bounded pressure."""

INLET_TOLERANCE = 1e-6
"""Largest error of the inlet pressure over the unit of pressure."""

MIN_FLUIDITY = 1e-10
"""Smallest η0/η; below it the pressure counts as unbounded."""

MAX_EVALUATIONS = 6000
"""Largest number of evaluations of the pressure gradient for one film; most films take about 1000."""

START, END, GREATEST = "start", "end", "greatest"

Thickness = Callable[[float], float]


@dataclass(frozen=True, kw_only=True)
class Exact:
    """A film with one region; pressures are above cavitation pressure.

    Attributes
    ----------
    load : ∫ p dx, N/m.
    pressure_max : largest pressure, Pa.
    film_start, rupture : start and end of the film, x/L from the inlet; both are 1 without a film.
    flow : flow through the film at the density of the cavitation pressure, m²/s.
    """

    load: float
    pressure_max: float
    film_start: float
    rupture: float
    flow: float


class _Film(NamedTuple):
    """The film at a flow, over the units of length and pressure; ``inlet`` is the pressure at x = 0."""

    load: float
    greatest: float
    start: float
    rupture: float
    inlet: float


def exact(problem: Problem) -> Exact:
    """Solve dp/dx = 12 η(p)/(θ h³) (u θ h/2 - m) with a constant flow m between the film's start and its rupture.

    The film ends where p = 0 and u h/2 = m in its diverging part, or else at the outlet with p = 0. It is integrated
    from there against the sliding, the direction in which errors decay. A starved inlet supplies m = u θ h/2, and the
    film begins where p = 0; if it reaches the inlet, the supply exceeds the flow. For an inlet of given pressure, or
    with excess supply, m is the flow with that pressure at the inlet. About 11 digits are correct for any bulk modulus,
    fewer if the viscosity grows by orders of magnitude. Only the lubricant's laws are shared with the finite volumes.

    The solution is for infinitely wide films of continuous thickness with one minimum that slide towards increasing x,
    with the outlet at cavitation pressure.

    Raises
    ------
    InputError
        If the film is not of that kind.
    ConvergenceError
        If the pressure is unbounded, as may happen if the viscosity grows without limit, or too steep for the
        integration, as if the viscosity grows ten thousandfold and only compression bounds the pressure.

    Sources: Jakobsson and Floberg 1957 for the conditions at both ends; Elrod 1981, doi:10.1115/1.3251669.
    """
    _check(problem)
    places = _Places.of(problem)
    drag, ends = problem.speed / 2, problem.ends
    if ends.inlet is None:
        supply = drag * ends.theta * places.thickness(0.0)
        film = _tried(problem, places, supply)
        if film is not None and film.inlet <= 0:
            return _in_units(places, film, supply)
    flow = _flow_of(problem, places, ends.inlet or 0.0)
    return _in_units(places, _film(problem, places, flow), flow)


def _check(problem: Problem) -> None:
    shape, ends = problem.shape, problem.ends
    if not shape.wide or any(shape.joined):
        raise InputError("shape: got a film with sides or joined ends; the exact solution is that of a line")
    if problem.speed <= 0:
        raise InputError(f"speed: got {problem.speed!r} m/s; it must be above 0, mirror the film")
    if ends.outlet != 0:
        raise InputError(f"outlet: got {ends.outlet!r} Pa; it must be 0, as a second film would begin there")


@dataclass(frozen=True, kw_only=True)
class _Places:
    """The film thickness over x/L, its breaks of slope and narrowest position; ``pressure`` is the unit, Pa."""

    thickness: Thickness
    breaks: tuple[float, ...]
    narrowest: float
    length: float
    pressure: float

    @classmethod
    def of(cls, problem: Problem) -> "_Places":
        shape = problem.shape
        low, length = shape.breaks[0], shape.length

        def thickness(x: float) -> float:
            return float(shape.thickness(np.array([low + length * x]), np.zeros(1))[0])

        breaks = tuple((place - low) / length for place in shape.breaks)
        samples = np.unique(np.append(np.linspace(0.0, 1.0, SAMPLES), breaks))
        film: Array = shape.thickness(low + length * samples, np.zeros_like(samples))
        lowest = int(np.argmin(film))
        if (np.diff(film[: lowest + 1]) > 0).any() or (np.diff(film[lowest:]) < 0).any():
            raise InputError("shape: got a film with more than one narrowest place; it must have one")
        around = samples[max(lowest - 1, 0)], samples[min(lowest + 1, samples.size - 1)]
        minimum = scipy.optimize.minimize_scalar(thickness, bounds=around, method="bounded", options={"xatol": 1e-12})
        narrowest = float(minimum.x) if minimum.fun < film[lowest] else float(samples[lowest])
        unit = 6 * problem.viscosity * problem.speed * length / thickness(narrowest) ** 2
        return cls(thickness=thickness, breaks=breaks, narrowest=narrowest, length=length, pressure=unit)


def _in_units(places: _Places, film: _Film, flow: float) -> Exact:
    return Exact(
        load=film.load * places.pressure * places.length,
        pressure_max=film.greatest * places.pressure,
        film_start=film.start,
        rupture=film.rupture,
        flow=flow,
    )


def _flow_of(problem: Problem, places: _Places, inlet: float) -> float:
    """The flow at which the film has the pressure ``inlet``, Pa, at x = 0; the excess pressure grows with the flow."""

    def excess(flow: float) -> float:
        film = _tried(problem, places, flow)
        if film is None:
            return UNBOUNDED_EXCESS
        return (film.inlet if film.start == 0 else -film.start) - inlet / places.pressure

    least = problem.speed / 2 * places.thickness(places.narrowest)
    most = problem.speed / 2 * places.thickness(0.0)
    for _ in range(MAX_DOUBLINGS):
        if excess(most) > 0:
            break
        least, most = most, 2 * most
    if excess(least) >= 0:
        return least
    flow = float(scipy.optimize.brentq(excess, least, most, xtol=1e-300, rtol=4 * np.finfo(float).eps, maxiter=200))
    if abs(excess(flow)) > INLET_TOLERANCE:
        raise _unbounded()
    return flow


def _tried(problem: Problem, places: _Places, flow: float) -> _Film | None:
    """The film at a flow; None if its pressure is unbounded, as it is then at all larger flows."""
    try:
        return _film(problem, places, flow)
    except ConvergenceError:
        return None


def _film(problem: Problem, places: _Places, flow: float) -> _Film:
    """The film at a flow, integrated from its end to its start."""
    full = 2 * flow / problem.speed
    if full <= places.thickness(places.narrowest):
        return _Film(0.0, 0.0, 1.0, 1.0, 0.0)
    end = 1.0
    if places.thickness(1.0) > full:
        end = float(
            scipy.optimize.brentq(lambda x: places.thickness(x) - full, places.narrowest, 1.0, xtol=1e-16, rtol=1e-15)
        )
    slope = _slope(problem, places, flow)
    here, state = end, np.zeros(2)
    greatest: float | None = None
    for stop in (*(place for place in reversed(places.breaks) if 0 < place < end), 0.0):
        while here > stop:
            place, why = _integrated(slope, here, stop, state, rising=greatest is None)
            state = _state_at(slope, here, place, state)
            if why == START:
                steepness = slope(place, state)[0]
                return _Film(float(state[1]), greatest or 0.0, float(place - state[0] / steepness), end, 0.0)
            if why == GREATEST:
                greatest = float(state[0])
            here = place
    return _Film(float(state[1]), max(greatest or 0.0, float(state[0])), 0.0, end, float(state[0]))


Slope = Callable[[float, Any], Array]


def _slope(problem: Problem, places: _Places, flow: float) -> Slope:
    """The function slope(x, (p, load behind x)) over the units of length and pressure."""
    left = MAX_EVALUATIONS

    def slope(x: float, state: Array) -> Array:
        nonlocal left
        left -= 1
        h = places.thickness(x)
        pressure = np.array([max(float(state[0]), 0.0) * places.pressure])
        theta = 1 + problem.compression(pressure)[0][0]
        fluidity = problem.piezoviscosity.fluidity(pressure, problem.viscosity)[0][0]
        if fluidity < MIN_FLUIDITY or left < 0:
            raise _unbounded()
        rise = 12 * problem.viscosity / fluidity / h**3 * (problem.speed / 2 * h - flow / theta)
        return np.array([rise * places.length / places.pressure, -state[0]])

    return slope


def _integrated(slope: Slope, here: float, stop: float, state: Array, *, rising: bool) -> tuple[float, str]:
    """The position where the integration from ``here`` against the sliding ends, and why.

    It ends where the pressure is 0 or, while it is ``rising`` in that direction, largest, or at ``stop``.
    """

    def starts(_x: float, now: Array) -> float:
        return float(now[0])

    def falls(x: float, now: Array) -> float:
        return float(slope(x, now)[0])

    starts.terminal = falls.terminal = True  # type: ignore[attr-defined]
    starts.direction, falls.direction = -1, 1  # type: ignore[attr-defined]
    solution = _solved(slope, here, stop, state, events=[starts, falls] if rising else [starts])
    if solution.t_events[0].size:
        return float(solution.t_events[0][0]), START
    if rising and solution.t_events[1].size:
        return float(solution.t_events[1][0]), GREATEST
    return stop, END


def _state_at(slope: Slope, here: float, there: float, state: Array) -> Array:
    """The state at a position, by steps that end there, since interpolation between steps is less accurate."""
    return np.asarray(_solved(slope, here, there, state).y[:, -1])


def _solved(slope: Slope, here: float, there: float, state: Array, events: Any = None) -> Any:
    solution = scipy.integrate.solve_ivp(
        slope, (here, there), state, method="DOP853", rtol=RELATIVE_TOLERANCE, atol=ABSOLUTE_TOLERANCE, events=events
    )
    if not solution.success or not np.isfinite(solution.y).all():
        raise _unbounded()
    return solution


def _unbounded() -> ConvergenceError:
    return ConvergenceError(
        "exact: the pressure of the film is unbounded or too steep; take a viscosity that grows less with pressure",
        outcome=Outcome.DIVERGED,
    )
