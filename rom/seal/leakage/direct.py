"""Direct solution of the flow through one or several periods of a gap between two reservoirs."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.homogenization.box import Box
from roughfilm.rom.homogenization.conductance import CLOSED_CUBE, FaceRule, faces, without_traces
from roughfilm.rom.homogenization.flow_factors import checked_gap
from roughfilm.rom.homogenization.grids import coarser_grids, refined
from roughfilm.rom.homogenization.paths import sealed_between_ends
from roughfilm.rom.homogenization.richardson import LOOSEST_TOLERANCE, off, sufficient
from roughfilm.rom.homogenization.solvers import SOLVERS, Solver, Source, first_to_converge
from roughfilm.rom.multigrid.multigrid import Solved
from roughfilm.rom.seal.leakage.passage import Leakage, Passage, shut


def direct_leakage(gap: ArrayLike, spacing: tuple[float, float], *, periods: int = 1) -> Leakage:
    """Compute the leakage in x and in y by :func:`direct_flow`, which explains the parameters and errors."""
    return Leakage(
        along=direct_flow(gap, spacing, 0, periods=periods), across=direct_flow(gap, spacing, 1, periods=periods)
    )


def direct_flow(
    gap: ArrayLike,
    spacing: tuple[float, float],
    direction: int,
    *,
    periods: int = 1,
    rule: FaceRule = FaceRule.LINEAR,
    tolerance: float | None = None,
    solvers: Sequence[str] = tuple(SOLVERS),
) -> Passage:
    """Solve ∇·(h³∇p) = 0 with p given at the two ends of a gap and periodic across, and return the flow.

    The ends are the nodes at x = 0 and their copies ``periods`` periods on. The flow is a quadratic
    functional of the pressure, so that its error is quadratic in the error of the pressure. Since the pressure is
    uniform at the ends, K ≥ A₁₁ of the periodic gap on any grid; the difference decreases as 1/periods.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period. Nodes with h = 0 are in contact and their faces are closed; h may be 0
        everywhere.
    spacing : (dx, dy), m.
    direction : 0 for flow in x, 1 in y.
    periods : number of periods in the direction of the flow.
    rule : interpolation of the gap between nodes.
    tolerance : largest relative solver error of K; by default a hundredth of the discretisation error estimated from
        coarser grids.
    solvers : names in :data:`roughfilm.rom.homogenization.solvers.SOLVERS`, tried in this order.

    Raises
    ------
    InputError
        If :func:`roughfilm.rom.homogenization.flow_factors.flow_factors` raises it, or ``periods`` is below 1.
    ConvergenceError
        If none of the solvers meets the tolerance.

    The error is of second order in the spacing where the gap is smooth and open, and of nearly first order at the edges
    of contact. The uncertainty is estimated from solutions on every second and every fourth node; that of a sealed gap
    is above 0 if these are open.

    Source: Sahlin 2008, F.7 and F.11, which sets the gap in contact to 10 nm and subtracts the leakage of a sealed
    gap.
    """
    if tolerance is not None and not 0 < tolerance < 1:
        raise InputError(f"tolerance: got {tolerance!r}; it must be above 0 and below 1")
    if not (isinstance(periods, int) and periods >= 1):
        raise InputError(f"periods: got {periods!r}; give 1 or more")
    gap = unmasked("gap", gap)
    if np.ndim(gap) == 2 and np.size(gap) and not np.any(gap):
        return shut(np.tile(gap, (periods, 1) if direction == 0 else (1, periods)).shape)
    h = checked_gap(gap, spacing)
    if direction == 1:
        h, spacing = np.ascontiguousarray(h.T), (spacing[1], spacing[0])
    scale = float(h.mean())
    solutions: list[_Solution] = []
    for grid, (dx, dy) in coarser_grids(h / scale, spacing):
        flows = [np.array(one.permeability) for one in solutions]
        limit = float(sufficient(flows, LOOSEST_TOLERANCE)) if tolerance is None else tolerance
        coarser = solutions[-1] if solutions else None
        solutions.append(_solve(np.tile(grid, (periods, 1)), dy / dx, rule, limit, solvers, coarser))
    finest = solutions[-1]
    closed = sealed_between_ends(np.tile(h, (periods, 1)), joined=True)
    trace = CLOSED_CUBE ** (1 / 3) * float(h.max()) if ((h > 0) & (without_traces(h) == 0)).any() else 0.0
    uncertainty = float(off([np.array(one.permeability) for one in solutions])) + finest.left
    corrector = finest.corrector * spacing[0]
    return Passage(
        permeability=finest.permeability * scale**3,
        uncertainty=uncertainty * scale**3 + trace**3,
        sealed=closed,
        corrector=np.ascontiguousarray(corrector.T) if direction == 1 else corrector,
        unsolved=finest.left / finest.permeability if finest.permeability > 0 else 0.0,
        iterations=finest.iterations,
        residual=finest.residual,
    )


@dataclass(frozen=True, kw_only=True)
class _Solution:
    """The solution on one grid for a mean gap of 1, with the corrector in spacings."""

    permeability: float
    left: float
    corrector: Array
    iterations: int
    residual: float


def _solve(
    h: Array, aspect: float, rule: FaceRule, tolerance: float, solvers: Sequence[str], coarser: _Solution | None
) -> _Solution:
    counted = without_traces(h)
    if sealed_between_ends(counted, joined=True):
        return _Solution(permeability=0.0, left=0.0, corrector=np.zeros(h.shape), iterations=0, residual=0.0)
    parts = faces(counted, rule)
    box = Box(east=parts.east * aspect, north=parts.north / aspect, joined=True)
    matrix = box.matrix()
    per_width = 1 / (aspect * h.shape[1])

    def attempt(solve: Solver) -> tuple[Solved, float, float]:
        start = None if coarser is None else refined(coarser.corrector, h.shape)[1:] * (len(h) / len(coarser.corrector))
        source = Source(values=box.source(), whole=box.whole(), start=start, tolerance=tolerance)
        (solved,) = solve(matrix, [source])
        flow = box.flow(solved.solution)
        left = max(solved.left / len(h), flow.uneven)
        if left > 2 * tolerance * flow.through:
            raise ConvergenceError(
                f"leakage: relative flow error {left / flow.through:.3g} from unequal cross sections misses the "
                f"tolerance {tolerance:g}; loosen it",
                outcome=Outcome.STALLED,
                iterations=solved.iterations,
            )
        return solved, flow.through * per_width, left * per_width

    (solved, through, left), _ = first_to_converge(solvers, attempt)
    return _Solution(
        permeability=through,
        left=left,
        corrector=np.pad(solved.solution, ((1, 0), (0, 0))),
        iterations=solved.iterations,
        residual=solved.residual,
    )
