"""How the mean square of the heights is divided among wave vectors, wavelengths and directions: the lay, Std."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from contact.errors import InputError
from contact.heights import surface_deviations
from contact.surface import Array, Surface

LAY_WIDTH = 3.0
"""degrees: directions this close (standard deviation) count together as one lay."""


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
    transform = fft.rfft2(z)
    power = transform.real**2 + transform.imag**2
    power[:, 1 : (surface.shape[1] + 1) // 2] *= 2  # those whose opposite is not in the array
    power[0, 0] = 0.0
    power *= mean_square / power.sum()
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    return PowerSpectrum(power=power, frequencies=(fft.fftfreq(nx, dx), fft.rfftfreq(ny, dy)))


def radial_power(spectrum: PowerSpectrum) -> tuple[Array, Array]:
    """Power by wavelength, all directions together.

    Returns
    -------
    frequency : shape (n,), 1/m, the middle of rings as wide as the finer of the two frequency steps, from 0.
    power : shape (n,), m², in each ring; its sum is Sq².
    """
    fx, fy = spectrum.frequencies
    step = float(min(fx[1], fy[1], key=abs))
    ring = np.rint(np.hypot.outer(fx, fy) / step).astype(np.intp)
    power = _totals(ring.ravel(), spectrum.power.ravel())
    return step * np.arange(float(power.size)), power


def angular_power(spectrum: PowerSpectrum, count: int = 180) -> tuple[Array, Array]:
    """Power by direction of the lay, all wavelengths together.

    Waves whose wave vector points to θ make ridges that run along θ + 90°.

    Returns
    -------
    angle : shape (count,), degrees from the x axis towards the y axis, 0 <= angle < 180; the middle of each sector.
    power : shape (count,), m², in each sector; its sum is Sq².
    """
    if count < 1:
        raise InputError(f"angular power: got {count} sectors; ask for at least 1")
    sector, _ = _sectors(spectrum, count)
    power = _totals(sector, spectrum.power.ravel(), count)
    return np.arange(count) * 180.0 / count, power


def texture_direction(spectrum: PowerSpectrum) -> float:
    """Std, the direction in which most ridges run: degrees from the x axis towards the y axis, 0 <= Std < 180.

    The direction of most power, after the power by direction has been blurred by 3°; a single wave is found exactly.
    Of an isotropic surface it says nothing (look at Str); of two equal lays it gives one.

    Notes
    -----
    ISO 25178-2 measures the maximum of the angular spectrum itself, which is across the lay: 90° from this.
    """
    count = 720
    sector, angle = _sectors(spectrum, count)
    weights = spectrum.power.ravel()
    power = _totals(sector, weights, count)
    lean = _totals(sector, weights * (angle - sector * np.pi / count), count)
    angles = np.arange(count) * np.pi / count + np.divide(lean, power, out=np.zeros(count), where=power > 0)
    concentration = 1 / (2 * np.radians(LAY_WIDTH)) ** 2

    def blurred(at: Array) -> NDArray[np.complex128]:
        kernel = np.exp(concentration * (np.cos(2 * np.subtract.outer(at, angles)) - 1))
        vectors: NDArray[np.complex128] = (kernel * power) @ np.exp(2j * angles)
        return vectors

    grid = np.arange(count) * np.pi / count
    lay = grid[np.argmax((blurred(grid) * np.exp(-2j * grid)).real)]
    for _ in range(100):
        lay = np.angle(blurred(np.array([lay]))[0]) / 2
    return float(np.degrees(lay) % 180.0 % 180.0)


def _sectors(spectrum: PowerSpectrum, count: int) -> tuple[NDArray[np.intp], Array]:
    """Sector of each wave vector's lay, and the angle of the lay near the middle of its sector, radians."""
    fx, fy = spectrum.frequencies
    angle = (np.arctan2.outer(-fx, fy) % np.pi).ravel()
    nearest = np.rint(angle * count / np.pi).astype(np.intp)
    wrapped = nearest == count
    angle[wrapped] -= np.pi
    nearest[wrapped] = 0
    return nearest, angle


def _totals(group: NDArray[np.intp], weights: Array, count: int = 0) -> Array:
    """Sum of the weights in each group."""
    return np.bincount(group, weights=weights, minlength=count).astype(np.float64)
