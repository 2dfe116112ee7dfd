"""A sum of waves of random phase with a given spectrum, on the lattice of a period, the same on every grid."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Array
from roughfilm.contact.synthetic.grid import Grid

Index = NDArray[np.int64]
Amplitudes = Literal["fixed", "random"]
Spectrum = Callable[[Array, Array], Array]
"""C(qx, qy) but for a factor; qx and qy in rad/m."""

LARGEST_SEED = 2**63 - 1


@dataclass(frozen=True, kw_only=True)
class Waves:
    """h(x, y) = Σ 2 Re(a exp(i(qx x + qy y))) over half of the wave vectors qx = 2π m/Lx, qy = 2π n/Ly.

    Attributes
    ----------
    m, n : shape (count,): n > 0, or n = 0 and m > 0, in order of growing |q|.
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
        """sqrt(<h²>) = sqrt(2 Σ |a|²), m."""
        return float(np.sqrt(2 * np.sum(np.abs(self.amplitudes) ** 2)))

    @property
    def rms_slope(self) -> float:
        """sqrt(<|∇h|²>) = sqrt(2 Σ q² |a|²), of the continuous surface, in both directions together."""
        return float(np.sqrt(2 * np.sum((self.qx**2 + self.qy**2) * np.abs(self.amplitudes) ** 2)))

    def heights(self, points: tuple[int, int]) -> Array:
        """The sum at the points of a grid that resolves every wave, shape ``points``, m."""
        nx, ny = points
        spectrum = np.zeros((nx, ny // 2 + 1), dtype=complex)
        spectrum[self.m % nx, self.n] = self.amplitudes
        level = self.n == 0
        spectrum[-self.m[level] % nx, 0] = self.amplitudes[level].conj()
        heights: Array = scipy.fft.irfft2(spectrum, s=tuple(points), norm="forward")
        return heights


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
    """Waves longer than ``cut_off`` (m) with a given spectrum, scaled to one of rms height (m) and rms slope exactly.

    For each wave vector a complex z of two normal numbers is drawn, in order of growing |q|, ties by n and then m. With
    "fixed" amplitudes |a|² is C(q) itself and only the phase of z counts, so that every seed has the spectrum that was
    asked; with "random" ones a = z sqrt(C(q)), the waves of a Gaussian process. The order knows no grid: with the same
    cut-off a finer grid has the same waves; with a shorter one it keeps them, but for the scaling, and has others too.

    Raises
    ------
    InputError
        If no wave of the period is longer than the cut-off, or amplitudes are named otherwise.
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
    """m, n, qx, qy of half the wave vectors 0 < |q| < 2π/cut_off that the grid resolves, in order of growing |q|."""
    most = [min(int(side / cut_off), (count - 1) // 2) for side, count in zip(grid.size, grid.points, strict=True)]
    m, n = np.arange(-most[0], most[0] + 1)[None, :], np.arange(most[1] + 1)[:, None]
    squared: Array = (m / grid.size[0]) ** 2 + (n / grid.size[1]) ** 2
    wanted = np.flatnonzero(((n > 0) | (m > 0)) & (squared * cut_off**2 < 1 - 1e-9))
    wanted = wanted[np.argsort(squared.ravel()[wanted], kind="stable")]
    rows, columns = np.divmod(wanted, m.size)
    chosen_m, chosen_n = m[0, columns], n[rows, 0]
    return chosen_m, chosen_n, 2 * np.pi * chosen_m / grid.size[0], 2 * np.pi * chosen_n / grid.size[1]
