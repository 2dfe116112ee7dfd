"""Anderson's method for a fixed point of fields, in its form for maps that are almost affine."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array

SINGULAR = 1e-12
"""Smallest eigenvalue of the normal equations over the largest one whose part of the solution counts."""


@dataclass(kw_only=True)
class AndersonAcceleration:
    """The last rests g(x) - x and images g(x) of a fixed point x = g(x), vectors.

    Attributes
    ----------
    remembered : number of earlier points from which the next one is extrapolated.
    rests : g(x) - x of these points and of the last one, in this order, or weighted values of a part of each.
    images : g(x) of the same points.
    """

    remembered: int
    rests: list[Array] = field(default_factory=list)
    images: list[Array] = field(default_factory=list)

    def following(self, rest: Array, image: Array) -> Array:
        """The combination of the images, with factors of sum 1, whose combination of the rests is least.

        For an affine g it lowers the error as GMRES does for (1 - g') x = g(0): the part of the error that lies in m
        slow modes vanishes after about m steps.

        Source: Walker and Ni 2011, doi:10.1137/10078356X.
        """
        self.rests = [*self.rests[-self.remembered :], rest]
        self.images = [*self.images[-self.remembered :], image]
        following = image.copy()
        if len(self.rests) > 1:
            for factor, (before, after) in zip(factors(self.rests), pairwise(self.images), strict=True):
                following -= factor * (after - before)
        return following


def factors(rests: Sequence[Array]) -> Array:
    """The factors a_k for which r_n - Σ a_k (r_(k+1) - r_k) of two or more rests r_0 to r_n has the least size.

    They solve the normal equations of changes of unit size, so that small changes, of the last points, count as well.
    """
    changes = np.diff(np.stack(rests), axis=0)
    sizes = np.linalg.norm(changes, axis=1)
    sizes[sizes == 0] = 1.0
    changes /= sizes[:, None]
    return np.asarray(np.linalg.lstsq(changes @ changes.T, changes @ rests[-1], rcond=SINGULAR)[0] / sizes)
