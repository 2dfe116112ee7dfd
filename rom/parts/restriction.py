"""Heights on a coarser grid, by leaving out the waves that it cannot hold."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array


def restricted(heights: Array, shape: tuple[int, int]) -> Array:
    """The periodic heights on a grid of fewer points, less every wave shorter than just over two of its points.

    z(x_i) = Σ a_k exp(i k·x_i) over the waves with |k_x| < nx/2, |k_y| < ny/2 of the coarser grid, which are exact.

    Parameters
    ----------
    heights : shape (nx, ny), m, of one period.
    shape : of the coarser grid; no side longer than it was.
    """
    if shape == heights.shape:
        return heights
    transform = scipy.fft.rfft2(heights, norm="forward")
    kept = np.zeros((shape[0], shape[1] // 2 + 1), dtype=complex)
    x, y = (shape[0] + 1) // 2, (shape[1] + 1) // 2
    kept[:x, :y] = transform[:x, :y]
    if x > 1:
        kept[-(x - 1) :, :y] = transform[-(x - 1) :, :y]
    return np.asarray(scipy.fft.irfft2(kept, s=shape, norm="forward"))
