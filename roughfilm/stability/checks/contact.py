"""Whether a pressure is that of a contact, told by NumPy alone: none of the solver's code is asked."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def displacement(pressure: Array, spacing: tuple[float, float], composite_modulus: float) -> Array:
    """Of the periodic half-space, without its mean: 2/(E* |q|) of every wave; shape to shape, m."""
    waves = [2 * math.pi * np.fft.fftfreq(n, step) for n, step in zip(pressure.shape, spacing, strict=True)]
    number = np.hypot(*np.meshgrid(*waves, indexing="ij"))
    number[0, 0] = math.inf
    return np.asarray(np.fft.ifft2(2 / (composite_modulus * number) * np.fft.fft2(pressure)).real)


def rms_slope(heights: Array, spacing: tuple[float, float]) -> float:
    """Of the periodic surface through the heights, by all its waves."""
    waves = [2 * math.pi * np.fft.fftfreq(n, step) for n, step in zip(heights.shape, spacing, strict=True)]
    number = np.hypot(*np.meshgrid(*waves, indexing="ij"))
    return float(np.sqrt(np.sum(number**2 * np.abs(np.fft.fft2(heights, norm="forward")) ** 2)))


def broken_conditions(
    pressure: Array,
    heights: Array,
    spacing: tuple[float, float],
    *,
    composite_modulus: float,
    hardness: float,
    load: float,
) -> float:
    """By how much the worst node breaks the conditions of contact; infinite if the pressure itself cannot be.

    The gap under the plane, h1 + u − g00, must be 0 where 0 < p < H, at least 0 where p = 0, at most 0 where p = H. The
    plane is laid where the worst is least. Over the rms height, or for a flat surface over P L/E*.
    """
    if pressure.shape != heights.shape or not np.isfinite(pressure).all():
        return math.inf
    if pressure.min() < 0 or pressure.max() > hardness * (1 + 1e-12) or abs(pressure.mean() / load - 1) > 1e-9:
        return math.inf
    gap = displacement(pressure, spacing, composite_modulus) - (heights - heights.mean())
    lower = gap[pressure < hardness]  # the plane may not lie above these
    upper = gap[pressure > 0]  # nor below these
    worst = (float(upper.max()) - float(lower.min())) / 2 if lower.size and upper.size else 0.0
    length = max(n * step for n, step in zip(heights.shape, spacing, strict=True))
    return max(worst, 0.0) / (float(heights.std()) or load * length / composite_modulus)
