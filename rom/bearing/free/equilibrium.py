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
"""First time step over the time in which the shaft turns by a radian, or a load would squeeze a film out."""

GROWTH = 4.0
"""Ratio of successive time steps that converge."""

LAST_STEP = 1e6
"""Time step over that time from which on the equilibrium itself is solved."""

MAX_STEPS = 200
"""Largest number of time steps."""

HOLDING = 1e-9
"""Stiffness that holds a shaft and pads that no pressure moves, over the load per clearance."""


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
    free, held_by = film.free, holding(film, force)
    if start is not None:
        drive = Drive(speed=solved.problem.speed, force=force, stiffness=held_by, free=free)
        try:
            return settled(solved, start, drive, tolerance=tolerance)
        except ConvergenceError:
            pass
    if start is None:
        start = film.first(film.wall.place)
        constant = unchanging(solved.problem)
        if constant != solved.problem and free.any():
            simple = replace(film, solved=replace(solved, problem=constant))
            start = _settling(simple, start, force, held_by, tolerance)
    return _settling(film, start, force, held_by, tolerance)


def _settling(film: FreeFilm, start: Instant, force: Array, held_by: Array, tolerance: float) -> Instant:
    """The end of the motion without mass from a film.

    At rest the last step is a long one: nothing determines how far the cavities of a steady film would be filled.
    """
    solved, free, count, speed = film.solved, film.free, force.size, film.solved.problem.speed
    time = 1 / _rate(film, force)
    step = FIRST_STEP * time
    given = Drive(
        speed=speed,
        force=force,
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
        storage=(0.0, 0.0) if speed else (1 / time, held(solved, start) / time),
    )
    instant = settled(solved, start, given, tolerance=tolerance)
    if not free.any():
        return instant
    for _ in range(MAX_STEPS):
        last = step >= LAST_STEP * time
        storage = (0.0, 0.0) if last and speed else (1 / step, held(solved, instant) / step)
        drive = Drive(speed=speed, force=force, stiffness=held_by, free=free, storage=storage)
        try:
            instant = settled(solved, instant, drive, tolerance=tolerance)
        except ConvergenceError:
            step /= GROWTH**2
            if step < 1e-6 * time:
                break
            continue
        if (reason := closed(film, instant, force)) is not None:
            raise reason
        if last:
            return instant
        step *= GROWTH
    other = "another pivot" if isinstance(film.scene.geometry, Tilting) else "another load"
    raise ConvergenceError(
        f"load: the motion towards the equilibrium does not settle; take more cells, or {other}",
        outcome=Outcome.STALLED,
        iterations=MAX_STEPS,
    )


def _rate(film: FreeFilm, force: Array) -> float:
    """The rate at which the shaft turns, rad/s, or at which the load would squeeze a film out at rest, if larger.

    A load W per width closes a film in a time of about 12π η (R/c)² R/W.
    """
    scene, geometry = film.scene, film.scene.geometry
    turning = max(abs(scene.motion.speed) / geometry.length * 2 * np.pi, 1e-6)
    if not isinstance(geometry, Shaft):
        return turning
    width = 1.0 if film.whole.problem.shape.wide else geometry.width or 1.0
    resistance = 12 * np.pi * scene.lubricant.viscosity * (geometry.radius / geometry.clearance) ** 2
    return max(turning, float(np.hypot(*force[:2])) / (resistance * geometry.radius * width))


def holding(film: FreeFilm, force: Array) -> Array:
    """The stiffness that holds a shaft and its pads where no pressure moves them, shape (coordinates, coordinates).

    A pad without pressure has no moment at any tilt, and a shaft on a single pad that tilts no force across it. With
    the stiffness such a pad rests at the least tilt at which its film carries nothing, and the shaft nearest to the
    middle. A pad of a thrust bearing always carries its load, and has none.
    """
    unit = film.wall.unit
    if not isinstance(film.scene.geometry, Shaft):
        return np.zeros((unit.size, unit.size))
    return np.diag(HOLDING * np.abs(force).max() * unit[0] / unit**2)


def refined(coarse: FreeFilm, instant: Instant, fine: FreeFilm) -> Instant:
    """An instant on a finer grid, from which its equilibrium there is sought."""
    one, other = coarse.solved, fine.solved
    state = carried(instant.state, one.grid, other.grid, other.problem.shape.joined)
    first = fine.first(instant.place)
    return replace(first, state=state, kind=kinds(first.network, state), pressures=instant.pressures)
