"""Solvers of the linear systems of a cell: multigrid, and elimination where that fails."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.multigrid.gradients import apply
from roughfilm.rom.multigrid.multigrid import Multigrid, Solved
from roughfilm.rom.multigrid.pieces import LEAK_ROUNDOFF

MAX_ELIMINATION_NODES = 1_100_000
"""Largest number of nodes for elimination; the factors of larger matrices take more than 3 GB."""

ELIMINATION_RESIDUAL = 1e-6
"""Relative residual above which an elimination has failed."""


@dataclass(frozen=True, kw_only=True)
class Matrix:
    """K of ∇·(h³∇χ) on a grid, arrays of shape (nx, ny) in the form that ``Multigrid`` takes."""

    centre: Array
    east: Array
    north: Array
    periodic: tuple[bool, bool] = (True, True)

    def image(self, chi: Array) -> Array:
        """Kχ, shape (nx, ny)."""
        return np.asarray(apply(self.centre, self.east, self.north, chi, self.periodic))


@dataclass(frozen=True, kw_only=True)
class Source:
    """A right-hand side b, shape (nx, ny), and how its solution χ starts and ends.

    Attributes
    ----------
    values : b.
    whole : E if the energy of interest is E − b·χ, None if it is b·χ.
    start : initial χ, shape (nx, ny), which a solver may overwrite; None for 0.
    tolerance : largest relative error of the energy.
    """

    values: Array
    whole: float | None
    start: Array | None
    tolerance: float


Solution = TypeVar("Solution")

Solver = Callable[[Matrix, Iterable[Source]], list[Solved]]
"""solve(matrix, sources) → solutions to the tolerance of each source, or ConvergenceError.

Sources are consumed one after the other, so that only one is in memory at a time."""


def by_multigrid(matrix: Matrix, sources: Iterable[Source], *, single: bool) -> list[Solved]:
    """Conjugate gradients, preconditioned by multigrid in single or double precision."""
    multigrid = Multigrid(matrix.centre, matrix.east, matrix.north, periodic=matrix.periodic, single=single)

    def solve(source: Source) -> Solved:
        return multigrid.minimise(source.values, source.whole, tolerance=source.tolerance, start=source.start)

    return list(map(solve, sources))


def by_elimination(matrix: Matrix, sources: Iterable[Source]) -> list[Solved]:
    """Sparse elimination (SuperLU) with one refinement; one node of each floating piece is fixed."""
    count = matrix.centre.size
    if count > MAX_ELIMINATION_NODES:
        raise ConvergenceError(
            f"the cell's linear system: {count} nodes are too many to eliminate; take a coarser grid",
            outcome=Outcome.STALLED,
            iterations=0,
        )
    nodes = np.arange(count).reshape(matrix.centre.shape)
    first = np.concatenate([nodes.ravel()] * 2)
    second = np.concatenate([np.roll(nodes, -1, axis=0).ravel(), np.roll(nodes, -1, axis=1).ravel()])
    inside = np.ones((2, *nodes.shape), dtype=bool)
    inside[0, -1], inside[1, :, -1] = matrix.periodic
    couplings = np.concatenate([matrix.east.ravel(), matrix.north.ravel()])
    linked = (couplings > 0) & inside.ravel()
    first, second, couplings = first[linked], second[linked], couplings[linked]
    links = scipy.sparse.csc_array((couplings, (first, second)), shape=(count, count))
    links = links + links.T
    diagonal = links.sum(axis=1)
    leak = matrix.centre.ravel() - diagonal
    leak[leak <= LEAK_ROUNDOFF * diagonal] = 0.0
    pieces, piece = scipy.sparse.csgraph.connected_components(links, directed=False)
    held = np.unique(piece, return_index=True)[1][np.bincount(piece, leak, pieces) == 0]
    diagonal += leak
    diagonal[held] *= 2
    whole = scipy.sparse.csc_array((diagonal, (np.arange(count),) * 2), shape=(count, count)) - links
    factors = scipy.sparse.linalg.splu(
        whole.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    solved = []
    for source in sources:
        b = source.values
        chi = factors.solve(b.ravel()).reshape(b.shape)
        rest = b - matrix.image(chi)
        change = factors.solve(rest.ravel()).reshape(b.shape)
        left = abs(float((rest * change).sum()))
        chi += change
        residual = float(np.linalg.norm(b - matrix.image(chi)) / (np.linalg.norm(b) or 1.0))
        if not residual <= ELIMINATION_RESIDUAL:
            raise ConvergenceError(
                f"the cell's linear system: elimination leaves a residual of {residual:.3g}; the gap spans too much",
                outcome=Outcome.STALLED,
                iterations=0,
            )
        solved.append(Solved(solution=chi, iterations=1, residual=residual, left=left))
    return solved


SOLVERS: dict[str, Solver] = {
    "multigrid": partial(by_multigrid, single=True),
    "multigrid_double": partial(by_multigrid, single=False),
    "elimination": by_elimination,
}
"""Solvers by name, in the order in which they are tried."""


def first_to_converge(names: Sequence[str], attempt: Callable[[Solver], Solution]) -> tuple[Solution, str]:
    """The result of an attempt with the first solver that converges, and the name of that solver."""
    *others, last = names
    for name in others:
        try:
            return attempt(SOLVERS[name]), name
        except ConvergenceError:
            continue
    return attempt(SOLVERS[last]), last
