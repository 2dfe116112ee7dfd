"""The linear systems of a cell, solved: by multigrid, and by elimination where that fails."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.multigrid.gradients import apply
from roughfilm.rom.multigrid.multigrid import Multigrid, Solved
from roughfilm.rom.multigrid.pieces import ROUNDING
from roughfilm.rom.pocket.gap import Array

MOST_ELIMINATED = 1_100_000
"""Nodes; factors of larger matrices take more than 3 GB."""

BALANCED = 1e-6
"""Of a right-hand side: an elimination that leaves a larger residual has failed."""


@dataclass(frozen=True, kw_only=True)
class Matrix:
    """K of ∇·(h³∇χ) on a grid, as :class:`rom.multigrid.multigrid.Multigrid` takes it, shape (nx, ny) each."""

    centre: Array
    east: Array
    north: Array
    periodic: tuple[bool, bool] = (True, True)

    def image(self, chi: Array) -> Array:
        """Kχ, shape (nx, ny)."""
        return np.asarray(apply(self.centre, self.east, self.north, chi, self.periodic))


@dataclass(frozen=True, kw_only=True)
class Source:
    """A right-hand side b, shape (nx, ny), and E, if the energy that counts is E − b·χ and not b·χ."""

    values: Array
    whole: float | None
    start: Array | None


Found = TypeVar("Found")

Solver = Callable[[Matrix, Iterable[Source], float], list[Solved]]
"""solve(matrix, sources, tolerance) → solutions, each good to the tolerance of its energy; ConvergenceError if not.

Sources are taken one after the other, so that only one of them needs memory at a time."""


def by_multigrid(matrix: Matrix, sources: Iterable[Source], tolerance: float, *, single: bool) -> list[Solved]:
    """Conjugate gradients, preconditioned by multigrid in single or double precision."""
    multigrid = Multigrid(matrix.centre, matrix.east, matrix.north, periodic=matrix.periodic, single=single)
    return [
        multigrid.minimise(source.values, source.whole, tolerance=tolerance, start=source.start) for source in sources
    ]


def by_elimination(matrix: Matrix, sources: Iterable[Source], _tolerance: float) -> list[Solved]:
    """Sparse elimination (SuperLU), refined once, up to 1.1 million nodes; pieces without reservoir held at a node."""
    count = matrix.centre.size
    if count > MOST_ELIMINATED:
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
    leak[leak <= ROUNDING * diagonal] = 0.0
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
        if not residual <= BALANCED:
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
"""In the order in which they are tried."""


def first_to_converge(names: Sequence[str], attempt: Callable[[Solver], Found]) -> tuple[Found, str]:
    """What an attempt finds by the first of the solvers that does not raise a ConvergenceError, and which one it is."""
    *others, last = names
    for name in others:
        try:
            return attempt(SOLVERS[name]), name
        except ConvergenceError:
            continue
    return attempt(SOLVERS[last]), last
