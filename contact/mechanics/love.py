"""The response of a half-space to uniformly loaded rectangles, for cyclic convolution on a doubled grid."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array


def influence(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Transform of the displacement due to unit pressure on one node, for E* = 1, shape (nx, ny // 2 + 1), m.

    In two dimensions u = 1/(π E*) ∫∫ dx dy / r over the rectangle dx dy of the node; in line contact (one side of one
    node) u = −2/(π E*) ∫ ln |x/D| dx over the strip, with the length D of the grid as reference. Distances are cyclic,
    so that a surface on half the grid does not interact with its images.

    Source: A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377, doi:10.1098/rsta.1929.0009; S. Liu, Q. Wang, G. Liu,
    Wear 243 (2000) 101, doi:10.1016/S0043-1648(00)00427-0.
    """
    x, y = (np.minimum(np.arange(n), n - np.arange(n)) * length for n, length in zip(shape, spacing, strict=True))
    half_x, half_y = spacing[0] / 2, spacing[1] / 2
    if 1 in shape:
        along, half, n = (x, half_x, shape[0]) if shape[1] == 1 else (y, half_y, shape[1])
        extent = n * 2 * half
        response = -2 / np.pi * (_logarithm(along + half, extent) - _logarithm(along - half, extent)).reshape(shape)
    else:
        response = np.zeros(shape)
        for sign_x in (1, -1):
            for sign_y in (1, -1):
                response += sign_x * sign_y * _corner(x[:, None] + sign_x * half_x, y[None, :] + sign_y * half_y)
        response /= np.pi
    return np.asarray(scipy.fft.rfft2(response).real)


def _corner(x: Array, y: Array) -> Array:
    """The integral of 1/r over the rectangle from the origin to (x, y), x arsinh(y/|x|) + y arsinh(x/|y|)."""
    return np.asarray(x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y)))


def _logarithm(x: Array, extent: float) -> Array:
    """The integral x (ln |x/D| − 1) of ln |x/D|."""
    return np.asarray(x * (np.log(np.abs(x) / extent) - 1))
