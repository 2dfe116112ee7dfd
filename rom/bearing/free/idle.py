"""Tilting pads that carry no load, and the tilts at which they would carry one."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.quantities import scene_positions
from roughfilm.rom.bearing.totals.pads import unloaded
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, settled

FIRST_TILT = 0.75
"""First tilt that is tried, between those at which a pad touches the shaft with its leading and its trailing edge."""

MAX_TILTS = 9
"""Largest number of tilts that are tried, each in the middle of the interval that is left."""


def idle_pads(film: FreeFilm, instant: Instant) -> list[int]:
    """The numbers from 0 of the pads of a journal bearing that tilt freely and carry no load."""
    geometry = film.scene.geometry
    if not isinstance(geometry, Lobes) or not film.free[film.wall.turns].any():
        return []
    solution = film.solution(instant)
    above = solution.grid.areas * (solution.state.pressure + film.scene.lubricant.cavitation_pressure)
    return [pad - 1 for pad in unloaded(geometry, scene_positions(solution), above)]


def with_wedges(film: FreeFilm, instant: Instant, pads: list[int], *, tolerance: float) -> Instant | None:
    """The film at the place of the shaft with idle pads at tilts at which their film carries a load and closes them.

    The moment of the film about the pivot changes its sign between such a tilt and that at which the trailing edge
    touches the shaft, so that an equilibrium in which the pad carries a load lies between them. At a fixed place of
    the shaft pads do not act on each other, and all of them are tried at once, each by halving the interval between a
    tilt without a load and one at which the film opens the pad. None if no pad has such a tilt.

    Parameters
    ----------
    pads : numbers from 0 of the idle pads.
    tolerance : residual at which a film is solved.
    """
    count, sense = instant.place.size, -1.0 if film.turned else 1.0
    drive = Drive(
        speed=film.solved.problem.speed,
        force=np.zeros(count),
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
    )
    ends = {pad: _ends(film, instant.place, pad, sense) for pad in pads}
    low, high = dict.fromkeys(pads, 0.0), dict.fromkeys(pads, 1.0)
    found: dict[int, float] = {}
    now = instant
    for number in range(MAX_TILTS):
        place = instant.place.copy()
        tried = {pad: FIRST_TILT if number == 0 else (low[pad] + high[pad]) / 2 for pad in pads if pad not in found}
        for pad in pads:
            leading, trailing = ends[pad]
            place[2 + pad] = leading + found.get(pad, tried.get(pad, 0.0)) * (trailing - leading)
        try:
            now = settled(film.solved, replace(film.first(place), pressures=now.pressures), drive, tolerance=tolerance)
        except (ConvergenceError, FloatingPointError):
            return None
        idle, moments = idle_pads(film, now), sense * film.solved.force(now.state.pressure)
        for pad, tilt in tried.items():
            if pad in idle:
                low[pad] = tilt
            elif moments[2 + pad] < 0:
                high[pad] = tilt
            else:
                found[pad] = tilt
        if len(found) == len(pads):
            break
    if not found:
        return None
    place = instant.place.copy()
    for pad, tilt in found.items():
        place[2 + pad] = ends[pad][0] + tilt * (ends[pad][1] - ends[pad][0])
    return replace(film.first(place), pressures=now.pressures)


def _ends(film: FreeFilm, place: Array, pad: int, sense: float) -> tuple[float, float]:
    """The tilts at which a pad touches the shaft with its leading and with its trailing edge, rad."""
    unit = np.zeros(place.size)
    unit[2 + pad] = sense
    leading, trailing = (1 / film.solved.closing(place, sign * unit) for sign in (-1.0, 1.0))
    return float(place[2 + pad] - sense * leading), float(place[2 + pad] + sense * trailing)
