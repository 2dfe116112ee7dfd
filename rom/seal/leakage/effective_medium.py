"""Leakage from the spectrum of a surface by Persson's contact theory and an effective medium."""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.estimates.persson import elastic_mean_gap
from roughfilm.contact.mechanics.moments import WavePower

SCALES = 48
"""Number of scales at which the spectrum is cut off, from the longest wave to the shortest."""

WAVE_BINS = 400
"""Largest number of groups of waves."""

GAUSS_POINTS = 24
"""Number of Gauss-Hermite points over the gaps that appear at a scale."""

REPORTED_GAPS = 1000
"""Number of gaps of equal probability by which those that appear at a scale are reported."""

SEALING_AREA = 0.415
"""Contact area fraction at which the medium seals, that of large self-affine elastic contacts (Wang and Müser)."""

SURROUNDING_WEIGHT = SEALING_AREA / (1 - SEALING_AREA)
"""Weight w of the medium around an element; w = 1 in Bruggeman's two-dimensional medium, which seals at A = 0.5."""


@dataclass(frozen=True, kw_only=True)
class EffectiveMedium:
    """The gap under load as an effective medium.

    Attributes
    ----------
    permeability : K, m³; 0 if sealed.
    mean_gap : mean gap, m.
    area_fraction : real area of contact over the nominal area.
    sealed : whether ``area_fraction`` is at least ``SEALING_AREA``.
    gaps, fractions : gaps, m, and their fractions of the nominal area, (n,); the rest is contact. Negative gaps of the
        theory are taken by magnitude, so that their mean exceeds ``mean_gap`` by about a tenth.
    residual : residual of the medium's equation over its positive terms.
    """

    permeability: float
    mean_gap: float
    area_fraction: float
    sealed: bool
    gaps: Array
    fractions: Array
    residual: float


def effective_medium(spectrum: WavePower, *, composite_modulus: float, load: float) -> EffectiveMedium:
    """Compute the permeability of the gap between an elastic, isotropic, Gaussian rough surface and a flat one.

    With roughness down to a scale, contact covers A = erf(P/√(2V)), with V the variance of full-contact pressures of
    all longer waves. The area that separates between two scales has the mean gap u₁ = (ū A − ū'A')/(A − A'), where ū is
    the mean gap of the shorter waves under the load P/A; its gaps scatter about u₁ with the rms height of these waves.
    The permeability K of the effective medium solves Σ a (u³ − K)/(u³ + w K) = 0 over all areas a including contact;
    with w = A_c/(1 − A_c) it seals at the contact area A_c = 0.415.

    Parameters
    ----------
    spectrum : mean square height by wave number of the surface.
    composite_modulus : E*, Pa.
    load : mean pressure P > 0, Pa.

    Notes
    -----
    The theory includes neither lay nor finite size. The ratio of its permeability to that of cells of three self-affine
    surfaces (256 x 256 points, Hurst exponent 0.8, four roll-off waves on a side) is 1.1 to 2.3 up to a third of the
    sealing load and 0.9 to 5 at half of it; near sealing the error is orders of magnitude, since each surface has its
    own sealing area. For low roughness without contact it is not exact to second order, unlike w = 1. Persson's contact
    area is 0.7 to 0.85 of the true one.

    Source: Lorenz and Persson, Eur. Phys. J. E 31 (2010) 159, doi:10.1140/epje/i2010-10558-6; Dapp, Lücke, Persson
    and Müser, Phys. Rev. Lett. 108 (2012) 244301, doi:10.1103/PhysRevLett.108.244301; Wang and Müser, Tribol. Lett. 69
    (2021) 1, doi:10.1007/s11249-020-01378-7; Almqvist, Campana, Prodanov and Persson, J. Mech. Phys. Solids 59 (2011)
    2355, doi:10.1016/j.jmps.2011.08.004; Bruggeman, Ann. Phys. 416 (1935) 636, doi:10.1002/andp.19354160705.
    """
    waves = _binned(spectrum)
    q, power = waves.wave_numbers, waves.power
    variance = np.concatenate([[0.0], np.cumsum((composite_modulus / 2 * q) ** 2 * power)])
    cuts = np.unique(np.linspace(0, q.size, SCALES + 1).astype(int))
    with np.errstate(divide="ignore"):
        areas = np.where(variance[cuts] > 0, scipy.special.erf(load / np.sqrt(2 * variance[cuts])), 1.0)
    means = np.array(
        [
            elastic_mean_gap(
                WavePower(wave_numbers=q[cut:], power=power[cut:], line=waves.line),
                composite_modulus=composite_modulus,
                load=load / area,
            )
            if cut < q.size
            else 0.0
            for cut, area in zip(cuts, areas, strict=True)
        ]
    )
    parted, volume = -np.diff(areas), -np.diff(means * areas)
    some = parted > 1e-15
    middle = np.maximum(volume[some] / parted[some], 0.0)
    remaining = power.sum() - np.concatenate([[0.0], np.cumsum(power)])[(cuts[1:] + cuts[:-1]) // 2]
    rms = np.sqrt(np.maximum(remaining[some], 0.0))
    contact = float(areas[-1])

    def distribution(steps: Array, weights: Array) -> tuple[Array, Array]:
        """The gaps at multiples ``steps`` of the rms height from the mean gaps, m, and their area fractions."""
        gaps = np.abs(middle[:, None] + rms[:, None] * steps)
        return gaps.ravel(), (parted[some, None] * (weights / weights.sum())).ravel()

    permeability, residual = _medium(*distribution(*np.polynomial.hermite_e.hermegauss(GAUSS_POINTS)), contact)
    steps = scipy.special.ndtri((np.arange(REPORTED_GAPS) + 0.5) / REPORTED_GAPS)
    gaps, fractions = distribution(steps, np.ones(REPORTED_GAPS))
    return EffectiveMedium(
        permeability=permeability,
        mean_gap=float(means[0]),
        area_fraction=contact,
        sealed=permeability == 0.0,
        gaps=gaps,
        fractions=fractions,
        residual=residual,
    )


def _binned(spectrum: WavePower) -> WavePower:
    """The spectrum reduced to at most ``WAVE_BINS`` waves, with unchanged rms height and slope."""
    q, power = spectrum.wave_numbers[spectrum.power > 0], spectrum.power[spectrum.power > 0]
    if q.size <= WAVE_BINS:
        return WavePower(wave_numbers=q, power=power, line=spectrum.line)
    edges = np.geomspace(q[0], q[-1] * (1 + 1e-12), WAVE_BINS + 1)
    bins = np.clip(np.searchsorted(edges, q, side="right") - 1, 0, WAVE_BINS - 1)
    total: Array = np.bincount(bins, power, WAVE_BINS).astype(np.float64)
    square = np.bincount(bins, power * q**2, WAVE_BINS)
    some = total > 0
    return WavePower(wave_numbers=np.sqrt(square[some] / total[some]), power=total[some], line=spectrum.line)


def _medium(gaps: Array, fractions: Array, contact: float) -> tuple[float, float]:
    """The permeability K of the medium, m³, and the relative residual of its equation."""
    if contact >= SEALING_AREA or not gaps.size:
        return 0.0, 0.0
    conductance = gaps**3
    largest = float(conductance.max())

    def excess(logarithm: float) -> float:
        one = largest * math.exp(logarithm)
        terms = fractions * (conductance - one) / (conductance + SURROUNDING_WEIGHT * one)
        return float(terms.sum()) - contact / SURROUNDING_WEIGHT

    lowest = -200.0
    if excess(lowest) <= 0:
        return 0.0, 0.0
    root = float(scipy.optimize.brentq(excess, lowest, 0.0, xtol=1e-12))
    return largest * math.exp(root), abs(excess(root)) / float(fractions.sum())
