"""The power spectrum of a surface by wave vector, wavelength and direction, and the texture direction Std."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import ROUNDING, surface_deviations
from roughfilm.contact.surfaces.surface import Surface

LAY_WIDTH = 3.0
"""Standard deviation, degrees, of the kernel that smooths the angular spectrum."""

SECTORS = 360
"""Number of directions over 180 degrees in the first search for the maximum of the angular spectrum."""

MEAN_SHIFT_STEPS = 50
"""Number of mean-shift steps from the best of these directions."""


@dataclass(frozen=True, kw_only=True)
class PowerSpectrum:
    """Mean square height of each pair of opposite wave vectors.

    Attributes
    ----------
    power : shape (nx, ny//2 + 1), m²; the sum is Sq².
    frequencies : spatial frequencies along x (of both signs) and y, shapes (nx,) and (ny//2 + 1,), 1/m.
    """

    power: Array
    frequencies: tuple[Array, Array]


def power_spectrum(surface: Surface) -> PowerSpectrum:
    """Power spectrum |∫ z e^(−2πi f·x)|² of the heights about their mean, scaled so that its sum is Sq².

    A surface that is not periodic is multiplied by a Hann window, which removes the spurious waves along x and y from
    its edges and makes spectral lines two frequency steps wide. Invalid points are set to the mean.

    Raises
    ------
    InputError
        If all heights are equal.
    """
    z = surface_deviations(surface)
    mean_square = float((z * z).sum()) / np.count_nonzero(surface.valid)
    if not surface.periodic:
        window = np.outer(*(np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2 for n in surface.shape)) * surface.valid
        z = window * (z - (window * z).sum() / window.sum())
    transform = scipy.fft.rfft2(z)
    power = transform.real**2 + transform.imag**2
    power[:, 1 : (surface.shape[1] + 1) // 2] *= 2  # the opposite wave vectors of these are not in the array
    power[0, 0] = 0.0
    power *= mean_square / power.sum()
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    return PowerSpectrum(power=power, frequencies=(scipy.fft.fftfreq(nx, dx), scipy.fft.rfftfreq(ny, dy)))


def radial_power(spectrum: PowerSpectrum) -> tuple[Array, Array]:
    """Power by radial frequency, summed over all directions.

    Returns
    -------
    frequency : middle of each ring, shape (n,), 1/m, from 0; rings are as wide as the larger frequency step.
    power : power in each ring, shape (n,), m²; the sum is Sq².
    """
    fx, fy = spectrum.frequencies
    step = max(abs(float(fx[1])), float(fy[1]))
    ring = np.rint(np.hypot.outer(fx, fy) / step).astype(np.intp)
    power = _totals(ring.ravel(), spectrum.power.ravel())
    return step * np.arange(float(power.size)), power


def angular_power(spectrum: PowerSpectrum, count: int = 180) -> tuple[Array, Array]:
    """Power by direction of the lay, summed over all wavelengths.

    A wave vector in the direction θ makes ridges along θ + 90°. The power of each wave vector is spread over directions
    by a kernel whose variance is that of 3° plus that of the cell 1/Lx by 1/Ly seen from the origin, as long waves
    occur in few directions only.

    Parameters
    ----------
    count : number of sectors, at least 1.

    Returns
    -------
    angle : shape (count,), degrees from the x axis towards the y axis, 0 <= angle < 180.
    power : power in each sector of 180°/count, shape (count,), m²; the sum is Sq² for sectors narrower than 6°.

    Raises
    ------
    InputError
        If ``count`` is below 1.
    """
    if count < 1:
        raise InputError(f"angular power: got {count} sectors; ask for at least 1")
    angle = np.arange(count) * np.pi / count
    return np.degrees(angle), _lays(spectrum).density(angle) * np.pi / count


def texture_direction(spectrum: PowerSpectrum) -> float:
    """The texture direction Std, the main direction of the ridges, degrees from x towards y, 0 <= Std < 180.

    Std is the maximum of `angular_power`, interpolated between sectors. It has no meaning for an isotropic surface (see
    Str) and is one of the two directions of a surface with two equal lays.

    Notes
    -----
    The value is exact for a periodic wave; otherwise the error is 0.6° for 5 waves in the surface, 0.1° for 12 and
    0.01° for 25. ISO 25178-2:2021, 4.3.4 takes the maximum of the angular spectrum, which lies 90° from the lay.
    """
    lays = _lays(spectrum)
    grid = np.arange(SECTORS) * np.pi / SECTORS
    angle = float(grid[lays.density(grid).argmax()])
    for _ in range(MEAN_SHIFT_STEPS):
        angle = lays.mean_shift(angle)
    return float(np.degrees(angle) % 180.0 % 180.0)


@dataclass(frozen=True, kw_only=True)
class _Lays:
    """Power by lay direction as a sum of von Mises kernels, one for each group of wave vectors, shapes (n,)."""

    power: Array
    angle: Array
    concentration: Array

    def kernels(self, angle: Array) -> Array:
        """Power per radian of each group, shape (angles, n)."""
        difference = np.subtract.outer(angle, self.angle)
        height = self.power / (np.pi * scipy.special.i0e(self.concentration))
        return np.asarray(height * np.exp(self.concentration * (np.cos(2 * difference) - 1)))

    def density(self, angle: Array) -> Array:
        """Total power per radian, shape (angles,)."""
        return np.asarray(self.kernels(angle).sum(axis=1))

    def mean_shift(self, angle: float) -> float:
        """The angle after one mean-shift step, which increases the density; a maximum is a fixed point."""
        weights = self.kernels(np.array([angle]))[0] * self.concentration
        return float(np.angle(weights @ np.exp(2j * self.angle))) / 2


def _lays(spectrum: PowerSpectrum) -> _Lays:
    (fx, fy), power = spectrum.frequencies, spectrum.power.ravel()
    square = np.add.outer(fx**2, fy**2).ravel()
    square[0] = np.inf  # the mean has no direction
    cell = np.add.outer((fx * fy[1]) ** 2, (fx[1] * fy) ** 2).ravel() / square**2
    blur = np.radians(LAY_WIDTH) ** 2
    variance = blur + cell
    angle = np.arctan2.outer(-fx, fy).ravel()
    sector = np.rint(angle * (SECTORS / np.pi)).astype(np.intp)
    angle -= sector * (np.pi / SECTORS)
    group = np.rint(2 * np.log2(variance / blur)).astype(np.intp) * SECTORS + sector % SECTORS
    total = _totals(group, power)
    some = np.flatnonzero(total > ROUNDING**2 * total.sum())
    total = total[some]
    return _Lays(
        power=total,
        angle=some % SECTORS * (np.pi / SECTORS) + _totals(group, power * angle)[some] / total,
        concentration=total / (4 * _totals(group, power * variance)[some]),
    )


def _totals(group: NDArray[np.intp], weights: Array) -> Array:
    """Sum of the weights of each group, shape (groups,)."""
    return np.bincount(group, weights=weights).astype(np.float64)
