"""A cell whose edges are joined, and what joining them changed."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface

Seams = tuple[Array | None, Array | None]
"""For the joints across x and across y, the position of the joint along that axis on every line of pixels across it, m
from the start of the cell; None where the joint is the edge of the cell."""


@dataclass(frozen=True, kw_only=True)
class Joined:
    """A surface with joined edges.

    Attributes
    ----------
    surface : with joined edges; periodic unless no direction was to be joined.
    weight : shape (nx, ny), weight by which a height was mixed with another one, 0 where it is as measured: the weight
        of the low-pass filtered copy, or the smaller one of the two weights at a seam.
    seams : where the opposite edges meet.
    """

    surface: Surface
    weight: Array
    seams: Seams = (None, None)

    @property
    def blended(self) -> float:
        """Fraction of the points that were mixed with others."""
        return float((self.weight > 0).mean())

    @property
    def mean_weight(self) -> float:
        """Mean of the weight over the area."""
        return float(self.weight.mean())


def seam_pixels(seams: Seams, surface: Surface) -> tuple[Array | None, Array | None]:
    """The first pixel behind each seam, on every line of pixels of a surface that covers the same cell.

    >>> surface = Surface(heights=np.eye(8, 4), spacing=(0.5, 1.0))
    >>> seam_pixels((np.array([1.0, 1.5]), None), surface)
    (array([2, 2, 3, 3]), None)
    """
    x, y = (
        None if seam is None else _pixels(seam, surface.spacing[axis], surface.shape[axis], surface.shape[1 - axis])
        for axis, seam in enumerate(seams)
    )
    return x, y


def _pixels(seam: Array, step: float, count: int, lines: int) -> Array:
    line = ((np.arange(lines) + 0.5) * seam.size / lines).astype(int)
    return np.asarray(np.rint(seam[line] / step).astype(int) % count)
