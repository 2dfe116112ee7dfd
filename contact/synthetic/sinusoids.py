"""Sinusoids along one direction or two: the surfaces whose contact and flow are known in closed form."""

import math
from typing import Literal

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, repeats
from roughfilm.contact.synthetic.grid import Grid, metres

Combination = Literal["product", "sum"]


def sinusoid(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    amplitude: float,
    wavelength_x: float | None = None,
    wavelength_y: float | None = None,
    combination: Combination = "product",
) -> Surface:
    """A wavy surface with a crest at x = y = 0.

    h = A cos(2π x/λx), or the same along y; with both wavelengths h = A cos(2π x/λx) cos(2π y/λy) ("product") or
    h = A (cos(2π x/λx) + cos(2π y/λy))/2 ("sum"), so that heights are -A to A in all cases.

    Parameters
    ----------
    size, points : the period, m, and the grid over it, along x and y.
    amplitude : A, m.
    wavelength_x, wavelength_y : m; one or both; at least two pixels, and a whole number of times in the period (to one
        part in a thousand; the one that fits exactly is taken and told in ``source["achieved"]``).
    combination : how two directions combine.

    Returns
    -------
    Periodic surface of mean 0.

    Raises
    ------
    InputError
        One line, with the nearest wavelengths that fit.

    Notes
    -----
    Source: Johnson, Greenwood and Higginson, Int. J. Mech. Sci. 27 (1985) 383, doi:10.1016/0020-7403(85)90029-3.
    """
    grid = Grid(kind="sinusoid", size=size, points=points)
    length("sinusoid.amplitude", amplitude)
    if combination not in ("product", "sum"):
        raise InputError(f"sinusoid.combination: got {combination!r}; write 'product' or 'sum'")
    waves, achieved = [], {}
    for axis, wavelength in enumerate((wavelength_x, wavelength_y)):
        if wavelength is None:
            continue
        name = f"wavelength_{'xy'[axis]}"
        count = repeats(f"sinusoid.{name}", wavelength, size[axis])
        fitting = grid.resolves(name, size[axis] / count, grid.spacing[axis])
        achieved[name] = metres(fitting)
        waves.append(np.cos(2 * np.pi * count * grid.axes[axis]))
    if not waves:
        raise InputError("sinusoid: got neither of wavelength_x and wavelength_y; give one or both")
    shape = math.prod(waves) if combination == "product" else sum(waves) / len(waves)
    return grid.surface(
        amplitude * np.broadcast_to(shape, points),
        {
            "amplitude": metres(amplitude),
            "wavelength_x": metres(wavelength_x),
            "wavelength_y": metres(wavelength_y),
            "combination": combination,
        },
        achieved,
    )
