"""Flow factors by Patir and Cheng: the gap in a box with closed sides."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.box import Box, Flow
from roughfilm.rom.homogenization.cell import CELL_TOLERANCE
from roughfilm.rom.homogenization.conductance import FaceRule, faces, without_traces
from roughfilm.rom.homogenization.flow_factors import checked_gap
from roughfilm.rom.homogenization.paths import sealed_between_ends
from roughfilm.rom.multigrid.multigrid import Multigrid, Solved


@dataclass(frozen=True, kw_only=True)
class PatirCheng:
    """Patir and Cheng's counterparts of A₁₁, A₂₂ and B₁ of :class:`FlowFactors`; A₁₂ and B₂ have none.

    Flow per width along x is (u/2) ``shear`` − ``pressure[0]`` ∂p/∂x/(12η), along y − ``pressure[1]`` ∂p/∂y/(12η).

    Attributes
    ----------
    mean_gap : ĥ, m.
    pressure : φ₁ĥ³ and φ₂ĥ³, shape (2,), m³; 0 in a direction in which the box is sealed.
    shear : ĥ + σφ_s, m.
    sealed : whether no open path leads through the box from end to end in x, and in y.
    iterations : conjugate-gradient iterations of both problems.
    residual : the larger recomputed residual of the two, relative to its right-hand side.
    """

    mean_gap: float
    pressure: Array
    shear: float
    sealed: tuple[bool, bool]
    iterations: int
    residual: float

    @property
    def relative(self) -> Self:
        """The factors over those of a smooth film of the mean gap: φ₁, φ₂ and 1 + σφ_s/ĥ."""
        return self.scaled(1 / self.mean_gap)

    def scaled(self, factor: float) -> Self:
        """The factors of the gap multiplied by ``factor``."""
        return replace(
            self, mean_gap=self.mean_gap * factor, pressure=self.pressure * factor**3, shear=self.shear * factor
        )


def patir_cheng(
    gap: ArrayLike,
    spacing: tuple[float, float],
    *,
    rule: FaceRule = FaceRule.LINEAR,
    tolerance: float = CELL_TOLERANCE,
) -> PatirCheng:
    """Pressure and shear flow factors of a box of one period with given end pressures and closed sides.

    φ₁ĥ³ = <h³ ∂₁ψ₁> with ∇·(h³∇ψ₁) = 0, ψ₁ = 0 at x = 0 and ψ₁ = Lx at x = Lx, ∂₂ψ₁ = 0 at y = 0 and y = Ly; φ₂ with x
    and y exchanged. ĥ + σφ_s = <h − h³∂₁p> with ∇·(h³∇p) = ∂₁h, p = 0 at x = 0 and x = Lx and the same sides, which is
    <h ∂₁ψ₁> by the symmetry of the problem.

    The ends and the sides pass through the nodes at x = 0, y = 0 and their copies one period on. The box therefore has
    every face of the cell once (half of those along a side on either side) and differs from the cell in its boundary
    conditions only. Where h is even in x and in y about the first node, it has the cell's A₁₁, A₂₂ and B₁ on any grid;
    otherwise it is second-order accurate in the spacing where the gap is smooth and open.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period. Nodes where h = 0 are contact, whose faces are closed.
    spacing : (dx, dy), m; pixels need not be square.
    tolerance : largest residual relative to the right-hand side.

    Raises
    ------
    InputError
        As in ``flow_factors``.
    ConvergenceError
        If a problem does not meet the tolerance.

    Sources: Patir and Cheng, J. Lubr. Technol. 100 (1978) 12, doi:10.1115/1.3453103; 101 (1979) 220,
    doi:10.1115/1.3453329. Sahlin 2008, E.46 to E.52 (one of E.49 to E.51 has the wrong sign: as printed, 1 + σφ_s of a
    transverse profile would be 2 − <h⁻²>/<h⁻³> at a mean gap of 1).
    """
    checked = checked_gap(gap, spacing)
    scale = float(checked.mean())
    h = without_traces(checked / scale)
    parts = faces(h, rule)
    dx, dy = spacing
    along, first = _solved(parts.east, parts.north, dy / dx, tolerance)
    across, second = _solved(parts.north.T, parts.east.T, dx / dy, tolerance)
    flows = np.array([along.through * dx / dy / h.shape[1], across.through * dy / dx / h.shape[0]])
    closed = tuple(sealed_between_ends(gap, joined=False) for gap in (h, h.T))
    drag = _lengthened(parts.drag)
    made = PatirCheng(
        mean_gap=1.0,
        pressure=np.where(closed, 0.0, flows),
        shear=0.0 if closed[0] else float((drag * along.gradient).sum() / h.size),
        sealed=(closed[0], closed[1]),
        iterations=first.iterations + second.iterations,
        residual=max(first.residual, second.residual),
    )
    return made.scaled(scale)


def _solved(along: Array, across: Array, aspect: float, tolerance: float) -> tuple[Flow, Solved]:
    """Flow in the first direction, in units of the spacing along it; ``aspect`` is dy/dx."""
    north = np.zeros((along.shape[0], along.shape[1] + 1))
    north[:, :-1] = across / aspect
    box = Box(east=_lengthened(along) * aspect, north=north, joined=False)
    matrix = box.matrix()
    solved = Multigrid(matrix.centre, matrix.east, matrix.north).solve(box.source(), tolerance=tolerance)
    return box.flow(solved.solution), solved


def _lengthened(part: Array) -> Array:
    """Faces along the flow, with half of those of the first column at either side of the box."""
    longer = np.concatenate([part, part[:, :1]], axis=1)
    longer[:, [0, -1]] /= 2
    return longer
