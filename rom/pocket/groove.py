"""Shapes of grooves, and the gap of a channel with grooves in its lower wall."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film.gap import Gap

SAME_PLACE = 1e-9
"""Distance over the period below which two positions are equal."""

STRAIGHT = 1e-9
"""Jump of slope over the largest slope up to which two lines are one."""

CORNER_SHARE = 0.1
"""Jump of slope over the largest one above which a point of a polygon is a corner."""


@dataclass(frozen=True, kw_only=True)
class Groove:
    """Depth of a groove along s, the distance from its position, m.

    Parameters
    ----------
    breaks
        Positions at which the depth or a derivative is not smooth, from one edge to the other, m, increasing.
    corners
        The breaks at which its slope jumps, m.
    depth
        Depth d(s) >= 0, m, zero outside the edges; vectorised.
    """

    breaks: tuple[float, ...]
    corners: tuple[float, ...]
    depth: Callable[[Array], Array]


def cylindrical(*, width: float, depth: float) -> Groove:
    """A groove whose wall is a circular arc through its two edges, in m; 0 < depth <= width / 2 (a half circle).

    With R = (w²/4 + d²) / 2d the radius of the arc,

        d(s) = sqrt(R² - s²) - (R - d)   for |s| < w/2,

    computed as (w²/4 - s²) / (sqrt(R² - s²) + R - d) to avoid cancellation in shallow grooves.
    Source: Sahlin et al. 2005, doi:10.1115/1.1828067, Fig. 1.

    Examples
    --------
    >>> groove = cylindrical(width=0.3e-3, depth=7.5e-6)
    >>> [float(round(d, 9)) for d in groove.depth(np.array([0.0, 0.15e-3, 0.4e-3]))]
    [7.5e-06, 0.0, 0.0]
    """
    radius = (width**2 / 4 + depth**2) / (2 * depth)

    def rise(s: Array) -> Array:
        inside = np.minimum(np.abs(s), width / 2)
        numerator = width**2 / 4 - inside**2
        denominator = np.sqrt(np.maximum(radius**2 - inside**2, 0)) + radius - depth
        return np.divide(numerator, denominator, out=np.zeros_like(inside), where=numerator > 0)

    edges = (-width / 2, width / 2)
    return Groove(breaks=edges, corners=edges, depth=rise)


def splined(*, width: float, depth: float, shift: float) -> Groove:
    """A groove of two cubics with zero slope at both edges and at the lowest point s = ``shift``; lengths in m.

        d(s) = d (3t² - 2t³),   t from 0 at an edge to 1 at the lowest point.

    The slope is continuous. |shift| < width / 2; it is positive in the sliding direction.
    Source: Sahlin et al. 2005, doi:10.1115/1.1828067, Fig. 1.
    """

    def rise(s: Array) -> Array:
        t = np.clip(np.minimum((s + width / 2) / (width / 2 + shift), (width / 2 - s) / (width / 2 - shift)), 0, 1)
        return np.asarray(depth * t**2 * (3 - 2 * t))

    return Groove(breaks=(-width / 2, shift, width / 2), corners=(), depth=rise)


def polygonal(*, points: Sequence[tuple[float, float]]) -> Groove:
    """A groove of straight lines between three or more points (s, depth) in m, s increasing, depth 0 first and last.

    Every point at which the slope changes is a break. It is a corner if its jump of slope is above ``CORNER_SHARE`` of
    the largest one: the many small jumps of a finely sampled curve are none.

    Examples
    --------
    >>> groove = polygonal(points=[(-0.1e-3, 0.0), (0.0, 2e-5), (0.1e-3, 0.0)])
    >>> [float(round(d, 9)) for d in groove.depth(np.array([-0.05e-3, 0.0, 0.2e-3]))], len(groove.corners)
    ([1e-05, 2e-05, 0.0], 3)
    """
    places, depths = (np.array(column, dtype=float) for column in zip(*points, strict=True))
    slopes = np.concatenate([[0.0], np.diff(depths) / np.diff(places), [0.0]])
    jumps = np.abs(np.diff(slopes))
    bent = jumps > STRAIGHT * np.abs(slopes).max()
    bent[[0, -1]] = True
    return Groove(
        breaks=tuple(map(float, places[bent])),
        corners=tuple(map(float, places[jumps > CORNER_SHARE * jumps.max()])),
        depth=lambda s: np.interp(s, places, depths, left=0.0, right=0.0),
    )


def monotone(*, points: Sequence[tuple[float, float]]) -> Groove:
    """A groove of monotone cubics through three or more points (s, depth) in m, s increasing, depth 0 first and last.

    The slope is continuous between the edges, and no depth exceeds those of the neighbouring points. Corners between
    the edges are lost: three points of a V make a parabola, which is up to a quarter of its depth below the V.
    Source: Fritsch and Butland 1984, doi:10.1137/0905021.
    """
    from scipy.interpolate import PchipInterpolator  # slow to import

    places, depths = (np.array(column, dtype=float) for column in zip(*points, strict=True))
    spline = PchipInterpolator(places, depths)

    def rise(s: Array) -> Array:
        inside = (s > places[0]) & (s < places[-1])
        return np.where(inside, np.maximum(spline(np.clip(s, places[0], places[-1])), 0), 0)

    slope = spline.derivative()
    corners = tuple(float(edge) for edge in places[[0, -1]] if slope(edge) != 0)
    return Groove(breaks=tuple(map(float, places)), corners=corners, depth=rise)


def channel(*, length: float, film: float, grooves: Sequence[tuple[float, Groove]]) -> Gap:
    """The gap of one period -length/2 .. length/2 of a film with grooves at the given positions, in m.

        h(x) = film + Σ d(x - position).

    The grooves may touch each other and the ends of the period, but not overlap.

    Examples
    --------
    >>> groove = splined(width=0.2e-3, depth=1e-5, shift=0.0)
    >>> gap = channel(length=1e-3, film=3e-5, grooves=[(-0.25e-3, groove), (0.25e-3, groove)])
    >>> [float(round(h, 9)) for h in gap.thickness(np.array([-0.25e-3, 0.0, 0.25e-3, 0.75e-3]))]
    [4e-05, 3e-05, 4e-05, 4e-05]
    """
    grooves = tuple(grooves)

    def thickness(x: Array) -> Array:
        within = x - length * np.round(np.asarray(x, dtype=float) / length)
        return np.asarray(film + sum(groove.depth(within - position) for position, groove in grooves))

    breaks = [-length / 2]
    for place in sorted(position + s for position, groove in grooves for s in groove.breaks):
        if breaks[-1] + SAME_PLACE * length < place < length / 2 - SAME_PLACE * length:
            breaks.append(place)

    def nearest(place: float) -> float:
        return min(breaks, key=lambda other: min(abs(place - other), abs(place - other - length)))

    corners = {nearest(position + s) for position, groove in grooves for s in groove.corners}
    return Gap(film=film, breaks=(*breaks, length / 2), corners=tuple(sorted(corners)), thickness=thickness)
