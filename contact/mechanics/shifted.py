"""Pressures moved by one amount, so that, cut to their bounds, they carry the load."""

import numpy as np

from contact.surface import Array

CARRIED = 1e-14
"""The mean is met to this part of it."""

MOST_STEPS = 200


def shifted(pressure: Array, mean: float, most: float) -> Array:
    """clip(p + λ, 0, H) with the mean W: of all pressures within the bounds that carry the load the nearest to p.

    By Newton's method within a bracket: the mean grows with λ, and is straight between kinks.

    Parameters
    ----------
    pressure : p, any shape, finite.
    mean : W, above 0 and at most H.
    most : H, which may be infinite.
    """
    low = -float(pressure.max())
    high = min(mean, most) - float(pressure.min())
    shift = min(max(0.0, low), high)
    for _ in range(MOST_STEPS):
        moved = pressure + shift
        kept = np.clip(moved, 0.0, most)
        missing = mean - float(kept.mean())
        if abs(missing) <= CARRIED * mean or not low < high:
            break
        if missing > 0:
            low = shift
        else:
            high = shift
        inside = np.count_nonzero(kept == moved)
        following = shift + missing * pressure.size / inside if inside else (low + high) / 2
        shift = following if low < following < high else (low + high) / 2
        if shift in (low, high):
            break
    return kept
