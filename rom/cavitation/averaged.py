"""What averaged roughness brings to a film beside its resistance: drag at the nodes, flow across, friction."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

BESIDE = (-0.25, 0.25)
"""Of the spacings before and behind a node, where what lies across from it is sampled."""


@dataclass(frozen=True, kw_only=True)
class Averaged:
    """Coefficients of averaged roughness over a grid, shape (nx, ny), of second order.

    Attributes
    ----------
    drag : B₁ of the nodes, m.
    cross : A₁₂ of the cells between (i, j) and (i+1, j+1), m³; 0 behind the last node.
    drag_across : B₂ of the faces towards j+1, m.
    wet, streaming : friction over ηu of the faces towards i+1, 1/m: d + 3e of a film, and, times ξ, that of streamers.
    torn : of the faces towards i+1, the filled part below which no film is left on the tips of the roughness: there the
        liquid goes as far as the least gap lets it, ξ B₁ = min h.
    torn_across : the same of the faces towards j+1.
    """

    drag: Array
    cross: Array
    drag_across: Array
    wet: Array
    streaming: Array
    torn: Array
    torn_across: Array


def averaged(shape: Shape, roughness: FactorsOverGap, grid: Grid) -> Averaged:
    """Sample the factors; ends of x lie inside the film."""

    def at(x: Array, y: Array) -> GapFactors:
        return roughness(shape.thickness(*np.broadcast_arrays(x, y)))

    x, dx, y = grid.x[:, None], grid.spacing_x[:, None], grid.y
    before = np.append(grid.spacing_x[-1], grid.spacing_x[:-1])[:, None]
    sides = (x + BESIDE[0] * before, x + BESIDE[1] * dx)
    ahead = at(x + dx / 2, y)
    cross, drag_across, torn_across = (np.zeros(grid.shape) for _ in range(3))
    if y.size > 1:
        middle = y + grid.spacing_y / 2
        cross = at(x + dx / 2, middle).cross
        cross[-1 if not grid.spacing_x[-1] else grid.x.size :] = 0
        found = [at(side, middle) for side in sides]
        drag_across = np.mean([one.drag_across for one in found], axis=0)
        torn_across = np.mean([_torn(one) for one in found], axis=0)
    return Averaged(
        drag=np.mean([at(side, y).drag for side in sides], axis=0),
        cross=cross,
        drag_across=drag_across,
        wet=ahead.couette + 3 * ahead.shear_couette,
        streaming=ahead.streaming,
        torn=_torn(ahead),
        torn_across=torn_across,
    )


def _torn(factors: GapFactors) -> Array:
    return np.asarray(np.clip(factors.least / np.where(factors.drag > 0, factors.drag, np.inf), 0.0, 1.0 - 1e-9))
