"""Periodic profiles of ground surfaces with given height parameters and nearly a self-affine spectrum."""

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.checks import length as checked_length
from roughfilm.contact.synthetic.checks import number_between, whole_between
from roughfilm.contact.synthetic.distribution import ranked
from roughfilm.contact.synthetic.four_moments import MAX_COUNT, MIN_COUNT, FourMoments, heights_with
from roughfilm.contact.synthetic.waves import MAX_SEED

MAX_ITERATIONS = 200
"""Largest number of iterations."""

MIN_IMPROVEMENT = 1e-3
"""Relative decrease of the spectral error below which the iteration stops."""

STEEL_PROFILES = {
    "A": FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-1.0, kurtosis=4.4),
    "B": FourMoments(average=0.3e-6, rms=0.38e-6, skewness=-0.25, kurtosis=3.2),
    "C": FourMoments(average=0.14e-6, rms=0.18e-6, skewness=-0.022, kurtosis=3.5),
    "D": FourMoments(average=0.35e-6, rms=0.45e-6, skewness=-0.069, kurtosis=3.1),
}
"""Moments of profiles of four steel surfaces, measured across the grinding direction.

The surfaces are A, phosphated and dephosphated after grinding; B, as ground; C, chemically deburred; D, shot-peened.
Source: Almqvist, Sahlin, Larsson and Glavatskih, Tribol. Int. 40 (2007) 574, Table 1 (thesis, Table D.1).
"""


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

    Its power spectrum approximates C(q) = C0 for q <= qr, C0 (q/qr)^(-1 - 2H) for qr < q < qs, and 0 from qs on, with
    qr = 2π/roll_off, qs = 2π/cut_off. Each iteration sets the amplitudes of the waves to this spectrum, keeping their
    phases, then replaces the heights, rank by rank, by those of `heights_with`.

    Parameters
    ----------
    moments : parameters of the n heights, met to 1e-8.
    length : period L, m.
    points : n, 32 to 1 000 000.
    seed : 0 to 2^63 - 1; equal seeds give equal profiles.
    roll_off : roll-off wavelength, m, at most L; about the longest distance between ridges.
    hurst : H, above 0 and at most 1; 0.5 to 1 for ground profiles.
    cut_off : cut-off wavelength, m, below the roll-off; at least two pixels, which is the default.

    Returns
    -------
    Array : shape (n,), m, of mean 0; reshaped to (n, 1) it describes a line contact.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Heights take precedence over the spectrum: waves beyond the cut-off are small, not 0. Slopes, on which contact
    depends, follow from the spectrum; for equal spectra they are proportional to Rq.

    Source: Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635, doi:10.1103/PhysRevLett.77.635; spectrum: Persson et
    al., J. Phys. Condens. Matter 17 (2005) R1, doi:10.1088/0953-8984/17/1/R01.
    """
    checked_length("profile.length", length)
    whole_between("profile.points", points, MIN_COUNT, MAX_COUNT)
    whole_between("profile.seed", seed, 0, MAX_SEED)
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
    """Sorted heights in the order whose amplitudes are nearest to those of ``waves``, starting from their phases."""
    amplitudes = np.abs(waves)
    amplitudes *= np.sqrt(heights.size * np.sum(heights**2) / np.sum(2 * amplitudes**2))
    best, error = heights, np.inf
    for _ in range(MAX_ITERATIONS):
        candidate = ranked(scipy.fft.irfft(waves, heights.size), heights)
        spectrum = scipy.fft.rfft(candidate)
        previous, next_error = error, float(np.sum((np.abs(spectrum) - amplitudes) ** 2))
        if next_error < error:
            best, error = candidate, next_error
        if not next_error < previous * (1 - MIN_IMPROVEMENT):
            break
        waves = amplitudes * np.exp(1j * np.angle(spectrum))
    return best
