"""Synthetic surfaces with the numbers of Table E.2 of Paper E, whose measured surfaces are not published."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.distribution import with_heights_of
from roughfilm.contact.synthetic.four_moments import heights_within
from roughfilm.contact.synthetic.gaussian import gaussian

SIDE = 3e-3
"""Side of the period, m; the windows of the source are about as large."""

POINTS = 256


@dataclass(frozen=True, kw_only=True)
class Heights:
    """A row of Table E.2: Sp, Sv, Sa and Sq of the measurement before preparation, m."""

    peak: float
    valley: float
    average: float
    rms: float


TABLE = {
    "surface 1": Heights(peak=9.601e-6, valley=5.565e-6, average=2.568e-6, rms=3.213e-6),
    "surface 2": Heights(peak=9.546e-6, valley=4.337e-6, average=2.029e-6, rms=2.483e-6),
    "surface 3": Heights(peak=6.189e-6, valley=5.405e-6, average=1.663e-6, rms=2.021e-6),
}

FEEDS = 12
"""Number of feed marks across the period of surface 1."""

LAYS = (35.0, -65.0)
"""Directions of the two lays of surface 2 relative to the sliding, degrees."""

LIFT = 0.5
"""Height of the second cut of surface 2 above the first, in rms heights."""

RIDGES = 0.06e-3, 20.0
"""Ridges of surface 3: correlation length across them, m, and its ratio along and across."""

SEEDS = {"surface 1": (501,), "surface 2": (502, 503), "surface 3": (504,)}


def made(name: str, points: int = POINTS, seed: int = 0) -> Surface:
    """Return a periodic surface of Table E.2 with a mean of 0; the sliding is along x.

    The heights have Sa, Sq, Sp and Sv of Table E.2 to 1e-8; the texture follows the description in the source. ``seed``
    is added to the seeds of the first sample.
    """
    return _with_heights(_RAW[name]((points, points), tuple(each + seed for each in SEEDS[name])), name)


def oblique(points: int = POINTS, seed: int = 0, degrees: float = 45.0) -> Surface:
    """Return surface 3 with its ridges at an angle to the sliding, in degrees, and with the same heights."""
    return _with_heights(_surface(_lay((points, points), SEEDS["surface 3"][0] + seed, degrees, *RIDGES)), "surface 3")


def _with_heights(raw: Surface, name: str) -> Surface:
    row = TABLE[name]
    raw = raw.with_heights(raw.heights * (row.rms / raw.heights.std()))
    heights = heights_within(average=row.average, rms=row.rms, peak=row.peak, valley=row.valley, count=raw.heights.size)
    return with_heights_of(raw, lambda _probability: heights, iterations=0)


def turned(surface: Surface) -> Surface:
    """Return the surface with x and y exchanged; a lay along the sliding becomes a lay across it."""
    return Surface(
        heights=np.ascontiguousarray(surface.heights.T),
        spacing=surface.spacing[::-1],
        periodic=surface.periodic,
        source=surface.source,
    )


def _lay(points: tuple[int, int], seed: int, degrees: float, across: float, anisotropy: float) -> Array:
    """Return random ridges of rms height 1 along a direction, shape ``points``."""
    found = gaussian(
        size=(SIDE, SIDE),
        points=points,
        seed=seed,
        rms_height=1e-6,
        correlation_length=across,
        anisotropy=anisotropy,
        lay_angle=float(np.radians(degrees)),
    )
    return found.heights * 1e6


def _milled(points: tuple[int, int], seeds: tuple[int, ...]) -> Surface:
    """Return feed marks of one period, whose height varies slightly along and across them."""
    y = np.arange(points[1]) / points[1]
    return _surface(np.sqrt(2) * np.cos(2 * np.pi * FEEDS * y) + _lay(points, seeds[0], 0.0, 0.15e-3, 8.0))


def _crossed(points: tuple[int, int], seeds: tuple[int, ...]) -> Surface:
    """Return the minimum of two families of ridges at every point."""
    first, second = (_lay(points, seed, degrees, 0.1e-3, 10.0) for seed, degrees in zip(seeds, LAYS, strict=True))
    return _surface(np.minimum(first, second + LIFT))


def _ground(points: tuple[int, int], seeds: tuple[int, ...]) -> Surface:
    return _surface(_lay(points, seeds[0], 0.0, *RIDGES))


def _surface(shape: Array) -> Surface:
    steps = tuple(SIDE / count for count in shape.shape)
    return Surface(heights=1e-6 * shape, spacing=(steps[0], steps[1]), periodic=True)


_RAW: dict[str, Callable[[tuple[int, int], tuple[int, ...]], Surface]] = {
    "surface 1": _milled,
    "surface 2": _crossed,
    "surface 3": _ground,
}
