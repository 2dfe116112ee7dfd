"""Multigrid by halves of the rows: the preconditioner, and conjugate gradients with it."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.errors import ConvergenceError, InputError, Outcome
from rom.gap import Array
from rom.multigrid import gradients, kernels, pieces
from rom.multigrid.kernels import Rows

TURNED = 2.0
"""Couplings along rows so many times those across them make columns the better rows."""


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A solution, shape (nx, ny), the iterations it took, and its residual ‖b − Ap‖/‖b‖."""

    solution: Array
    iterations: int
    residual: float


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
        self, centre: ArrayLike, east: ArrayLike, north: ArrayLike, *, periodic: tuple[bool, bool] = (False, False)
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
        self._rows = Rows(
            leak=np.zeros(full),
            centre=np.zeros(full),
            north=np.zeros(full),
            east=np.zeros(full),
            up=np.zeros(coarse),
            down=np.zeros(coarse),
            inverse=np.zeros(full),
            factor=np.zeros(full),
            border=np.zeros((total, length if ring else 0)),
        )
        self._source, self._values = np.zeros(full), np.zeros(full)
        self._centre, self._direction, self._image = (np.zeros((count, length)) for _ in range(3))
        self._work = np.zeros((4, length))
        self._seen, self._stack = np.zeros((count, length), dtype=bool), np.zeros(count * length, dtype=np.int64)
        self._set_up(matrix)

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
        return self._outer(values)

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
        p = np.zeros(b.shape) if start is None else np.array(self._inner(start), order="C")
        norm = math.sqrt(gradients.dot(b, b))
        if norm == 0:
            return Solved(solution=np.zeros(self.shape), iterations=0, residual=0.0)
        iterations, before = 0, np.inf
        while True:
            residual = self._set_residual(b, p) / norm
            if residual <= tolerance:
                return Solved(solution=self._outer(p), iterations=iterations, residual=residual)
            if iterations >= limit or not residual < before / 2:
                break
            before = residual
            iterations += self._gradients(p, tolerance * norm, limit - iterations)
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
        return np.array(values.T if self._turned else values, order="C")

    def _set_up(self, matrix: list[Array]) -> None:
        count, length = self._centre.shape
        first, second = matrix[:0:-1] if self._turned else matrix[1:]
        centre, east, north = self._centre, self._rows.east[:count], self._rows.north[:count]
        centre[:], east[:], north[:] = (part.T if self._turned else part for part in (matrix[0], first, second))
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
        pieces.set_leak(centre, east, north, self._rows.leak[:count], self._seen, self._stack)
        kernels.set_up(self._counts, self._rows, self._work)

    def _cycle(self) -> None:
        kernels.cycle(self._counts, self._rows, self._across, self._source, self._values, self._work[0])

    def _apply(self, p: Array) -> float:
        """Set the image to Ap; Σ p Ap."""
        count = self._counts[0]
        east, north = self._rows.east[:count], self._rows.north[:count]
        return float(gradients.set_image(self._centre, east, north, p, self._across, self._along, self._image))

    def _set_residual(self, b: Array, p: Array) -> float:
        """Set the finest source to b − Ap; its norm."""
        self._apply(p)
        source = self._finest[0]
        np.subtract(b, self._image, out=source)
        return math.sqrt(gradients.dot(source, source))

    def _gradients(self, p: Array, goal: float, limit: int) -> int:
        """Improve p until the residual that is carried along is below the ``goal``; how many iterations it took."""
        residual, steepest = self._finest
        slope = np.inf
        self._direction[:] = 0
        for iteration in range(1, limit + 1):
            self._cycle()
            before, slope = slope, gradients.dot(residual, steepest)
            gradients.turn(slope / before, steepest, self._direction)
            bend = self._apply(self._direction)
            if not (slope > 0 and bend > 0):
                return iteration
            square = gradients.advance(slope / bend, self._direction, self._image, p, residual)
            if square <= goal**2:
                return iteration
        return limit
