"""Deviations of a surface from the isotropic Gaussian ones that statistical theories of contact describe."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array

MAX_SLOPE_RATIO = 1.5
"""Largest ratio of rms slopes across and along a lay of a surface that counts as one without a lay."""

MAX_SKEWNESS = 0.7
"""Largest skewness of heights that count as Gaussian."""


def skewed(heights: Array) -> str | None:
    """A sentence on a skewness of heights beyond ``MAX_SKEWNESS``, or None; the shape of ``heights`` is (nx, ny)."""
    z = heights - heights.mean()
    skewness = float(np.mean(z**3) / np.mean(z**2) ** 1.5)
    if abs(skewness) <= MAX_SKEWNESS:
        return None
    limit = f"beyond ±{MAX_SKEWNESS:g}, and the theory is for Gaussian heights"
    return f"the skewness of the heights is {skewness:.2g}, {limit}"


def with_lay(heights: Array, spacing: tuple[float, float]) -> str | None:
    """A sentence on a ratio of rms slopes beyond ``MAX_SLOPE_RATIO``, or None.

    Parameters
    ----------
    heights : z, m, shape (nx, ny).
    spacing : (dx, dy), m.
    """
    x, y = ((np.roll(heights, -1, axis) - heights) / step for axis, step in enumerate(spacing))
    least, most = np.linalg.eigvalsh([[np.mean(x * x), np.mean(x * y)], [np.mean(x * y), np.mean(y * y)]])
    if most <= MAX_SLOPE_RATIO**2 * least:
        return None
    return (
        "the surface has a lay, which the theory leaves out (ratio of rms slopes across and along it above "
        f"{MAX_SLOPE_RATIO:g})"
    )
