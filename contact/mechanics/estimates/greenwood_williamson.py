"""Contact of non-interacting asperities (Greenwood and Williamson) from spectral moments."""

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import positive
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.moments import SpectralMoments

MAX_SEPARATION, MIN_SEPARATION = 6.0, -30.0
"""Range of the separation, in standard deviations of the summit heights; one summit of a billion is higher than 6."""

MAX_ARGUMENT = 36.0
"""Largest t at which F_n(t) does not underflow."""

LEAST_SUMMITS = 1.0
"""Smallest mean number of touching summits of a surface for which there is an estimate."""

MAX_PLASTIC_SHARE = 0.1
"""Largest part of the contact area of a trusted estimate whose elastic pressure exceeds the hardness."""

AREA_FRACTIONS = (1e-3, 0.02)
"""Range of the area fraction of a trusted estimate."""

NAYAK_PARAMETERS = (1.6, 8.0)
"""Range of Nayak's parameter of a trusted estimate."""

LARGEST_AREA_FRACTION = 0.1
"""Area fraction up to which there is an estimate."""

LEAST_NAYAK, LARGEST_NAYAK = 1.5 * (1 - 1e-6), 100.0
"""Range of Nayak's parameter in which there is an estimate; no surface is below 3/2."""


def greenwood_williamson(
    moments: SpectralMoments,
    *,
    composite_modulus: float,
    load: float,
    hardness: float = math.inf,
    nominal_area: float = math.inf,
) -> Estimate:
    """Estimate of the elastic contact of independent spherical asperities of one radius with Gaussian heights.

    With t the distance of the plane from the mean summit in units of the standard deviation σs of summit heights, and
    F_n(t) = ∫_t^∞ (s − t)^n exp(−s²/2) ds/sqrt(2π):
    P = (4/3) E* η R^(1/2) σs^(3/2) F_3/2(t), A/A0 = π η R σs F_1(t).
    The density η, radius R, mean height and σs of the summits follow from m0, m2, m4 (`SpectralMoments`), as in McCool.

    Parameters
    ----------
    moments : spectral moments of an isotropic Gaussian surface.
    composite_modulus : E*, Pa.
    load : P, mean pressure, Pa; above 0.
    hardness : H, Pa; the estimate is elastic and trusted only if at most 0.1 of its contact area has p > H.
    nominal_area : A0, m²; the mean number of touching summits η A0 F_0(t) must be 1 or more, since a surface on which
        fewer touch is in contact at its highest summit, whose height the statistics do not give.

    Returns
    -------
    Estimate : area, pressure density and mean gap; the gap is measured from the mean plane, which is taken as fixed.

    Raises
    ------
    InputError
        If the moments are those of a profile, Nayak's parameter α lies outside 3/2 to 100, or the load outside the
        range from one touching summit, or a separation of 6 σs, to an area fraction of 0.1, and to a plane at the mean
        height, or the nominal area has so few summits that this range is empty.

    Notes
    -----
    The estimate is trusted for A/A0 of 0.001 to 0.02 and α of 1.6 to 8. In a contact of the depth w, whose largest
    pressure is p0 = (2E*/π) sqrt(w/R), the pressure exceeds H on the area π R (w − w_H), w_H = R (πH/(2E*))², so that
    this part of all contact is F_1(t + w_H/σs)/F_1(t). Ratios to numerical solutions for 200 isotropic
    Gaussian surfaces (128 x 128 to 1024 x 1024 points, Hurst exponents of 0.3 to 1; median and 90 % of the surfaces):

    ==========  ===================  ===================  ===================
    A/A0        area, α = 1.6 ... 4  area, α = 4 ... 8    gap, α = 1.6 ... 8
    ==========  ===================  ===================  ===================
    0.001-0.01  1.05 (0.8 ... 1.4)   0.9 (0.6 ... 1.1)    1.0 (0.93 ... 1.1)
    0.01-0.02   1.05 (0.9 ... 1.2)   0.9 (0.75 ... 1.0)   0.97 (0.9 ... 1.03)
    0.03-0.1    0.85 (0.75 ... 1.0)  0.8 (0.7 ... 0.9)    0.75 (0.6 ... 0.95)
    0.1-0.3     0.7                  0.7                  below 0
    ==========  ===================  ===================  ===================

    At α = 8 to 16 the area is 0.8, at 16 to 32 0.67 and at 32 to 60 0.6 of theirs, the gap 1.0, 1.1 and 1.3. Few
    summits touch at the lightest loads, so that surfaces differ. With a lay (1 : 2 to 1 : 4) the area is 0.6 to 1.1.
    Ellipsoidal summits of all curvatures give A/A0 = sqrt(2π) P/(E* g') in the limit of large separation (Bush, Gibson
    and Thomas; `roughfilm.contact.mechanics.exact.light_load`). Ridges are excluded, since a cylinder has no approach.

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
    if not LEAST_NAYAK <= moments.nayak <= LARGEST_NAYAK:
        raise InputError(
            f"greenwood_williamson: got Nayak's parameter {moments.nayak:.4g}; it must be 1.5 to {LARGEST_NAYAK:g}, "
            "take persson or elastic"
        )
    carried = 4 / 3 * modulus * density * math.sqrt(radius) * spread**1.5
    touching = math.pi * density * radius * spread
    nearest = -moments.summit_mean / spread
    if touching * exceedance(nearest, 1.0) > LARGEST_AREA_FRACTION:
        nearest = _separation(1.0, LARGEST_AREA_FRACTION / touching)
    for name, size in (("hardness", hardness), ("nominal_area", nominal_area)):
        if not size > 0:
            raise InputError(f"greenwood_williamson.{name}: got {size!r}; give a number above 0")
    summits = density * nominal_area
    farthest = -float(scipy.special.ndtri(LEAST_SUMMITS / summits)) if summits > LEAST_SUMMITS else -math.inf
    if farthest < nearest:
        raise InputError(
            f"greenwood_williamson.nominal_area: got {nominal_area:.4g} m² with {summits:.2g} summits, too few for "
            "their statistics; give a larger surface, or take persson or elastic"
        )
    least, most = (carried * exceedance(t, 1.5) for t in (min(farthest, MAX_SEPARATION), nearest))
    if not least <= load <= most:
        raise InputError(
            f"greenwood_williamson.load: got {load:.6g} Pa; it must be {least:.4g} to {most:.4g} Pa, where one summit "
            f"or more touches, on at most {LARGEST_AREA_FRACTION:g} of the area, and the plane lies above the mean "
            "height, take persson or elastic"
        )
    t = _separation(1.5, load / carried)
    area = touching * exceedance(t, 1.0)
    separation = moments.summit_mean + t * spread
    yielding = radius * (math.pi * hardness / (2 * modulus)) ** 2 / spread
    plastic_share = exceedance(min(t + yielding, MAX_ARGUMENT), 1.0) / exceedance(t, 1.0)

    def pressure_density(pressure: ArrayLike) -> Array:
        """Sum of 2p/p0² over the Hertzian contacts whose largest pressure p0 = (2E*/π) sqrt(w/R) exceeds p, 1/Pa."""
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
        trusted=plastic_share <= MAX_PLASTIC_SHARE
        and AREA_FRACTIONS[0] <= area <= AREA_FRACTIONS[1]
        and NAYAK_PARAMETERS[0] <= moments.nayak <= NAYAK_PARAMETERS[1],
        range_of_validity="isotropic Gaussian surfaces with Nayak's parameter of {:g} to {:g} ".format(
            *NAYAK_PARAMETERS
        )
        + "at contact areas of {:g} to {:g} of the nominal, ".format(*AREA_FRACTIONS)
        + f"of which at most {MAX_PLASTIC_SHARE:g} would exceed the hardness",
        cannot_say="how asperities lower each other or merge, plastic deformation, ridges, and skewed heights",
    )


def _separation(power: float, wanted: float) -> float:
    """The separation t at which F_n(t) has a value."""
    return float(
        scipy.optimize.brentq(
            lambda t: math.log(exceedance(t, power)) - math.log(wanted),
            MIN_SEPARATION,
            MAX_SEPARATION,
            xtol=1e-12,
            rtol=1e-13,
        )
    )


def exceedance(t: float, power: float) -> float:
    """The function F_n(t) = ∫_t^∞ (s − t)^n exp(−s²/2) ds/sqrt(2π) = Γ(n + 1) exp(−t²/4) D_(−n−1)(t)/sqrt(2π).

    D is Whittaker's parabolic cylinder function; t is -30 to ``MAX_ARGUMENT``, where F is
    neither 0 nor infinite by rounding.
    """
    return float(
        scipy.special.gamma(power + 1)
        / math.sqrt(2 * math.pi)
        * math.exp(-t * t / 4)
        * scipy.special.pbdv(-power - 1, t)[0]
    )
