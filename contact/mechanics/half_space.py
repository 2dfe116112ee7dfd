"""The elastic half-space on a grid: displacement from pressure, and pressure from displacement, by FFT."""

import math
from typing import Literal

import numpy as np
import pyfftw
from numpy.typing import NDArray

from contact.mechanics import kernels
from contact.mechanics.love import influence
from contact.mechanics.pieces import Pieces
from contact.mechanics.transforms import plans
from contact.surface import Array

Boundary = Literal["periodic", "free"]
Single = NDArray[np.float32]


def periodic_response(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Modes 2/|q| of displacement over pressure for E* = 1, and 0 for the mean; shape (nx, ny // 2 + 1), m."""
    qx, qy = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0]), 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qx[:, None], qy[None, :])
    q[0, 0] = math.inf
    return np.asarray(2 / q)


class HalfSpace:
    """u = K ∗ p over a grid of nodes, periodic, or free by a convolution on a grid twice as long both ways.

    Transforms in single precision serve the iterations, one in double precision the residual. The flat arrays ``step``,
    ``image`` and ``source`` are what the former read and write.

    Parameters
    ----------
    shape : nodes (nx, ny) of the whole grid; for the free boundary at least twice those of the surface.
    spacing : (dx, dy) in any unit of length; the displacement is for E* = 1 in the same unit.
    boundary : "periodic": the mode of wave vector q answers 2/(E* |q|), the mean not at all; "free": uniformly loaded
        rectangles, or strips in line contact.
    threads : that share a transform.
    """

    def __init__(
        self, shape: tuple[int, int], spacing: tuple[float, float], boundary: Boundary, threads: int = 1
    ) -> None:
        modes = (shape[0], shape[1] // 2 + 1)
        self.shape = shape
        self._modes = Pieces(modes[0] * modes[1], threads)
        self._spectrum = pyfftw.empty_aligned(modes, "complex64")
        self._grids = [pyfftw.empty_aligned(shape, "float32") for _ in range(3)]
        self._plans = plans(self._grids[0], self._spectrum, threads)
        self._grid_double = pyfftw.empty_aligned(shape, "float64")
        self._spectrum_double = pyfftw.empty_aligned(modes, "complex128")
        self._plans_double = plans(self._grid_double, self._spectrum_double, threads)
        for grid in self._grids:
            grid[:] = 0
        self.step, self.image, self.source = (grid.reshape(-1) for grid in self._grids)

        response = periodic_response(shape, spacing)
        response[0, 0] = math.inf
        inverse = 1 / response
        if boundary == "free":
            inverse[0, 0] = inverse.ravel()[1:].min()
            response = influence(shape, spacing)
        else:
            response[0, 0] = 0
        nodes = shape[0] * shape[1]
        self._response = (response / nodes).reshape(-1)
        self._response_single = self._response.astype(np.float32)
        self._inverse = (inverse / nodes).reshape(-1)
        self._inverse_single = self._inverse.astype(np.float32)

    def displace(self) -> None:
        """``image`` = K ∗ ``step``."""
        step, image, _ = self._grids
        self._transform(step, self._response_single, image)

    def precondition(self) -> None:
        """``source`` becomes the pressure that would make it the displacement, were every node in contact."""
        source = self._grids[2]
        self._transform(source, self._inverse_single, source)

    def displacement(self, pressure: Array) -> Array:
        """K ∗ p in double precision, a new array of the shape of ``pressure``, which may be a part of the grid."""
        return self._transform_double(pressure, self._response)

    def pressure(self, displacement: Array) -> Array:
        """The pressure of zero mean that makes a displacement, in double precision (periodic only)."""
        return self._transform_double(displacement, self._inverse)

    def _transform_double(self, values: Array, factors: Array) -> Array:
        grid, (forward, backward) = self._grid_double, self._plans_double
        part = tuple(slice(n) for n in values.shape)
        grid[:] = 0
        grid[part] = values
        forward.execute()
        self._modes.over_all(kernels.scale_modes, self._spectrum_double.reshape(-1), factors)
        backward.execute()
        return np.array(grid[part])

    def _transform(self, grid: Single, factors: Single, result: Single) -> None:
        forward, backward = self._plans
        forward.update_arrays(grid, self._spectrum)
        forward.execute()
        self._modes.over_all(kernels.scale_modes, self._spectrum.reshape(-1), factors)
        backward.update_arrays(self._spectrum, result)
        backward.execute()
