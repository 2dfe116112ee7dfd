"""Ground profiles: periodic, with given height parameters, and a self-affine spectrum as far as these allow."""

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Array
from roughfilm.contact.synthetic.checks import length as checked_length
from roughfilm.contact.synthetic.checks import number_between, whole_between
from roughfilm.contact.synthetic.four_moments import FEWEST, MOST, FourMoments, heights_with
from roughfilm.contact.synthetic.waves import LARGEST_SEED

TURNS = 200
IMPROVEMENT = 1e-3
"""A relative decrease of the spectral error below which the turns end."""

STEEL_PROFILES = {
    "A": FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-1.0, kurtosis=4.4),
    "B": FourMoments(average=0.3e-6, rms=0.38e-6, skewness=-0.25, kurtosis=3.2),
    "C": FourMoments(average=0.14e-6, rms=0.18e-6, skewness=-0.022, kurtosis=3.5),
    "D": FourMoments(average=0.35e-6, rms=0.45e-6, skewness=-0.069, kurtosis=3.1),
}
"""Four steel surfaces across their grinding: A then phosphated and dephosphated, B as ground, C chemically deburred, D
shot-peened. Almqvist, Sahlin, Larsson and Glavatskih, Tribol. Int. 40 (2007) 574, Table 1 (thesis, Table D.1)."""


def ground_profile(
    moments: FourMoments,
    *,
    length: float,
    points: int,
    seed: int,
    roll_off: float,
    hurst: float = 0.8,
    cut_off: float | None = None,
) -> Array:
    """A random periodic profile with given Ra, Rq, Rsk, Rku.

    Its power spectrum is near C(q) = C0 for q <= qr, C0 (q/qr)^(-1 - 2H) for qr < q < qs, and 0 from qs on, with
    qr = 2π/roll_off, qs = 2π/cut_off. By turns the waves get these amplitudes, keeping their phases, and the heights
    are replaced, rank by rank, by those of `heights_with`; the latter comes last.

    Parameters
    ----------
    moments : of the n heights; met to 1e-8.
    length : L, m, one period.
    points : n.
    seed : 0 to 2^63 - 1; the same profile for the same seed.
    roll_off : m, at most L: about the longest distance between ridges.
    hurst : H, above 0 and at most 1: the roughness of profiles ground, 0.5 (as by a random walk) to 1 (smooth).
    cut_off : m, below the roll-off, at least two pixels, which is the default.

    Returns
    -------
    Shape (n,), m, with a mean of 0. As (n, 1) it is a line contact.

    Raises
    ------
    InputError
        One line, for what makes no sense.

    Notes
    -----
    Heights come before the spectrum: waves beyond the cut-off are small, not 0. Height parameters say nothing of
    slopes, on which contact depends: they follow from the spectrum, and are proportional to Rq where that is the same.

    Source: Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635, doi:10.1103/PhysRevLett.77.635; spectrum: Persson et
    al., J. Phys. Condens. Matter 17 (2005) R1, doi:10.1088/0953-8984/17/1/R01.
    """
    checked_length("profile.length", length)
    whole_between("profile.points", points, FEWEST, MOST)
    whole_between("profile.seed", seed, 0, LARGEST_SEED)
    number_between("profile.hurst", hurst, 1e-6, 1, "it must be above 0 and at most 1")
    shortest = 2 * length / points if cut_off is None else checked_length("profile.cut_off", cut_off)
    if shortest < 2 * length / points * (1 - 1e-9):
        raise InputError(f"profile.cut_off: got {shortest:.5g} m, below two pixels; write {2 * length / points:.5g} m")
    if not shortest < checked_length("profile.roll_off", roll_off) <= length * (1 + 1e-9):
        raise InputError(
            f"profile.roll_off: got {roll_off:.5g} m; write one between the cut-off, {shortest:.5g} m, and the length"
        )
    wave = np.arange(points // 2 + 1)
    amplitudes = np.maximum(wave * roll_off / length, 1.0) ** (-0.5 - hurst)
    amplitudes[(wave == 0) | (wave * shortest > length * (1 - 1e-9))] = 0.0
    turn = np.random.default_rng(seed).uniform(0, 2 * np.pi, wave.size)
    return _ranked_into(amplitudes * np.exp(1j * turn), heights_with(moments, points))


def _ranked_into(waves: NDArray[np.complex128], heights: Array) -> Array:
    """Growing heights in the order that brings their amplitudes nearest to those of some waves, from their phases."""
    amplitudes = np.abs(waves)
    amplitudes *= np.sqrt(heights.size * np.sum(heights**2) / np.sum(2 * amplitudes**2))
    best, error, bettered, turns = heights, np.inf, True, 0
    while bettered and turns < TURNS:
        ranked = np.empty_like(heights)
        ranked[np.argsort(scipy.fft.irfft(waves, heights.size), kind="stable")] = heights
        found = scipy.fft.rfft(ranked)
        next_error = float(np.sum((np.abs(found) - amplitudes) ** 2))
        bettered = next_error < error * (1 - IMPROVEMENT)
        if next_error < error:
            best, error = ranked, next_error
        waves = amplitudes * np.exp(1j * np.angle(found))
        turns += 1
    return best
