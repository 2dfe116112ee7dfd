"""Films whose walls move, from which several tests start: plates, lines and journals on small grids."""

from dataclasses import replace

import numpy as np

from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.closing import closed_cavities
from roughfilm.rom.cavitation.motion.coupled import Drive, full_film, kinds, settled
from roughfilm.rom.cavitation.motion.film import Inflow, MovingFilm
from roughfilm.rom.cavitation.motion.march import Course, begun, march
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape


def flat(x, y):
    """1 at all positions."""
    return 1 + 0 * x + 0 * y


def plates(nodes, *, length=1.0, viscosity=1.0, ambient=0.0, theta=None, inflows=(), thickness=None, **problem):
    """A film on a line whose upper wall moves up and down; h = h₀(x) + q."""
    shape = Shape(thickness=thickness or (lambda x, y: 0 * x + 0 * y), breaks=(0.0, length))
    ends = Ends(inlet=ambient, outlet=ambient) if theta is None else Ends(theta=theta, outlet=ambient)
    entries = {"speed": 0.0} | problem
    return MovingFilm(
        problem=Problem(shape=shape, ends=ends, viscosity=viscosity, **entries),
        grid=grid(shape, (nodes, 1)),
        normals=(flat,),
        inflows=inflows,
        ambient=ambient,
    )


RADIUS, CLEARANCE, SPEED, VISCOSITY = 0.05, 5e-5, 10.0, 0.02
"""Those of all journals, in SI units."""


def journal(cells, *, width=0.05, halved=False, groove=True, ruptures=True, speed=SPEED, wide=False):
    """A journal with coordinates of its shaft in units of m, and a groove at ambient pressure at x = 0."""
    length = 2 * np.pi * RADIUS
    across = (0.0, width / 2 if halved else width)
    shape = Shape(
        thickness=lambda x, y: CLEARANCE + 0 * x + 0 * y,
        breaks=(0.0, length),
        across=across,
        wide=wide,
        joined=(True, False),
    )
    ends = Ends(sides=None if wide else (0.0, 0.0))
    inflows = (Inflow(covers=lambda x, y: (np.abs(x) < 1e-9) & np.isfinite(y), pressure=0.0),) if groove else ()
    return MovingFilm(
        problem=Problem(shape=shape, ends=ends, speed=speed, viscosity=VISCOSITY),
        grid=grid(shape, cells),
        normals=(lambda x, y: np.cos(x / RADIUS) + 0 * y, lambda x, y: np.sin(x / RADIUS) + 0 * y),
        inflows=inflows,
        halved=halved,
        ruptures=ruptures,
    )


def full(film, place, *, fill=1.0, pressure=0.0):
    """A film at coordinates, from which an iteration starts; it is full unless ``fill`` is below 1."""
    place = np.asarray(place, dtype=float)
    first = full_film(film, place)
    fixed = first.network.fixed
    state = State(
        pressure=np.where(fixed, first.network.pressure, pressure),
        fill=np.where(fixed, 1.0, fill) * np.ones(fixed.shape),
    )
    return replace(first, state=state, kind=kinds(first.network, state))


def drive(film, *, force=None, storage=(0.0, 0.0), speed=None):
    """What acts on a film: all coordinates are free if there is a force, else all are given."""
    count = len(film.normals)
    return Drive(
        speed=film.problem.speed if speed is None else speed,
        force=np.zeros(count) if force is None else np.asarray(force, dtype=float),
        stiffness=np.zeros((count, count)),
        free=np.full(count, force is not None),
        storage=storage,
    )


def steady(film, place, *, tolerance=1e-10, storage=(0.0, 0.0)):
    """The film at given coordinates."""
    return settled(film, full(film, place), drive(film, storage=storage), tolerance=tolerance)


def course(film, *, place=None, force=None, speed=None, mass=0.0, scale=1.0):
    """The course of a film: coordinates that are given over time, or forces on free ones."""
    count = len(film.normals)
    held = film.problem.speed if speed is None else speed
    return Course(
        free=np.full(count, place is None),
        place=place or (lambda _time: np.zeros(count)),
        speed=held if callable(held) else lambda _time: held,
        force=force or (lambda _time: np.zeros(count)),
        mass=mass * np.eye(count),
        stiffness=np.zeros((count, count)),
        velocity_scale=np.full(count, scale),
    )


def order(sizes, errors):
    """The slope of the errors over the sizes, both as logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])


def stored(film, before, after):
    """∂(θh)/∂t over the whole film, m³/s, by backward Euler or the two-step formula, from the volumes at the times.

    In a step of the two-step formula in which a cavity closes, what it lacks, (1 - θ) h, has backward Euler.
    """
    past = after.past[:3]
    times, areas = [known.time for known in past], film.grid.areas
    held = [known.held for known in past]
    first = times[0] - times[1]
    if after.order == 1:
        return float((areas * (held[0] - held[1])).sum()) / first
    assert before.now.time == times[1]
    second = times[0] - times[2]
    closed = closed_cavities(film, past[1:], after.instant)
    lacking = [np.where(closed, film.gap_at(known.place) - known.held, 0.0) for known in past]
    volumes = [float((areas * (one + lacks)).sum()) for one, lacks in zip(held, lacking, strict=True)]
    taken_up = float((areas * (lacking[1] - lacking[0])).sum()) / first
    return taken_up + (
        volumes[0] * (1 / first + 1 / second)
        - volumes[1] * second / (first * (second - first))
        + volumes[2] * first / (second * (second - first))
    )


def damping_of_slow_motions(film, place):
    """B: motions that pass the place at ±v long after their start have forces that differ by -2 B v."""
    turn = 2 * np.pi * RADIUS / SPEED
    step, count, velocity = turn / 4, 16, 1e-4 * CLEARANCE / turn
    columns = []
    for direction in np.eye(2):
        forces = []
        for side in (1, -1):
            first = place - side * velocity * count * step * direction

            def path(time, first=first, side=side, direction=direction):
                return first + side * velocity * time * direction

            start, moves = begun(film, steady(film, first, tolerance=1e-12)), course(film, place=path)
            *_, last = march(film, moves, start, count * step, largest_step=step, error=None, tolerance=1e-12)
            forces.append(film.force(last.instant.state.pressure))
        columns.append(-(forces[0] - forces[1]) / (2 * velocity))
    return np.transpose(columns)
