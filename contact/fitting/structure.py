"""Properties of windows beyond spectrum and height distribution: scratches, plateaus and periodic grooves."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.distribution import with_heights_of

DIRECTIONS = 36
"""Number of directions over 180 degrees in which heights are projected."""

ITERATIONS = 15
"""Largest number of iterations of a surrogate."""


def surrogate(cell: Surface, seed: int) -> Surface:
    """A surface with the power of each wave and the sorted heights of a cell, and random phases.

    It is a sample of the field that spectrum and height distribution describe alone. Source: Schreiber and Schmitz,
    doi:10.1103/PhysRevLett.77.635.

    Parameters
    ----------
    cell : periodic.
    seed : 0 or more.
    """
    waves = scipy.fft.rfft2(cell.heights)
    noise = scipy.fft.rfft2(np.random.default_rng(seed).standard_normal(cell.shape))
    heights = scipy.fft.irfft2(np.abs(waves) * noise / np.abs(noise), s=cell.shape)
    ordered = np.sort(cell.heights, axis=None)
    return with_heights_of(cell.with_heights(heights), lambda _: ordered, iterations=ITERATIONS)


def kurtosis_of_projections(cell: Surface) -> tuple[float, float]:
    """The largest kurtosis of the heights projected along a direction, and this direction, degrees from x towards y.

    A projection is the mean height in strips one pixel wide within the largest circle, over the square root of its
    expected variance; for a Gaussian field the kurtosis is near 3, for a straight scratch far above it.
    """
    (nx, ny), (dx, dy) = cell.shape, cell.spacing
    x, y = np.meshgrid((np.arange(nx) - (nx - 1) / 2) * dx, (np.arange(ny) - (ny - 1) / 2) * dy, indexing="ij")
    radius, width = min(cell.size) / 2, max(dx, dy)
    inside = np.hypot(x, y) < radius
    x, y, z = x[inside], y[inside], cell.heights[inside]
    best = (0.0, 0.0)
    for number in range(DIRECTIONS):
        angle = math.pi * number / DIRECTIONS
        strip = np.floor((y * math.cos(angle) - x * math.sin(angle) + radius) / width).astype(int)
        counts = np.bincount(strip)
        full = counts >= 0.5 * counts.max()
        means = np.bincount(strip, z)[full] / counts[full]
        means -= means.mean()
        kurtosis = float(np.mean(means**4) / np.mean(means**2) ** 2)
        best = max(best, (kurtosis, math.degrees(angle)))
    return best


def flatness_of_tops(cell: Surface) -> float:
    """The natural logarithm of the rms slope of the lower half of the heights over that of the upper half.

    It is 0 for a field that is symmetric in height, and above 0 where plateaus lie over steep valleys.
    """
    along, across = (
        ((np.roll(cell.heights, -1, axis) - np.roll(cell.heights, 1, axis)) / (2 * step)) ** 2
        for axis, step in enumerate(cell.spacing)
    )
    slopes = along + across
    upper = cell.heights > np.median(cell.heights)
    return 0.5 * math.log(float(np.mean(slopes[~upper])) / float(np.mean(slopes[upper])))


@dataclass(frozen=True, kw_only=True)
class Line:
    """The strongest group of three by three waves of a set of windows.

    Attributes
    ----------
    wavelength : of its middle, m.
    angle : direction of its ridges, degrees from x towards y, 0 <= angle < 180.
    share : power of the group over that of all waves.
    steadiness : standard deviation of this power between windows over its mean, in units of that of a Gaussian field.
    harmonic : mean cosine of the phase of the double wave against twice that of the wave, from -1 to 1, as a modulus;
        about 1/sqrt(n) for n windows of a Gaussian field.
    """

    wavelength: float
    angle: float
    share: float
    steadiness: float
    harmonic: float


def strongest_line(cells: Sequence[Surface]) -> Line:
    """The strongest group of waves of windows, whose wave number is 2 or more."""
    first = cells[0]
    nx, ny = first.shape
    waves = np.array([scipy.fft.fft2(cell.heights - cell.heights.mean(), norm="forward") for cell in cells])
    power = np.abs(waves) ** 2
    total = power.sum(axis=(1, 2))
    mean = (power / total[:, None, None]).mean(axis=0)
    groups = scipy.ndimage.uniform_filter(mean, 3, mode="wrap") * 9
    m, n = np.rint(scipy.fft.fftfreq(nx, 1 / nx)), np.rint(scipy.fft.fftfreq(ny, 1 / ny))
    slow = np.hypot(m[:, None], n[None, :]) < 2
    double = (np.abs(m)[:, None] < nx // 4) & (np.abs(n)[None, :] < ny // 4)
    i, j = np.unravel_index(int(np.argmax(np.where(double & ~slow, groups, 0.0))), groups.shape)
    near = np.ix_([(i + k) % nx for k in (-1, 0, 1)], [(j + k) % ny for k in (-1, 0, 1)])
    own = np.array([one[near].sum() for one in power])
    expected = math.sqrt(float((mean[near] ** 2).sum())) / float(mean[near].sum())
    i, j = near[0][np.argmax(mean[near]) // 3, 0], near[1][0, np.argmax(mean[near]) % 3]
    once, twice = waves[:, i, j], waves[:, int(2 * m[i]) % nx, int(2 * n[j]) % ny]
    locked = twice * np.conj(once) ** 2
    fx, fy = m[i] / first.size[0], n[j] / first.size[1]
    return Line(
        wavelength=1 / math.hypot(fx, fy),
        angle=math.degrees(math.atan2(fx, -fy)) % 180.0 % 180.0,
        share=2 * float(mean[near].sum()),
        steadiness=float(own.std() / own.mean()) / expected,
        harmonic=float(abs(np.mean(locked / np.maximum(np.abs(locked), 1e-300)))),
    )
