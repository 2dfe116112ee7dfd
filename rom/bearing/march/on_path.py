"""Paths over time: the load of the film at each place, and how much squeeze changes it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.course import Duty, film_at
from roughfilm.rom.bearing.march.quasi_static import CELLS, RESIDUAL, TIMES, at_speed, carried_over, times_of
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import Instant


@dataclass(frozen=True, kw_only=True)
class PathLoads:
    """The forces of films at the places of a path over time, which do not move and which do.

    Attributes
    ----------
    time : times, s.
    place : the coordinates of the wall at each time, shape (times, coordinates); free tilts are in equilibrium.
    velocity : their rates, m/s (rad/s).
    load : force of the film of a wall at rest, N (N/m if infinitely wide), below 0 where it draws a wall closer.
    moved : the same with squeeze, to first order in the velocity.
    squeeze_number : largest ratio of the force by squeeze to the largest force of a wall at rest; infinite if a wall at
        rest carries no load.
    """

    time: Array
    place: Array
    velocity: Array
    load: Array
    moved: Array
    squeeze_number: float

    @property
    def carries_at_rest(self) -> bool:
        """Whether the film of a wall at rest carries a load anywhere."""
        return bool(self.load.max() > 0)

    @property
    def change(self) -> float:
        """The relative change of the largest load by squeeze; infinite if a wall at rest carries no load."""
        return float(self.moved.max() / self.load.max() - 1) if self.carries_at_rest else math.inf

    @property
    def largest(self) -> int:
        """The number of the place with the largest load, with squeeze if a wall at rest carries none."""
        return int(np.argmax(self.load if self.carries_at_rest else self.moved))


def loads_on_path(duty: Duty, *, cells: tuple[int, int] = CELLS, times: int = TIMES) -> PathLoads:
    """The forces of a film whose place, or only its speed, is given over time.

    With the damping B of the film at rest at each place the force is F - B q̇, to first order in the velocity q̇. A pad
    that tilts freely turns by -K⁻¹ B q̇ of its own coordinates, with the stiffness K.

    Raises
    ------
    InputError
        If the tilts of a pad have no equilibrium at one of the places.
    ConvergenceError
        If a film does not converge, or nothing slides.
    """
    film, time = film_at(duty, cells), times_of(duty, times)
    states: list[tuple[FreeFilm, Instant]] = []
    for at in time:
        given = duty.place(float(at), film)
        placed = at_speed(film, duty.speed(float(at)))
        start = None
        if states:
            last = carried_over(*states[-1], placed)
            start = replace(last, place=np.where(film.free, last.place, given))
        else:
            placed = replace(placed, wall=replace(placed.wall, place=np.where(film.free, film.wall.place, given)))
        states.append((placed, equilibrium(placed, start, tolerance=RESIDUAL, load=np.zeros(given.size))))
    place = np.array([state.place for _, state in states])
    velocity = np.gradient(place, time, axis=0)
    still, moving, free = ~film.wall.turns, [], film.free
    for number, (placed, state) in enumerate(states):
        found = coefficients(placed.solved, state, speed=placed.solved.problem.speed)
        by_squeeze = -found.damping @ velocity[number]
        if free.any():
            turned = np.zeros(free.size)
            turned[free] = np.linalg.lstsq(found.stiffness[np.ix_(free, free)], by_squeeze[free], rcond=None)[0]
            by_squeeze = by_squeeze - found.stiffness @ turned
        moving.append(by_squeeze)
    forces, squeezed = (
        np.array([placed.solved.force(state.state.pressure) for placed, state in states]),
        np.array(moving),
    )
    load, moved, by_squeeze = (_sizes(one[:, still]) for one in (forces, forces + squeezed, squeezed))
    return PathLoads(
        time=time,
        place=place,
        velocity=velocity,
        load=load,
        moved=moved,
        squeeze_number=float(np.abs(by_squeeze).max() / load.max()) if load.max() > 0 else math.inf,
    )


def _sizes(forces: Array) -> Array:
    """The sizes of forces on a shaft, shape (times, 2), or the force on a wall that moves along its normal."""
    return forces[:, 0] if forces.shape[1] == 1 else np.asarray(np.linalg.norm(forces, axis=1))
