"""Two families of equal, crossing grooves, as honing leaves them."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, number_between
from roughfilm.contact.synthetic.grid import Grid, metres, radians

SPACING_TOLERANCE, ANGLE_TOLERANCE = 0.1, math.radians(3)
"""Largest relative change of the spacing, and of the angle, rad, that makes the grooves periodic."""


def cross_hatch(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    spacing: float,
    half_angle: float,
    depth: float,
    width: float,
) -> Surface:
    """A plane at height 0 with two families of parallel grooves at ± the half angle to the x axis.

    The cross-section of a groove is h = -d (1 + cos(2π t/w))/2 for |t| < w/2, with t from its middle line; the deeper
    groove counts at crossings. One groove of each family passes through x = y = 0.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    spacing : distance between neighbouring grooves of a family, perpendicular to them, m.
    half_angle : angle between the grooves and the x axis, above 0 and below π/2, rad; half the honing angle.
    depth, width : d and w, m; the width is at least two pixels and at most the spacing.

    Returns
    -------
    Surface : periodic, so that m = Lx sin(angle)/spacing and n = Ly cos(angle)/spacing are rounded to whole numbers;
        ``source["achieved"]`` holds the spacing and half angle that result.

    Raises
    ------
    InputError
        If an argument is out of range, or rounding changes the spacing by more than 10 % or the angle by more than 3°;
        the message gives values that fit.
    """
    grid = Grid(kind="cross_hatch", size=size, points=points)
    length("cross_hatch.spacing", spacing)
    length("cross_hatch.depth", depth)
    number_between("cross_hatch.half_angle", half_angle, 1e-6, math.pi / 2 - 1e-6, "it must lie between 0 and π/2 rad")
    m = max(1, round(size[0] * math.sin(half_angle) / spacing))
    n = max(1, round(size[1] * math.cos(half_angle) / spacing))
    across = (m / size[0], n / size[1])
    near_spacing, near_angle = 1 / math.hypot(*across), math.atan2(*across)
    if abs(near_spacing / spacing - 1) > SPACING_TOLERANCE or abs(near_angle - half_angle) > ANGLE_TOLERANCE:
        raise InputError(
            f"cross_hatch: got spacing {spacing:.4g} m at {math.degrees(half_angle):.4g} deg, which does not close "
            f"over the period; write {near_spacing:.4g} m at {math.degrees(near_angle):.4g} deg, or a longer size"
        )
    grid.resolves("width", width)
    if width > near_spacing:
        raise InputError(f"cross_hatch.width: got {width:.5g} m; write at most the spacing, {near_spacing:.5g} m")
    x, y = grid.axes

    def groove(phase: Array) -> Array:
        distance = np.minimum(np.abs(phase - np.round(phase)) * near_spacing / width, 0.5)
        return np.asarray((1 + np.cos(2 * np.pi * distance)) / 2)

    return grid.surface(
        -depth * np.maximum(groove(m * x - n * y), groove(m * x + n * y)),
        {
            "spacing": metres(spacing),
            "half_angle": radians(half_angle),
            "depth": metres(depth),
            "width": metres(width),
        },
        {"spacing": metres(near_spacing), "half_angle": radians(near_angle)},
    )
