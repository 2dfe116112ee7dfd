"""Multigrid that halves the number of rows, as preconditioner of conjugate gradients."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.multigrid import gradients, kernels, pieces
from roughfilm.rom.multigrid.rows import rows_of_zeros

TRANSPOSED_RATIO = 2.0
"""Ratio of the couplings in the second to those in the first direction above which the arrays are transposed."""

ITERATIONS_PER_RECENT = 3
"""Ratio of all iterations to the recent ones whose gains estimate the remaining gain."""

MIN_RECENT = 3
"""Smallest number of recent iterations."""


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A solution, shape (nx, ny), its number of iterations and residual ‖b − Ap‖/‖b‖.

    ``left`` is an estimate of (p − p*)·A(p − p*) = b·p* − b·p with the exact solution p*.
    """

    solution: Array
    iterations: int
    residual: float
    left: float = 0.0


class Multigrid:
    """A solver with multigrid preconditioner for one matrix of a thin film on a grid of nx × ny nodes.

        (Ap)_ij = centre_ij p_ij − east_ij p_{i+1,j} − east_{i−1,j} p_{i−1,j}
                                 − north_ij p_{i,j+1} − north_{i,j−1} p_{i,j−1}

    Each level has every second row of the one before, down to one row. The smoother solves whole rows, even and odd
    ones in turn. An omitted row is interpolated from the rows beside it with the weights T⁻¹B1, and the coarse operator
    is Galerkin's. This is Dendy's black-box multigrid in its variant for any anisotropy.

    Parameters
    ----------
    centre
        Diagonal, shape (nx, ny), at least the sum of the node's couplings; more beside an eliminated Dirichlet node. A
        node outside the problem has any centre above 0 and no couplings.
    east, north
        Couplings >= 0 to the next node in the first and the second direction, shape (nx, ny). The last ones lead to the
        first node in a periodic direction, and are ignored otherwise.
    periodic
        Whether the first and the second direction are periodic.
    single
        Whether the preconditioner works in single precision, at half the cost; residuals have double precision. It is
        suitable for ratios of couplings up to about 1e12.

    Raises
    ------
    InputError
        If the arrays are not of one two-dimensional shape with at least one node.

    Notes
    -----
    The solver is for any size and anisotropy. The mean is free in a part without a Dirichlet node. For resolved films
    the number of iterations hardly grows with the grid at any contrast. It grows, possibly above 200, if couplings jump
    by 1e4 or more within few nodes all over the grid (a random h³ at each node, roughness of Hurst exponent 0.3), since
    coarse rows do not separate strongly coupled parts that hardly touch. Large pressures across weak couplings limit
    the residual to about 1e-16 ‖|A||p|‖.

    J. E. Dendy, Black box multigrid, J. Comput. Phys. 48 (1982) 366-386, doi:10.1016/0021-9991(82)90057-2;
    interpolation: S. Schaffer, SIAM J. Sci. Comput. 20 (1998) 228-242, doi:10.1137/S1064827595281587.
    """

    def __init__(
        self,
        centre: ArrayLike,
        east: ArrayLike,
        north: ArrayLike,
        *,
        periodic: tuple[bool, bool] = (False, False),
        single: bool = False,
    ) -> None:
        matrix = [np.asarray(part, dtype=np.float64) for part in (centre, east, north)]
        self.shape = matrix[0].shape
        self._check(matrix)
        first, second = (float(coupling.sum()) for coupling in matrix[1:])
        self._transposed = second > TRANSPOSED_RATIO * first
        self._across, self._along = periodic[::-1] if self._transposed else periodic
        count, length = self.shape[::-1] if self._transposed else self.shape
        counts = [count]
        while counts[-1] > 1:
            counts.append((counts[-1] + 1) // 2)
        self._counts = np.array(counts)
        total = sum(counts)
        kind = np.float32 if single else np.float64
        self._rows = rows_of_zeros(total, count, length, ring=self._along and length > 2, kind=kind)
        self._source, self._values = np.zeros((total, length), kind), np.zeros((total, length), kind)
        self._work = np.zeros((2, length), kind)
        self._matrix = self._set_up(matrix)

    def cycle(self, residual: ArrayLike) -> Array:
        """One V(1,1) cycle from 0, M r ≈ A⁻¹ r, shape (nx, ny); M is linear, symmetric and positive definite.

        Raises
        ------
        InputError
            If the residual has another shape.
        """
        source, values = self._finest
        residual = self._checked(residual)
        source[:] = residual.T if self._transposed else residual
        self._cycle()
        return np.array(values.T if self._transposed else values, order="C")

    def solve(
        self,
        right_hand_side: ArrayLike,
        *,
        tolerance: float = 1e-10,
        start: ArrayLike | None = None,
        limit: int = 200,
    ) -> Solved:
        """Solve Ap = b by conjugate gradients, preconditioned by one cycle.

        Parameters
        ----------
        right_hand_side
            b, shape (nx, ny), with sum 0 in each part without a Dirichlet node.
        tolerance
            Tolerance of the recomputed ‖b − Ap‖/‖b‖.
        start
            Initial p, shape (nx, ny); 0 by default.
        limit
            Largest number of iterations.

        Raises
        ------
        InputError
            If an array has another shape.
        ConvergenceError
            If the residual exceeds the tolerance after ``limit`` iterations, or because of round-off.
        """
        b = self._inner(right_hand_side)
        p = np.zeros(b.shape) if start is None else np.array(self._inner(start))
        norm = math.sqrt(gradients.dot(b, b))
        if norm == 0:
            return Solved(solution=np.zeros(self.shape), iterations=0, residual=0.0)
        iterations, before, goal = 0, np.inf, (tolerance * norm) ** 2
        while True:
            residual = math.sqrt(self._set_residual(b, p)[0]) / norm
            if residual <= tolerance:
                return Solved(solution=self._outer(p), iterations=iterations, residual=residual)
            if iterations >= limit or not residual < before / 2:
                break
            before = residual
            iterations += self._gradients(b, p, limit - iterations, lambda square, _gain, _energy: square <= goal)
        finished = iterations < limit
        remedy = (
            "round-off limits it, or sources of a part without a Dirichlet node do not sum to 0; loosen the tolerance"
            if finished
            else "raise the limit or loosen the tolerance"
        )
        raise ConvergenceError(
            f"the film's linear system: the residual is {residual:.3g} of the right-hand side after {iterations} "
            f"iterations, not {tolerance:g}; {remedy}",
            outcome=Outcome.STALLED if finished else Outcome.UNFINISHED,
            iterations=iterations,
        )

    def minimise(
        self,
        right_hand_side: ArrayLike,
        whole: float | None,
        *,
        tolerance: float = 1e-8,
        start: ArrayLike | None = None,
        limit: int = 500,
    ) -> Solved:
        """Solve Ap = b to a tolerance of the energy G = 2b·p − p·Ap, whose error is quadratic in that of p.

        The gain of G in the last third of the iterations estimates the remaining gain. The estimate is at least
        Σ r²/(2 centre), r = b − Ap, and the gain of a correction constant along rows or columns, since the gain per
        iteration is small if round-off degrades the preconditioner.

        Parameters
        ----------
        right_hand_side, start, limit
            Arguments of :meth:`solve`; ``start`` may be overwritten.
        whole
            W if the energy is W − G; None if it is G.
        tolerance
            Tolerance of the remaining gain over the energy.

        Raises
        ------
        InputError
            If an array has another shape.
        ConvergenceError
            If the tolerance is not met.
        """
        b = self._inner(right_hand_side)
        p = np.zeros(b.shape) if start is None else self._inner(start)
        norm = math.sqrt(gradients.dot(b, b))
        if norm == 0:
            return Solved(solution=np.zeros(self.shape), iterations=0, residual=0.0)
        first = self._set_residual(b, p)[1]
        gains: list[float] = []

        def left() -> float:
            recent = sum(gains[-max(MIN_RECENT, len(gains) // ITERATIONS_PER_RECENT) :])
            return recent if recent > tolerance * counts() else max(recent, self._left_between_rows())

        def counts() -> float:
            energy = first + sum(gains)
            return energy if whole is None else whole - energy

        def enough(_square: float, gain: float, energy: float | None) -> bool:
            nonlocal first
            gains.append(gain)
            if energy is not None:
                first = energy - sum(gains)
            return len(gains) >= MIN_RECENT and left() <= tolerance * counts()

        iterations, before = 0, np.inf
        while True:
            iterations += self._gradients(b, p, limit - iterations, enough)
            square, energy = self._set_residual(b, p)
            first = energy - sum(gains)
            rest = max(left(), float(gradients.weighed(self._finest[0], self._matrix[0])) / 2)
            if len(gains) >= MIN_RECENT and rest <= tolerance * counts():
                residual = math.sqrt(square) / norm
                return Solved(solution=self._outer(p), iterations=iterations, residual=residual, left=rest)
            if iterations >= limit or not rest < before / 2:
                break
            before = rest
        raise ConvergenceError(
            f"the film's linear system: the energy {counts():.3g} may change by {rest:.3g} more after "
            f"{iterations} iterations, over {tolerance:g} of it; raise the limit or loosen the tolerance",
            outcome=Outcome.UNFINISHED if iterations >= limit else Outcome.STALLED,
            iterations=iterations,
        )

    @property
    def _finest(self) -> tuple[Array, Array]:
        count = self._counts[0]
        return self._source[:count], self._values[:count]

    def _check(self, matrix: list[Array]) -> None:
        shapes = {part.shape for part in matrix}
        if shapes != {self.shape} or len(self.shape) != 2 or 0 in self.shape:
            raise InputError(
                f"a matrix on a grid: got centre, east and north of the shapes {[part.shape for part in matrix]}; "
                "give three of one shape (nx, ny), that of the first matrix"
            )

    def _inner(self, values: ArrayLike) -> Array:
        """The values on the grid, transposed if the rows are columns."""
        array = self._checked(values)
        return np.ascontiguousarray(array.T if self._transposed else array)

    def _checked(self, values: ArrayLike) -> Array:
        array = np.asarray(values, dtype=np.float64)
        if array.shape != self.shape:
            raise InputError(f"values on a grid: got the shape {array.shape}; give {self.shape}, that of the matrix")
        return array

    def _outer(self, values: Array) -> Array:
        return np.ascontiguousarray(values.T if self._transposed else values)

    def _set_up(self, matrix: list[Array]) -> tuple[Array, Array, Array]:
        """Compute the hierarchy; returns the matrix by rows without couplings out of the grid."""
        if self._transposed:
            matrix = [matrix[0].T, matrix[2].T, matrix[1].T]
        count, length = matrix[0].shape
        shared = self._across and self._along and min(count, length) > 2
        centre, east, north = (np.ascontiguousarray(part) if shared else np.array(part, order="C") for part in matrix)
        if not self._across:
            east[-1] = 0
        elif count == 1:
            centre -= 2 * east
            east[:] = 0
        if not self._along:
            north[:, -1] = 0
        elif length == 1:
            centre -= 2 * north
            north[:] = 0
        elif length == 2:
            north[:, 0] += north[:, 1]
            north[:, 1] = 0
        leak = np.zeros((count, length))
        seen, stack = np.zeros((count, length), dtype=bool), np.zeros(count * length, dtype=np.int64)
        pieces.set_leak(centre, east, north, leak, seen, stack)
        rows = self._rows
        rows.base[rows.leak : rows.leak + count] = leak
        rows.base[rows.north : rows.north + count] = north
        rows.solver[rows.east : rows.east + count] = east
        kernels.set_up(self._counts, rows, np.zeros((5, length)))
        self._rows = rows._replace(base=np.zeros((0, length), rows.base.dtype))
        return centre, east, north

    def _cycle(self) -> None:
        kernels.cycle(self._counts, self._rows, self._across, self._source, self._values, self._work)

    def _set_residual(self, b: Array, p: Array) -> tuple[float, float]:
        """Write r = b − Ap to the finest source, and return Σr² and Σ p(b + r)."""
        source, _ = self._finest
        work = np.zeros(b.shape[1])
        square, energy = gradients.set_residual(*self._matrix, b, p, source, work)
        return float(square), float(energy)

    def _left_between_rows(self) -> float:
        """The energy gain of a p constant along rows or columns; 0 unless both directions are periodic."""
        if not (self._across and self._along):
            return 0.0
        _, east, north = self._matrix
        residual, _ = self._finest
        return max(
            _left_on_ring(residual.sum(axis=1 - axis, dtype=np.float64), coupling.sum(axis=1 - axis))
            for axis, coupling in enumerate((east, north))
        )

    def _gradients(self, b: Array, p: Array, limit: int, enough: Callable[[float, float, float | None], bool]) -> int:
        """Iterate on p until ``enough(residual², gain, energy)``, and return the number of iterations.

        The finest source is the residual r, and the finest values are M r and then the image of the direction. The
        updates of r accumulate round-off, so that r is computed anew when it has become much smaller. Then ``energy``
        is that of p; otherwise it is None.
        """
        residual, values = self._finest
        slope, roundoff = np.inf, math.sqrt(np.finfo(values.dtype).eps)
        small = roundoff * gradients.dot(residual, residual)
        direction, work = np.zeros_like(values), np.zeros(p.shape[1])
        for iteration in range(1, limit + 1):
            self._cycle()
            before, slope = slope, gradients.dot(residual, values)
            gradients.turn(slope / before, values, direction)
            bend = gradients.set_image(*self._matrix, direction, values, work)
            if not (slope > 0 and bend > 0):
                return iteration
            square = gradients.advance(slope / bend, direction, values, p, residual)
            energy = None
            if square < small:
                square, energy = self._set_residual(b, p)
                small = roundoff * square
            if enough(square, slope * slope / bend, energy):
                return iteration
        return limit


def _left_on_ring(residual: Array, coupling: Array) -> float:
    """The energy r·K⁻¹r = Σ (F − F̄)²/k of a periodic row of nodes, with F the flow whose divergence is r."""
    if coupling.size < 2 or not coupling.all():
        return 0.0
    flow = np.cumsum(residual)
    flow -= (flow / coupling).sum() / (1 / coupling).sum()
    return float((flow * flow / coupling).sum())
