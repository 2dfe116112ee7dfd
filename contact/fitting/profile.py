"""The random field whose profiles have the spectrum and the heights of a measured one."""

import math

import numpy as np
import scipy

from roughfilm.contact.fitting.fit import DEEPEST, described, quantile_steps, rounded, wave_numbers
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.parameters.profile import SECTIONS
from roughfilm.contact.surfaces.profile import CONSTANT, Profile
from roughfilm.contact.synthetic.description import RandomField
from roughfilm.contact.synthetic.random_field import DECIBEL, MIN_WINDOWS, at_scores, octave_of

MIN_POINTS, MAX_POINTS = 32, 1024
"""Smallest and largest number of points along a side of the surface."""


def fit_profile(profile: Profile, *, anisotropy: float = 1.0) -> RandomField:
    """Fit a random field to a profile, whose spectrum is taken to be the same in all directions.

    The profile is divided into sections, at least five, whose length is the period of the field. The power P(m) of the
    wave with m periods in a section is the mean over sections that overlap by half, with a Hann window. A field whose
    waves have the power p(√(m² + n²)) has P(m) = Σ_n p(√(m² + n²)) along any line; p is constant over half an octave,
    not negative, and fits P best in the least-squares sense of its relative errors. This is the discrete form of Abel's
    integral equation. The heights have the quantiles of the profile.

    Parameters
    ----------
    profile : roughness, without form, measured along x: across the ridges of a lay.
    anisotropy : γ, the length of ridges (along y) over their width; the field is p(√(m² + n²)) over a period that is γ
        times as long along y.

    Returns
    -------
    RandomField : seeds differ by the phases and the amplitudes of waves alone, not as windows of a surface do.

    Raises
    ------
    InputError
        If a section has fewer than 32 points, all heights are the same, or the anisotropy is out of range.

    Notes
    -----
    Waves longer than a section are left out; a roughness profile by ISO 21920 has none, as its sections have the length
    of the nesting index of the L-filter. The relative standard deviation of p at long waves is about one half.

    References
    ----------
    P. R. Nayak, J. Lubr. Technol. 93 (1971) 398 (profile and surface); P. D. Welch, IEEE Trans. Audio Electroacoust. 15
    (1967) 70 (spectrum of overlapping sections).
    """
    gamma = in_range("anisotropy", anisotropy, "1")
    sections = max(SECTIONS, math.ceil(profile.heights.size / MAX_POINTS))
    points = profile.heights.size // sections
    if points < MIN_POINTS:
        raise InputError(
            f"profile: got {profile.heights.size} points; {SECTIONS * MIN_POINTS} are needed for a spectrum"
        )
    if np.ptp(profile.heights) <= CONSTANT * np.abs(profile.heights).max():
        raise InputError("profile: all heights are the same; there is no roughness to fit")
    top = (points - 1) // 2
    edges = np.unique(np.append(np.rint(2 ** np.arange(0, 2 * math.log2(top), 0.5)), top + 1))
    edges = edges[edges <= top + 1]
    power = _radial_power(_wave_power(profile.heights, points), edges)
    side = points * profile.spacing
    period, numbers = (side, gamma * side), np.arange(-top, top + 1)
    waves = _at(np.hypot(*np.meshgrid(numbers, numbers, indexing="ij")), edges, power)
    q = [np.asarray(2 * np.pi * numbers / length, dtype=np.float64) for length in period]
    count = max(1, round(math.log2(max(top / max(gamma, 1 / gamma), 1))))
    octaves = np.bincount(octave_of(q[0][:, None], q[1][None], period, count).ravel(), waves.ravel(), minlength=count)
    along = wave_numbers(top)
    columns = np.array([-number for number in along[:0:-1]] + list(along), dtype=float)
    table = _at(np.hypot(columns[None, :], np.array(along, dtype=float)[:, None]), edges, power)
    table[0, len(along) - 1] = table.max()
    deepest = 10 ** (DEEPEST / 10)
    z = profile.heights - profile.heights.mean()
    scores, steps = quantile_steps(z[None] / z.std())
    heights = np.concatenate([[0.0], np.cumsum(steps[0] ** 2)])
    middle = at_scores(scores, heights, scipy.special.ndtri((np.arange(4096) + 0.5) / 4096))
    octaves = np.maximum(np.log(np.maximum(octaves, deepest * octaves.max())), -700)
    sides = [with_unit(float(f"{length:.12g}"), "m") for length in period]
    return described(
        {
            "kind": "random_field",
            "size": sides,
            "points": [points, points],
            "seed": 0,
            "spectrum": {
                "period": sides,
                "waves_x": along,
                "waves_y": along,
                "decibels": np.round(10 * np.log10(np.maximum(table / table.max(), deepest)), 2).tolist(),
            },
            "population": {
                "windows": float(max(sections, MIN_WINDOWS)),
                "rms_height": with_unit(float(f"{math.sqrt(waves.sum()):.6g}"), "m"),
                "octaves": rounded((octaves - octaves.max()) / DECIBEL, 3),
                "scores": rounded(scores, 6),
                "heights": rounded((heights - middle.mean()) / middle.std(), 6),
            },
        }
    )


def _wave_power(heights: Array, points: int) -> Array:
    """The mean power of the waves 0 to (points − 1)/2 of sections that overlap by half, m², by Welch's method."""
    window = scipy.signal.windows.hann(points, sym=False)
    starts = range(0, heights.size - points + 1, points // 2)
    parts = np.array([heights[start : start + points] for start in starts])
    parts = (parts - parts.mean(axis=1, keepdims=True)) * window
    power = np.abs(scipy.fft.rfft(parts, axis=1, norm="forward")) ** 2
    return np.asarray(power.mean(axis=0)[: (points - 1) // 2 + 1] / np.mean(window**2))


def _radial_power(power: Array, edges: Array) -> Array:
    """The power of a wave in each band of wave numbers, of the field along whose lines the waves have ``power``."""
    top = power.size - 1
    m, n = np.arange(1, top + 1), np.arange(-top, top + 1)
    bands = edges.size - 1
    radial = np.searchsorted(edges, np.hypot(m[:, None], n[None, :]), side="right") - 1
    line = np.searchsorted(edges, m, side="right") - 1
    inside = radial < bands
    keys = (line[:, None] * bands + np.minimum(radial, bands - 1))[inside]
    counts = np.bincount(keys, minlength=bands * bands).reshape(bands, bands)
    known = np.bincount(line, power[1:], minlength=bands)
    least = 1e-12 * known.max()
    return np.asarray(
        scipy.optimize.nnls(counts / np.maximum(known, least)[:, None], known / np.maximum(known, least))[0]
    )


def _at(number: Array, edges: Array, power: Array) -> Array:
    """The power at wave numbers, by the band; 0 for the mean and beyond the last band."""
    band = np.searchsorted(edges, number, side="right") - 1
    inside = (band >= 0) & (band < power.size)
    return np.where(inside, power[np.clip(band, 0, power.size - 1)], 0.0)
