"""Walls that move as rigid bodies: the coordinates by which a bearing's film thickness is linear."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Part


@dataclass(frozen=True, kw_only=True)
class RigidWall:
    """The coordinates q of a wall that moves as a rigid body, h = h₀ + Σ q_k n_k(x, y).

    Attributes
    ----------
    names : name of each coordinate, such as "eccentricity_x".
    normals : ∂h/∂q_k at positions of the film.
    unit : size of each coordinate by which it is made dimensionless, m, or rad of an angle.
    place : the coordinates of the geometry; 0 where they are sought.
    turns : whether each coordinate is an angle.
    """

    names: tuple[str, ...]
    normals: tuple[Callable[[Array, Array], Array], ...]
    unit: Array
    place: Array
    turns: NDArray[np.bool_]

    def first(self, count: int) -> Self:
        """The first coordinates alone; the others stay where they are."""
        return replace(
            self,
            names=self.names[:count],
            normals=self.normals[:count],
            unit=self.unit[:count],
            place=self.place[:count],
            turns=self.turns[:count],
        )


class MovingWall(Part):
    """The shape of a film one wall of which moves freely as a rigid body: a shaft, or a pad about its pivot."""

    @property
    def wall(self) -> RigidWall:
        """The coordinates of the wall; InputError if a load determines them and no start is chosen."""
        raise NotImplementedError

    def at(self, place: Array) -> Self:
        """The same shape at the coordinates of its wall."""
        raise NotImplementedError

    @property
    def tilted(self) -> bool:
        """Whether the tilts of pads are given."""
        raise NotImplementedError

    @property
    def symmetric(self) -> bool:
        """Whether the film is symmetric about the middle of its width."""
        raise NotImplementedError

    def gaps(self) -> Iterator[tuple[float, float]]:
        """Where gaps without a film begin and end along the sliding, m."""
        raise NotImplementedError
