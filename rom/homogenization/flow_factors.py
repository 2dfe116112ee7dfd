"""Flow factors of a gap with an error bar: the cell on its own grid, and on every second and fourth node of it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contact.errors import InputError
from rom.gap import Array
from rom.homogenization.cell import Cell, solve_cell
from rom.homogenization.conductance import FaceRule
from rom.homogenization.factors import FlowFactors
from rom.ladder import Progress, silent

TOLERANCE = 1e-8
"""Of the residuals over their right-hand sides."""

FEWEST = 8
"""Nodes in a direction that is coarsened."""

SAFETY = 1.5
"""Of an error estimated from three grids: 95 of 100 gaps of all kinds are nearer."""


@dataclass(frozen=True, kw_only=True)
class Estimated:
    """Flow factors and how far off they may be.

    Attributes
    ----------
    factors : on the gap's own nodes.
    uncertainty : of each, in the same units; ``mean_gap`` has none, it is that of the nodes.
    correctors : as in :class:`rom.homogenization.cell.Cell`, to begin a gap much alike from.
    contact : the part of the nodes where h = 0.
    """

    factors: FlowFactors
    uncertainty: FlowFactors
    correctors: Array
    contact: float
    iterations: int
    residual: float


def flow_factors(
    gap: ArrayLike,
    spacing: tuple[float, float],
    *,
    rule: FaceRule = FaceRule.LINEAR,
    offset: float = 0.0,
    tolerance: float = TOLERANCE,
    start: Array | None = None,
    progress: Progress = silent,
) -> Estimated:
    """Homogenized coefficients A, B, C, d and e of a periodic gap, each with an error bar.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period. Nodes where h = 0 are contact, whose faces are closed.
    spacing : (dx, dy), m; pixels need not be square.
    offset : m, is added to the gap everywhere: Sahlin 2008, who lets contact through, takes 1e-8.
    tolerance : of the residuals of the cell problems over their right-hand sides.
    start : correctors of a gap much alike on the same grid.

    Raises
    ------
    InputError
        For a gap that is no array of at least 2 x 2 finite numbers, is below 0 anywhere or closed everywhere.
    ConvergenceError
        If a cell problem does not meet the tolerance.

    Second order in the spacing where the gap is smooth and open, near first order at the edges of contact.
    """
    h = checked_gap(gap, spacing) + offset
    cells: list[Cell] = []
    grids = coarser_grids(h, spacing)
    work = [float(grid.size) for grid, _ in grids]
    for number, (grid, steps) in enumerate(grids):
        progress(sum(work[:number]) / sum(work), f"{grid.shape[0]} × {grid.shape[1]} nodes")
        guess = start if number + 1 == len(grids) else None
        cells.append(solve_cell(grid, steps, rule=rule, tolerance=tolerance, start=guess))
    finest = cells[-1]
    return Estimated(
        factors=finest.factors,
        uncertainty=uncertainty_of([cell.factors for cell in cells]),
        correctors=finest.correctors,
        contact=float((h == 0).mean()),
        iterations=finest.iterations,
        residual=finest.residual,
    )


def checked_gap(gap: ArrayLike, spacing: tuple[float, float]) -> Array:
    """The gap as numbers; InputError as in :func:`flow_factors`."""
    h = np.asarray(gap)
    if h.ndim != 2 or min(h.shape, default=0) < 2:
        raise InputError(
            f"gap: got shape {h.shape}; give at least 2 x 2 nodes (rom.homogenization.line takes profiles)"
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
    if len(spacing) != 2 or not all(np.isfinite(step) and step > 0 for step in spacing):
        raise InputError(f"spacing: got {spacing!r}; give two lengths above 0, in m")
    return h


def coarser_grids(gap: Array, spacing: tuple[float, float]) -> list[tuple[Array, tuple[float, float]]]:
    """The gap on up to three grids, the coarsest first, and their spacings; nodes of a finer one where they fit."""
    grids = [(gap, spacing)]
    while len(grids) < 3:
        h, steps = grids[0]
        counts = tuple(-(-n // 2) if n >= FEWEST else n for n in h.shape)
        if counts == h.shape:
            break
        coarser = (steps[0] * h.shape[0] / counts[0], steps[1] * h.shape[1] / counts[1])
        grids.insert(0, (sampled(sampled(h, counts[0], 0), counts[1], 1), coarser))
    return grids


def sampled(gap: Array, count: int, axis: int) -> Array:
    """The gap at ``count`` places evenly along an axis, straight between its nodes."""
    own = gap.shape[axis]
    if own % count == 0:
        return np.take(gap, np.arange(0, own, own // count), axis=axis)
    place = np.arange(count) * (own / count)
    before = place.astype(np.int64)
    part = np.expand_dims(place - before, 1 - axis)
    after = np.take(gap, (before + 1) % own, axis=axis)
    return np.asarray(np.take(gap, before, axis=axis) * (1 - part) + after * part)


def uncertainty_of(found: list[FlowFactors]) -> FlowFactors:
    """Of the last of up to three on grids each twice as fine, by Richardson's rule at the order seen, one to two."""

    def off(values: list[Array]) -> Array:
        if len(values) < 2:
            return np.full_like(values[0], np.inf)
        last = np.abs(values[-1] - values[-2])
        if len(values) < 3:
            return SAFETY * last
        before = np.abs(values[-2] - values[-3])
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.clip(np.where(last > 0, before / last, 4.0), 2.0, 4.0)
        return np.asarray(SAFETY * np.maximum(last, before / 4) / (ratio - 1))

    def each(name: str) -> Array:
        return off([np.asarray(getattr(factors, name), dtype=float) for factors in found])

    return replace(
        found[-1],
        mean_gap=0.0,
        pressure=each("pressure"),
        shear=each("shear"),
        couette=float(each("couette")),
        shear_couette=float(each("shear_couette")),
    )
