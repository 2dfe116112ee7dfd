"""One film region of an infinitely wide bearing, solved as an ordinary differential equation: a reference."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.problem import Problem

RELATIVE, ABSOLUTE = 1e-13, 1e-16
"""Tolerances of the integration, over the unit of pressure."""

SAMPLES = 4000
"""Places at which the narrowest one is sought before it is refined."""

DOUBLINGS = 60
"""Of the flow, until it is more than the inlet can let in."""

UNBOUNDED, NEAR = 1.0, 1e-6
"""Over the unit of pressure: what a flow whose film has no pressure is told to exceed by, and what none need be."""

STIFFEST = 1e-10
"""Least η0/η: where the liquid is stiffer, the pressure is taken to grow beyond all bounds."""

EVALUATIONS = 6000
"""Of the slope, for one film; most take about 1000."""

START, END, GREATEST = "start", "end", "greatest"

Wide = Callable[[float], float]


@dataclass(frozen=True, kw_only=True)
class Exact:
    """A film with one region; pressures are above that of cavitation.

    Attributes
    ----------
    load : ∫ p dx, N/m.
    pressure_max : Pa.
    film_start, rupture : where the film begins and ends, x/L from the inlet; both are 1 where there is none.
    flow : through the film, m²/s at the density of cavitation.
    """

    load: float
    pressure_max: float
    film_start: float
    rupture: float
    flow: float


class _Film(NamedTuple):
    """A film of one flow, over the units of length and pressure; ``inlet`` is its pressure where x = 0."""

    load: float
    greatest: float
    start: float
    rupture: float
    inlet: float


def exact(problem: Problem) -> Exact:
    """Solve dp/dx = 12 η(p)/(θ h³) (u θ h/2 - m) with one constant flow m between the film's start and its rupture.

    The film ends where p = 0 and u h/2 = m on its widening side, or else at the outlet with p = 0, from where it is
    integrated against the sliding, in which direction errors decay. A starved inlet brings m = u θ h/2 and the film
    begins where p = 0; if it then reaches the inlet, more is brought than enters. An inlet of given pressure, or one
    that brings enough, lets in the m for which p is that pressure there. About 11 digits are right, whatever the bulk
    modulus, and fewer where viscosity grows by orders of magnitude; the lubricant's laws are all that is shared with
    the finite volumes.

    Valid for infinitely wide films whose thickness is continuous and has one minimum, slid towards growing x, with
    the outlet at the pressure of cavitation.

    Raises
    ------
    InputError
        If the film is not of that kind.
    ConvergenceError
        If the pressure has no bound, as may be where viscosity grows with it without end, or changes too steeply to
        be integrated, as where viscosity grows ten thousandfold and only compression bounds the pressure.

    Sources: Jakobsson and Floberg 1957 for the conditions at both ends; Elrod 1981, doi:10.1115/1.3251669.
    """
    _check(problem)
    places = _Places.of(problem)
    drag, ends = problem.speed / 2, problem.ends
    if ends.inlet is None:
        brought = drag * ends.theta * places.thickness(0.0)
        film = _tried(problem, places, brought)
        if film is not None and film.inlet <= 0:
            return _told(places, film, brought)
    flow = _flow_of(problem, places, ends.inlet or 0.0)
    return _told(places, _film(problem, places, flow), flow)


def _check(problem: Problem) -> None:
    shape, ends = problem.shape, problem.ends
    if not shape.wide or any(shape.joined):
        raise InputError("shape: got a film with sides or joined ends; the exact solution is that of a line")
    if problem.speed <= 0:
        raise InputError(f"speed: got {problem.speed!r} m/s; it must be above 0, turn the film round")
    if ends.outlet != 0:
        raise InputError(f"outlet: got {ends.outlet!r} Pa; a second film begins there, it must be 0")


@dataclass(frozen=True, kw_only=True)
class _Places:
    """Film thickness over x/L, where its slope may jump, and where it is least; ``pressure`` is the unit, Pa."""

    thickness: Wide
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
        found = scipy.optimize.minimize_scalar(thickness, bounds=around, method="bounded", options={"xatol": 1e-12})
        narrowest = float(found.x) if found.fun < film[lowest] else float(samples[lowest])
        unit = 6 * problem.viscosity * problem.speed * length / thickness(narrowest) ** 2
        return cls(thickness=thickness, breaks=breaks, narrowest=narrowest, length=length, pressure=unit)


def _told(places: _Places, film: _Film, flow: float) -> Exact:
    return Exact(
        load=film.load * places.pressure * places.length,
        pressure_max=film.greatest * places.pressure,
        film_start=film.start,
        rupture=film.rupture,
        flow=flow,
    )


def _flow_of(problem: Problem, places: _Places, inlet: float) -> float:
    """The flow whose film has the pressure ``inlet``, Pa, where x = 0: what it lacks grows with the flow."""

    def excess(flow: float) -> float:
        film = _tried(problem, places, flow)
        if film is None:
            return UNBOUNDED
        return (film.inlet if film.start == 0 else -film.start) - inlet / places.pressure

    least = problem.speed / 2 * places.thickness(places.narrowest)
    most = problem.speed / 2 * places.thickness(0.0)
    for _ in range(DOUBLINGS):
        if excess(most) > 0:
            break
        least, most = most, 2 * most
    if excess(least) >= 0:
        return least
    found = float(scipy.optimize.brentq(excess, least, most, xtol=1e-300, rtol=4 * np.finfo(float).eps, maxiter=200))
    if abs(excess(found)) > NEAR:
        raise _unbounded()
    return found


def _tried(problem: Problem, places: _Places, flow: float) -> _Film | None:
    """The film that a flow keeps; None if its pressure grows beyond all bounds, as that of all greater flows does."""
    try:
        return _film(problem, places, flow)
    except ConvergenceError:
        return None


def _film(problem: Problem, places: _Places, flow: float) -> _Film:
    """The film that a flow keeps, integrated from its end to its start."""
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
    """slope(x, (p, load behind x)) over the units of length and pressure."""
    left = EVALUATIONS

    def slope(x: float, state: Array) -> Array:
        nonlocal left
        left -= 1
        h = places.thickness(x)
        pressure = np.array([max(float(state[0]), 0.0) * places.pressure])
        theta = 1 + problem.compression(pressure)[0][0]
        fluidity = problem.piezoviscosity.fluidity(pressure, problem.viscosity)[0][0]
        if fluidity < STIFFEST or left < 0:
            raise _unbounded()
        rise = 12 * problem.viscosity / fluidity / h**3 * (problem.speed / 2 * h - flow / theta)
        return np.array([rise * places.length / places.pressure, -state[0]])

    return slope


def _integrated(slope: Slope, here: float, stop: float, state: Array, *, rising: bool) -> tuple[float, str]:
    """How far it goes from ``here`` against the sliding until the pressure is 0, greatest, or ``stop`` is reached.

    The greatest is met once, and looked for only while the pressure is still ``rising`` that way.
    """

    def starts(_x: float, now: Array) -> float:
        return float(now[0])

    def falls(x: float, now: Array) -> float:
        return float(slope(x, now)[0])

    starts.terminal = falls.terminal = True  # type: ignore[attr-defined]
    starts.direction, falls.direction = -1, 1  # type: ignore[attr-defined]
    found = scipy.integrate.solve_ivp(
        slope,
        (here, stop),
        state,
        method="DOP853",
        rtol=RELATIVE,
        atol=ABSOLUTE,
        events=[starts, falls] if rising else [starts],
    )
    _whole(found)
    if found.t_events[0].size:
        return float(found.t_events[0][0]), START
    if rising and found.t_events[1].size:
        return float(found.t_events[1][0]), GREATEST
    return stop, END


def _state_at(slope: Slope, here: float, there: float, state: Array) -> Array:
    """The state at a place, by steps that end there: between them it is known less well."""
    found = scipy.integrate.solve_ivp(slope, (here, there), state, method="DOP853", rtol=RELATIVE, atol=ABSOLUTE)
    _whole(found)
    return np.asarray(found.y[:, -1])


def _whole(found: Any) -> None:
    if not found.success or not np.isfinite(found.y).all():
        raise _unbounded()


def _unbounded() -> ConvergenceError:
    return ConvergenceError(
        "exact: the pressure of the film grows beyond all bounds or too steeply; viscosity must grow less with it",
        outcome=Outcome.DIVERGED,
    )
