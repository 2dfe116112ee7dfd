"""The equilibrium of a wall that moves freely: the steady state of a motion with long time steps."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.free.closed import closed
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.cavitation.interpolation import carried
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, kinds, settled
from roughfilm.rom.cavitation.motion.march import held
from roughfilm.rom.cavitation.problem import unchanging

FIRST_STEP = 0.2
"""First time step over the time in which the shaft turns by a radian."""

GROWTH = 4.0
"""Ratio of successive time steps that converge."""

LAST_STEP = 1e6
"""Time step over that time from which on the equilibrium itself is solved."""

MAX_STEPS = 200
"""Largest number of time steps."""

HOLDING = 1e-6
"""Stiffness that holds a shaft and pads that no pressure moves, over the load per clearance."""

MAX_MOVE = 0.25
"""Largest move of a shaft or of the edge of a pad in a step, over the clearance."""

SETTLED = 1e-3
"""Move in the last step, over the clearance, up to which the motion has ended."""


def equilibrium(film: FreeFilm, start: Instant | None, *, tolerance: float, load: Array | None = None) -> Instant:
    """The film at which the load of the scene and the force of the film balance.

    It is the end of a motion without mass by backward Euler steps, each ``GROWTH`` times as long as the one before.
    From a start that is near enough, the first step is that of a steady film.

    Parameters
    ----------
    start : a film near the equilibrium; without one the shaft starts at rest in its middle.
    tolerance : residual at which a film is solved.
    load : the load on each coordinate, N; by default that of the scene.

    Raises
    ------
    InputError
        If nothing supplies the film, or it closes.
    ConvergenceError
        If the motion does not settle.
    """
    solved = film.solved
    sides = solved.problem.ends.sides
    if solved.problem.shape.joined[0] and not solved.inflows and sides is not None and max(sides) <= 0:
        raise InputError(
            "boundary.sides: got the cavitation pressure at both sides of a bore without grooves, which then has no "
            "supply; give geometry.arc, or a lower lubricant.cavitation_pressure"
        )
    force = film.load if load is None else load
    if start is not None:
        try:
            instant = _moved(film, start, force, 0.0, tolerance)
        except ConvergenceError:
            pass
        else:
            if _move(film, start, instant) <= MAX_MOVE:
                return instant
    if start is None:
        start = film.first(film.wall.place)
        constant = unchanging(solved.problem)
        if constant != solved.problem and film.free.any():
            simple = replace(film, solved=replace(solved, problem=constant))
            start = _settling(simple, start, force, tolerance)
    return _settling(film, start, force, tolerance)


def _settling(film: FreeFilm, start: Instant, force: Array, tolerance: float) -> Instant:
    """The end of the motion without mass from a film."""
    solved, count = film.solved, force.size
    given = Drive(
        speed=solved.problem.speed,
        force=force,
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
    )
    instant = settled(solved, start, given, tolerance=tolerance)
    if not film.free.any():
        return instant
    time = 1 / _rate(film)
    step = FIRST_STEP * time
    for _ in range(MAX_STEPS):
        last = step >= LAST_STEP * time
        try:
            following = _moved(film, instant, force, 0.0 if last else 1 / step, tolerance)
        except ConvergenceError:
            following = None
        move = np.inf if following is None else _move(film, instant, following)
        if following is None or move > MAX_MOVE:
            step /= GROWTH**2
            if step < 1e-6 * time:
                break
            continue
        instant = following
        if (reason := closed(film, instant, force)) is not None:
            raise reason
        if last and move <= SETTLED:
            return instant
        step *= GROWTH
    other = "another pivot" if isinstance(film.scene.geometry, Tilting) else "another load"
    raise ConvergenceError(
        f"load: the motion towards the equilibrium does not settle; take more cells, or {other}",
        outcome=Outcome.STALLED,
        iterations=MAX_STEPS,
    )


def _moved(film: FreeFilm, instant: Instant, force: Array, rate: float, tolerance: float) -> Instant:
    """The film after a step of backward Euler of the length 1/rate, s; in equilibrium for the rate 0."""
    solved, held_by = film.solved, holding(film, force)
    storage = (rate, rate * held(solved, instant)) if rate else (0.0, 0.0)
    drive = Drive(
        speed=solved.problem.speed,
        force=force + held_by @ instant.place,
        stiffness=held_by,
        free=film.free,
        storage=storage,
    )
    return settled(solved, instant, drive, tolerance=tolerance)


def _move(film: FreeFilm, instant: Instant, following: Instant) -> float:
    """The largest move of a coordinate over its unit; 0 of a pad about its pivot, which may move by many."""
    if not isinstance(film.scene.geometry, Shaft):
        return 0.0
    return float((np.abs(following.place - instant.place) / film.wall.unit).max())


def _rate(film: FreeFilm) -> float:
    """The rate at which the shaft turns, rad/s, or at which the load would close the clearance at rest."""
    scene = film.scene
    return max(abs(scene.motion.speed) / scene.geometry.length * 2 * np.pi, 1e-6)


def holding(film: FreeFilm, force: Array) -> Array:
    """The stiffness that holds a shaft and its pads where no pressure moves them, shape (coordinates, coordinates).

    A pad without pressure has no moment at any tilt, and a shaft on a single pad that tilts no force across it. The
    stiffness holds them at their place before each step, so that they rest where the film that moved them ends. It is
    small beside that of a film, and has no force in equilibrium. A pad of a thrust bearing always carries its load, and
    has none.
    """
    unit, scene = film.wall.unit, film.scene
    if not isinstance(scene.geometry, Shaft):
        return np.zeros((unit.size, unit.size))
    width = 1.0 if film.whole.problem.shape.wide else scene.geometry.width or 1.0
    sliding = scene.lubricant.viscosity * abs(scene.motion.speed) * width * (scene.geometry.radius / unit[0]) ** 2
    return np.diag(HOLDING * max(float(np.abs(force).max()), sliding) * unit[0] / unit**2)


def refined(coarse: FreeFilm, instant: Instant, fine: FreeFilm) -> Instant:
    """An instant on a finer grid, from which its equilibrium there is sought."""
    one, other = coarse.solved, fine.solved
    state = carried(instant.state, one.grid, other.grid, other.problem.shape.joined)
    first = fine.first(instant.place)
    return replace(first, state=state, kind=kinds(first.network, state), pressures=instant.pressures)
