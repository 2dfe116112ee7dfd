"""Flow through a box of one period between two reservoirs, with closed or periodic sides."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.solvers import Matrix


@dataclass(frozen=True, kw_only=True)
class Box:
    """Conductances of the faces of a box with flow along the first axis, lengths in spacings along it.

    The unknown ψ is the pressure minus that of a uniform film, at a mean gradient of 1: ψ = 0 on line 0, one reservoir,
    and on its copy one period on, the other; the lines between are unknown.

    Attributes
    ----------
    east : conductances from each line to the next, shape (n, m), the last to the copy of line 0.
    north : conductances from column to column, shape (n, m); those of line 0 have no effect, and those of the last
        column lead to the first if the sides are joined.
    joined : whether the box is periodic across the flow; if not, its sides are closed.
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
        """The residual of a uniform gradient at the nodes of the inner lines, shape (n − 1, m)."""
        return np.diff(self.east, axis=0)

    def whole(self) -> float:
        """The energy of a uniform gradient."""
        return float(self.east.sum())

    def flow(self, inside: Array) -> "Flow":
        """The flow of ψ on the inner lines, shape (n − 1, m)."""
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
    """Flow through a box.

    Attributes
    ----------
    through : total flow at a mean gradient of 1, computed as an energy, whose error is the square of that of ψ.
    gradient : gradient along the flow on the faces of ``Box.east``.
    uneven : lower bound on the decrease of ``through`` if the flow were equal through all cross sections.
    """

    through: float
    gradient: Array
    uneven: float
