"""The elastic half-space on a grid: displacement from pressure and pressure from displacement, by FFT."""

import math
from typing import Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.love import influence
from roughfilm.contact.mechanics.transforms import Filter

Boundary = Literal["periodic", "free"]


def periodic_response(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Transfer function 2/|q| from pressure to displacement for E* = 1, shape (nx, ny // 2 + 1), m; 0 for the mean."""
    qx, qy = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0]), 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qx[:, None], qy[None, :])
    q[0, 0] = math.inf
    return np.asarray(2 / q)


class HalfSpace:
    """The convolution u = K ∗ p over a grid of nodes, periodic, or free by zero padding to twice the grid.

    Iterations use transforms in single precision, which read the flat arrays ``step`` and ``source`` and write
    ``image``; residuals use transforms in double precision.

    Parameters
    ----------
    shape : number of nodes (nx, ny) of the whole grid; for the free boundary at least twice that of the surface.
    spacing : (dx, dy) in any unit of length; displacements are for E* = 1 in the same unit.
    boundary : "periodic": K has the transfer function 2/(E* |q|), 0 for the mean; "free": uniformly loaded rectangles,
        or strips in line contact.
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
        """Set ``image`` to K ∗ ``step``."""
        self._single.apply(0, self._response_single)

    def precondition(self) -> None:
        """Set ``image`` to the pressure whose displacement is ``source`` if every node is in contact."""
        self._single.apply(1, self._inverse_single)

    def displacement(self, pressure: Array) -> Array:
        """K ∗ p in double precision, same shape as ``pressure``, which may cover a part of the grid.

        The next transform in double precision overwrites the array returned.
        """
        return self._in_double(pressure, self._response)

    def pressure(self, displacement: Array) -> Array:
        """Pressure of zero mean with a given displacement, in double precision; periodic only; overwritten likewise."""
        return self._in_double(displacement, self._inverse)

    def _in_double(self, values: Array, factors: list[list[Array]]) -> Array:
        part = tuple(slice(n) for n in values.shape)
        if values.shape != self.shape:
            self._grid[:] = 0
        self._grid[part] = values
        self._double.apply(0, factors)
        return np.asarray(self._grid[part])
