"""The cell problems of one periodic gap on its own grid."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from contact.compiled import compiled
from contact.errors import ConvergenceError
from rom.gap import Array
from rom.homogenization.conductance import FaceRule, Faces, faces, without_traces
from rom.homogenization.factors import FlowFactors
from rom.homogenization.paths import sealed
from rom.homogenization.solvers import SOLVERS, Matrix, Source

TOLERANCE = 1e-8
"""Of A; far below what any grid is good for."""


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A solved cell.

    Attributes
    ----------
    factors : of the gap.
    correctors : χ₁, χ₂, χ₃, shape (3, nx, ny): χ₁ and χ₂ in m, χ₃ in 1/m (of pressure over 6ηu); 0 for sealed ones.
    unsolved : by how much A₁₁, A₂₂ and e, over those of a smooth film of the mean gap, would change by iterating on.
    solver : which one it was.
    iterations : of conjugate gradients, all three problems together.
    residual : the largest of the three, recomputed, over its right-hand side.
    """

    factors: FlowFactors
    correctors: Array
    unsolved: Array
    solver: str
    iterations: int
    residual: float


def solve_cell(
    gap: Array,
    spacing: tuple[float, float],
    *,
    rule: FaceRule = FaceRule.LINEAR,
    tolerance: float = TOLERANCE,
    start: Array | None = None,
    solvers: Sequence[str] = tuple(SOLVERS),
) -> Cell:
    """Solve ∇·(h³(e_i + ∇χ_i)) = 0 and ∇·(h e₁ − h³∇χ₃) = 0, all periodic, on the nodes of a gap.

    A_ij = <h³(e_i + ∇χ_i)·(e_j + ∇χ_j)>, B_i = <h(δ_1i + ∂₁χ_i)>, d = <1/h>, e = <h ∂₁χ₃>. A and e are least and
    greatest energies, and B has what the residuals do to χ₃ added: their errors are squares of those of χ.

    Parameters
    ----------
    gap : h >= 0, shape (nx, ny), m; one period. Nodes where h = 0 are contact: nothing flows there.
    spacing : (dx, dy), m.
    tolerance : of what iterating on would change A₁₁ and A₂₂ by, over themselves; and e, over its part from χ₃.
    start : correctors of a gap much alike, shape (3, nx, ny), in the units of :class:`Cell`.
    solvers : names in :data:`rom.homogenization.solvers.SOLVERS`, tried in this order.

    Raises
    ------
    ConvergenceError
        If none of the solvers meets the tolerance.
    """
    scale, (dx, dy) = float(gap.mean()), spacing
    h = without_traces(gap / scale)
    parts = faces(h, rule)
    aspect = dy / dx
    east, north = parts.east * aspect, parts.north / aspect
    matrix = Matrix(centre=east + np.roll(east, 1, axis=0) + north + np.roll(north, 1, axis=1), east=east, north=north)
    matrix.centre[matrix.centre == 0] = 1.0
    units = dx * np.array([1.0, 1.0, scale**-2])[:, None, None]
    wanted = [(i, _source(i, parts, aspect, start if start is None else start[i] / units[i])) for i in range(3)]
    closed = sealed(h)
    wanted = [(i, source) for i, source in wanted if i == 2 or not closed[i]]
    for name in solvers:
        try:
            found = dict(zip(dict(wanted), SOLVERS[name](matrix, list(dict(wanted).values()), tolerance), strict=True))
            break
        except ConvergenceError:
            if name == solvers[-1]:
                raise
    chi = np.zeros((3, *h.shape))
    for i, one in found.items():
        chi[i] = one.solution
    factors = _factors(h, parts, aspect, chi, closed)
    correction = [
        float((chi[2] * (dict(wanted)[i].values - matrix.image(chi[i]))).mean()) / aspect if i in found else 0.0
        for i in (0, 1)
    ]
    return Cell(
        factors=replace(factors, shear=factors.shear + correction).scaled(scale),
        correctors=chi * units,
        unsolved=np.array([found[i].left / (h.size * aspect) if i in found else 0.0 for i in range(3)]),
        solver=name,
        iterations=sum(one.iterations for one in found.values()),
        residual=max(one.residual for one in found.values()),
    )


def _source(which: int, parts: Faces, aspect: float, start: Array | None) -> Source:
    """Of χ₁, χ₂ or χ₃, lengths in spacings along x."""
    if which == 0:
        flux, along, whole = parts.east * aspect, 0, float(parts.east.sum()) * aspect
    elif which == 1:
        flux, along, whole = parts.north, 1, float(parts.north.sum()) * aspect
    else:
        flux, along, whole = -parts.drag * aspect, 0, None
    return Source(values=flux - np.roll(flux, 1, axis=along), whole=whole, start=start)


def _factors(h: Array, parts: Faces, aspect: float, chi: Array, closed: tuple[bool, bool]) -> FlowFactors:
    """From the correctors; of A the flow that they drive along themselves, so that nothing cancels near sealing."""
    sums = _energies(parts.east, parts.north, parts.drag, aspect, chi) / h.size
    open_to = ~np.array(closed)
    return FlowFactors(
        mean_gap=float(h.mean()),
        pressure=np.where(np.outer(open_to, open_to), [[sums[0], sums[1]], [sums[1], sums[2]]], 0.0),
        shear=np.where(open_to, sums[3:5], 0.0),
        couette=parts.inverse,
        shear_couette=float(sums[5]) + parts.inside,
        sealed=closed,
    )


@compiled
def _energies(east, north, drag, aspect, chi):  # type: ignore[no-untyped-def]
    """Sums over faces for A₁₁, A₁₂, A₂₂, B₁, B₂ and e; lengths in spacings along x."""
    _, count, length = chi.shape
    sums = np.zeros(6)
    for i in range(count):
        k, m, u = east[i], north[i], drag[i]
        one, two, three = chi[0, i], chi[1, i], chi[2, i]
        after = i + 1 if i + 1 < count else 0
        one_on, two_on, three_on = chi[0, after], chi[1, after], chi[2, after]
        first = mixed = second = along = aside = rub = 0.0
        for j in range(length):
            x_one, x_two = one_on[j] - one[j] + 1.0, two_on[j] - two[j]
            first += k[j] * x_one * x_one
            mixed += k[j] * x_one * x_two
            second += k[j] * x_two * x_two
            along += u[j] * x_one
            aside += u[j] * x_two
            rub += u[j] * (three_on[j] - three[j])
        for j in range(length):
            on = j + 1 if j + 1 < length else 0
            y_one, y_two = (one[on] - one[j]) / aspect, (two[on] - two[j]) / aspect + 1.0
            first += m[j] * y_one * y_one
            mixed += m[j] * y_one * y_two
            second += m[j] * y_two * y_two
        sums[0] += first
        sums[1] += mixed
        sums[2] += second
        sums[3] += along
        sums[4] += aside
        sums[5] += rub
    return sums
