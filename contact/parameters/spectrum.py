"""How the mean square of the heights is divided among wave vectors, wavelengths and directions: the lay, Std."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import ROUNDING, surface_deviations
from roughfilm.contact.surfaces.surface import Array, Surface

LAY_WIDTH = 3.0
"""degrees: directions this close (standard deviation) count together as one lay."""

SECTORS = 360
STEPS = 50
"""Of the search for the lay, from the best of the sectors."""


@dataclass(frozen=True, kw_only=True)
class PowerSpectrum:
    """Mean square of the heights in each pair of opposite wave vectors.

    Attributes
    ----------
    power : shape (nx, ny//2 + 1), m²; its sum is Sq².
    frequencies : shapes (nx,) and (ny//2 + 1,), periods per metre along x (of both signs) and y.
    """

    power: Array
    frequencies: tuple[Array, Array]


def power_spectrum(surface: Surface) -> PowerSpectrum:
    """Power spectrum |∫ z e^(−2πi f·x)|² of the heights less their mean, scaled so that its sum is Sq².

    A periodic surface is taken as it is. Any other is faded out towards its edges (Hann's window), whose jump would
    else be seen as waves along x and y; its lines are then two frequencies wide. Invalid points lie on the mean.

    Raises
    ------
    InputError
        If all heights are the same.
    """
    z = surface_deviations(surface)
    mean_square = float((z * z).sum()) / np.count_nonzero(surface.valid)
    if not surface.periodic:
        window = np.outer(*(np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2 for n in surface.shape)) * surface.valid
        z = window * (z - (window * z).sum() / window.sum())
    transform = scipy.fft.rfft2(z)
    power = transform.real**2 + transform.imag**2
    power[:, 1 : (surface.shape[1] + 1) // 2] *= 2  # those whose opposite is not in the array
    power[0, 0] = 0.0
    power *= mean_square / power.sum()
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    return PowerSpectrum(power=power, frequencies=(scipy.fft.fftfreq(nx, dx), scipy.fft.rfftfreq(ny, dy)))


def radial_power(spectrum: PowerSpectrum) -> tuple[Array, Array]:
    """Power by wavelength, all directions together.

    Returns
    -------
    frequency : shape (n,), 1/m, the middle of rings as wide as the coarser of the two frequency steps, from 0.
    power : shape (n,), m², in each ring; its sum is Sq².
    """
    fx, fy = spectrum.frequencies
    step = max(abs(float(fx[1])), float(fy[1]))
    ring = np.rint(np.hypot.outer(fx, fy) / step).astype(np.intp)
    power = _totals(ring.ravel(), spectrum.power.ravel())
    return step * np.arange(float(power.size)), power


def angular_power(spectrum: PowerSpectrum, count: int = 180) -> tuple[Array, Array]:
    """Power by direction of the lay, all wavelengths together.

    Waves whose wave vector points to θ make ridges that run along θ + 90°. Each wave vector counts for a bell of
    directions as wide (standard deviation) as its cell, 1/Lx by 1/Ly, is seen from the origin, and 3°: long waves have
    too few directions among the discrete ones to count for these alone.

    Returns
    -------
    angle : shape (count,), degrees from the x axis towards the y axis, 0 <= angle < 180.
    power : shape (count,), m², in each sector of 180°/count; its sum is Sq² for sectors narrower than 6°.

    Raises
    ------
    InputError
        If fewer than one sector is asked for.
    """
    if count < 1:
        raise InputError(f"angular power: got {count} sectors; ask for at least 1")
    angle = np.arange(count) * np.pi / count
    return np.degrees(angle), _lays(spectrum).density(angle) * np.pi / count


def texture_direction(spectrum: PowerSpectrum) -> float:
    """Std, the direction in which most ridges run: degrees from the x axis towards the y axis, 0 <= Std < 180.

    The maximum of `angular_power`, between its sectors. A periodic wave is found exactly, one that is not within 0.6°
    if the surface holds 5 of it, 0.1° if 12, 0.01° if 25. Of an isotropic surface it says nothing (look at Str); of
    two equal lays it gives one.

    Notes
    -----
    ISO 25178-2:2021, 4.3.4 takes the maximum of the angular spectrum itself, which lies across the lay: 90° from this.
    """
    lays = _lays(spectrum)
    grid = np.arange(SECTORS) * np.pi / SECTORS
    angle = float(grid[lays.density(grid).argmax()])
    for _ in range(STEPS):
        angle = lays.climb(angle)
    return float(np.degrees(angle) % 180.0 % 180.0)


@dataclass(frozen=True, kw_only=True)
class _Lays:
    """Power by lay as a sum of periodic bells: wave vectors of nearly one direction and width together, shape (n,)."""

    power: Array
    angle: Array
    concentration: Array

    def bells(self, angle: Array) -> Array:
        """Power per radian of each at some angles, shape (angles, n)."""
        away = np.subtract.outer(angle, self.angle)
        height = self.power / (np.pi * scipy.special.i0e(self.concentration))
        bells: Array = height * np.exp(self.concentration * (np.cos(2 * away) - 1))
        return bells

    def density(self, angle: Array) -> Array:
        """Power per radian of all together, shape (angles,)."""
        density: Array = self.bells(angle).sum(axis=1)
        return density

    def climb(self, angle: float) -> float:
        """An angle where it is higher (mean shift), or the same at a maximum."""
        weights = self.bells(np.array([angle]))[0] * self.concentration
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
    """Sum of the weights in each group."""
    return np.bincount(group, weights=weights).astype(np.float64)
