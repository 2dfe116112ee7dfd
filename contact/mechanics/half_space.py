"""The elastic half-space on a grid: displacement from pressure and pressure from displacement, by FFT."""

from typing import Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.love import influence
from roughfilm.contact.mechanics.transforms import Filter

Boundary = Literal["periodic", "free"]


def periodic_response(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Transfer function 2/|q| from pressure to displacement for E* = 1, m; infinite for the mean.

    The shape is (nx // 2 + 1, ny // 2 + 1); the modes of opposite sign have the same value.
    """
    qx, qy = (2 * np.pi * np.fft.rfftfreq(n, d) for n, d in zip(shape, spacing, strict=True))
    q = np.hypot(qx[:, None], qy[None, :])
    with np.errstate(divide="ignore"):
        return np.asarray(np.divide(2, q, out=q))


class HalfSpace:
    """The convolution u = K ∗ p over a grid of nodes, periodic, or free by zero padding to twice the grid.

    Iterations use transforms in single precision, which read the flat array ``source`` and write ``image``; residuals
    use a transform in double precision, in place in ``grid``.

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
        team = team or Team(1)
        self.shape, self.spacing = shape, spacing
        self._single = Filter(shape, "float32", team)
        self._double = Filter(shape, "float64", team, in_place=True)
        self.source, self.image = self._single.source.reshape(-1), self._single.result.reshape(-1)
        self.grid: Array = self._double.result

        response = periodic_response(shape, spacing)
        inverse = 1 / response
        if boundary == "free":
            inverse[0, 0] = inverse.ravel()[1:].min()
            response = influence(shape, spacing)[: len(inverse)]
        else:
            response[0, 0] = 0
        self._response = self._double.cut(response)
        self._response_single, self._inverse_single = self._single.cut(response), self._single.cut(inverse)

    def displace(self) -> None:
        """Set ``image`` to K ∗ ``source``."""
        self._single.apply(self._response_single)

    def precondition(self) -> None:
        """Set ``image`` to the pressure whose displacement is ``source``."""
        self._single.apply(self._inverse_single)

    def convolve(self) -> None:
        """Replace the pressure in ``grid`` by its displacement, in double precision."""
        self._double.apply(self._response)

    def displacement(self, pressure: Array) -> Array:
        """K ∗ p in double precision, same shape as ``pressure``, which may cover a part of the grid.

        The next transform in double precision overwrites the array returned.
        """
        part = tuple(slice(n) for n in pressure.shape)
        if pressure.shape != self.shape:
            self.grid[:] = 0
        self.grid[part] = pressure
        self.convolve()
        return np.asarray(self.grid[part])

    def pressure(self, displacement: Array) -> Array:
        """Pressure of zero mean with a given displacement, in double precision; periodic only; overwritten likewise."""
        self.grid[:] = displacement
        self._double.apply(self._double.cut(1 / periodic_response(self.shape, self.spacing)))
        return np.asarray(self.grid)
