"""The cell problems of one periodic gap on its own grid."""

from dataclasses import dataclass

import numpy as np

from rom.gap import Array
from rom.homogenization.conductance import FaceRule, Faces, faces, without_traces
from rom.homogenization.factors import FlowFactors
from rom.homogenization.paths import sealed
from rom.multigrid.multigrid import Multigrid


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A solved cell.

    Attributes
    ----------
    factors : of the gap.
    correctors : χ₁, χ₂, χ₃, shape (3, nx, ny): χ₁ and χ₂ in m, χ₃ in 1/m (of pressure over 6ηu).
    iterations : of conjugate gradients, all three problems together.
    residual : the largest of the three, recomputed, over its right-hand side.
    """

    factors: FlowFactors
    correctors: Array
    iterations: int
    residual: float


def solve_cell(
    gap: Array,
    spacing: tuple[float, float],
    *,
    rule: FaceRule = FaceRule.LINEAR,
    tolerance: float = 1e-8,
    start: Array | None = None,
) -> Cell:
    """Solve ∇·(h³(e_i + ∇χ_i)) = 0 and ∇·(h e₁ − h³∇χ₃) = 0, all periodic, on the nodes of a gap.

    A_ij = <h³(e_i + ∇χ_i)·(e_j + ∇χ_j)>, whose error is the square of that of χ; B_i = <h(δ_1i + ∂₁χ_i)>; d = <1/h>;
    e = <h ∂₁χ₃>.

    Parameters
    ----------
    gap : h >= 0, shape (nx, ny), m; one period. Nodes where h = 0 are contact: nothing flows there.
    spacing : (dx, dy), m.
    tolerance : of the residuals over their right-hand sides.
    start : correctors of a gap much alike, shape (3, nx, ny), in the units of :class:`Cell`.

    Raises
    ------
    ConvergenceError
        If a tolerance is not met.
    """
    scale = float(gap.mean())
    h = without_traces(gap / scale)
    parts = faces(h, rule)
    dx, dy = spacing
    aspect = dy / dx
    east, north = parts.east * aspect, parts.north / aspect
    centre = east + np.roll(east, 1, axis=0) + north + np.roll(north, 1, axis=1)
    matrix = Multigrid(centre, east, north, periodic=(True, True))
    sources = [
        (east - np.roll(east, 1, axis=0)) * dx,
        (north - np.roll(north, 1, axis=1)) * dy,
        -(parts.drag - np.roll(parts.drag, 1, axis=0)) * dy,
    ]
    units = (1.0, 1.0, scale**-2)
    solved = [
        matrix.solve(b, tolerance=tolerance, start=None if start is None else start[i] / units[i])
        for i, b in enumerate(sources)
    ]
    correctors = [one.solution for one in solved]
    return Cell(
        factors=_factors(h, parts, spacing, correctors, sealed(h)).scaled(scale),
        correctors=np.array([chi * unit for chi, unit in zip(correctors, units, strict=True)]),
        iterations=sum(one.iterations for one in solved),
        residual=max(one.residual for one in solved),
    )


def _factors(
    h: Array, parts: Faces, spacing: tuple[float, float], correctors: list[Array], closed: tuple[bool, bool]
) -> FlowFactors:
    dx, dy = spacing
    along = [(np.roll(chi, -1, axis=0) - chi) / dx for chi in correctors]
    across = [(np.roll(chi, -1, axis=1) - chi) / dy for chi in correctors]
    along[0] += 1.0
    across[1] += 1.0
    open_to = ~np.array(closed)
    pressure = np.array(
        [
            [(parts.east * along[i] * along[j]).mean() + (parts.north * across[i] * across[j]).mean() for j in (0, 1)]
            for i in (0, 1)
        ]
    )
    shear = np.array([(parts.drag * along[i]).mean() for i in (0, 1)])
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = np.where(parts.east > 0, parts.inverse - parts.drag * parts.drag / parts.east, 0.0)
    return FlowFactors(
        mean_gap=float(h.mean()),
        pressure=pressure * np.outer(open_to, open_to),
        shear=shear * open_to,
        couette=float(parts.inverse.mean()),
        shear_couette=float((parts.drag * along[2]).mean() + inside.mean()),
        sealed=closed,
    )
