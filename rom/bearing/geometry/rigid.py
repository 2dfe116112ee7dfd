"""Walls that move as rigid bodies: the coordinates by which a bearing's film thickness is linear."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array


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
