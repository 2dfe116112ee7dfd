"""Periodic sums of waves of random phase with a given spectrum, independent of the grid."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.grid import Grid

Index = NDArray[np.int64]
Amplitudes = Literal["fixed", "random"]
Spectrum = Callable[[Array, Array], Array]
"""Function C(qx, qy), up to a constant factor, with qx and qy in rad/m."""

TIE = 1e-12
"""Relative difference of two |q|² that is rounding; such waves are as long as each other."""

MAX_SEED = 2**63 - 1
"""Largest seed of random numbers."""


@dataclass(frozen=True, kw_only=True)
class Waves:
    """Waves h(x, y) = Σ 2 Re(a exp(i(qx x + qy y))) over half of the wave vectors qx = 2π m/Lx, qy = 2π n/Ly.

    Attributes
    ----------
    m, n : shape (count,), with n > 0, or n = 0 and m > 0, in order of increasing |q|.
    qx, qy : shape (count,), rad/m.
    amplitudes : shape (count,), complex, m.
    """

    m: Index
    n: Index
    qx: Array
    qy: Array
    amplitudes: NDArray[np.complex128]

    @property
    def rms_height(self) -> float:
        """The rms height sqrt(<h²>) = sqrt(2 Σ |a|²), m."""
        return float(np.sqrt(2 * np.sum(np.abs(self.amplitudes) ** 2)))

    @property
    def rms_slope(self) -> float:
        """The rms slope sqrt(<|∇h|²>) = sqrt(2 Σ q² |a|²) of the continuous surface."""
        return float(np.sqrt(2 * np.sum((self.qx**2 + self.qy**2) * np.abs(self.amplitudes) ** 2)))

    def heights(self, points: tuple[int, int]) -> Array:
        """Heights h at the points of a grid that resolves every wave, shape ``points``, m."""
        nx, ny = points
        spectrum = np.zeros((nx, ny // 2 + 1), dtype=complex)
        spectrum[self.m % nx, self.n] = self.amplitudes
        level = self.n == 0
        spectrum[-self.m[level] % nx, 0] = self.amplitudes[level].conj()
        return np.asarray(scipy.fft.irfft2(spectrum, s=tuple(points), norm="forward"))


def random_waves(
    grid: Grid,
    *,
    spectrum: Spectrum,
    cut_off: float,
    seed: int | tuple[int, int],
    amplitudes: Amplitudes = "fixed",
    rms_height: float | None = None,
    rms_slope: float | None = None,
) -> Waves:
    """Random waves longer than the cut-off with a given spectrum, scaled exactly to an rms height or an rms slope.

    Each wave vector gets a complex z of two normal random numbers, drawn in order of increasing |q|, ties by n and then
    m. "fixed" amplitudes are sqrt(C(q)) with the phase of z, so that every seed has the given spectrum; "random" ones
    are z sqrt(C(q)), the waves of a Gaussian process. The order is independent of grid and scale: a finer grid has the
    same waves for the same cut-off, and additional ones, apart from the scaling, for a shorter cut-off; a larger period
    of the same shape has the same waves, enlarged.

    Parameters
    ----------
    spectrum : C(qx, qy), up to a constant factor.
    cut_off : wavelength, m.
    seed : seed or pair of seeds of the random numbers.
    rms_height, rms_slope : m, and a number; one of them.

    Raises
    ------
    InputError
        If no wave of the period is longer than the cut-off, or ``amplitudes`` is unknown.
    """
    if amplitudes not in ("fixed", "random"):
        raise InputError(f"{grid.kind}.amplitudes: got {amplitudes!r}; write 'fixed' or 'random'")
    m, n, qx, qy = _wave_vectors(grid, cut_off)
    if not m.size:
        raise InputError(
            f"{grid.kind}: got no wave between the cut-off, {cut_off:.5g} m, and the longer side, "
            f"{max(grid.size):.5g} m; shorten the one or lengthen the other"
        )
    drawn = np.random.default_rng(seed).standard_normal((m.size, 2)).view(complex)[:, 0]
    if amplitudes == "fixed":
        drawn /= np.abs(drawn)
    waves = Waves(m=m, n=n, qx=qx, qy=qy, amplitudes=drawn * np.sqrt(spectrum(qx, qy)))
    factor = (rms_height or 0.0) / waves.rms_height if rms_slope is None else rms_slope / waves.rms_slope
    return replace(waves, amplitudes=waves.amplitudes * factor)


def _wave_vectors(grid: Grid, cut_off: float) -> tuple[Index, Index, Array, Array]:
    """Arrays m, n, qx, qy of half the wave vectors 0 < |q| < 2π/cut_off that the grid resolves, by increasing |q|."""
    most = [min(int(side / cut_off), (count - 1) // 2) for side, count in zip(grid.size, grid.points, strict=True)]
    m, n = np.arange(-most[0], most[0] + 1)[None, :], np.arange(most[1] + 1)[:, None]
    squared: Array = (m / grid.size[0]) ** 2 + (n / grid.size[1]) ** 2
    wanted = np.flatnonzero(((n > 0) | (m > 0)) & (squared * cut_off**2 < 1 - 1e-9))
    wanted = wanted[np.argsort(squared.ravel()[wanted], kind="stable")]
    lengths = squared.ravel()[wanted]
    wanted = wanted[np.lexsort((wanted, np.cumsum(np.diff(lengths, prepend=0.0) > TIE * lengths)))]
    rows, columns = np.divmod(wanted, m.size)
    chosen_m, chosen_n = m[0, columns], n[rows, 0]
    return chosen_m, chosen_n, 2 * np.pi * chosen_m / grid.size[0], 2 * np.pi * chosen_n / grid.size[1]
