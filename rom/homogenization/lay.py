"""Grooves turned against the flow, in closed form: their tensor, and what a box without side flow makes of a tensor."""

from math import acos, cos, exp, log, log1p, pi, sin, sqrt

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.pocket.gap import Array

NEAR_ONE, LARGEST = 12.0, 700.0
"""Of ln(m/(1 − m)): above the one two terms of the series about m = 1 are enough, beyond the other exp overflows."""

SINGULAR = 1e-12
"""Of A₁₁A₂₂: below it rounding rules the determinant."""


def turned(principal: ArrayLike, angle: float) -> Array:
    """R diag(along, across) Rᵀ: ``principal`` (across, along) of grooves whose lay lies at an angle, rad, from x to y.

    With <h⁻³>⁻¹ and <h³> it is A; with <h⁻²>/<h⁻³> and <h> its first column is B.
    """
    across, along = np.asarray(principal, dtype=np.float64)
    lay, normal = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
    return np.asarray(along * np.outer(lay, lay) + across * np.outer(normal, normal))


def box_factors(tensor: ArrayLike, size: tuple[float, float]) -> Array:
    """What Patir and Cheng's boxes make of A: (φ₁, φ₂) of a box whose roughness is far smaller than the box itself.

    A box between pressures at x = 0 and Lx, without flow through y = 0 and Ly, and with q = −A∇p inside. Stretched so
    that A becomes √(det A) I it is a parallelogram, with cos θ = −A₁₂/√(A₁₁A₂₂) and sides of the ratio
    Lx/Ly √(A₂₂/A₁₁), that F(1−m)/F(m) with F(m) = ₂F₁(θ/π, 1−θ/π; 1; m) maps on a rectangle:
    φ₁ = √(det A) Lx/Ly K(m)/K(1−m). Flow and pressure change places between the two boxes, so that φ₁φ₂ = det A always,
    where A₁₁A₂₂ = det A + A₁₂². A short wide box has φ₁ = A₁₁ (no pressure across), a long narrow one det A/A₂₂ (no
    flow across), a square one with A₁₁ = A₂₂ has √(det A).

    Parameters
    ----------
    tensor : A, shape (2, 2), symmetric and positive definite.
    size : (Lx, Ly), in any unit.

    Raises
    ------
    InputError
        For a tensor that is not symmetric and positive definite, or a size that is not above 0.

    Source of the map: Heikkala, Vamanamurthy and Vuorinen, Generalized elliptic integrals, arXiv:math/0701436.
    """
    a = np.asarray(tensor, dtype=np.float64)
    if a.shape != (2, 2) or not abs(a[0, 1] - a[1, 0]) <= 1e-6 * sqrt(abs(a[0, 0] * a[1, 1])):
        raise InputError(f"tensor: got {a.tolist()}; give a symmetric one of shape (2, 2)")
    determinant = a[0, 0] * a[1, 1] - a[0, 1] ** 2
    if not (a[0, 0] > 0 and determinant > SINGULAR * a[0, 0] * a[1, 1]):
        raise InputError(f"tensor: got {a.tolist()}; give a positive definite one")
    if not min(size) > 0:
        raise InputError(f"size: got {size!r}; give two lengths above 0")
    part = acos(-a[0, 1] / sqrt(a[0, 0] * a[1, 1])) / pi
    aspect = size[0] / size[1]
    wanted = log(aspect) + log(a[1, 1] / a[0, 0]) / 2

    def excess(modulus: float) -> float:
        return log(_integral(part, -modulus)) - log(_integral(part, modulus)) - wanted

    reach = 1.0
    while excess(-reach) * excess(reach) > 0:
        reach *= 2
    modulus = scipy.optimize.brentq(excess, -reach, reach, xtol=1e-13, rtol=1e-13)
    first = sqrt(determinant) * aspect * _integral(0.5, modulus) / _integral(0.5, -modulus)
    return np.array([first, determinant / first])


def _integral(part: float, modulus: float) -> float:
    """₂F₁(part, 1 − part; 1; m) with m = 1/(1 + exp(−modulus)); of the part 1/2 it is 2K(m)/π."""
    if modulus < NEAR_ONE:
        return float(scipy.special.hyp2f1(part, 1 - part, 1.0, 1 / (1 + exp(-max(modulus, -LARGEST)))))
    rest = 1 / (1 + exp(min(modulus, LARGEST)))
    logarithm = modulus + log1p(exp(-modulus))
    terms = [
        logarithm + 2 * scipy.special.digamma(n) - scipy.special.digamma(part + n - 1) - scipy.special.digamma(n - part)
        for n in (1, 2)
    ]
    return float(sin(pi * part) / pi * (terms[0] + part * (1 - part) * rest * terms[1]))
