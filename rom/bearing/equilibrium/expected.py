"""The film that a bearing is expected to have under its load, from a few films on a coarse grid."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.parts.allowance import allowance

REFERENCE = 1e-4
"""Film thickness at which the shape of a wall is sampled, over the largest film thickness of the geometry."""

SAMPLES = 129
"""Number of positions along and across at which the film thickness is sampled."""

ROUNDING = 1e-9
"""Variation of the film thickness over the reference film thickness below which the walls are parallel."""

MIN_FILM_RATIO = 1e-4
"""Smallest film thickness that is tried over the variation of the film thickness."""

MIN_FILM_OVER_PEAK = 1.001
"""Smallest mean gap over the height of the roughness that is tried without contact."""

STEEPNESS_OF_SHAFT = 1.0
"""Exponent of the load of a shaft near its bore over the least film, W ~ 1/h of a wide bearing."""

STEEPNESS_OF_PAD = 2.0
"""Exponent of the load of a pad about its pivot over the least film, W ~ 1/h² of a pad that keeps its shape."""

FIRST_OFF_CENTRE = 0.5
"""Film thickness over the clearance of a journal bearing at which the search begins."""


@dataclass(frozen=True)
class ExpectedFilm:
    """The film that a bearing is expected to have under its load.

    Attributes
    ----------
    thickness : minimum film thickness, m.
    steepness : exponent n of the load over the film thickness there, W ~ h⁻ⁿ.
    place : the coordinates of a wall that moves freely; None where the thickness is the only one.
    """

    thickness: float
    steepness: float
    place: tuple[float, ...] | None = None


def expected_scene(scene: Bearing) -> Bearing:
    """The scene at the film that it is expected to have: as given, or, with a load, the one that carries it.

    Raises
    ------
    InputError
        If no film carries the load.
    ConvergenceError
        If a film or the load does not converge.
    """
    if scene.load is None:
        return scene
    expected, geometry = expected_film(scene), scene.geometry
    if isinstance(geometry, MovingWall) and expected.place is not None:
        return scene.moved(geometry.at(np.array(expected.place)))
    return scene.at_film(expected.thickness)


def expected_film(scene: Bearing) -> ExpectedFilm:
    """The film of the smooth or averaged bearing with cavitation on a coarse grid, of a scene with a load.

    Where asperities touch, the film is at least twice the rms height.

    Raises
    ------
    InputError
        If no film carries the load.
    ConvergenceError
        If a film or the load does not converge.
    """
    found = _expected(keyed(scene))
    if isinstance(found, Exception):
        raise found.with_traceback(None)
    return found


_estimate = deferred("rom.bearing.equilibrium.estimate", "estimate")
_expected_place = deferred("rom.bearing.free.solve", "expected_place")


@lru_cache(maxsize=64)
def _expected(question: KeyedScene) -> ExpectedFilm | InputError | ConvergenceError:
    """The expected film, or the error of its search, which is as dear."""
    scene = question.scene
    try:
        with allowance(math.inf):  # what is kept does not depend on who asks first
            if not isinstance(scene.geometry, MovingWall):
                return ExpectedFilm(*_estimate(scene))
            place = _expected_place(scene)
    except (InputError, ConvergenceError) as error:
        return error
    steepness = STEEPNESS_OF_SHAFT if isinstance(scene.geometry, Shaft) else STEEPNESS_OF_PAD
    return ExpectedFilm(scene.geometry.at(np.array(place)).thinnest, steepness, place)


def closest_film(scene: Bearing) -> float:
    """The smallest film thickness of a smooth bearing that is tried, m.

    It is above the dip of waves by ``MIN_FILM_RATIO`` times the variation of the film thickness; between parallel walls
    times the film thickness at which 6ηuL/h² or 12ηVL²/h³ is the load over the nominal area, or that of a film behind
    restrictors.
    """
    least = MIN_FILM_RATIO * (_variation(scene) or _scale(scene) or MIN_FILM_RATIO * scene.geometry.widest)
    return min(scene.geometry.dip * MIN_FILM_OVER_PEAK + least, scene.geometry.widest / 2)


def first_film(scene: Bearing, closest: float) -> float:
    """The film thickness at which the search begins, m: as given, or that of a wedge with the same rise.

    The mean pressure of an infinitely wide wedge is 6ηuL/h² (ln(1 + K) - 2K/(2 + K))/K² with K = rise/h; a side flow
    reduces it by 1 + (L/B)². The search for a journal begins at half of its clearance.
    """
    geometry, pressure = scene.geometry, scene.load_pressure
    assert pressure is not None
    if geometry.film is not None and geometry.film > closest:
        return geometry.film
    if isinstance(geometry, Journal):
        return FIRST_OFF_CENTRE * geometry.clearance
    rise, scale = _variation(scene), _scale(scene)
    if rise == 0 or scale == 0 or scene.motion.approach > 0 or scene.supply:
        return min(max(scale, 2 * closest), geometry.widest / 2)
    share = 1.0 if geometry.width is None else 1 / (1 + (geometry.length / geometry.width) ** 2)

    def excess(logarithm: float) -> float:
        film = math.exp(logarithm)
        ratio = rise / film
        wedge = (math.log1p(ratio) - 2 * ratio / (2 + ratio)) / ratio**2 if ratio > 1e-3 else ratio / 12
        return share * (scale / film) ** 2 * wedge - 1

    low, high = math.log(closest), math.log(geometry.widest)
    if excess(low) <= 0 or excess(high) >= 0:
        return geometry.dip + 2 * closest if excess(low) <= 0 else geometry.widest / 2
    return geometry.dip + math.exp(scipy.optimize.brentq(excess, low, high, xtol=1e-3))


def _scale(scene: Bearing) -> float:
    """The film thickness at which 6ηuL/h² or 12ηVL²/h³ is the load over the nominal area, or of a restricted film, m.

    It is the greatest of these.
    """
    assert scene.load_pressure is not None
    viscosity, length = scene.lubricant.viscosity, scene.geometry.length
    sheared = 6 * viscosity * abs(scene.motion.speed) * length
    squeezed = 12 * viscosity * max(scene.motion.approach, 0.0) * length**2
    of_squeeze = float(np.cbrt(squeezed / scene.load_pressure))
    return max(math.sqrt(sheared / scene.load_pressure), of_squeeze, fed_film(scene))


def fed_film(scene: Bearing) -> float:
    """The film thickness whose resistance 12η/h³ is that of a restrictor at half of its pressure, m; 0 without one."""
    viscosity, films = scene.lubricant.viscosity, [0.0]
    for inflow in scene.inflows:
        if inflow.restrictor is not None:
            drop = inflow.pressure / 2 or scene.load_pressure or 0.0
            films.append((12 * viscosity * abs(inflow.restrictor.flow(drop)[0]) / drop) ** (1 / 3))
    return max(films)


def _variation(scene: Bearing) -> float:
    """The largest minus the smallest film thickness, m; 0 between parallel walls."""
    film = REFERENCE * scene.geometry.widest + scene.geometry.dip
    shape = scene.geometry.at_film(film).film_shape()
    x, y = np.linspace(shape.breaks[0], shape.breaks[-1], SAMPLES), np.linspace(*shape.across, SAMPLES)
    variation = float(np.ptp(shape.thickness(*np.broadcast_arrays(x[:, None], y[:1] if shape.wide else y))))
    return variation if variation > ROUNDING * film else 0.0
