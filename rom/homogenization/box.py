"""A box of one period between two reservoirs: pressure is given at its ends, and its sides are closed or joined."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.solvers import Matrix


@dataclass(frozen=True, kw_only=True)
class Box:
    """The faces of a box, its flow in the first direction, lengths in spacings along it.

    With ψ the pressure less what it would be in a uniform film, at a mean gradient of 1: ψ = 0 on line 0, which is one
    reservoir, and on its copy one period on, which is the other; the lines between are unknown.

    Attributes
    ----------
    east : what the faces from each line to the next let through, shape (n, m), the last to the copy of line 0.
    north : the same from column to column, shape (n, m), of which those of line 0 count for nothing; the last column's
        lead round to the first if the sides are joined.
    joined : whether the box is periodic across the flow; if not, nothing gets out of its sides.
    """

    east: Array
    north: Array
    joined: bool

    def matrix(self) -> Matrix:
        """K of ∇·(h³∇ψ) on the lines between the ends, shape (n − 1, m)."""
        east, north = self.east, self.north[1:]
        centre = east[:-1] + east[1:] + north
        centre[:, 1:] += north[:, :-1]
        if self.joined:
            centre[:, 0] += north[:, -1]
        centre[centre == 0] = 1.0
        return Matrix(centre=centre, east=east[1:], north=north, periodic=(False, self.joined))

    def source(self) -> Array:
        """What a uniform gradient leaves at the nodes of the lines between, shape (n − 1, m)."""
        return np.diff(self.east, axis=0)

    def whole(self) -> float:
        """The energy of a uniform gradient."""
        return float(self.east.sum())

    def flow(self, inside: Array) -> "Flow":
        """What ψ on the lines between, shape (n − 1, m), drives."""
        psi = np.pad(inside, ((1, 1), (0, 0)))
        gradient = np.diff(psi, axis=0)
        gradient += 1
        aside = np.roll(inside, -1, axis=1) - inside if self.joined else np.diff(inside, axis=1, append=0.0)
        if not self.joined:
            aside[:, -1] = 0.0
        through = self.east * gradient
        sections, widths = through.sum(axis=1), self.east.sum(axis=1)
        energy = float((through * gradient).sum() + (self.north[1:] * aside**2).sum())
        mean = energy / len(sections)
        uneven = float(np.divide((sections - mean) ** 2, widths, out=np.zeros_like(widths), where=widths > 0).mean())
        return Flow(through=mean, gradient=gradient, uneven=uneven)


@dataclass(frozen=True, kw_only=True)
class Flow:
    """Of a box.

    Attributes
    ----------
    through : the flow through all of its width at a mean gradient of 1: an energy, whose error is the square of ψ's.
    gradient : along the flow, on the faces of ``Box.east``.
    uneven : by how much ``through`` would fall at least if every section were to let the same through.
    """

    through: float
    gradient: Array
    uneven: float
