"""Face-milled surfaces: the arcs that a face mill leaves."""

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
    """The marks of a face mill fed along x: arcs with parabolic scallops between cusps.

    The front of the mill leaves h = d (2u/f)², where u, -f/2 to f/2, is the distance along x from the nearest arc
    x = k f - b(y), with b = R - sqrt(R² - (y - yc)²). If the back cuts too, the lower of this and h = l + d (2v/f)²
    counts, with v from the arcs x = k f + b(y). Heights are 0 on the arcs of the front, and at most d.

    Parameters
    ----------
    size, points : period, m, and number of points, along x (the feed) and y.
    radius : radius R of the circle of the cutting edge, m; its arcs must span the width.
    feed : f, m, per revolution; divides the length to 0.1 %, at least two pixels.
    depth : d, m, from arc to cusp; f²/(8 r) for an edge of nose radius r.
    offset : distance of yc from the middle of the width, m.
    back_lift : height l of the back of the mill above its front, m: 0 for equal crossing marks, d or more for none. By
        default the back does not cut.

    Returns
    -------
    Surface : periodic along y since a non-zero offset is moved to the nearest for which b(Ly) - b(0) is a whole number
        of feeds; ``source["achieved"]`` holds feed and offset. Heights are continuous at the joint y = 0, but arcs have
        a kink there: with offset 0, dx/dy jumps by about Ly/R, so that R should be large against Ly.

    Raises
    ------
    InputError
        If an argument is out of range, or arcs end inside the width or come within two pixels of each other.
    """
    grid = Grid(kind="milled", size=size, points=points)
    length("milled.depth", depth)
    length("milled.radius", radius)
    count = repeats("milled.feed", feed, size[0])
    fitting = grid.resolves("feed", size[0] / count, grid.spacing[0])
    number_between("milled.offset", offset, -1e6, 1e6, "it must be -1e6 to 1e6 m, look at the unit")
    if back_lift is not None:
        number_between("milled.back_lift", back_lift, 0, 1e6, "it must be 0 to 1e6 m, look at the unit")
    half_span = size[1] / 2 + abs(offset)
    if half_span >= radius:
        raise InputError(
            f"milled.radius: got {radius:.5g} m, whose arcs end inside the width; write more than {half_span:.5g} m, "
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
    """Height (2u/f)² of a scallop at the distance u from the nearest point of whole phase, in feeds."""
    return np.asarray((2 * (phase - np.round(phase))) ** 2)


def _closing_offset(radius: float, half: float, feed: float, offset: float) -> float:
    """The offset e, m, nearest to the given one for which b(Ly) - b(0) = j f is a whole number of feeds.

    e² = j² f² (R² - a² - j² f²/4) / (j² f² + 4 a²) with a = Ly/2.
    """
    far, near = (math.sqrt(radius**2 - (half + sign * abs(offset)) ** 2) for sign in (1, -1))
    most = 2 * math.sqrt(half * (radius - half))
    apart = feed * min(round(4 * half * abs(offset) / (far + near) / feed), math.floor(most / feed))
    closing = apart * math.sqrt((radius**2 - half**2 - apart**2 / 4) / (apart**2 + 4 * half**2))
    return math.copysign(closing, offset)
