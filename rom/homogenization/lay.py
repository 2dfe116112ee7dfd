"""Closed forms for grooves at an angle to the flow: their tensor A, and their flow factors in a closed box."""

from math import acos, cos, exp, log, log1p, pi, sin, sqrt

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

SERIES_LOGIT = 12.0
"""ln(m/(1 − m)) above which two terms of the series about m = 1 are accurate to round-off."""

MAX_LOGIT = 700.0
"""Largest ln(m/(1 − m)) whose exponential does not overflow."""

MIN_DETERMINANT = 1e-12
"""Smallest det A over A₁₁A₂₂ that round-off does not dominate."""


def turned(principal: ArrayLike, angle: float) -> Array:
    """R diag(along, across) Rᵀ: ``principal`` (across, along) of grooves whose lay lies at an angle, rad, from x to y.

    With <h⁻³>⁻¹ and <h³> it is A; with <h⁻²>/<h⁻³> and <h> its first column is B.
    """
    across, along = np.asarray(principal, dtype=np.float64)
    lay, normal = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
    return np.asarray(along * np.outer(lay, lay) + across * np.outer(normal, normal))


def box_factors(tensor: ArrayLike, size: tuple[float, float]) -> Array:
    """Patir and Cheng's (φ₁, φ₂) of a box whose roughness of tensor A is much finer than the box.

    The box has given pressures at x = 0 and Lx, no flow through y = 0 and Ly, and q = −A∇p inside. An affine map that
    turns A into √(det A) I makes it a parallelogram with cos θ = −A₁₂/√(A₁₁A₂₂) and sides of ratio Lx/Ly √(A₂₂/A₁₁).
    F(1−m)/F(m) with F(m) = ₂F₁(θ/π, 1−θ/π; 1; m) maps the parallelogram to a rectangle:
    φ₁ = √(det A) Lx/Ly K(m)/K(1−m). The two boxes are dual, so φ₁φ₂ = det A, where A₁₁A₂₂ = det A + A₁₂². A short wide
    box has φ₁ = A₁₁ (no pressure gradient across), a long narrow one det A/A₂₂ (no flow across), and a square one with
    A₁₁ = A₂₂ has √(det A).

    Parameters
    ----------
    tensor : A, shape (2, 2), symmetric and positive definite.
    size : (Lx, Ly), in any unit.

    Raises
    ------
    InputError
        If the tensor is not symmetric and positive definite, or a length is not above 0.

    Source of the map: Heikkala, Vamanamurthy and Vuorinen, Generalized elliptic integrals, arXiv:math/0701436.
    """
    a = np.asarray(tensor, dtype=np.float64)
    if a.shape != (2, 2) or not abs(a[0, 1] - a[1, 0]) <= 1e-6 * sqrt(abs(a[0, 0] * a[1, 1])):
        raise InputError(f"tensor: got {a.tolist()}; give a symmetric one of shape (2, 2)")
    determinant = a[0, 0] * a[1, 1] - a[0, 1] ** 2
    if not (a[0, 0] > 0 and determinant > MIN_DETERMINANT * a[0, 0] * a[1, 1]):
        raise InputError(f"tensor: got {a.tolist()}; give a positive definite one")
    if not min(size) > 0:
        raise InputError(f"size: got {size!r}; give two lengths above 0")
    part = acos(-a[0, 1] / sqrt(a[0, 0] * a[1, 1])) / pi
    aspect = size[0] / size[1]
    wanted = log(aspect) + log(a[1, 1] / a[0, 0]) / 2

    def excess(modulus: float) -> float:
        return log(_integral(part, -modulus)) - log(_integral(part, modulus)) - wanted

    bracket = 1.0
    while excess(-bracket) * excess(bracket) > 0:
        bracket *= 2
    modulus = scipy.optimize.brentq(excess, -bracket, bracket, xtol=1e-13, rtol=1e-13)
    first = sqrt(determinant) * aspect * _integral(0.5, modulus) / _integral(0.5, -modulus)
    return np.array([first, determinant / first])


def _integral(part: float, modulus: float) -> float:
    """₂F₁(part, 1 − part; 1; m) with m = 1/(1 + exp(−modulus)); 2K(m)/π for part = 1/2."""
    if modulus < SERIES_LOGIT:
        return float(scipy.special.hyp2f1(part, 1 - part, 1.0, 1 / (1 + exp(-max(modulus, -MAX_LOGIT)))))
    rest = 1 / (1 + exp(min(modulus, MAX_LOGIT)))
    logarithm = modulus + log1p(exp(-modulus))
    terms = [
        logarithm + 2 * scipy.special.digamma(n) - scipy.special.digamma(part + n - 1) - scipy.special.digamma(n - part)
        for n in (1, 2)
    ]
    return float(sin(pi * part) / pi * (terms[0] + part * (1 - part) * rest * terms[1]))
