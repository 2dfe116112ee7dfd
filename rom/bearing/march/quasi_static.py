"""Loads over time: whether films in equilibrium with each load are enough, or squeeze changes them."""

import math
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.course import Duty, course_of, film_at
from roughfilm.rom.bearing.march.journals import opened, with_coordinates
from roughfilm.rom.bearing.moving.checks import MOMENTS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import Instant, turned_round
from roughfilm.rom.ladder.kind import InTime

CELLS = (48, 24)
"""Cells along and across of the films."""

TIMES = 64
"""Number of times at which films are solved, over the table."""

RESIDUAL = 1e-9
"""Residual at which a film is solved."""

AT_REST = 1e-6
"""Speed over the largest one below which a wall that slides back and forth is at rest."""

JUDGED = "load over time: models are judged at the largest load"

MAX_CHANGE = 0.3
"""Relative change of the least film up to which the linear estimate is stated as a number."""


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
        """The relative change of the least film over time by squeeze."""
        return float(self.moved.min() / self.film_min.min() - 1)

    def faster(self, within: float) -> float:
        """The factor of all rates at which the change by squeeze reaches a tolerance; infinite without a change."""
        return within / abs(self.change) if self.change else math.inf


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
    film, table = film_at(duty, cells), duty.scene.motion.over_time
    assert table is not None
    time = np.linspace(duty.begin, duty.begin + (table.period or float(np.ptp(table.table.time))), times + 1)
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


def _equilibria(duty: Duty, film: FreeFilm, time: Array) -> list[tuple[FreeFilm, Instant]]:
    """The film in equilibrium with the load at each time, each from the one before, and mirrored if it slides back."""
    found: list[tuple[FreeFilm, Instant]] = []
    for at in time:
        speed = duty.speed(float(at))
        placed = _at_speed(film.reversed if speed and (speed < 0) != film.turned else film, abs(speed))
        start = None
        if found:
            before, start = found[-1]
            start = start if before.turned == placed.turned else turned_round(before.solved, start)
        load = duty.load(float(at))[: film.wall.place.size]
        found.append((placed, equilibrium(placed, start, tolerance=RESIDUAL, load=load)))
    return found


def _at_speed(film: FreeFilm, speed: float) -> FreeFilm:
    """The film at another sliding speed of the same direction, m/s (rad/s)."""
    of = {name: replace(part.problem, speed=speed) for name, part in (("whole", film.whole), ("solved", film.solved))}
    return replace(
        film,
        whole=replace(film.whole, problem=of["whole"]),
        solved=replace(film.solved, problem=of["solved"]),
    )


def in_time(scene: Bearing, within: float) -> InTime | None:
    """What the change of a load over time means for a scene: whether squeeze matters.

    Parameters
    ----------
    within : tolerated relative error of the least film.
    """
    if not _loaded_over_time(scene):
        return None
    try:
        found = quasi_static(Duty(scene=with_coordinates(scene, CELLS)))
    except (InputError, ConvergenceError) as error:
        line = f"load over time: not every load has a film in equilibrium ({error}); take roughfilm march"
        return InTime(lines=(line, JUDGED), entries={"quasi_static": None})
    change, rate = found.change, found.faster(within)
    small = abs(change) <= MAX_CHANGE
    size = f"by up to about {100 * abs(change):.2g} %" if small else f"possibly by more than {100 * MAX_CHANGE:g} %"
    number = "" if math.isinf(found.squeeze_number) else f" (squeeze number {found.squeeze_number:.2g})"
    enough = abs(change) <= within
    verdict = (
        f"films in equilibrium with each load are enough for {100 * within:g} %"
        if enough
        else f"films in equilibrium with each load are not enough for {100 * within:g} %, take roughfilm march"
    )
    limit = (
        "at any rate of change"
        if math.isinf(rate)
        else f"up to {rate:.2g} times the rates of this table"
        if enough
        else f"below {rate:.2g} times the rates of this table they would be"
    )
    return InTime(
        lines=(
            f"load over time: squeeze changes the least film {size}{number}",
            f"load over time: {verdict}; {limit}",
            JUDGED,
        ),
        entries={
            "quasi_static": {
                "enough": enough,
                "change_of_least_film": change if abs(change) <= MAX_CHANGE else None,
                "squeeze_number": None if math.isinf(found.squeeze_number) else found.squeeze_number,
                "largest_rate_factor": None if math.isinf(rate) else rate,
            }
        },
    )


def _loaded_over_time(scene: Bearing) -> bool:
    """Whether the load of a scene changes in time."""
    table = scene.motion.over_time
    return table is not None and bool({"load", "load_x", *MOMENTS} & table.table.columns.keys())


def steady(scene: Bearing) -> Bearing:
    """The scene at the time of the largest load of its table, with that load, its direction and the speed then."""
    if not _loaded_over_time(scene):
        return scene
    duty, table = Duty(scene=opened(scene)), scene.motion.over_time
    assert table is not None
    times = np.linspace(table.table.time[0], table.table.time[-1], 20 * TIMES + 1)
    at = float(max(times, key=lambda time: float(np.linalg.norm(duty.load(time)[: 2 if duty.lobes else 1]))))
    if duty.reverses and abs(duty.speed(at)) <= AT_REST * max(abs(duty.speed(float(time))) for time in times):
        raise InputError(
            f"motion.over_time.speed: got {duty.speed(at):.4g} m/s at {at:.4g} s with the largest load, which no "
            "steady film carries then; take roughfilm march, or another speed then"
        )
    radius = scene.turning_radius if not duty.lobes and scene.turning_radius is not None else 1.0
    motion = scene.motion.model_copy(update={"speed": duty.speed(at) * radius, "over_time": None})
    return scene.model_copy(update={"load": duty.steady_load(at), "motion": motion, "body": None})
