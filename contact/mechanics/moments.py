"""Spectral moments of a periodic surface or profile: mean squares of height, slope and curvature."""

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import positive
from roughfilm.contact.parameters.heights import deviations

SUMMIT_VARIANCE_REDUCTION = 0.8968
"""Relative reduction of the variance of summit heights below that of all heights, times α (McCool)."""


@dataclass(frozen=True, kw_only=True)
class WavePower:
    """Mean square height by wave number, in increasing order.

    Attributes
    ----------
    wave_numbers : |q|, shape (n,), rad/m, increasing; one entry for each pair of opposite wave vectors.
    power : shape (n,), m²; the sum is the mean square of the heights.
    line : true for a profile (ridges, plane strain), false for a surface.
    """

    wave_numbers: Array
    power: Array
    line: bool

    @property
    def moments(self) -> "SpectralMoments":
        """Spectral moments of a profile, or of the profiles of a surface averaged over all directions.

        m0 = Σ |a|², m2 = s2 Σ q²|a|², m4 = s4 Σ q⁴|a|², with s2 = <cos²> = 1/2 and s4 = <cos⁴> = 3/8 for a surface,
        1 for a profile.
        """
        square = self.wave_numbers**2
        return SpectralMoments(
            m0=float(self.power.sum()),
            m2=float(square @ self.power) * (1.0 if self.line else 0.5),
            m4=float(square**2 @ self.power) * (1.0 if self.line else 0.375),
            line=self.line,
        )


@dataclass(frozen=True, kw_only=True)
class SpectralMoments:
    """Mean squares of height, slope and curvature along a profile.

    Attributes
    ----------
    m0, m2, m4 : <z²>, m²; <z'²>, 1; <z''²>, 1/m².
    line : true for a profile (ridges, plane strain), false for an isotropic surface.

    Raises
    ------
    InputError
        If a moment is not finite and above 0, or m0 m4 < m2², which is impossible.

    Notes
    -----
    Source: Nayak, J. Lubr. Technol. 93 (1971) 398, doi:10.1115/1.3451608; McCool, Wear 107 (1986) 37,
    doi:10.1016/0043-1648(86)90045-1.
    """

    m0: float
    m2: float
    m4: float
    line: bool

    def __post_init__(self) -> None:
        for name in ("m0", "m2", "m4"):
            positive(f"moments.{name}", getattr(self, name))
        if self.nayak < 1 - 1e-9:
            raise InputError(f"moments: got m0 m4/m2² = {self.nayak:.6g}; of one surface it is never below 1")

    @property
    def nayak(self) -> float:
        """Nayak's parameter α = m0 m4/m2², breadth of the spectrum: 1 for one wave, 3/2 if isotropic."""
        return self.m0 / self.m2 * (self.m4 / self.m2)

    @property
    def rms_height(self) -> float:
        """The rms height sqrt(m0), m."""
        return math.sqrt(self.m0)

    @property
    def rms_slope(self) -> float:
        """The rms slope g' = sqrt(<|∇z|²>): sqrt(2 m2) for a surface, sqrt(m2) for a profile."""
        return math.sqrt(self.m2 if self.line else 2 * self.m2)

    @property
    def summit_density(self) -> float:
        """Density of Gaussian summits, m4/(6π√3 m2), 1/m²; for a profile density of peaks, sqrt(m4/m2)/(2π), 1/m."""
        ratio = self.m4 / self.m2
        return math.sqrt(ratio) / (2 * math.pi) if self.line else ratio / (6 * math.pi * math.sqrt(3))

    @property
    def summit_radius(self) -> float:
        """Radius of the mean curvature of Gaussian summits, (3/8) sqrt(π/m4), m; for profile peaks sqrt(2/(π m4))."""
        return math.sqrt(2 / (math.pi * self.m4)) if self.line else 0.375 * math.sqrt(math.pi / self.m4)

    @property
    def summit_mean(self) -> float:
        """Mean height of Gaussian summits over the mean plane, 4 sqrt(m0/(πα)), m; for profile peaks sqrt(πm0/(2α))."""
        factor = math.pi / 2 if self.line else 16 / math.pi
        return math.sqrt(factor * self.m0 / self.nayak)

    @property
    def summit_spread(self) -> float:
        """Standard deviation of summit heights, sqrt((1 − 0.8968/α) m0), m; for peaks sqrt((1 − (π/2 − 1)/α) m0)."""
        factor = math.pi / 2 - 1 if self.line else SUMMIT_VARIANCE_REDUCTION
        return math.sqrt(max(1 - factor / self.nayak, 0.0) * self.m0)


def wave_power(heights: ArrayLike, spacing: tuple[float, float]) -> WavePower:
    """Mean square of every wave of periodic heights z = Σ a exp(i q·x), by Parseval's theorem.

    Parameters
    ----------
    heights : shape (nx, ny), m; a profile has ny = 1.
    spacing : (dx, dy), m; dy is ignored for a profile.

    Returns
    -------
    WavePower : exact for heights without waves shorter than two pixels. A wave of exactly two pixels counts with its
        mean square at the points, twice that of the continuous wave.

    Raises
    ------
    InputError
        If the heights are not two-dimensional, not finite or all equal, or a spacing is not above 0.

    Notes
    -----
    A measurement that is not periodic has steps at its edges, which count as slopes; prepare it first.

    Examples
    --------
    >>> ridges = np.cos(2 * np.pi * np.arange(16) / 16)[:, None]
    >>> moments = wave_power(ridges, (1 / 16, 1.0)).moments
    >>> round(moments.m0, 12), round(moments.rms_slope / (2 * math.pi) * math.sqrt(2), 12), round(moments.nayak, 12)
    (0.5, 1.0, 1.0)
    """
    shape = np.shape(heights)
    if len(shape) != 2:
        raise InputError(f"moments.heights: got shape {shape}; give (nx, ny), with ny = 1 for a profile")
    dx, dy = (positive("moments.spacing", float(length)) for length in spacing)
    z = deviations(heights)
    transform = scipy.fft.rfft2(z, norm="forward")
    power = transform.real**2 + transform.imag**2
    power[:, 1 : (shape[1] + 1) // 2] *= 2
    power[0, 0] = 0.0
    qx, qy = 2 * np.pi * scipy.fft.fftfreq(shape[0], dx), 2 * np.pi * scipy.fft.rfftfreq(shape[1], dy)
    number = np.hypot(qx[:, None], qy[None, :]).ravel()
    order = np.argsort(number, kind="stable")[1:]
    return WavePower(wave_numbers=number[order], power=power.ravel()[order], line=1 in shape)
