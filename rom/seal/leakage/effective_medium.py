"""Leakage from the spectrum of a surface: gaps by Persson's theory, put together as an effective medium."""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.estimates.persson import elastic_mean_gap
from roughfilm.contact.mechanics.moments import WavePower

SCALES = 48
"""At which roughness is cut off, from the longest wave to the shortest."""

BINS = 400
"""Of waves that are taken together."""

NODES = 24
"""Of Gauss's and Hermite's rule, for what the gaps that appear at a scale let through."""

PIECES = 1000
"""Equal ones, into which the gaps that appear at a scale are parted where they are told: nodes would be spikes."""

THRESHOLD = 0.415
"""Contact area at which the medium seals, as large elastic contacts of self-affine surfaces do (Wang and Müser)."""

OTHERS = THRESHOLD / (1 - THRESHOLD)
"""Weight of what surrounds a piece; 1 in Bruggeman's medium of two dimensions, which seals at half of contact."""


@dataclass(frozen=True, kw_only=True)
class EffectiveMedium:
    """What a spectrum tells of a gap under load.

    Attributes
    ----------
    permeability : K, m³; 0 if sealed.
    mean_gap : m.
    area_fraction : real area of contact over the nominal one.
    sealed : whether that area is ``THRESHOLD`` or more.
    gaps, shares : (n,), m and parts of the nominal area: how wide the gap is where; the rest is contact. Gaps that the
        theory spreads to below 0 are folded up, so that together they hold more than ``mean_gap``, by a tenth or so.
    residual : of the medium's equation at the permeability, over the parts of it that are above 0.
    """

    permeability: float
    mean_gap: float
    area_fraction: float
    sealed: bool
    gaps: Array
    shares: Array
    residual: float


def effective_medium(spectrum: WavePower, *, composite_modulus: float, load: float) -> EffectiveMedium:
    """Permeability of the gap between an elastic, isotropic, Gaussian rough surface and a flat one.

    Seen at a scale, contact covers A = erf(P/√(2V)), V the variance of full-contact pressures of all longer waves;
    what parts between two scales is open by u₁ = (ū A − ū'A')/(A − A') on average, where ū is the mean gap of the waves
    that are still shorter under the load P/A, and by ± their rms height about it. The permeability is that of a medium
    of which each piece is surrounded by itself, Σ a (u³ − K)/(u³ + w K) = 0 over all pieces a, those in contact
    included; with w = A_c/(1 − A_c) it seals at the contact area A_c = 0.415.

    Parameters
    ----------
    spectrum : of the surface.
    composite_modulus : E*, Pa.
    load : P, mean pressure, Pa; above 0.

    Notes
    -----
    Knows neither lay nor size. Beside the cells of three self-affine surfaces (256 x 256 points, Hurst 0.8, four waves
    of the roll-off on a side) it is 1.1 to 2.3 times as large up to a third of the load at which they seal, 0.9 to 5
    times at half of it, and off by orders of magnitude near it, as each surface seals at an area of its own. For low
    roughness without contact it is not exact to second order, as it would be with w = 1. Persson's contact is 0.7 to
    0.85 of the true area.

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

    def apart(steps: Array, weights: Array) -> tuple[Array, Array]:
        """Gaps at so many rms heights from their mean, and the parts of the area that they have by the weights."""
        gaps = np.abs(middle[:, None] + rms[:, None] * steps)
        return gaps.ravel(), (parted[some, None] * (weights / weights.sum())).ravel()

    permeability, residual = _medium(*apart(*np.polynomial.hermite_e.hermegauss(NODES)), contact)
    gaps, shares = apart(scipy.special.ndtri((np.arange(PIECES) + 0.5) / PIECES), np.ones(PIECES))
    return EffectiveMedium(
        permeability=permeability,
        mean_gap=float(means[0]),
        area_fraction=contact,
        sealed=permeability == 0.0,
        gaps=gaps,
        shares=shares,
        residual=residual,
    )


def _binned(spectrum: WavePower) -> WavePower:
    """Fewer waves of the same heights and slopes."""
    q, power = spectrum.wave_numbers[spectrum.power > 0], spectrum.power[spectrum.power > 0]
    if q.size <= BINS:
        return WavePower(wave_numbers=q, power=power, line=spectrum.line)
    edges = np.geomspace(q[0], q[-1] * (1 + 1e-12), BINS + 1)
    bins = np.clip(np.searchsorted(edges, q, side="right") - 1, 0, BINS - 1)
    total: Array = np.bincount(bins, power, BINS).astype(np.float64)
    square = np.bincount(bins, power * q**2, BINS)
    some = total > 0
    return WavePower(wave_numbers=np.sqrt(square[some] / total[some]), power=total[some], line=spectrum.line)


def _medium(gaps: Array, shares: Array, contact: float) -> tuple[float, float]:
    """K of the medium, and the residual of its equation."""
    if contact >= THRESHOLD or not gaps.size:
        return 0.0, 0.0
    conductance = gaps**3
    largest = float(conductance.max())

    def excess(logarithm: float) -> float:
        one = largest * math.exp(logarithm)
        return float((shares * (conductance - one) / (conductance + OTHERS * one)).sum()) - contact / OTHERS

    lowest = -200.0
    if excess(lowest) <= 0:
        return 0.0, 0.0
    found = float(scipy.optimize.brentq(excess, lowest, 0.0, xtol=1e-12))
    return largest * math.exp(found), abs(excess(found)) / float(shares.sum())
