"""The estimate of the film that a bearing has under its load: the film of a simple model on a coarse grid."""

import math
from contextlib import nullcontext
from functools import partial
from typing import Any

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.balance import ROUNDING, FilmsAtSpeed, balanced, robustly_balanced
from roughfilm.rom.bearing.equilibrium.expected import MIN_FILM_OVER_PEAK, closest_film, first_film
from roughfilm.rom.bearing.equilibrium.films import ModelFilms
from roughfilm.rom.bearing.film import averaged_film
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.newton import few_rounds

CONTACT_FILM = 2.0
"""Expected film thickness over the rms height where asperities carry the load."""

CELLS = {True: (64, 256), False: (24, 96)}
"""Numbers of cells along a side, for an infinitely wide film (True) and for others; the second if the first fails."""

CLEARLY = 2.0
"""Smallest load of films on the first grid over the wanted one above which it is refused there.

Above the same ratio of the wanted load to the largest one the second grid is asked at the film of the largest alone,
which a coarse grid does not resolve at the end of a wedge that is a ten-thousandth of its rise thick.
"""

LOAD_TOLERANCE = 1e-4
"""Relative error of the load at which the search stops."""


def estimate(scene: Bearing) -> tuple[float, float]:
    """The minimum film thickness of a scene under its load, m, and the exponent n of the load there, W ~ h⁻ⁿ.

    Ridges are averaged, and other walls are smooth; where asperities touch, the film is at least ``CONTACT_FILM`` times
    the rms height. Errors are those of :func:`roughfilm.rom.bearing.equilibrium.expected.expected_film`.
    """
    roughness, pressure = scene.roughness, scene.load_pressure
    assert pressure is not None
    closest, touching = closest_film(scene), 0.0
    if isinstance(roughness, Sinusoid):
        closest = max(closest, MIN_FILM_OVER_PEAK * (roughness.peak + scene.geometry.dip))
    elif roughness is not None and scene.asperities is not None:
        touching = CONTACT_FILM * roughness.rms
    failure: InputError | ConvergenceError | None = None
    place: float | None = None
    for cells in CELLS[scene.wide]:
        films = ModelFilms(
            scene=scene,
            film=averaged_film if isinstance(roughness, Sinusoid) else Bearing.problem,
            ruptures=True,
            cells=cells,
            closest=closest,
            touching=max(first_film(scene, closest), MIN_FILM_OVER_PEAK * closest),
        )
        at = FilmsAtSpeed(film=films, speed=scene.motion.speed)
        search = robustly_balanced if place is None else partial(balanced, guess=place)
        try:
            with nullcontext() if failure is None else few_rounds():
                film = search(at, pressure, tolerance=LOAD_TOLERANCE).scene.geometry.thinnest
        except (InputError, ConvergenceError) as error:
            if touching > 0:
                return touching, at.steepness
            if place is None or isinstance(error, InputError):
                failure = error
            load, carried = pressure * films.area, at.loads
            if isinstance(error, InputError) and carried:
                place = max(carried, key=lambda film: carried[film])
                if load < min(carried.values()) / CLEARLY or carried[place] <= ROUNDING * load:
                    break
                if load <= CLEARLY * carried[place]:
                    place = None
        else:
            return max(film, touching), steepness_of(at, film)
    assert failure is not None
    raise failure


def steepness_of(at: FilmsAtSpeed[Any], film: float) -> float:
    """The exponent n of the load over the film thickness, from the two solved films next to a film thickness, m."""
    nearest = sorted(at.loads, key=lambda place: abs(math.log(place / film)))[:2]
    carried = [at.loads[place] + at.film.contact_load(place) for place in nearest]
    if len(nearest) < 2 or min(carried) <= 0:
        return at.steepness
    return -math.log(carried[0] / carried[1]) / math.log(nearest[0] / nearest[1])
