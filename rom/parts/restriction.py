"""Restriction of heights to a coarser grid by removal of the waves that it cannot represent."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array


def restricted(heights: Array, shape: tuple[int, int]) -> Array:
    """The periodic heights z(x_i) = Σ a_k exp(i k·x_i) on a coarser grid, from waves |k_x| < nx/2, |k_y| < ny/2.

    The remaining waves are exact.

    Parameters
    ----------
    heights : heights of one period, m, shape (nx, ny).
    shape : shape of the coarser grid, in both directions at most that of the heights.
    """
    if shape == heights.shape:
        return heights
    transform = scipy.fft.rfft2(heights, norm="forward")
    coarse = np.zeros((shape[0], shape[1] // 2 + 1), dtype=complex)
    x, y = (shape[0] + 1) // 2, (shape[1] + 1) // 2
    coarse[:x, :y] = transform[:x, :y]
    if x > 1:
        coarse[-(x - 1) :, :y] = transform[-(x - 1) :, :y]
    return np.asarray(scipy.fft.irfft2(coarse, s=shape, norm="forward"))
