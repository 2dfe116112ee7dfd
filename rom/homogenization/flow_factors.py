"""Flow factors of a gap with an error bar: the cell on its own grid, and on every second and fourth node of it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING
from roughfilm.rom.homogenization.cell import Cell, solve_cell
from roughfilm.rom.homogenization.conductance import CLOSED, FaceRule, without_traces
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.grids import coarser_grids
from roughfilm.rom.homogenization.richardson import sufficient, uncertainty_of
from roughfilm.rom.homogenization.solvers import SOLVERS
from roughfilm.rom.ladder.model import Progress, silent

LONGEST = 1e4
"""Of a pixel, over its width."""


@dataclass(frozen=True, kw_only=True)
class Estimated:
    """Flow factors and how far off they may be.

    Attributes
    ----------
    factors : on the gap's own nodes.
    uncertainty : of each, in the same units; ``mean_gap`` has none, it is that of the nodes.
    correctors : as in :class:`roughfilm.rom.homogenization.cell.Cell`.
    contact : the part of the nodes that are closed: where h = 0, or h³ below 1e-14 of the largest.
    unsolved : the largest part of A₁₁, A₂₂ or e by which iterating on would change them.
    residual : of χ, which may be far larger: where next to nothing flows χ counts as much as elsewhere.
    """

    factors: FlowFactors
    uncertainty: FlowFactors
    correctors: Array
    contact: float
    unsolved: float
    iterations: int
    residual: float


def flow_factors(
    gap: ArrayLike,
    spacing: tuple[float, float],
    *,
    rule: FaceRule = FaceRule.LINEAR,
    offset: float = 0.0,
    tolerance: float | None = None,
    solvers: Sequence[str] = tuple(SOLVERS),
    progress: Progress = silent,
) -> Estimated:
    """Homogenized coefficients A, B, C, d and e of a periodic gap, each with an error bar.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period. Nodes where h = 0 are contact, whose faces are closed.
    spacing : (dx, dy), m; pixels need not be square.
    offset : m, is added to the gap everywhere: Sahlin 2008, who lets contact through, takes 1e-8.
    tolerance : of each cell, as :func:`rom.homogenization.cell.solve_cell` takes it; by default a hundredth of what the
        coarser grids say that the grid is off by.
    solvers : as :func:`roughfilm.rom.homogenization.cell.solve_cell` takes them.

    Raises
    ------
    InputError
        For a gap that is no array of at least 2 x 2 finite numbers, is below 0 anywhere or closed everywhere; for an
        offset below 0.
    ConvergenceError
        If a cell problem does not meet the tolerance.

    Each grid begins from the correctors of the coarser one, which are nearer than those of a gap 10 % wider are. Second
    order in the spacing where the gap is smooth and open, near first order at the edges of contact.
    """
    if tolerance is not None and not 0 < tolerance < 1:
        raise InputError(f"tolerance: got {tolerance!r}; it must be above 0 and below 1")
    if not 0 <= offset < np.inf:
        raise InputError(f"offset: got {offset!r} m; give 0 or more")
    h = checked_gap(gap, spacing) + offset
    cells: list[Cell] = []
    grids = coarser_grids(h, spacing)
    work = [float(grid.size) for grid, _ in grids]
    for number, (grid, steps) in enumerate(grids):
        progress(sum(work[:number]) / sum(work), f"{grid.shape[0]} × {grid.shape[1]} nodes")
        flows = [np.diag(cell.factors.pressure) for cell in cells]
        cells.append(
            solve_cell(
                grid,
                steps,
                rule=rule,
                tolerance=sufficient(flows) if tolerance is None else tolerance,
                start=cells[-1].correctors if cells else None,
                solvers=solvers,
            )
        )
    finest = cells[-1]
    return Estimated(
        factors=finest.factors,
        uncertainty=_uncertainty(cells, h),
        correctors=finest.correctors,
        contact=float((without_traces(h) == 0).mean()),
        unsolved=_largest_part(finest),
        iterations=finest.iterations,
        residual=finest.residual,
    )


def checked_gap(gap: ArrayLike, spacing: tuple[float, float]) -> Array:
    """The gap as numbers; InputError as in :func:`flow_factors`."""
    if isinstance(gap, np.ma.MaskedArray):
        raise InputError("gap: is masked; fill what is masked first")
    h = np.asarray(gap)
    if h.ndim != 2 or min(h.shape, default=0) < 2:
        raise InputError(
            f"gap: got shape {h.shape}; give at least 2 x 2 nodes (roughfilm.rom.homogenization.line takes profiles)"
        )
    if h.dtype.kind not in "fiu":
        raise InputError(f"gap: got {h.dtype}; give real numbers, in m")
    h = h.astype(np.float64)
    if not np.isfinite(h).all():
        i, j = np.argwhere(~np.isfinite(h))[0]
        raise InputError(f"gap: got {h[i, j]} at [{i}, {j}]; fill such nodes first")
    if h.min() < 0:
        i, j = np.unravel_index(int(h.argmin()), h.shape)
        raise InputError(f"gap: got {h[i, j]:.6g} m at [{i}, {j}]; walls cannot overlap, set contact to 0")
    if not h.any():
        raise InputError("gap: is closed everywhere; there is no film, raise the separation")
    if not MIN_SPACING <= h.max() <= MAX_LENGTH:
        raise InputError(f"gap: got up to {h.max():.3g} m; give {MIN_SPACING:g} to {MAX_LENGTH:g} m, look at the unit")
    steps = np.asarray(spacing, dtype=object)
    if steps.shape != (2,) or not all(np.isfinite(step) and step > 0 for step in spacing):
        raise InputError(f"spacing: got {spacing!r}; give two lengths above 0, in m")
    if not 1 / LONGEST <= spacing[0] / spacing[1] <= LONGEST:
        raise InputError(f"spacing: got {spacing!r} m; pixels may be up to {LONGEST:g} times as long as wide, resample")
    return h


def _largest_part(cell: Cell) -> float:
    own = cell.factors.relative
    sizes = np.array([own.pressure[0, 0], own.pressure[1, 1], own.shear_couette])
    return float(np.max(cell.unsolved[sizes > 0] / sizes[sizes > 0], initial=0.0))


def _uncertainty(cells: list[Cell], h: Array) -> FlowFactors:
    """What the grids leave open, what the solver does, and what passes where the film is too thin to count."""
    doubt = uncertainty_of([cell.factors for cell in cells])
    unsolved, gap = cells[-1].unsolved, cells[-1].factors.mean_gap
    mixed = np.sqrt(unsolved[:2])
    trace = CLOSED ** (1 / 3) * float(h.max()) if ((h > 0) & (without_traces(h) == 0)).any() else 0.0
    return replace(
        doubt,
        pressure=doubt.pressure + gap**3 * np.outer(mixed, mixed) + trace**3,
        shear=doubt.shear + gap * mixed * np.sqrt(unsolved[2]) + trace,
        shear_couette=doubt.shear_couette + float(unsolved[2]) / gap,
    )
