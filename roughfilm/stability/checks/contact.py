"""The conditions of contact, recomputed by NumPy without any code of the solver."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array


def _wave_numbers(shape: tuple[int, ...], spacing: tuple[float, float]) -> Array:
    """The wave number |q| of every wave of a periodic grid, 1/m, with the given ``shape``."""
    waves = [2 * math.pi * np.fft.fftfreq(n, step) for n, step in zip(shape, spacing, strict=True)]
    return np.asarray(np.hypot(*np.meshgrid(*waves, indexing="ij")))


def displacement(pressure: Array, spacing: tuple[float, float], composite_modulus: float) -> Array:
    """The displacement of the periodic half-space without its mean, m, shape (nx, ny): û(q) = 2 p̂(q)/(E* |q|).

    Parameters
    ----------
    pressure : pressure at the nodes, Pa, shape (nx, ny).
    spacing : dx and dy, m.
    composite_modulus : E*, Pa.
    """
    number = _wave_numbers(pressure.shape, spacing)
    number[0, 0] = math.inf
    return np.asarray(np.fft.ifft2(2 / (composite_modulus * number) * np.fft.fft2(pressure)).real)


def rms_slope(heights: Array, spacing: tuple[float, float]) -> float:
    """The rms slope √(Σ |q|² |ẑ(q)|²) of the periodic surface through the heights (m, shape (nx, ny))."""
    number = _wave_numbers(heights.shape, spacing)
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
    """The largest violation of the conditions of contact at a node, over the rms height; infinite if p is impossible.

    The gap under the plane, h1 + u − g00, must be 0 where 0 < p < H, at least 0 where p = 0, at most 0 where p = H. The
    plane is placed where the largest violation is smallest. For a flat surface the violation is divided by P L/E*, with
    the longer side L. A pressure is impossible if it is not finite, is outside of 0 to H, or does not carry the load.

    Parameters
    ----------
    pressure, heights : pressures (Pa) and heights (m) at the nodes, shape (nx, ny).
    spacing : dx and dy, m.
    composite_modulus, hardness : E* and H, Pa.
    load : mean pressure P, Pa.
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
