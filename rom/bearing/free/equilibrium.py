"""The equilibrium of a wall that moves freely: the steady state of a motion with long time steps."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.lobes import Lobes
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
"""Stiffness that holds pads without pressure, over the load per clearance."""

CLOSEST = 1e-4
"""Least film over the clearance below which no equilibrium is sought."""

CLOSEST_OF_CONTACT = 2e-3
"""Distance from the smallest known separation, over that of first contact, below which none is sought with contact."""


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
        If the film becomes thinner than ``CLOSEST`` times the clearance, or the walls come nearly as close as their
        contact pressure is known for.
    ConvergenceError
        If the motion does not settle.
    """
    solved = film.solved
    force = film.load if load is None else load
    free, held_by = film.free, _holding(film, force)
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
    """The end of the motion without mass from a film."""
    solved, free, count = film.solved, film.free, force.size
    given = Drive(
        speed=solved.problem.speed,
        force=force,
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
    )
    instant = settled(solved, start, given, tolerance=tolerance)
    if not free.any():
        return instant
    time = 1 / _rate(film, force)
    step = FIRST_STEP * time
    for _ in range(MAX_STEPS):
        last = step >= LAST_STEP * time
        storage = (0.0, 0.0) if last else (1 / step, held(solved, instant) / step)
        drive = Drive(speed=solved.problem.speed, force=force, stiffness=held_by, free=free, storage=storage)
        try:
            instant = settled(solved, instant, drive, tolerance=tolerance)
        except ConvergenceError:
            step /= GROWTH**2
            if step < 1e-6 * time:
                break
            continue
        if last:
            return instant
        _check_room(film, instant, force)
        step *= GROWTH
    raise ConvergenceError(
        "load: the motion towards the equilibrium does not settle; take more cells, or another load",
        outcome=Outcome.STALLED,
        iterations=MAX_STEPS,
    )


def _check_room(film: FreeFilm, instant: Instant, force: Array) -> None:
    """Raise InputError if the walls have nearly reached the smallest film thickness that has a solution."""
    contact, clearance = film.solved.contact, film.wall.unit[0]
    least = CLOSEST * clearance if contact is None else CLOSEST_OF_CONTACT * (contact.touching - contact.closest)
    if film.solved.room(instant.place) >= least:
        return
    size = f"{np.hypot(*force[:2]):.6g} N"
    if contact is None:
        raise InputError(
            f"load: got {size}; no film above {instant.faces.thickness.min():.2g} m carries it; lower the load, or "
            "raise the speed or the viscosity"
        )
    pressed = np.hypot(*film.solved.contact_at(instant.place).force[:2])
    raise InputError(
        f"load: got {size}; at a separation of {contact.closest:.4g} m, the smallest whose contact pressure is known, "
        f"the asperities carry {pressed:.4g} N and the film too little; lower the load, or make a table with larger "
        "loads"
    )


def _rate(film: FreeFilm, force: Array) -> float:
    """The rate at which the shaft turns, rad/s, or at which the load would squeeze a film out at rest, if larger.

    A load W per width closes a film in a time of about 12π η (R/c)² R/W.
    """
    scene, geometry = film.scene, film.scene.geometry
    assert isinstance(geometry, Lobes)
    width = 1.0 if film.whole.problem.shape.wide else geometry.width or 1.0
    thinness = (geometry.clearance / geometry.radius) ** 2
    squeezed = (
        float(np.hypot(*force[:2])) * thinness / (12 * np.pi * scene.lubricant.viscosity * geometry.radius * width)
    )
    return max(abs(scene.motion.speed) / geometry.radius, squeezed)


def _holding(film: FreeFilm, force: Array) -> Array:
    """The stiffness that holds pads without pressure at their place, shape (coordinates, coordinates)."""
    unit = film.wall.unit
    stiff = np.where(film.wall.turns, HOLDING * np.abs(force).max() * unit[0] / unit**2, 0.0)
    return np.diag(stiff)


def refined(coarse: FreeFilm, instant: Instant, fine: FreeFilm) -> Instant:
    """An instant on a finer grid, from which its equilibrium there is sought."""
    one, other = coarse.solved, fine.solved
    state = carried(instant.state, one.grid, other.grid, other.problem.shape.joined)
    first = fine.first(instant.place)
    return replace(first, state=state, kind=kinds(first.network, state), pressures=instant.pressures)
