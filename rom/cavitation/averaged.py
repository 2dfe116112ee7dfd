"""Coefficients of averaged roughness beside its resistance: drag at the nodes, flow across, friction."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

BESIDE = (-0.25, 0.25)
"""Positions, in spacings before and behind a node, at which its coefficients are sampled."""


@dataclass(frozen=True, kw_only=True)
class Averaged:
    """Coefficients of averaged roughness on a grid, shape (nx, ny), second-order accurate.

    Attributes
    ----------
    drag : B₁ at the nodes, m.
    cross : A₁₂ of the cells between (i, j) and (i+1, j+1), m³; 0 behind the last node.
    drag_across : B₂ at the faces towards j+1, m.
    wet : friction over ηu of a film at the faces towards i+1, d + 3e, 1/m.
    streaming : friction over ηu and ξ of streamers at these faces, 1/m.
    threshold : ξ₀ at these faces: below this filling fraction no film covers the tips of the roughness, since the
        liquid then passes through the smallest gap, ξ₀ B₁ = min h.
    threshold_across : ξ₀ at the faces towards j+1.
    """

    drag: Array
    cross: Array
    drag_across: Array
    wet: Array
    streaming: Array
    threshold: Array
    threshold_across: Array


def averaged(shape: Shape, roughness: FactorsOverGap, grid: Grid) -> Averaged:
    """The coefficients on a grid, sampled inside the film at its ends in x."""

    def at(x: Array, y: Array) -> GapFactors:
        return roughness(shape.thickness(*np.broadcast_arrays(x, y)))

    x, dx, y = grid.x[:, None], grid.spacing_x[:, None], grid.y
    before = np.append(grid.spacing_x[-1], grid.spacing_x[:-1])[:, None]
    sides = (x + BESIDE[0] * before, x + BESIDE[1] * dx)
    ahead = at(x + dx / 2, y)
    cross, drag_across, threshold_across = (np.zeros(grid.shape) for _ in range(3))
    if y.size > 1:
        middle = y + grid.spacing_y / 2
        cross = at(x + dx / 2, middle).cross
        cross[-1 if not grid.spacing_x[-1] else grid.x.size :] = 0
        beside = [at(side, middle) for side in sides]
        drag_across = np.mean([one.drag_across for one in beside], axis=0)
        threshold_across = np.mean([_threshold(one) for one in beside], axis=0)
    return Averaged(
        drag=np.mean([at(side, y).drag for side in sides], axis=0),
        cross=cross,
        drag_across=drag_across,
        wet=ahead.couette + 3 * ahead.shear_couette,
        streaming=ahead.streaming,
        threshold=_threshold(ahead),
        threshold_across=threshold_across,
    )


def _threshold(factors: GapFactors) -> Array:
    return np.asarray(np.clip(factors.least / np.where(factors.drag > 0, factors.drag, np.inf), 0.0, 1.0 - 1e-9))
