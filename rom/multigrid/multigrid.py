"""Multigrid by halves of the rows: the preconditioner, and conjugate gradients with it."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.multigrid import gradients, kernels, pieces
from roughfilm.rom.multigrid.rows import Rows

TURNED = 2.0
"""Couplings along rows so many times those across them make columns the better rows."""


SHARE, FEWEST = 3, 3
"""Of the iterations, one in so many is looked back at to see what is left to gain, and so many at least."""


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A solution, shape (nx, ny), the iterations it took, and its residual ‖b − Ap‖/‖b‖.

    ``left`` is an estimate of (p − p*)·A(p − p*), p* the exact solution: by how much b·p is short of b·p*.
    """

    solution: Array
    iterations: int
    residual: float
    left: float = 0.0


class Multigrid:
    """A preconditioner for one matrix of a thin film on a grid of nx × ny nodes, and the solver that uses it.

        (Ap)_ij = centre_ij p_ij − east_ij p_{i+1,j} − east_{i−1,j} p_{i−1,j}
                                 − north_ij p_{i,j+1} − north_{i,j−1} p_{i,j−1}

    Every second row is left out from level to level, down to one row; rows are solved whole, even ones and odd ones in
    turn. A row left out takes from the rows beside it what it takes from ones in them, T⁻¹B1, and the coarse operator
    is Galerkin's. This is Dendy's multigrid, which knows the matrix only, in its variant for any anisotropy.

    Parameters
    ----------
    centre
        Shape (nx, ny), at least the sum of the node's couplings: more next to a Dirichlet node that was eliminated.
        A node out of the problem has any centre above 0 (say 1) and no couplings.
    east, north
        Couplings to the next node in the first and the second direction, shape (nx, ny), 0 or more. The last of each
        direction lead round to the first node where that direction is periodic, and are ignored elsewhere.
    periodic
        Whether the first and the second direction are periodic.
    single
        Whether the preconditioner works in single precision, at half the cost; residuals are in double always. Good for
        couplings up to about 1e12 apart.

    Raises
    ------
    InputError
        For arrays that are not of one two-dimensional shape, with a node at least.

    Notes
    -----
    Any size and anisotropy; pieces without any Dirichlet node may be there, their mean is then free. Where the film is
    resolved iterations hardly grow with the grid, whatever its contrast. They do grow, and 200 may not do, where
    couplings jump 1e4-fold and more within few nodes all over the grid (an h³ that is random at each node, roughness
    of a Hurst exponent of 0.3): coarse rows cannot tell apart pieces that hang together strongly but hardly touch.
    Where weak links hold large pressures, no residual can be below about 1e-16 ‖|A||p|‖.

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
        self._turned = second > TURNED * first
        self._across, self._along = periodic[::-1] if self._turned else periodic
        count, length = self.shape[::-1] if self._turned else self.shape
        counts = [count]
        while counts[-1] > 1:
            counts.append((counts[-1] + 1) // 2)
        self._counts = np.array(counts)
        total = sum(counts)
        full, coarse = (total, length), (total - count, length)
        ring = self._along and length > 2
        kind = np.float32 if single else np.float64
        self._rows = Rows(
            leak=np.zeros(full, kind),
            centre=np.zeros(full, kind),
            north=np.zeros(full, kind),
            east=np.zeros(full, kind),
            up=np.zeros(coarse, kind),
            down=np.zeros(coarse, kind),
            inverse=np.zeros(full, kind),
            factor=np.zeros(full, kind),
            border=np.zeros((total, length if ring else 0), kind),
        )
        self._source, self._values = np.zeros(full, kind), np.zeros(full, kind)
        self._work = np.zeros(length, kind)
        self._matrix = self._set_up(matrix)
        self._direction, self._image, self._residual = (np.zeros((count, length)) for _ in range(3))

    def cycle(self, residual: ArrayLike) -> Array:
        """One V(1,1) cycle from 0: what M r ≈ A⁻¹ r is, shape (nx, ny); M is linear, symmetric and positive definite.

        Raises
        ------
        InputError
            For a residual of another shape.
        """
        source, values = self._finest
        source[:] = self._inner(residual)
        self._cycle()
        return self._outer(values.copy())

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
            b, shape (nx, ny). In a piece without a Dirichlet node it must add up to 0.
        tolerance
            Of ‖b − Ap‖/‖b‖, which is recomputed at the end.
        start
            The guess of p, shape (nx, ny); 0 if there is none.
        limit
            The most iterations.

        Raises
        ------
        InputError
            For arrays of another shape.
        ConvergenceError
            If the tolerance is not met: within the limit, or because rounding keeps the residual above it.
        """
        b = self._inner(right_hand_side)
        p = self._first(b, start)
        norm = math.sqrt(gradients.dot(b, b))
        if norm == 0:
            return Solved(solution=np.zeros(self.shape), iterations=0, residual=0.0)
        iterations, before, goal = 0, np.inf, (tolerance * norm) ** 2
        while True:
            residual = self._set_residual(b, p) / norm
            if residual <= tolerance:
                return Solved(solution=self._outer(p), iterations=iterations, residual=residual)
            if iterations >= limit or not residual < before / 2:
                break
            before = residual
            iterations += self._gradients(p, limit - iterations, lambda square, _gain: square <= goal)
        finished = iterations < limit
        remedy = (
            "rounding keeps it there, or sources of a piece without a Dirichlet node do not add up to 0; ask for less"
            if finished
            else "allow more, or ask for less"
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
        """Solve Ap = b as far as its energy G = 2b·p − p·Ap asks for, whose error is the square of that of p.

        What an iteration gains of G is known, and what the last third of them gained tells what is left to gain. It is
        at least Σ r²/(2 centre), r = b − Ap, and what a correction constant along rows or columns would gain: a
        preconditioner that rounding has spoilt gains little with every iteration.

        Parameters
        ----------
        right_hand_side, start, limit
            As in :meth:`solve`.
        whole
            W, if it is W − G that counts; None if it is G.
        tolerance
            Of what is left to gain, over the energy that counts.

        Raises
        ------
        InputError
            For arrays of another shape.
        ConvergenceError
            If the tolerance is not met.
        """
        b = self._inner(right_hand_side)
        p = self._first(b, start)
        norm = math.sqrt(gradients.dot(b, b))
        if norm == 0:
            return Solved(solution=np.zeros(self.shape), iterations=0, residual=0.0)
        self._set_residual(b, p)
        first = float(gradients.dot(b, p) + gradients.dot(self._residual, p))
        gains: list[float] = []

        def left() -> float:
            recent = sum(gains[-max(FEWEST, len(gains) // SHARE) :])
            return recent if recent > tolerance * counts() else max(recent, self._left_between_rows())

        def counts() -> float:
            energy = first + sum(gains)
            return energy if whole is None else whole - energy

        def enough(_square: float, gain: float) -> bool:
            gains.append(gain)
            return len(gains) >= FEWEST and left() <= tolerance * counts()

        iterations, before = 0, np.inf
        while True:
            iterations += self._gradients(p, limit - iterations, enough)
            residual = self._set_residual(b, p) / norm
            first = float(gradients.dot(b, p) + gradients.dot(self._residual, p)) - sum(gains)
            rest = max(left(), float(gradients.weighed(self._residual, self._matrix[0])) / 2)
            if len(gains) >= FEWEST and rest <= tolerance * counts():
                return Solved(solution=self._outer(p), iterations=iterations, residual=residual, left=rest)
            if iterations >= limit or not rest < before / 2:
                break
            before = rest
        raise ConvergenceError(
            f"the film's linear system: the energy {counts():.3g} may change by {rest:.3g} more after "
            f"{iterations} iterations, over {tolerance:g} of it; allow more, or ask for less",
            outcome=Outcome.UNFINISHED if iterations >= limit else Outcome.STALLED,
            iterations=iterations,
        )

    def _first(self, b: Array, start: ArrayLike | None) -> Array:
        return np.zeros(b.shape) if start is None else np.array(self._inner(start), order="C")

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
        """Values on the grid, turned to rows."""
        array = np.asarray(values, dtype=np.float64)
        if array.shape != self.shape:
            raise InputError(f"values on a grid: got the shape {array.shape}; give {self.shape}, that of the matrix")
        return np.ascontiguousarray(array.T if self._turned else array)

    def _outer(self, values: Array) -> Array:
        return np.ascontiguousarray(values.T if self._turned else values)

    def _set_up(self, matrix: list[Array]) -> tuple[Array, Array, Array]:
        """The matrix by rows, with nothing that leads out of it; and the hierarchy below it."""
        if self._turned:
            matrix = [matrix[0].T, matrix[2].T, matrix[1].T]
        count, length = matrix[0].shape
        kept = self._across and self._along and min(count, length) > 2
        centre, east, north = (np.ascontiguousarray(part) if kept else np.array(part, order="C") for part in matrix)
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
        self._rows.leak[:count], self._rows.east[:count], self._rows.north[:count] = leak, east, north
        kernels.set_up(self._counts, self._rows, np.zeros((4, length)))
        none = np.zeros((0, length), self._values.dtype)
        self._rows = self._rows._replace(leak=none, centre=none)
        return centre, east, north

    def _cycle(self) -> None:
        kernels.cycle(self._counts, self._rows, self._across, self._source, self._values, self._work)

    def _apply(self, p: Array) -> float:
        """Set the image to Ap; Σ p Ap."""
        return float(gradients.set_image(*self._matrix, p, self._across, self._along, self._image))

    def _set_residual(self, b: Array, p: Array) -> float:
        """Set the residual and the finest source to b − Ap; its norm."""
        self._apply(p)
        return math.sqrt(gradients.leave(b, self._image, self._residual, self._finest[0]))

    def _left_between_rows(self) -> float:
        """What p constant along rows, or along columns, could gain of the energy; 0 but on a torus without leaks."""
        if not (self._across and self._along):
            return 0.0
        _, east, north = self._matrix
        return max(
            _left_on_ring(self._residual.sum(axis=1 - axis), coupling.sum(axis=1 - axis))
            for axis, coupling in enumerate((east, north))
        )

    def _gradients(self, p: Array, limit: int, enough: Callable[[float, float], bool]) -> int:
        """Improve p until it is ``enough``, by the residual's square and the energy gained; the iterations it took."""
        source, steepest = self._finest
        slope = np.inf
        self._direction[:] = 0
        for iteration in range(1, limit + 1):
            self._cycle()
            before, slope = slope, gradients.dot(self._residual, steepest)
            gradients.turn(slope / before, steepest, self._direction)
            bend = self._apply(self._direction)
            if not (slope > 0 and bend > 0):
                return iteration
            square = gradients.advance(slope / bend, self._direction, self._image, p, self._residual, source)
            if enough(square, slope * slope / bend):
                return iteration
        return limit


def _left_on_ring(residual: Array, coupling: Array) -> float:
    """r·K⁻¹r of a ring of nodes, each coupled to the next: Σ (F − F̄)²/k, F the flow that makes up for r."""
    if coupling.size < 2 or not coupling.all():
        return 0.0
    flow = np.cumsum(residual)
    flow -= (flow / coupling).sum() / (1 / coupling).sum()
    return float((flow * flow / coupling).sum())
