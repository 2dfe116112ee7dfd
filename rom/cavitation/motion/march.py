"""Films in time: the wall moves as given, or as the forces on it make it move."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.balance import FILM
from roughfilm.rom.cavitation.motion.closing import closed_cavities, closes_after, refilling
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, UnresistedError, settled, turned_round
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.past import Known, differences, held, predicted, weights
from roughfilm.rom.cavitation.motion.warming import UNKNOWN, Warming, expected, following
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE

MAX_GROWTH, MIN_GROWTH, SAFETY = 2.0, 0.2, 0.85
"""Largest and smallest ratio of successive time steps, and the fraction of the one that the error allows."""

EMPTY = -1e-9
"""Smallest filling fraction; a step of second order that drains a node further is repeated with first order."""

CLOSING_STEP = 0.03
"""Time step over the largest one across the closing of a cavity, where pressures jump."""

MIN_STEP = 1e-9
"""Smallest time step over the largest one, below which the march stops."""

SHORT_STEP, MAX_SHORT_STEPS = 1e-5, 2000
"""Time step over the largest one, and the number of such steps in a row, beyond which a march would hardly end."""

MAX_UNRESISTED = 100
"""Number of steps of a film without pressure that fail because nothing resists its wall, beyond which a march stops."""

FIRST_STEP = 1e-3
"""First time step over the largest one: it has first order, since no earlier film is known."""

TILTED = 0.1
"""Least film thickness over the mean one below which a pad that touches is tilted."""

WARMED, MAX_WARMINGS = 1e-4, 20
"""Relative error of the viscosity at which the temperature of a step without time constant is found, and the largest
number of films for it."""

ROUNDOFF = 1e-9
"""Difference of times, over the time step, that counts as none."""


@dataclass(frozen=True, kw_only=True)
class Course:
    """What moves the wall of a film; coordinates q as in :class:`roughfilm.rom.cavitation.motion.film.MovingFilm`.

    Attributes
    ----------
    free : whether each coordinate moves as its forces make it move.
    place : place(t), the coordinates that are given, m (rad); free ones have no effect.
    speed : speed(t) of the sliding wall, m/s; below 0 towards decreasing x.
    force : force(t) on each coordinate besides that of the film, N (N m).
    mass : mass matrix, kg (kg m²); coordinates without mass move so that their forces balance.
    stiffness : matrix S of forces -S q of springs, N/m.
    velocity_scale : size of the velocities, m/s, to which the error of a time step is related, for each coordinate.
    names : name of each coordinate, for messages.
    remedies : what to give so that each coordinate resists its motion without a film, such as "body.inertia".
    warming : how the temperature of the film follows its flow; None of a film without temperature.
    """

    free: NDArray[np.bool_]
    place: Callable[[float], Array]
    speed: Callable[[float], float]
    force: Callable[[float], Array]
    mass: Array
    stiffness: Array
    velocity_scale: Array
    names: tuple[str, ...] = ()
    remedies: tuple[str, ...] = ()
    warming: Warming | None = None


@dataclass(frozen=True, kw_only=True)
class Moving:
    """A film at one time of a march, from which the march can go on.

    Attributes
    ----------
    instant : the film.
    past : what is known at this time and at up to three earlier ones, the latest first.
    step : the time step that led here, s; 0 at the start.
    following : the time step that is proposed next, s.
    order : the order of the step.
    error : estimated relative error of the coordinates of the step.
    turned : whether the wall slides towards decreasing x, so that the film is the mirrored one.
    solved_at : temperature whose viscosity the film has, K, as it was expected before the step.
    balanced : temperature T_eq that the heat of the film brings about, K.
    closes_after : time from the beginning of the step to the closing of a cavity in it, s; infinite without one.
    """

    instant: Instant
    past: tuple[Known, ...]
    step: float = 0.0
    following: float = 0.0
    order: int = 1
    error: float = 0.0
    turned: bool = False
    solved_at: float = UNKNOWN
    balanced: float = UNKNOWN
    closes_after: float = math.inf

    @property
    def now(self) -> Known:
        """What is known at this time."""
        return self.past[0]


def begun(film: MovingFilm, instant: Instant, *, time: float = 0.0, velocity: Array | None = None) -> Moving:
    """The start of a march from a film, with the velocities of the coordinates; at rest by default."""
    known = Known(
        time=time,
        place=instant.place,
        velocity=np.zeros(instant.place.size) if velocity is None else velocity,
        held=held(film, instant),
    )
    return Moving(instant=instant, past=(known,))


def march(
    film: MovingFilm,
    course: Course,
    start: Moving,
    end: float,
    *,
    largest_step: float,
    error: float | None = 1e-3,
    tolerance: float = RESIDUAL_TOLERANCE,
    closest: float = 0.0,
) -> Iterator[Moving]:
    """Solve ∂(θh)/∂t + (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0 and M q̈ = F + f(t) - S q to a time.

    Steps follow the two-step backward differentiation formula, which is of second order in time and stable for steps of
    any length: ẋ ≈ ((1 + 2r)/(1 + r) x₊ - (1 + r) x + r²/(1 + r) x₋)/Δt with the ratio r of the step to the one before.
    The volume that a film holds changes by what flows in and out, to the tolerance. The first step, and steps that
    would drain a node below empty, follow backward Euler, of first order. While the wall slides towards decreasing x,
    the film is that mirrored in x, whose nodes hold the same volumes.

    A film with a temperature T, τ dT/dt = T_eq - T, is solved in each step with the viscosity at the temperature that
    the two times before let expect, to second order; T₊ follows by the same formula from T_eq of the film, with its
    slope dT_eq/dT, so that steps of any length are stable. Without time constant the step is repeated until T₊ = T_eq.

    Parameters
    ----------
    start : the film from which the march goes on.
    end : the last time, s.
    largest_step : largest time step, s.
    error : largest error of the coordinates in a step, over the way at ``velocity_scale`` in the largest step; None for
        steps of ``largest_step``.
    tolerance : residual at which a step is solved.
    closest : film thickness, m, below which the march ends with an error.

    Yields
    ------
    Each later film.

    Raises
    ------
    InputError
        If the end or the largest step is not finite or not ahead, the error is not positive, or the course gives a
        number that is not finite.
    ConvergenceError
        If a film becomes thinner than ``closest``, a step does not converge however short it is, or more than
        ``MAX_SHORT_STEPS`` steps in a row are short, as where a film no longer resists the motion of its wall.

    Source: Hairer, Nørsett and Wanner 1993, Solving Ordinary Differential Equations I, III.5, for the formula;
    Elrod 1981, doi:10.1115/1.3251669, for the film.
    """
    _check_times(start.now.time, end, largest_step, error)
    moving = start
    size = start.following or (largest_step if error is None else FIRST_STEP * largest_step)
    shortest, cut = CLOSING_STEP * largest_step, False
    short = unresisted = 0
    while moving.now.time < end - ROUNDOFF * min(largest_step, end - start.now.time):
        left = end - moving.now.time
        size = min(size, largest_step)
        if left < (1 + ROUNDOFF) * size:
            size = left
        elif left < 2 * size:
            size = left / 2
        order = 2 if len(moving.past) > 1 else 1
        following = _attempt(film, course, moving, size, order=order, tolerance=tolerance, longest=largest_step)
        ratio = MIN_GROWTH
        if isinstance(following, Moving):
            estimate = following.error
            ratio = MAX_GROWTH
            if error is not None and estimate > 0:
                power = 1.0 / (following.order + 1)
                ratio = min(max(SAFETY * (error / estimate) ** power, MIN_GROWTH), MAX_GROWTH)
        if not isinstance(following, Moving) or (
            error is not None and following.error > error and size > MIN_STEP * largest_step
        ):
            size *= min(ratio, 0.7)
            unresisted += isinstance(following, UnresistedError)
            if size < MIN_STEP * largest_step or unresisted > MAX_UNRESISTED:
                raise _stopped(film.mirrored if moving.turned else film, course, moving, closest, following)
            continue
        if error is not None and not cut and following.closes_after < math.inf and size > shortest:
            size, cut = min(max(following.closes_after, shortest), size), True
            continue
        size, cut = shortest if cut else ratio * size, False
        moving = replace(following, following=size)
        least = float(moving.instant.faces.thickness.min())
        if least < closest:
            raise _stopped(film.mirrored if moving.turned else film, course, moving, closest, None)
        unresisted = 0 if _pressed(moving.instant) else unresisted
        short = short + 1 if moving.step < SHORT_STEP * largest_step else 0
        if short > MAX_SHORT_STEPS:
            raise _too_fast(course, moving)
        yield moving


def _check_times(begin: float, end: float, largest_step: float, error: float | None) -> None:
    """Raise InputError for times and errors at which no march ends."""
    if not begin < end < math.inf:
        raise InputError(f"end: got {end!r} s; a march from {begin!r} s needs a later, finite time")
    if not 0 < largest_step < math.inf:
        raise InputError(f"largest_step: got {largest_step!r} s; give a finite time above 0 s")
    if error is not None and not 0 < error < math.inf:
        raise InputError(f"error: got {error!r}; give a finite number above 0, such as 1e-3, or None for equal steps")


def _check_course(time: float, speed: float, place: Array, force: Array) -> None:
    """Raise InputError for numbers that are not finite."""
    if not math.isfinite(speed):
        raise InputError(f"motion.speed: got {speed!r} m/s at the time {time:.6g} s; give a finite speed")
    for name, values in (("place", place), ("force", force)):
        if not np.isfinite(values).all():
            raise InputError(f"motion.{name}: got {values.tolist()} at the time {time:.6g} s; give finite numbers")


def _pressed(instant: Instant) -> bool:
    """Whether a film has pressure anywhere."""
    return bool(((instant.kind == FILM) & (instant.state.pressure > 0)).any())


def _names(course: Course) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The name of each coordinate, and what makes it resist its motion."""
    count = course.free.size
    return (
        course.names or tuple(f"coordinate {number + 1}" for number in range(count)),
        course.remedies or ("mass",) * count,
    )


def _too_fast(course: Course, moving: Moving) -> ConvergenceError:
    """The error of a march whose steps stay short."""
    names, remedies = _names(course)
    speeds = np.where(course.free, np.abs(moving.now.velocity) / course.velocity_scale, 0.0)
    fastest = int(np.argmax(speeds))
    return ConvergenceError(
        f"motion: at the time {moving.now.time:.6g} s more than {MAX_SHORT_STEPS} steps in a row are shorter than "
        f"{SHORT_STEP:g} of the largest, since the film hardly resists {names[fastest]}, which moves fast; give a "
        f"larger {remedies[fastest]}, or a larger error",
        outcome=Outcome.STALLED,
        iterations=moving.instant.iterations,
    )


def _stopped(
    film: MovingFilm, course: Course, moving: Moving, closest: float, cause: Moving | ConvergenceError | None
) -> ConvergenceError:
    """The error of a march that cannot go on, with the time, the coordinate that moves, and the remedy.

    Parameters
    ----------
    cause : the error of the last step that did not converge.
    """
    instant, (names, remedies) = moving.instant, _names(course)
    thickness = instant.faces.thickness
    least, at = float(thickness.min()), np.unravel_index(int(np.argmin(thickness)), thickness.shape)
    resists = np.diag(course.mass) + np.abs(np.diag(course.stiffness)) > 0
    loose = np.flatnonzero(course.free & ~resists)
    if least < 2 * closest:
        closing = -film.at_nodes[at] * moving.now.velocity
        reason = (
            f"the film is {least:.3g} m thick, and the walls touch, mainly by the motion of "
            f"{names[int(np.argmax(closing))]}; "
        )
        tilted = film.turns is not None and film.turns.any() and least < TILTED * float(thickness.mean())
        reason += (
            "move the pivot or change the moments, which tilt the pad under any load"
            if tilted
            else "lower the load, or raise the viscosity or the speed"
        )
    elif loose.size and (isinstance(cause, UnresistedError) or not _pressed(instant)):
        remedy = " and ".join(dict.fromkeys(remedies[number] for number in loose))
        reason = (
            f"the film loses its pressure and does not resist {_listed([names[number] for number in loose])}; give "
            f"{remedy}, a start near the equilibrium, or a cavitation pressure further below ambient pressure"
        )
    else:
        reason = (
            f"no step down to {MIN_STEP:g} of the largest converges, with a film of {least:.3g} m; take more cells, or "
            "a smaller error"
        )
        if loose.size:
            given = dict.fromkeys(remedies[number] for number in loose)
            reason += f", or give {' and '.join(given)}"
    return ConvergenceError(
        f"motion: at the time {moving.now.time:.6g} s {reason}",
        outcome=Outcome.STALLED,
        iterations=instant.iterations,
    )


def _listed(names: Sequence[str]) -> str:
    """Names in a row, with "or" before the last."""
    *before, last = names
    return f"{', '.join(before)} or {last}" if before else last


def _attempt(
    film: MovingFilm,
    course: Course,
    moving: Moving,
    size: float,
    *,
    order: int,
    tolerance: float,
    longest: float,
) -> Moving | ConvergenceError | None:
    """The film after a time step; the error if it does not converge, None if given walls touch before it."""
    time = moving.now.time + size
    speed, given, force = course.speed(time), course.place(time), course.force(time)
    _check_course(time, speed, given, force)
    back = speed < 0 or (speed == 0 and moving.turned)
    if back != moving.turned:
        moving = _turned_round(film.mirrored if moving.turned else film, moving)
    film, driven = film.mirrored if back else film, (abs(speed), given, force)
    if course.warming is None:
        return _stepped(film, course, moving, size, driven, order=order, tolerance=tolerance, longest=longest)
    near, warming = moving.past[:2], course.warming
    times, temperatures = tuple(one.time for one in near), tuple(one.temperature for one in near)
    temperature = expected(times, temperatures, time, warming.coldest)
    for _ in range(MAX_WARMINGS):
        stepped = _stepped(
            warming.film(film, temperature),
            course,
            moving,
            size,
            driven,
            order=order,
            tolerance=tolerance,
            longest=longest,
        )
        if not isinstance(stepped, Moving):
            return stepped
        stepped = _warmed(warming, replace(stepped, solved_at=temperature))
        off = abs(stepped.now.temperature - temperature) * warming.sensitivity(temperature)
        if warming.time_constant > 0:
            return replace(stepped, error=max(stepped.error, off))
        if off <= WARMED:
            return stepped
        temperature = stepped.now.temperature
    return ConvergenceError(
        "motion: the temperature does not converge", outcome=Outcome.STALLED, iterations=MAX_WARMINGS
    )


def _turned_round(film: MovingFilm, moving: Moving) -> Moving:
    """A film at one time of a march as the one mirrored in x."""
    past = tuple(replace(known, held=film.turned_round(known.held)) for known in moving.past)
    return replace(moving, instant=turned_round(film, moving.instant), past=past, turned=not moving.turned)


def _stepped(
    film: MovingFilm,
    course: Course,
    moving: Moving,
    size: float,
    driven: tuple[float, Array, Array],
    *,
    order: int,
    tolerance: float,
    longest: float,
) -> Moving | ConvergenceError | None:
    """The film after a time step, with the speed, the given coordinates and the forces at its end."""
    speed, given, force = driven
    time = moving.now.time + size
    rate, (place, velocity, volume) = differences(moving.past, size, order)
    guess = _guess(film, course, moving, given, size)
    if guess is None:
        return None
    acceleration = rate * place + velocity
    drive = Drive(
        speed=speed,
        force=force + course.mass @ acceleration,
        stiffness=course.stiffness + rate**2 * course.mass,
        free=course.free,
        storage=(rate, volume),
    )
    start, closes = replace(moving.instant, place=guess), math.inf
    try:
        instant = settled(film, start, drive, tolerance=tolerance)
        if order > 1 and (closed := closed_cavities(film, moving.past, instant)).any():
            drive = refilling(film, moving.past, size, drive, closed)
            instant = settled(film, instant, drive, tolerance=tolerance)
            closes = closes_after(film, moving.past, instant, closed)
    except ConvergenceError as error:
        return error
    if order > 1 and instant.state.fill.min() < EMPTY:
        return _stepped(film, course, moving, size, driven, order=1, tolerance=tolerance, longest=longest)
    now = Known(
        time=time,
        place=instant.place,
        velocity=rate * instant.place - place,
        held=held(film, instant),
    )
    past = (now, *moving.past[:3])
    return Moving(
        instant=instant,
        past=past,
        step=size,
        order=order,
        error=_error(past, course, order, longest),
        turned=moving.turned,
        closes_after=closes,
    )


def _warmed(warming: Warming, moving: Moving) -> Moving:
    """A film after a step, which was solved at an expected temperature, with its temperature."""
    now, *before = moving.past
    balanced = warming.balanced(now.time, moving.instant, now.velocity, moving.solved_at, turned=moving.turned)
    rate, near, far = weights(tuple(before), moving.step, moving.order)
    memory = near * before[0].temperature - (far * before[1].temperature if far else 0.0)
    temperature = following(warming, balanced, moving.solved_at, rate, memory)
    return replace(moving, past=(replace(now, temperature=temperature), *before), balanced=balanced)


def _guess(film: MovingFilm, course: Course, moving: Moving, given: Array, size: float) -> Array | None:
    """The coordinates from which a step starts; None if the given ones leave no film while the free ones rest.

    The free ones are extrapolated, but so far only that no film closes by more than half.
    """
    last = moving.instant
    place = np.where(course.free, last.place, given)
    if film.room(place) <= 0:
        if course.free.any():
            return None
        least = float((last.faces.thickness + film.at_nodes @ (place - last.place)).min())
        raise InputError(
            f"motion.place: got {given.tolist()} at the time {moving.now.time + size:.6g} s, where the film would be "
            f"{least:.3g} m thick; keep the walls apart"
        )
    moved = np.where(course.free, predicted(moving.past, size) - last.place, 0.0)
    return np.asarray(place + 0.5 / max(film.closing(place, moved), 0.5) * moved)


def _error(past: tuple[Known, ...], course: Course, order: int, longest: float) -> float:
    """The estimated error of the coordinates of a step over their motion in the longest one.

    It is Δt²/2 q̈ of backward Euler, and Δt² (Δt + Δt₋)²/(6 (2Δt + Δt₋)) d³q/dt³ of the two-step formula with the step
    Δt₋ before, from a difference of the next order.
    """
    if len(past) < order + 2:
        return 0.0
    times = [known.time for known in past[: order + 2]]
    table = [known.place for known in past[: order + 2]]
    for level in range(1, order + 2):
        table = [(table[n] - table[n + 1]) / (times[n] - times[n + level]) for n in range(len(table) - 1)]
    size, before = times[0] - times[1], times[1] - times[2]
    local = size**2 if order == 1 else (size * (size + before)) ** 2 / (2 * size + before)
    return float((np.abs(local * table[0]) / (course.velocity_scale * longest)).max())
