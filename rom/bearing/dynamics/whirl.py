"""The stability of a rigid rotor in bearings with given stiffness and damping."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.linalg import eig
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array

Matrices = tuple[Array, Array]
"""Stiffness and damping of a shaft, each of shape (2, 2), N/m and N s/m."""

RATIOS = np.geomspace(0.01, 10.0, 120)
"""Whirl ratios between which whirl is sought if stiffness and damping depend on the frequency."""

RATIOS_OF_MEMORY = np.concatenate([[0.01, 0.02, 0.05], np.linspace(0.1, 2.0, 20), [2.5, 3.0, 4.0, 5.0, 7.0, 10.0]])
"""The same of a film with memory, each of which is a solution: what its cavities carry along the film within a turn
comes and goes with a period of about 1."""

BEYOND = np.geomspace(1.0, 1e6, 61)[1:]
"""Frequencies over the largest of these at which K and B are taken to be those at it."""

BETWEEN, ASIDE = 50, 5
"""Number of parts of the interval between two ratios in which K and B are interpolated, and how many of them away
from a limit of stability that is found so they are computed, too."""

WHIRL_TOLERANCE = 1e-9
"""Error of a whirl ratio at which its search stops."""

SAME = 0.05
"""Relative change of stiffness or damping up to which those of slow motions are taken to hold."""

FASTEST = 100.0
"""Size of the roots of the motion over the rotational speed up to which they are considered."""

ROUND_OFF = 1e-8
"""Stiffness at the limit of stability over the largest of K up to which it is that of a full film, 0: K is known to
the tolerance of the equilibrium."""

GROWTH = 1e-9
"""Rate of growth over the rotational speed up to which a motion is taken not to grow."""

At = Callable[[float], Matrices]
"""at(ν), stiffness and damping of a shaft for a motion of the frequency ν, rad/s; those of slow motions at 0."""


@dataclass(frozen=True, kw_only=True)
class Whirl:
    """The whirl at which a rigid rotor becomes unstable.

    Attributes
    ----------
    inverse_mass : 1/M of the largest mass M in the bearing at which the rotor is stable, 1/kg; 0 or below if it is
        stable at any mass, infinite if it is stable at none.
    frequency_squared : square of the frequency of the whirl, rad²/s²; 0 or below without whirl, NaN if it is unknown.
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
    at none if k, det K, det B or the trace of B is not positive. In a film without a cavity K has no symmetric part and
    k is 0: a mass of 0 whirls at ν, without growth or decay.

    Parameters
    ----------
    stiffness, damping : K, N/m, and B, N s/m, of the bearing that carries the mass, of shape (2, 2).

    Source: Lund 1987, doi:10.1115/1.3261324.
    """
    if not _damped(stiffness, damping):
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)
    k, smallest = _whirl_stiffness(stiffness, damping), ROUND_OFF * float(np.abs(stiffness).max())
    if k < -smallest:
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)
    squared = _frequency_squared(stiffness, damping)
    return Whirl(inverse_mass=squared / k if k > smallest else math.inf, frequency_squared=squared)


def whirl_of(at: At, speed: float, ratios: Array = RATIOS) -> Whirl:
    """The whirl of a rigid rotor in a bearing whose stiffness and damping depend on the frequency.

    The conditions of :func:`rigid_whirl` hold with K and B of the shaft at the frequency ν. Of several whirls that with
    the smallest mass counts. A small mass has as many growing motions as det(K + sB) has zeros with a positive real
    part, which by the argument principle are 1 - Δ/π with the growth Δ of the argument of det(K + iνB) over all ν; the
    rotor is then stable at no mass.

    Parameters
    ----------
    at : K and B of the shaft.
    speed : rotational speed ω of the rotor, rad/s, above 0.
    ratios : whirl ratios ν/ω between which whirl is sought.

    Source: Lund 1987, doi:10.1115/1.3261324.
    """
    found = [at(float(ratio) * speed) for ratio in ratios]
    ratios = np.union1d(ratios, _around_roots(ratios, found, speed))
    found = [at(float(ratio) * speed) for ratio in ratios]
    (stiffness, damping), (fine, *between) = found[-1], _between(ratios, found)
    fast = [stiffness + 1j * beyond * ratios[-1] * speed * damping for beyond in BEYOND]
    slow = between[0] + 1j * speed * fine[:, None, None] * between[1]
    arguments = np.unwrap(np.angle(np.linalg.det([found[0][0], *slow, *fast])))
    if round(1 - float(arguments[-1] - arguments[0]) / math.pi) != 0:
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)

    def excess(ratio: float) -> float:
        stiffness, damping = at(ratio * speed)
        return float(_excess(stiffness, damping, ratio * speed))

    whirls = []
    for (low, below), (high, above) in pairwise((ratio, excess(ratio)) for ratio in map(float, ratios)):
        if below * above < 0:
            frequency = float(brentq(excess, low, high, xtol=WHIRL_TOLERANCE)) * speed
            k = _whirl_stiffness(*at(frequency))
            if k > 0:
                whirls.append(Whirl(inverse_mass=frequency**2 / k, frequency_squared=frequency**2))
    if whirls:
        return max(whirls, key=lambda whirl: whirl.inverse_mass)
    squared = min(_frequency_squared(*found[0]), 0.0)
    return Whirl(inverse_mass=squared / abs(_whirl_stiffness(*found[0])), frequency_squared=squared)


def _excess(stiffness: Array, damping: Array, frequency: float | Array) -> Array:
    """(tr B)² ((Kxx - k)(Kyy - k) - Kxy Kyx - ν² det B), 0 at the limit of stability, of matrices of shape (..., 2, 2).

    With the factor it has no pole where the trace of B, by which k is divided, changes its sign.
    """
    trace, square = np.trace(damping, axis1=-2, axis2=-1), np.asarray(frequency) ** 2
    kxx, kxy, kyx, kyy = (stiffness[..., i, j] for i in (0, 1) for j in (0, 1))
    bxx, bxy, byx, byy = (damping[..., i, j] for i in (0, 1) for j in (0, 1))
    above = kxx * byy + kyy * bxx - kxy * byx - kyx * bxy
    detuned = (kxx * trace - above) * (kyy * trace - above) - kxy * kyx * trace**2
    return np.asarray(detuned - trace**2 * square * (bxx * byy - bxy * byx))


def _around_roots(ratios: Array, found: Sequence[Matrices], speed: float) -> Array:
    """Ratios on both sides of the limits of stability between given ratios, by interpolation.

    Two limits between neighbouring ratios leave no change of sign at these.
    """
    fine, stiffness, damping = _between(ratios, found)
    signs = np.sign(_excess(stiffness, damping, fine * speed))
    roots = np.flatnonzero(signs[1:] != signs[:-1])
    aside = [np.interp(np.arange(fine.size)[roots] + side, np.arange(fine.size), fine) for side in (-ASIDE, 1 + ASIDE)]
    return np.concatenate(aside)


def _between(ratios: Array, found: Sequence[Matrices]) -> tuple[Array, Array, Array]:
    """Ratios at and between given ones, and K and B there by monotone cubics, each of shape (n, 2, 2)."""
    fine = np.concatenate([*(np.linspace(*pair, BETWEEN, endpoint=False) for pair in pairwise(ratios)), ratios[-1:]])
    stiffness, damping = PchipInterpolator(ratios, np.array(found))(fine).swapaxes(0, 1)
    return fine, stiffness, damping


def grows(stiffness: Array, damping: Array, speed: float) -> bool:
    """Whether a root s of det(K + sB) = 0 of pads without inertia has a positive real part while the shaft rests.

    Roots beyond ``FASTEST`` times the speed, as those of pads without pressure or damping, are left out.

    Parameters
    ----------
    stiffness, damping : K and B of the pads.
    speed : rotational speed of the rotor, rad/s.
    """
    top, bottom = eig(stiffness, -damping, right=False, homogeneous_eigvals=True)
    finite = np.abs(top) < FASTEST * speed * np.abs(bottom)
    return bool(((top[finite] / bottom[finite]).real > GROWTH * speed).any())


def slow_up_to(at: At, speed: float, ratios: Array = RATIOS) -> float:
    """The frequency over the speed up to which K and B differ by at most ``SAME`` from those of slow motions.

    Each differs by the norm of its change over its own; the largest of the ratios if they do at all of them.

    Parameters
    ----------
    at, speed, ratios : as in :func:`whirl_of`.
    """
    slow = at(0.0)

    def change(ratio: float) -> float:
        pairs = zip(at(ratio * speed), slow, strict=True)
        return max(float(np.linalg.norm(one - before) / np.linalg.norm(before)) for one, before in pairs) - SAME

    last = 0.0
    for ratio in map(float, ratios):
        if change(ratio) > 0:
            return float(brentq(change, last, ratio, xtol=WHIRL_TOLERANCE)) if last else ratio
        last = ratio
    return last


def _damped(stiffness: Array, damping: Array) -> bool:
    """Whether a small mass in the bearing is stable where k is positive."""
    return bool(np.linalg.det(damping) > 0 and np.trace(damping) > 0 and np.linalg.det(stiffness) > 0)


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
