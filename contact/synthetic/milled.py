"""The arcs that a face mill leaves."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, number_between, repeats
from roughfilm.contact.synthetic.grid import Grid, metres


def milled(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    radius: float,
    feed: float,
    depth: float,
    offset: float = 0.0,
    back_lift: float | None = None,
) -> Surface:
    """Arcs of a face mill that is fed along x, with parabolic scallops between cusps.

    Front: h = d (2u/f)², where u, -f/2 to f/2, is the distance along x from the nearest arc x = k f - b(y), with
    b = R - sqrt(R² - (y - yc)²). Where the back of the mill cuts too, the lower of that and h = l + d (2v/f)² counts,
    with v from the arcs x = k f + b(y). Heights are 0 on the arcs of the front, and at most d.

    Parameters
    ----------
    size, points : the period, m, and the grid over it, along x (the feed) and y.
    radius : R, m, of the circle the cutting edge moves on; arcs must span the width.
    feed : f, m, for each revolution; a whole number of times along x (to one part in a thousand), at least two pixels.
    depth : d, m, from arc to cusp: f²/(8 r) for an edge of nose radius r.
    offset : how far yc lies from the middle of the width, m.
    back_lift : l, m, how much higher the back of the mill passes: 0 for equal crossing marks; from d on it leaves
        none. Without it the back does not cut.

    Returns
    -------
    Periodic surface: along x because the feed divides the length; across the joint at y = 0 because the arcs arrive
    there a whole number of feeds apart. With offset 0 they are symmetric and meet; any other offset is moved to the
    nearest for which b(Ly) - b(0) is a whole number of feeds, told in ``source["achieved"]``. Heights are continuous at
    the joint, but arcs have a kink there: with offset 0, dx/dy jumps by about Ly/R. Let R be long against Ly.

    Raises
    ------
    InputError
        One line, for what makes no sense, or where arcs end inside the width or come within two pixels of each other.
    """
    grid = Grid(kind="milled", size=size, points=points)
    length("milled.depth", depth)
    length("milled.radius", radius)
    count = repeats("milled.feed", feed, size[0])
    fitting = grid.resolves("feed", size[0] / count, grid.spacing[0])
    number_between("milled.offset", offset, -1e6, 1e6, "it must be -1e6 to 1e6 m, look at the unit")
    if back_lift is not None:
        number_between("milled.back_lift", back_lift, 0, 1e6, "it must be 0 to 1e6 m, look at the unit")
    reach = size[1] / 2 + abs(offset)
    if reach >= radius:
        raise InputError(
            f"milled.radius: got {radius:.5g} m, whose arcs end inside the width; write more than {reach:.5g} m, "
            "or less offset"
        )
    closing = _closing_offset(radius, size[1] / 2, fitting, offset)
    x, y = grid.axes
    aside = (y - 0.5) * size[1] - closing
    beside = np.sqrt(np.maximum(radius**2 - aside**2, 0.0))
    if (np.abs(aside) * grid.spacing[1] > beside * fitting / 2).any():
        raise InputError(
            f"milled.radius: got {radius:.5g} m, whose arcs come within two pixels of each other along y; write a "
            "longer one, or more points along y"
        )
    sagitta = aside**2 / (radius + beside) / fitting
    heights = depth * _scallop(count * x + sagitta)
    if back_lift is not None:
        heights = np.minimum(heights, back_lift + depth * _scallop(count * x - sagitta))
    return grid.surface(
        heights,
        {
            "radius": metres(radius),
            "feed": metres(feed),
            "depth": metres(depth),
            "offset": metres(offset),
            "back_lift": metres(back_lift),
        },
        {"feed": metres(fitting), "offset": metres(closing)},
    )


def _scallop(phase: Array) -> Array:
    """(2u/f)² of the distance u from the nearest of the places where the phase, in feeds, is whole."""
    shape: Array = (2 * (phase - np.round(phase))) ** 2
    return shape


def _closing_offset(radius: float, half: float, feed: float, offset: float) -> float:
    """The nearest offset e with b(Ly) - b(0) = j f: e² = j² f² (R² - a² - j² f²/4) / (j² f² + 4 a²), a = Ly/2."""
    far, near = (math.sqrt(radius**2 - (half + sign * abs(offset)) ** 2) for sign in (1, -1))
    most = 2 * math.sqrt(half * (radius - half))
    apart = feed * min(round(4 * half * abs(offset) / (far + near) / feed), math.floor(most / feed))
    closing = apart * math.sqrt((radius**2 - half**2 - apart**2 / 4) / (apart**2 + 4 * half**2))
    return math.copysign(closing, offset)
