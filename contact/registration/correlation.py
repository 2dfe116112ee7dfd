"""Normalised cross-correlation of two surfaces at all lags, over the valid points that both have in common."""

from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError

MIN_OVERLAP = 0.25
"""Smallest number of common valid points at a lag, over that of the surface with fewer valid points."""

LOBE_FRACTION = 0.5
"""The lobe of a peak is where the correlation exceeds this fraction of it, connected with the peak."""


@dataclass(frozen=True, kw_only=True)
class Peak:
    """The lag at which two surfaces match best.

    Attributes
    ----------
    lag : pixels along x and y; pixel k of the second surface lies on pixel k + lag of the first.
    coefficient : correlation coefficient over the common points.
    false_probability : upper bound of the probability that unrelated surfaces have so high a peak.
    other : coefficient of the best lag outside the lobe of the peak, 0 if there is none.
    other_lag : that lag, pixels.
    """

    lag: tuple[int, int]
    coefficient: float
    false_probability: float
    other: float
    other_lag: tuple[int, int]


def best_lag(first: Array, first_valid: Mask, second: Array, second_valid: Mask) -> Peak:
    """The lag with the most significant correlation of two arrays of heights on grids of one spacing.

    r(t) = ⟨a b⟩ / √(⟨a²⟩ ⟨b²⟩) over the points that are valid in both at the lag t, with a and b measured from their
    means over these points. Few common points correlate by chance: lags are compared by z = √N atanh r, where N is the
    number of common points, which has the same variance at all lags of unrelated surfaces. N is at least a quarter of
    the valid points of the smaller surface.

    The variance of z is estimated from its median over all lags, so that it includes the correlation length and lay of
    both surfaces. The probability that one lag of unrelated surfaces reaches z is that of the normal distribution;
    times the number of lags it bounds the probability that any does.

    Parameters
    ----------
    first, second : heights, m, shapes (nx, ny), which may differ; without form.
    first_valid, second_valid : masks of valid points.

    Raises
    ------
    InputError
        If a surface is constant.

    Notes
    -----
    The sums over common points are computed by Fourier transforms: 12 of them on the sum of both shapes.

    References
    ----------
    D. Padfield, Masked object registration in the Fourier domain, IEEE Trans. Image Process. 21 (2012) 2706.
    """
    coefficient, count = correlation_map(first, first_valid, second, second_valid)
    allowed = count >= MIN_OVERLAP * min(first_valid.sum(), second_valid.sum())
    z = np.where(allowed, np.sqrt(count) * np.arctanh(np.clip(coefficient, -1 + 1e-12, 1 - 1e-12)), -np.inf)
    place = np.unravel_index(int(np.argmax(z)), z.shape)
    scale = float(np.median(np.abs(z[allowed]))) / 0.6745
    peak = float(coefficient[place])
    lobe = scipy.ndimage.label(allowed & (coefficient > LOBE_FRACTION * peak))[0]
    outside = np.where(allowed & (lobe != lobe[place]), coefficient, -np.inf)
    other = np.unravel_index(int(np.argmax(outside)), outside.shape)
    return Peak(
        lag=_lag(place, second.shape),
        coefficient=peak,
        false_probability=min(1.0, float(allowed.sum() * scipy.stats.norm.sf(z[place] / scale))),
        other=max(0.0, float(outside[other])),
        other_lag=_lag(other, second.shape),
    )


def correlation_map(first: Array, first_valid: Mask, second: Array, second_valid: Mask) -> tuple[Array, Array]:
    """The correlation coefficient and the number of common points at all lags.

    Returns
    -------
    coefficient : r, shape (mx, my) of the sum of both shapes less 1; entry k is that of the lag k + 1 − shape of the
        second; 0 where the heights of the common points are constant.
    count : N, of the same shape.

    Raises
    ------
    InputError
        If a surface is constant.
    """
    shape = tuple(n + m - 1 for n, m in zip(first.shape, second.shape, strict=True))
    padded = [scipy.fft.next_fast_len(n, real=True) for n in shape]
    scaled = []
    for heights, valid in ((first, first_valid), (second[::-1, ::-1], second_valid[::-1, ::-1])):
        inside = heights[valid]
        deviation = float(inside.std())
        if not deviation > 1e-12 * float(np.abs(inside).max()):
            raise InputError("registration: the heights of a surface are all the same; give a rough one")
        scaled.append((np.where(valid, (heights - inside.mean()) / deviation, 0.0), valid.astype(np.float64)))
    (a, u), (b, v) = scaled
    waves = {key: scipy.fft.rfft2(field, s=padded) for key, field in {"a": a, "u": u, "b": b, "v": v}.items()}

    def sums(one: Array, two: Array) -> Array:
        return np.asarray(scipy.fft.irfft2(one * two, s=padded)[: shape[0], : shape[1]])

    count = np.maximum(np.rint(sums(waves["u"], waves["v"])), 0.0)
    safe = np.maximum(count, 1.0)
    mean_a, mean_b = sums(waves["a"], waves["v"]) / safe, sums(waves["u"], waves["b"]) / safe
    product = sums(waves["a"], waves["b"]) / safe - mean_a * mean_b
    square_a = sums(scipy.fft.rfft2(a * a, s=padded), waves["v"]) / safe - mean_a**2
    square_b = sums(waves["u"], scipy.fft.rfft2(b * b, s=padded)) / safe - mean_b**2
    rough = (square_a > 1e-9) & (square_b > 1e-9) & (count > 1)
    scale = np.sqrt(np.where(rough, square_a * square_b, 1.0))
    return np.where(rough, product / scale, 0.0), count


def _lag(place: tuple[np.intp, ...], second: tuple[int, ...]) -> tuple[int, int]:
    i, j = (int(k) + 1 - n for k, n in zip(place, second, strict=True))
    return i, j
