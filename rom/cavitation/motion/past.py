"""What is known of a film at earlier times of a march, and the formulas of a time step from it."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.warming import UNKNOWN


@dataclass(frozen=True, kw_only=True)
class Known:
    """The coordinates, their velocities, θh at the nodes, m, and the temperature, K, at one time, s.

    The temperature is not a number of a film without one.
    """

    time: float
    place: Array
    velocity: Array
    held: Array
    temperature: float = UNKNOWN


def held(film: MovingFilm, instant: Instant) -> Array:
    """θh at the nodes, m."""
    excess = film.problem.compression(instant.state.pressure)[0]
    return np.asarray((instant.state.fill + excess) * film.gap(instant.faces.thickness))


def differences(past: tuple[Known, ...], size: float, order: int) -> tuple[float, tuple[Array, Array, Array]]:
    """The rate a, 1/s, and s of ẋ = a x - s after a step, for the coordinates, their velocities and θh."""
    rate, near, far = weights(past, size, order)
    last = past[0]
    if order == 1:
        return rate, (last.place / size, last.velocity / size, last.held / size)
    before = past[1]
    return rate, (
        near * last.place - far * before.place,
        near * last.velocity - far * before.velocity,
        near * last.held - far * before.held,
    )


def weights(past: tuple[Known, ...], size: float, order: int) -> tuple[float, float, float]:
    """a, b and c of ẋ = a x₊ - b x + c x₋, 1/s, after a step; c is 0 of first order."""
    if order == 1:
        return 1 / size, 1 / size, 0.0
    ratio = size / (past[0].time - past[1].time)
    return (1 + 2 * ratio) / ((1 + ratio) * size), (1 + ratio) / size, ratio**2 / ((1 + ratio) * size)


def predicted(past: tuple[Known, ...], size: float) -> Array:
    """The coordinates after a step, extrapolated from up to three times; at first with the velocity."""
    last = past[0]
    if len(past) == 1:
        return np.asarray(last.place + size * last.velocity)
    before = past[1]
    slope = (last.place - before.place) / (last.time - before.time)
    place = last.place + size * slope
    if len(past) > 2:
        older = past[2]
        bend = (slope - (before.place - older.place) / (before.time - older.time)) / (last.time - older.time)
        place = place + size * (size + last.time - before.time) * bend
    return np.asarray(place)
