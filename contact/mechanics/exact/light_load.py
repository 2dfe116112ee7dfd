"""The contact area of an elastic rough surface at light load, where it is proportional to the load."""

import math

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.checks import finite, positive

BUSH_GIBSON_THOMAS = math.sqrt(2 * math.pi)
"""κ of non-interacting asperities in the limit of large separation (Bush, Gibson and Thomas)."""

PERSSON = math.sqrt(8 / math.pi)
"""κ of Persson's theory."""


def light_load_area_fraction(load: ArrayLike, *, composite_modulus: float, rms_slope: float, kappa: float) -> Array:
    """Area fraction A/A0 = κ P/(E* g') at light load.

    Parameters
    ----------
    load : P, mean pressure, Pa, any shape.
    composite_modulus : E*, Pa.
    rms_slope : g' = sqrt(<|∇z|²>).
    kappa : κ, from `PERSSON` (1.596) to `BUSH_GIBSON_THOMAS` (2.507); numerical solutions give 2.0 to 2.2.

    Returns
    -------
    Array : A/A0, same shape as ``load``.

    Raises
    ------
    InputError
        If a number is not finite, or an argument other than the load is not above 0.

    Notes
    -----
    The relation holds for isotropic Gaussian surfaces and A/A0 up to a few per cent. For ridges (line contact) the κ of
    Persson is an estimate, with g' across them; that of Bush, Gibson and Thomas counts summits and does not apply.

    Source: Bush, Gibson and Thomas, Wear 35 (1975) 87, doi:10.1016/0043-1648(75)90145-3; Persson, J. Chem. Phys. 115
    (2001) 3840, doi:10.1063/1.1388626; Hyun, Pei, Molinari and Robbins, Phys. Rev. E 70 (2004) 026117,
    doi:10.1103/PhysRevE.70.026117.

    Examples
    --------
    >>> light = {"composite_modulus": 1e11, "rms_slope": 0.1}
    >>> float(light_load_area_fraction(1e8, kappa=2.0, **light))
    0.02
    """
    stiffness = positive("light_load.composite_modulus", composite_modulus) * positive(
        "light_load.rms_slope", rms_slope
    )
    return np.asarray(positive("light_load.kappa", kappa) * finite("light_load.load", load) / stiffness)
