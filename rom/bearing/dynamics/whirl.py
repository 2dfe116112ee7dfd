"""The stability of a rigid rotor in bearings with given stiffness and damping."""

import math
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array

Matrices = tuple[Array, Array]
"""Stiffness and damping of a shaft, each of shape (2, 2), N/m and N s/m."""

RATIOS = np.geomspace(0.01, 10.0, 120)
"""Whirl ratios between which whirl is sought if stiffness and damping depend on the frequency."""

FASTEST = 100.0
"""Size of the roots of the motion over the rotational speed up to which they are considered."""

GROWTH = 1e-9
"""Rate of growth over the rotational speed up to which a motion is taken not to grow."""


@dataclass(frozen=True, kw_only=True)
class Whirl:
    """The whirl at which a rigid rotor becomes unstable.

    Attributes
    ----------
    inverse_mass : 1/M of the largest mass M in the bearing at which the rotor is stable, 1/kg; 0 or below if it is
        stable at any mass, infinite if it is stable at none.
    frequency_squared : square of the frequency of the whirl, rad²/s²; 0 or below without whirl.
    """

    inverse_mass: float
    frequency_squared: float


def rigid_whirl(stiffness: Array, damping: Array) -> Whirl:
    """The whirl of a mass M in a bearing, from M z'' + B z' + K z = 0.

    With z = Z exp(iνt) at the limit of stability, the determinant of K - Mν² + iνB is zero. Its imaginary and its real
    part give

        Mν² = k = (Kxx Byy + Kyy Bxx - Kxy Byx - Kyx Bxy)/(Bxx + Byy),
        ν² = ((Kxx - k)(Kyy - k) - Kxy Kyx)/(Bxx Byy - Bxy Byx),    M = k/ν².

    By the criterion of Routh and Hurwitz, the rotor is stable exactly below this M, at any M if ν² is not positive, and
    at none if k, det K, det B or the trace of B is not positive.

    Parameters
    ----------
    stiffness, damping : K, N/m, and B, N s/m, of the bearing that carries the mass, of shape (2, 2).

    Source: Lund 1987, doi:10.1115/1.3261324.
    """
    if not _damped(stiffness, damping):
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)
    k = _whirl_stiffness(stiffness, damping)
    squared = _frequency_squared(stiffness, damping)
    return Whirl(inverse_mass=squared / k, frequency_squared=squared)


def whirl_of(stiffness: Array, damping: Array, kept: NDArray[np.bool_], speed: float) -> Whirl:
    """The whirl of a rigid rotor in a bearing whose pads, without inertia, follow the shaft.

    The conditions of :func:`rigid_whirl` hold with K and B of the shaft at the frequency ν, see :func:`condensed`. Of
    several whirls that with the smallest mass counts; whirl ratios ν/ω from 0.01 to 10 are searched. The rotor is
    stable at no mass if a root s of det(K + sB + s²M) = 0 of all coordinates has a positive real part for a mass that
    is smaller than that of any of these whirls. Damping of slow motions may be negative without such a root.

    Parameters
    ----------
    stiffness, damping : K and B of all coordinates.
    kept : whether each coordinate is one of the two of the shaft.
    speed : rotational speed ω of the rotor, rad/s, above 0.
    """
    at = partial(condensed, stiffness, damping, kept)
    fast, slow = at(float(RATIOS[-1]) * speed), at(float(RATIOS[0]) * speed)
    mass = abs(_whirl_stiffness(*fast)) / (RATIOS[-1] * speed) ** 2
    if _grows(stiffness, damping, kept, mass, speed):
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)

    def excess(ratio: float) -> float:
        k, b = at(ratio * speed)
        return _detuned(k, b) - float(np.linalg.det(b)) * (ratio * speed) ** 2

    values = [excess(float(ratio)) for ratio in RATIOS]
    found = []
    for (low, below), (high, above) in pairwise(zip(map(float, RATIOS), values, strict=True)):
        if below * above < 0:
            frequency = float(brentq(excess, low, high, xtol=1e-14)) * speed
            k = _whirl_stiffness(*at(frequency))
            if k > 0:
                found.append(Whirl(inverse_mass=frequency**2 / k, frequency_squared=frequency**2))
    if found:
        return max(found, key=lambda whirl: whirl.inverse_mass)
    squared = min(_frequency_squared(*slow), 0.0)
    return Whirl(inverse_mass=squared / abs(_whirl_stiffness(*slow)), frequency_squared=squared)


def _grows(stiffness: Array, damping: Array, kept: NDArray[np.bool_], mass: float, speed: float) -> bool:
    """Whether a root s of det(K + sB + s²M) = 0 with a mass on the kept coordinates has a positive real part.

    Roots beyond ``FASTEST`` times the speed, as those of pads without pressure or damping, are left out.
    """
    held = np.eye(len(kept))[:, kept]
    none, one = np.zeros(held.shape), np.eye(held.shape[1])
    left = np.block([[stiffness, none], [none.T, one]])
    right = np.block([[-damping, -mass * held], [held.T, np.zeros(one.shape)]])
    top, bottom = eig(left, right, right=False, homogeneous_eigvals=True)
    finite = np.abs(top) < FASTEST * speed * np.abs(bottom)
    return bool(((top[finite] / bottom[finite]).real > GROWTH * speed).any())


def _damped(stiffness: Array, damping: Array) -> bool:
    """Whether a small mass in the bearing is stable."""
    return bool(
        np.linalg.det(damping) > 0
        and np.trace(damping) > 0
        and np.linalg.det(stiffness) > 0
        and _whirl_stiffness(stiffness, damping) > 0
    )


def _whirl_stiffness(stiffness: Array, damping: Array) -> float:
    """The stiffness k = Mν² at the limit of stability, N/m."""
    (kxx, kxy), (kyx, kyy) = stiffness
    (bxx, bxy), (byx, byy) = damping
    return float((kxx * byy + kyy * bxx - kxy * byx - kyx * bxy) / (bxx + byy))


def _detuned(stiffness: Array, damping: Array) -> float:
    """(Kxx - k)(Kyy - k) - Kxy Kyx, which is ν² det B at the limit of stability, N²/m²."""
    k = _whirl_stiffness(stiffness, damping)
    (kxx, kxy), (kyx, kyy) = stiffness
    return float((kxx - k) * (kyy - k) - kxy * kyx)


def _frequency_squared(stiffness: Array, damping: Array) -> float:
    """The square ν² of the frequency at the limit of stability, rad²/s²."""
    return _detuned(stiffness, damping) / float(np.linalg.det(damping))


def condensed(stiffness: Array, damping: Array, kept: NDArray[np.bool_], frequency: float) -> Matrices:
    """The stiffness and damping of some coordinates while the others, without inertia, follow their motion.

    With Z = K + iωB of all coordinates, the forces on the kept ones j, while those on the others p are zero, are

        Z_jj - Z_jp Z_pp⁻¹ Z_pj = K' + iωB'.

    At ω = 0 it is the limit of slow motions.

    Parameters
    ----------
    stiffness, damping : K and B of all coordinates.
    kept : whether each coordinate is kept.
    frequency : ω of the motion, rad/s.

    Source: Lund 1964, ASLE Transactions 7, 342-352, for the pads of a bearing.
    """
    j, p = np.ix_(kept, kept), np.ix_(~kept, ~kept)
    jp, pj = np.ix_(kept, ~kept), np.ix_(~kept, kept)
    if kept.all():
        return stiffness, damping
    if frequency == 0:
        after = np.linalg.solve(stiffness[p], stiffness[pj])
        before = np.linalg.solve(stiffness[p].T, stiffness[jp].T).T
        slow = damping[j] - damping[jp] @ after - before @ damping[pj] + before @ damping[p] @ after
        return stiffness[j] - stiffness[jp] @ after, slow
    z = stiffness + 1j * frequency * damping
    reduced = z[j] - z[jp] @ np.linalg.solve(z[p], z[pj])
    return np.asarray(reduced.real), np.asarray(reduced.imag / frequency)
