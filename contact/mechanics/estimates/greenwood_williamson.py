"""Asperities that do not feel each other: Greenwood and Williamson's contact, from spectral moments."""

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import positive
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.moments import SpectralMoments

FARTHEST, NEAREST = 36.0, -30.0
"""Separations, in standard deviations of the summits, between which the load is looked for."""

LARGEST_AREA = 0.03
"""Up to which asperities may be taken as apart."""


def greenwood_williamson(moments: SpectralMoments, *, composite_modulus: float, load: float) -> Estimate:
    """Elastic contact of spherical asperities of one radius whose heights are Gaussian, each as if it were alone.

    With t the separation of the plane from the mean summit over their spread σs, and
    F_n(t) = ∫_t^∞ (s − t)^n exp(−s²/2) ds/sqrt(2π):
    P = (4/3) E* η R^(1/2) σs^(3/2) F_3/2(t), A/A0 = π η R σs F_1(t).
    Density η, radius R, mean height and spread of the summits follow from m0, m2, m4 (`SpectralMoments`), as in McCool.

    Parameters
    ----------
    moments : of an isotropic Gaussian surface.
    composite_modulus : E*, Pa.
    load : P, mean pressure, Pa; above 0.

    Returns
    -------
    Area, mean gap (the separation from the mean plane of the surface, which is taken to stay), density of pressures.

    Raises
    ------
    InputError
        If the moments are of a profile, Nayak's parameter is so low that summits have no spread, or the load is so high
        or low that the separation lies beyond -30 or 36 spreads.

    Notes
    -----
    Trusted for A/A0 up to 0.03, a separation above 0 and α >= 3/2, below which no isotropic Gaussian surface lies.
    Beside contacts solved on Gaussian self-affine surfaces (256 x 256 points, α = 3.5 to 8) the area is 0.9 to 1.1 of
    theirs and the gap within 4 % at 0.2 % of contact, 0.8 to 0.94 and 4 % too small at 2 %, 0.7 to 0.85 and 10 to 17 %
    too small at 7 %; beyond 20 % the plane sinks below the mean height. Counting ellipsoidal summits of all
    curvatures gives A/A0 = sqrt(2π) P/(E* g') in the limit of far separation (Bush, Gibson and Thomas;
    `roughfilm.contact.mechanics.exact.light_load`). For ridges it has no meaning: a cylinder has no approach.

    Source: Greenwood and Williamson, Proc. R. Soc. A 295 (1966) 300, doi:10.1098/rspa.1966.0242; McCool, Wear 107
    (1986) 37, doi:10.1016/0043-1648(86)90045-1.
    """
    modulus = positive("greenwood_williamson.composite_modulus", composite_modulus)
    positive("greenwood_williamson.load", load)
    if moments.line:
        raise InputError(
            "greenwood_williamson: got a profile; asperities need a surface, take another model for ridges"
        )
    spread, radius, density = moments.summit_spread, moments.summit_radius, moments.summit_density
    if not spread > 0:
        raise InputError(f"greenwood_williamson: got Nayak's parameter {moments.nayak:.4g}; summits have no spread")
    wanted = math.log(load) - math.log(4 / 3 * modulus * density * math.sqrt(radius) * spread**1.5)

    def excess(t: float) -> float:
        return math.log(exceedance(t, 1.5)) - wanted

    if not excess(FARTHEST) < 0 < excess(NEAREST):
        raise InputError(
            f"greenwood_williamson.load: got {load:.6g} Pa, at which no separation is sensible; look at the units"
        )
    t = float(scipy.optimize.brentq(excess, NEAREST, FARTHEST, xtol=1e-12, rtol=1e-13))
    area = math.pi * density * radius * spread * exceedance(t, 1.0)
    separation = moments.summit_mean + t * spread

    def pressure_density(pressure: ArrayLike) -> Array:
        """Of Hertzian contacts, 2p/p0² each, over all whose largest pressure p0 = (2E*/π) sqrt(w/R) is above p."""
        p = np.maximum(np.asarray(pressure, dtype=np.float64), 0.0)
        depth = radius * (math.pi * p / (2 * modulus)) ** 2
        taller = scipy.special.ndtr(-(t + depth / spread))
        return np.asarray(math.pi**3 * density * radius**2 / (2 * modulus**2) * p * taller)

    return Estimate(
        load=load,
        area_fraction=area,
        plastic_fraction=0.0,
        mean_gap=separation,
        pressure_density=pressure_density,
        trusted=area <= LARGEST_AREA and separation > 0 and moments.nayak >= 1.5,
        range_of_validity=f"isotropic Gaussian surfaces at contact areas up to {LARGEST_AREA:g} of the nominal",
        cannot_say="how asperities lower each other or merge, plastic deformation, ridges, and skewed heights",
    )


def exceedance(t: float, power: float) -> float:
    """F_n(t) = ∫_t^∞ (s − t)^n exp(−s²/2) ds/sqrt(2π) = Γ(n + 1) exp(−t²/4) D_(−n−1)(t)/sqrt(2π).

    D is Whittaker's parabolic cylinder function. For t from -30 to 36, where it neither overflows nor vanishes.
    """
    return float(
        scipy.special.gamma(power + 1)
        / math.sqrt(2 * math.pi)
        * math.exp(-t * t / 4)
        * scipy.special.pbdv(-power - 1, t)[0]
    )
