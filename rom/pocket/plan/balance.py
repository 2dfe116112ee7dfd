"""Periodic pressures over a cell in plan whose flows between the columns balance given flows."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array

MAX_ITERATIONS = 1000
"""Largest number of iterations."""

TOLERANCE = 1e-11
"""Imbalance of a column over the largest flow into one, both scaled, at which the iteration stops."""


class Balance:
    """The equations Σ conductance (p - p of the neighbour) = flow into each column, periodic, and their solver.

    Conjugate gradients with the diagonal scaled to 1 are preconditioned by the equations of the mean scaled
    conductances, which Fourier transforms solve. The number of iterations hardly depends on the number of columns.

    Parameters
    ----------
    east, north : conductances > 0 to the next column along and across, shape (nx, ny).
    """

    def __init__(self, east: Array, north: Array) -> None:
        self._scale = 1 / np.sqrt(east + np.roll(east, 1, axis=0) + north + np.roll(north, 1, axis=1))
        self._east = east * self._scale * np.roll(self._scale, -1, axis=0)
        self._north = north * self._scale * np.roll(self._scale, -1, axis=1)
        nx, ny = east.shape
        along = 2 * self._east.mean() * (1 - np.cos(2 * np.pi * np.arange(nx) / nx))
        across = 2 * self._north.mean() * (1 - np.cos(2 * np.pi * np.arange(ny // 2 + 1) / ny))
        symbol = along[:, None] + across
        symbol[0, 0] = np.partition(symbol.ravel(), 1)[1]
        self._inverse = 1 / symbol
        self._constant = 1 / (self._scale * np.linalg.norm(1 / self._scale))

    def pressure(self, into: Array) -> tuple[Array, int]:
        """The pressure for a flow into each column, whose sum is 0, and the number of iterations.

        The iteration stops at round-off: the caller judges the residual. The pressure is determined up to a constant.
        """
        rest = self._without_constant(into * self._scale)
        found = np.zeros_like(rest)
        goal = TOLERANCE * float(np.abs(rest).max())
        direction, before = np.zeros_like(rest), 1.0
        for iteration in range(MAX_ITERATIONS):
            if not float(np.abs(rest).max()) > goal:
                return found * self._scale, iteration
            changed = self._without_constant(scipy.fft.irfft2(scipy.fft.rfft2(rest) * self._inverse, s=rest.shape))
            now = _product(rest, changed)
            direction = changed + (now / before if iteration else 0.0) * direction
            image = self._image(direction)
            stride = now / _product(direction, image)
            found, rest, before = found + stride * direction, rest - stride * image, now
        return found * self._scale, MAX_ITERATIONS

    def _without_constant(self, values: Array) -> Array:
        return np.asarray(values - self._constant * _product(self._constant, values))

    def _image(self, values: Array) -> Array:
        found = values.copy()
        for coupling, own, image in ((self._east, values, found), (self._north.T, values.T, found.T)):
            image[:-1] -= coupling[:-1] * own[1:]
            image[1:] -= coupling[:-1] * own[:-1]
            image[-1] -= coupling[-1] * own[0]
            image[0] -= coupling[-1] * own[-1]
        return np.asarray(found)


def _product(one: Array, other: Array) -> float:
    """The sum of products; the threads of BLAS would cost more than they save here."""
    return float(np.einsum("ij,ij->", one, other))


def outflow(along: Array, across: Array) -> Array:
    """The flow out of each column, of the flows through the faces towards greater x and y, shape (nx, ny)."""
    return np.asarray(along - np.roll(along, 1, axis=0) + across - np.roll(across, 1, axis=1))
