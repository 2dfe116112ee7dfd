"""The elastic half-space on a grid: displacement from pressure, and pressure from displacement, by FFT."""

import math
from typing import Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.love import influence
from roughfilm.contact.mechanics.transforms import Filter

Boundary = Literal["periodic", "free"]


def periodic_response(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Modes 2/|q| of displacement over pressure for E* = 1, and 0 for the mean; shape (nx, ny // 2 + 1), m."""
    qx, qy = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0]), 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qx[:, None], qy[None, :])
    q[0, 0] = math.inf
    return np.asarray(2 / q)


class HalfSpace:
    """u = K ∗ p over a grid of nodes, periodic, or free by a convolution on a grid twice as long both ways.

    Transforms in single precision serve the iterations, one in double precision the residual. The former read the flat
    arrays ``step`` and ``source`` and write ``image``.

    Parameters
    ----------
    shape : nodes (nx, ny) of the whole grid; for the free boundary at least twice those of the surface.
    spacing : (dx, dy) in any unit of length; the displacement is for E* = 1 in the same unit.
    boundary : "periodic": the mode of wave vector q answers 2/(E* |q|), the mean not at all; "free": uniformly loaded
        rectangles, or strips in line contact.
    team : that shares a transform.
    """

    def __init__(
        self, shape: tuple[int, int], spacing: tuple[float, float], boundary: Boundary, team: Team | None = None
    ) -> None:
        import pyfftw  # slow to import

        team = team or Team(1)
        self.shape = shape
        grids = [pyfftw.empty_aligned(shape, "float32") for _ in range(3)]
        self._single = Filter(grids[:2], grids[2], team)
        self._grid = pyfftw.empty_aligned(shape, "float64")
        self._double = Filter([self._grid], self._grid, team)
        for grid in grids:
            grid[:] = 0
        self.step, self.source, self.image = (grid.reshape(-1) for grid in grids)

        response = periodic_response(shape, spacing)
        response[0, 0] = math.inf
        inverse = 1 / response
        if boundary == "free":
            inverse[0, 0] = inverse.ravel()[1:].min()
            response = influence(shape, spacing)
        else:
            response[0, 0] = 0
        self._response, self._inverse = self._double.cut(response), self._double.cut(inverse)
        self._response_single, self._inverse_single = self._single.cut(response), self._single.cut(inverse)

    def displace(self) -> None:
        """``image`` = K ∗ ``step``."""
        self._single.apply(0, self._response_single)

    def precondition(self) -> None:
        """``image`` becomes the pressure that would make ``source`` the displacement, were every node in contact."""
        self._single.apply(1, self._inverse_single)

    def displacement(self, pressure: Array) -> Array:
        """K ∗ p in double precision, of the shape of ``pressure``, which may be a part of the grid.

        It is good until the next transform in double precision, which is written over it.
        """
        return self._in_double(pressure, self._response)

    def pressure(self, displacement: Array) -> Array:
        """The pressure of zero mean that makes a displacement, in double precision (periodic only); good as long."""
        return self._in_double(displacement, self._inverse)

    def _in_double(self, values: Array, factors: list[list[Array]]) -> Array:
        part = tuple(slice(n) for n in values.shape)
        if values.shape != self.shape:
            self._grid[:] = 0
        self._grid[part] = values
        self._double.apply(0, factors)
        return np.asarray(self._grid[part])
