"""Flow factors of a gap with their uncertainty, from its own grid and two coarser ones."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING
from roughfilm.rom.homogenization.cell import Cell, solve_cell
from roughfilm.rom.homogenization.conductance import CLOSED_CUBE, FaceRule, without_traces
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.grids import coarser_grids
from roughfilm.rom.homogenization.richardson import LOOSEST_TOLERANCE, sufficient, uncertainty_of
from roughfilm.rom.homogenization.solvers import SOLVERS
from roughfilm.rom.ladder.model import Progress, silent

MAX_PIXEL_ASPECT = 1e4
"""Largest ratio of a pixel's sides."""

SHARES = np.array([1.0, 1.0, 5.0])
"""Solver tolerances of A₁₁, A₂₂ and e over :func:`sufficient`; in contact e depends on the grid by a tenth and more."""


@dataclass(frozen=True, kw_only=True)
class Estimated:
    """Flow factors and their uncertainty.

    Attributes
    ----------
    factors : on the nodes of the gap.
    uncertainty : uncertainty of each factor, in its unit; 0 for ``mean_gap``, the mean over the nodes.
    correctors : as in :class:`roughfilm.rom.homogenization.cell.Cell`.
    contact : fraction of closed nodes: h = 0, or h³ below 1e-14 of the largest.
    unsolved : largest relative solver error of A₁₁, A₂₂ and e.
    residual : residual of χ; it may far exceed ``unsolved``, since χ counts equally where hardly anything flows.
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
    """Homogenized coefficients A, B, C, d and e of a periodic gap, each with its uncertainty.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period. Nodes where h = 0 are contact, whose faces are closed.
    spacing : (dx, dy), m; pixels need not be square.
    offset : length added to the gap everywhere, m; Sahlin 2008 uses 1e-8, which makes contact permeable.
    tolerance : solver tolerance of each cell, as in ``solve_cell``; by default, for A₁₁ and A₂₂ a hundredth and
        for e a twentieth of the discretisation error that the coarser grids indicate.
    solvers : names of solvers, as in ``solve_cell``.

    Raises
    ------
    InputError
        If the gap is not an array of at least 2 x 2 finite numbers, is negative anywhere or closed everywhere, or if
        the offset is negative.
    ConvergenceError
        If a cell problem does not meet the tolerance.

    Each grid starts from the correctors of the coarser one. The factors are second-order accurate in the spacing where
    the gap is smooth and open, and nearly first-order at the edges of contact.
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
        energies = [np.array([*np.diag(one.pressure), one.shear_couette]) for one in (cell.factors for cell in cells)]
        cells.append(
            solve_cell(
                grid,
                steps,
                rule=rule,
                tolerance=SHARES * sufficient(energies, LOOSEST_TOLERANCE) if tolerance is None else tolerance,
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
    h = unmasked("gap", gap)
    if h.ndim != 2 or min(h.shape, default=0) < 2:
        raise InputError(f"gap: got shape {h.shape}; give at least 2 x 2 nodes (for a profile call line_factors)")
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
    if not 1 / MAX_PIXEL_ASPECT <= spacing[0] / spacing[1] <= MAX_PIXEL_ASPECT:
        raise InputError(
            f"spacing: got {spacing!r} m; pixels may be up to {MAX_PIXEL_ASPECT:g} times as long as wide, resample"
        )
    return h


def _largest_part(cell: Cell) -> float:
    own = cell.factors.relative
    sizes = np.array([own.pressure[0, 0], own.pressure[1, 1], own.shear_couette])
    return float(np.max(cell.unsolved[sizes > 0] / sizes[sizes > 0], initial=0.0))


def _uncertainty(cells: list[Cell], h: Array) -> FlowFactors:
    """Sum of the discretisation error, the solver error and the flow through nodes treated as closed."""
    grids = uncertainty_of([cell.factors for cell in cells])
    unsolved, gap = cells[-1].unsolved, cells[-1].factors.mean_gap
    mixed = np.sqrt(unsolved[:2])
    closed = CLOSED_CUBE ** (1 / 3) * float(h.max()) if ((h > 0) & (without_traces(h) == 0)).any() else 0.0
    return replace(
        grids,
        pressure=grids.pressure + gap**3 * np.outer(mixed, mixed) + closed**3,
        shear=grids.shear + gap * mixed * np.sqrt(unsolved[2]) + closed,
        shear_couette=grids.shear_couette + float(unsolved[2]) / gap,
    )
