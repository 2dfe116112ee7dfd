"""Sinusoids along one or two directions, whose contact and flow are known in closed form."""

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
    """A sinusoidal surface with a crest at x = y = 0.

    One wavelength gives h = A cos(2π x/λx), or the same along y; both give h = A cos(2π x/λx) cos(2π y/λy) ("product")
    or h = A (cos(2π x/λx) + cos(2π y/λy))/2 ("sum"). Heights range from -A to A in all cases.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    amplitude : A, m.
    wavelength_x, wavelength_y : m, one or both, at least two pixels; each divides the period to 0.1 % and is rounded to
        fit exactly.
    combination : "product" or "sum" of the two directions.

    Returns
    -------
    Surface : periodic, of mean 0; ``source["achieved"]`` holds the rounded wavelengths.

    Raises
    ------
    InputError
        If an argument is out of range or a wavelength does not fit; the message gives wavelengths that fit.

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
