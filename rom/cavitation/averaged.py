"""What averaged roughness brings to a film beside its resistance: drag at the nodes, flow across, friction."""

from dataclasses import dataclass

import numpy as np

from rom.cavitation.grid import Grid
from rom.cavitation.shape import Shape
from rom.gap import Array
from rom.homogenization.gap_factors import FactorsOverGap, GapFactors

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
    rub, rub_empty : friction over ηu of the faces towards i+1, 1/m: d + 3e where full; d - e in a cavity, where
        no pressure adds to it, exact for ridges along and across.
    """

    drag: Array
    cross: Array
    drag_across: Array
    rub: Array
    rub_empty: Array


def averaged(shape: Shape, roughness: FactorsOverGap, grid: Grid) -> Averaged:
    """Sample the factors; ends of x lie inside the film."""

    def at(x: Array, y: Array) -> GapFactors:
        return roughness(shape.thickness(*np.broadcast_arrays(x, y)))

    x, dx, y = grid.x[:, None], grid.spacing_x[:, None], grid.y
    before = np.append(grid.spacing_x[-1], grid.spacing_x[:-1])[:, None]
    sides = (x + BESIDE[0] * before, x + BESIDE[1] * dx)
    ahead = at(x + dx / 2, y)
    cross, drag_across = np.zeros(grid.shape), np.zeros(grid.shape)
    if y.size > 1:
        middle = y + grid.spacing_y / 2
        cross = at(x + dx / 2, middle).cross
        cross[-1 if not grid.spacing_x[-1] else grid.x.size :] = 0
        drag_across = np.mean([at(side, middle).drag_across for side in sides], axis=0)
    return Averaged(
        drag=np.mean([at(side, y).drag for side in sides], axis=0),
        cross=cross,
        drag_across=drag_across,
        rub=ahead.couette + 3 * ahead.shear_couette,
        rub_empty=ahead.couette - ahead.shear_couette,
    )
