"""Loads over time: whether films in equilibrium with each load are enough, or squeeze changes them."""

import math
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.course import STEPS_PER_TABLE, Duty, course_of, film_at
from roughfilm.rom.bearing.march.numbers import Observer
from roughfilm.rom.bearing.march.series import Numerics, run
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import Instant, turned_round

CELLS = (48, 24)
"""Cells along and across of the films."""

TIMES = 64
"""Number of times at which films are solved, over the table."""

RESIDUAL = 1e-9
"""Residual at which a film is solved."""

MARCH_CELLS, MARCH_ERROR, MARCH_PERIODS = (32, 16), 4e-3, 2
"""Cells, error of a step, and periods of the march that finds the change, of which the last period counts."""

SHORTEST_STEP, MARCH_STEPS = 1 / 400, 4000
"""Least of the largest step of that march over the length of the table, and the number of its steps that are too many.

A rotor that whirls takes many steps in a turn."""


@dataclass(frozen=True, kw_only=True)
class QuasiStatic:
    """Films in equilibrium with each load of a table, and the estimated change by squeeze.

    Attributes
    ----------
    time : times, s.
    film_min : least film of the equilibrium at each time, m.
    moved : estimated least film with squeeze and the inertia of the body, m.
    squeeze_number : largest ratio |B q̇ + M q̈|/|W| of the forces by motion to the load.
    """

    time: Array
    film_min: Array
    moved: Array
    squeeze_number: float

    @property
    def change(self) -> float:
        """The relative change of the least film over time by squeeze, to first order in the rate of change."""
        return float(self.moved.min() / self.film_min.min() - 1)


def quasi_static(duty: Duty, *, cells: tuple[int, int] = CELLS, times: int = TIMES) -> QuasiStatic:
    """The films in equilibrium with each load of a table over time, and the first-order change by motion.

    The equilibria q(t) neglect the velocity of the wall. With the stiffness K and damping B there, the motion changes
    them by δq = -K⁻¹ (B q̇ + M q̈), to first order in the rate of change; the least film of q + δq is compared.

    Raises
    ------
    InputError
        If no film carries the load at one of the times.
    ConvergenceError
        If a film does not converge.
    """
    film = film_at(duty, cells)
    time = times_of(duty, times)
    found = _equilibria(duty, film, time)
    place = np.array([instant.place for _, instant in found])
    velocity = np.gradient(place, time, axis=0)
    mass = course_of(duty, film).mass
    motion = []
    for number, (placed, instant) in enumerate(found):
        linear = coefficients(placed.solved, instant, speed=placed.solved.problem.speed)
        forces = linear.damping @ velocity[number] + mass @ np.gradient(velocity, time, axis=0)[number]
        motion.append((forces, np.linalg.lstsq(linear.stiffness, -forces, rcond=None)[0]))
    least, moved = [], []
    for (placed, instant), (_, change) in zip(found, motion, strict=True):
        thickness = instant.faces.thickness
        least.append(float(thickness.min()))
        moved.append(max(float((thickness + placed.solved.at_nodes @ change).min()), 0.0))
    moving = ~film.wall.turns
    loads = np.array([np.linalg.norm(duty.load(at)[: moving.size][moving]) for at in time])
    pulls = np.array([np.linalg.norm(forces[moving]) for forces, _ in motion])
    return QuasiStatic(
        time=time,
        film_min=np.array(least),
        moved=np.array(moved),
        squeeze_number=float((pulls / loads).max()) if loads.min() > 0 else math.inf,
    )


def times_of(duty: Duty, count: int) -> Array:
    """Times over a table, evenly spaced, ``count`` + 1, s."""
    table = duty.scene.motion.over_time
    assert table is not None
    return np.linspace(duty.begin, duty.begin + (table.period or float(np.ptp(table.table.time))), count + 1)


def marched_change(
    duty: Duty, *, cells: tuple[int, int] = MARCH_CELLS, error: float = MARCH_ERROR, times: int = TIMES
) -> float:
    """The relative change of the least film over time from the equilibria to a march of smooth walls on a coarse grid.

    The march begins in equilibrium with the first load. Of a table that repeats the second period counts.

    Raises
    ------
    InputError
        If no film carries the load at one of the times.
    ConvergenceError
        If a film does not converge, the walls touch, or the march takes too many steps.
    """
    scene = duty.scene.model_copy(update={"roughness": None, "asperities": None})
    smooth, table = Duty(scene=scene), scene.motion.over_time
    assert table is not None
    rows = table.table.time
    length = table.period or float(np.ptp(rows))
    step = max(min(length / STEPS_PER_TABLE, 2 * float(np.median(np.diff(rows)))), SHORTEST_STEP * length)
    last, count = smooth.begin + (MARCH_PERIODS if table.period else 1) * length, 0

    def limited(_fraction: float, _words: str) -> None:
        nonlocal count
        count += 1
        if count > MARCH_STEPS:
            raise ConvergenceError(
                f"a march to {last:.4g} s takes more than {MARCH_STEPS} steps", outcome=Outcome.UNFINISHED
            )

    series = run(smooth, Numerics(cells=cells, end=last, error=error, step=step), progress=limited)
    film, time = film_at(smooth, cells), times_of(smooth, times)
    least = min(
        Observer(duty=smooth, film=placed).least(one.faces.thickness)[0]
        for placed, one in _equilibria(smooth, film, time)
    )
    return float(series["film_min"][series.time >= last - length * (1 + 1e-9)].min() / least - 1)


def _equilibria(duty: Duty, film: FreeFilm, time: Array) -> list[tuple[FreeFilm, Instant]]:
    """The film in equilibrium with the load at each time, each from the one before, and mirrored if it slides back."""
    found: list[tuple[FreeFilm, Instant]] = []
    for at in time:
        placed = at_speed(film, duty.speed(float(at)))
        start = carried_over(*found[-1], placed) if found else None
        load = duty.load(float(at))[: film.wall.place.size]
        try:
            found.append((placed, equilibrium(placed, start, tolerance=RESIDUAL, load=load)))
        except InputError as error:
            speed = duty.sliding_speed(float(at))
            raise InputError(f"motion.over_time: at {at:.4g} s, with {speed:.4g} m/s, {error}") from None
    return found


def at_speed(film: FreeFilm, speed: float) -> FreeFilm:
    """The film at another sliding speed, m/s (rad/s), mirrored if the wall slides in the other direction."""
    placed = film.reversed if speed and (speed < 0) != film.turned else film
    of = {
        name: replace(part.problem, speed=abs(speed))
        for name, part in (("whole", placed.whole), ("solved", placed.solved))
    }
    return replace(
        placed,
        whole=replace(placed.whole, problem=of["whole"]),
        solved=replace(placed.solved, problem=of["solved"]),
    )


def carried_over(before: FreeFilm, instant: Instant, film: FreeFilm) -> Instant:
    """An instant of a film as one of the film at another speed, which may be mirrored."""
    return instant if before.turned == film.turned else turned_round(before.solved, instant)
