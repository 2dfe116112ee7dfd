"""The cell problems of one periodic gap on its own grid."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import allocating
from roughfilm.rom.homogenization.conductance import FaceRule, faces, without_traces
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.grids import refined
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.rom.homogenization.solvers import SOLVERS, Matrix, Solver, Source, first_to_converge
from roughfilm.rom.multigrid.multigrid import Solved

CELL_TOLERANCE = 1e-8
"""Default relative error of A from the linear solver, far below the discretisation error of any grid."""


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A solved cell.

    Attributes
    ----------
    factors : of the gap.
    correctors : χ₁, χ₂, χ₃, shape (3, nx, ny): χ₁ and χ₂ in m, χ₃ in 1/m (pressure over 6ηu); 0 in sealed directions.
    unsolved : solver errors of A₁₁, A₂₂ and e, relative to those of a smooth film of the mean gap.
    solver : name of the solver that converged.
    iterations : conjugate-gradient iterations of all three problems.
    residual : the largest recomputed residual of the three, relative to its right-hand side.
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
    tolerance: ArrayLike = CELL_TOLERANCE,
    start: Array | None = None,
    solvers: Sequence[str] = tuple(SOLVERS),
) -> Cell:
    """Solve ∇·(h³(e_i + ∇χ_i)) = 0 and ∇·(h e₁ − h³∇χ₃) = 0, all periodic, on the nodes of a gap.

    A_ij = <h³(e_i + ∇χ_i)·(e_j + ∇χ_j)>, B_i = <h(δ_1i + ∂₁χ_i)>, d = <1/h>, e = <h ∂₁χ₃>. A is a minimum of an
    energy, and B and e contain the first-order effect of the residuals: all errors are quadratic in the error of χ.

    Parameters
    ----------
    gap : h >= 0, shape (nx, ny), m; one period. Nodes where h = 0 are contact: nothing flows there.
    spacing : (dx, dy), m.
    tolerance : largest relative solver error of A₁₁ and A₂₂, and of the contribution of χ₃ to e: one or three numbers.
    start : correctors of a similar gap, in the units of :class:`Cell`, on this grid or a coarser one.
    solvers : names in :data:`roughfilm.rom.homogenization.solvers.SOLVERS`, tried in this order.

    Raises
    ------
    ConvergenceError
        If none of the solvers meets the tolerance.
    """
    scale, (dx, dy) = float(gap.mean()), spacing
    network, units = _network(gap / scale, rule, dy / dx), _units(scale, dx)
    tolerances = np.broadcast_to(tolerance, 3).tolist()
    wanted = [i for i in range(3) if i == 2 or not network.closed[i]]

    def source(which: int) -> Source:
        values, whole = network.source(which)
        if start is None:
            return Source(values=values, whole=whole, start=None, tolerance=tolerances[which])
        begun = refined(start[which], gap.shape)
        begun /= units[which]
        return Source(values=values, whole=whole, start=begun, tolerance=tolerances[which])

    def attempt(solve: Solver) -> dict[int, Solved]:
        return dict(zip(wanted, solve(network.matrix, map(source, wanted)), strict=True))

    solved, name = first_to_converge(solvers, attempt)
    chi = np.zeros((3, *gap.shape))
    for i, one in solved.items():
        chi[i] = one.solution
    factors = network.factors(chi).scaled(scale)
    chi *= units[:, None, None]
    return Cell(
        factors=factors,
        correctors=chi,
        unsolved=np.array([solved[i].left / (gap.size * network.aspect) if i in solved else 0.0 for i in range(3)]),
        solver=name,
        iterations=sum(one.iterations for one in solved.values()),
        residual=max(one.residual for one in solved.values()),
    )


def factors_of_correctors(
    gap: Array, spacing: tuple[float, float], correctors: Array, *, rule: FaceRule = FaceRule.LINEAR
) -> FlowFactors:
    """The factors of a gap with given correctors, which are those of a similar gap, without a solution.

    The arguments are those of :func:`solve_cell`; the errors are quadratic in the error of the correctors. By
    stationarity, the derivatives of A, B and e with respect to the gap are those at constant correctors.
    """
    scale, (dx, dy) = float(gap.mean()), spacing
    network = _network(gap / scale, rule, dy / dx)
    return network.factors(correctors / _units(scale, dx)[:, None, None]).scaled(scale)


def _units(scale: float, dx: float) -> Array:
    """The units of χ₁, χ₂ (m) and χ₃ (1/m) of a gap of mean 1 on the grid of a network."""
    return dx * np.array([1.0, 1.0, scale**-2])


@dataclass(frozen=True, kw_only=True)
class _Network:
    """The faces of a gap of mean 1 as a linear system, lengths in spacings along x."""

    matrix: Matrix
    drag: Array
    aspect: float
    inverse: float
    inside: float
    closed: tuple[bool, bool]
    sealed: tuple[bool, bool]

    def source(self, which: int) -> tuple[Array, float | None]:
        """The right-hand side for χ₁, χ₂ or χ₃, and the energy of the uniform gradient."""
        if which == 0:
            return _less_before(self.matrix.east, 0), float(self.matrix.east.sum())
        if which == 1:
            values = _less_before(self.matrix.north, 1)
            values *= self.aspect
            return values, float(self.matrix.north.sum()) * self.aspect**2
        values = _less_before(self.drag, 0)
        values *= -self.aspect
        return values, None

    def factors(self, chi: Array) -> FlowFactors:
        """The factors of the correctors; A as an energy, so that no cancellation occurs near sealing."""
        sums = _energies(self.matrix.east, self.matrix.north, self.drag, self.aspect, chi) / chi[0].size
        open_to = ~np.array(self.closed)
        return FlowFactors(
            mean_gap=1.0,
            pressure=np.where(np.outer(open_to, open_to), [[sums[0], sums[1]], [sums[1], sums[2]]], 0.0),
            shear=np.where(open_to, sums[3:5], 0.0),
            couette=self.inverse,
            shear_couette=float(sums[5]) + self.inside,
            sealed=self.sealed,
        )


def _network(h: Array, rule: FaceRule, aspect: float) -> _Network:
    counted = without_traces(h)
    parts = faces(counted, rule)
    east, north = parts.east * aspect, parts.north / aspect
    centre = east + north
    for coupling, all_of in ((east, centre), (north.T, centre.T)):
        all_of[1:] += coupling[:-1]
        all_of[0] += coupling[-1]
    centre[centre == 0] = 1.0
    return _Network(
        matrix=Matrix(centre=centre, east=east, north=north),
        drag=parts.drag,
        aspect=aspect,
        inverse=parts.inverse,
        inside=parts.inside,
        closed=sealed(counted),
        sealed=sealed(h),
    )


def _less_before(flux: Array, along: int) -> Array:
    """The divergence of a flux through the faces at the nodes."""
    values = flux.copy()
    own, all_of = (values, flux) if along == 0 else (values.T, flux.T)
    own[1:] -= all_of[:-1]
    own[0] -= all_of[-1]
    return values


@allocating
def _energies(east, north, drag, aspect, chi):  # type: ignore[no-untyped-def]
    """Sums over faces for A₁₁, A₁₂, A₂₂, B₁, B₂ and e, the last three corrected by χ₃ times the residuals."""
    _, count, length = chi.shape
    sums = np.zeros(6)
    for i in range(count):
        k, m, u = east[i], north[i], drag[i]
        one, two, three = chi[0, i], chi[1, i], chi[2, i]
        after = i + 1 if i + 1 < count else 0
        one_on, two_on, three_on = chi[0, after], chi[1, after], chi[2, after]
        first = mixed = second = along = aside = friction = 0.0
        for j in range(length):
            x_one, x_two, x_three = one_on[j] - one[j] + 1.0, two_on[j] - two[j], three_on[j] - three[j]
            first += k[j] * x_one * x_one
            mixed += k[j] * x_one * x_two
            second += k[j] * x_two * x_two
            drive = u[j] - k[j] * x_three / aspect
            along += drive * x_one
            aside += drive * x_two
            friction += (u[j] + drive) * x_three
        for j in range(length):
            on = j + 1 if j + 1 < length else 0
            y_one, y_two, y_three = one[on] - one[j], two[on] - two[j] + aspect, three[on] - three[j]
            first += m[j] * y_one * y_one
            mixed += m[j] * y_one * y_two
            second += m[j] * y_two * y_two
            drive = m[j] * y_three / aspect
            along -= drive * y_one
            aside -= drive * y_two
            friction -= drive * y_three
        sums[0] += first / aspect
        sums[1] += mixed / aspect
        sums[2] += second / aspect
        sums[3] += along
        sums[4] += aside
        sums[5] += friction
    return sums
