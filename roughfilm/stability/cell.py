"""The map of the cell problems: every solver and the default on many gaps, judged by formulas and by elimination."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.stability.form import (
    BAD,
    GOOD,
    Judgement,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_groups,
    in_numbers,
    in_turn,
    listed,
)
from roughfilm.stability.questions.cell import CellGap, gaps

DEFAULT = "default"
"""Name of the column of the flow factors that users get: all solvers in their order, on nested grids."""

REFERENCES = (("elimination", 1e-8), ("multigrid_double", 1e-12))
"""Solvers that give the reference where no formula does, with their tolerances; the second is used if the first fails.
"""

TOLERANCE = 1e-8
"""Relative tolerance of a single solver in A."""

ALLOWED_ERROR = 1e-6
"""Allowed relative error of A, and of B over the mean gap."""

UNCERTAINTY_FRACTION = 0.1
"""Largest error of the default's linear systems over its uncertainty."""

ROUND_OFF = 1e-9
"""Smallest error that is compared with the solver's own estimate, the remaining gain."""

CLOSED_FRACTION = 1e-13
"""Allowed error of A over the largest h³, because conductances below 1e-14 of the largest h³ are closed."""


@dataclass(frozen=True, kw_only=True)
class CellAnswer:
    """The answer of a solver.

    Attributes
    ----------
    pressure : A, m³, shape (2, 2).
    shear : B over the mean gap, shape (2,).
    unsolved : estimate of the remaining gain in A over A, the larger of both directions.
    uncertainty : uncertainty of A over √(A_ii A_jj), shape (2, 2); 0 for a single solver.
    iterations : number of iterations of all problems.
    closed : error of A that closed conductances may cause, m³.
    """

    pressure: Array
    shear: Array
    unsolved: float
    uncertainty: Array
    iterations: int
    closed: float


@dataclass(frozen=True, kw_only=True)
class Reference:
    """The values that answers are judged by.

    Attributes
    ----------
    pressure : A, m³, shape (2, 2).
    shear : B over the mean gap; None if the source is a formula or if there is no reference.
    source : name of the solver or "a formula"; "nothing" if there is no reference, and A is then NaN.
    """

    pressure: Array
    shear: Array | None
    source: str


def answer_of(gap: CellGap, solver: str, tolerance: float = TOLERANCE) -> CellAnswer:
    """The answer of one solver at a tolerance, or of the default, to the cell problems of a gap."""
    from roughfilm.rom.homogenization.cell import solve_cell  # numba is slow to import
    from roughfilm.rom.homogenization.flow_factors import flow_factors

    if solver == DEFAULT:
        average = flow_factors(gap.thickness, gap.spacing, offset=gap.offset)
        factors, iterations, unsolved = average.factors, average.iterations, average.unsolved
        uncertainty = _over_diagonal(average.uncertainty.pressure, factors.pressure, 0.0)
    else:
        cell = solve_cell(np.add(gap.thickness, gap.offset), gap.spacing, tolerance=tolerance, solvers=(solver,))
        factors, iterations, uncertainty = cell.factors, cell.iterations, np.zeros((2, 2))
        own = np.diag(factors.relative.pressure)
        unsolved = float(np.max(cell.unsolved[:2][own > 0] / own[own > 0], initial=0.0))
    return CellAnswer(
        pressure=factors.pressure,
        shear=factors.shear / factors.mean_gap,
        unsolved=unsolved,
        uncertainty=uncertainty,
        iterations=iterations,
        closed=CLOSED_FRACTION * float(np.max(gap.thickness) + gap.offset) ** 3,
    )


def _over_diagonal(values: Array, pressure: Array, closed: float) -> Array:
    """The excess of the values over ``closed``, over √(A_ii A_jj); infinite where A is 0 and the excess is not."""
    size = np.sqrt(np.outer(np.diag(pressure), np.diag(pressure)))
    more = np.maximum(np.abs(values) - closed, 0.0)
    return np.divide(more, size, out=np.where(more == 0, 0.0, np.inf), where=size > 0)


def reference(gap: CellGap) -> Reference:
    """The reference of a gap: by a formula, else by elimination, else by multigrid."""
    if gap.exact is not None:
        along, cross, across = gap.exact
        return Reference(pressure=np.array([[along, cross], [cross, across]]), shear=None, source="a formula")
    for name, tolerance in REFERENCES:
        try:
            answer = answer_of(gap, name, tolerance)
            return Reference(pressure=answer.pressure, shear=answer.shear, source=name)
        except ConvergenceError:
            continue
    return Reference(pressure=np.full((2, 2), np.nan), shear=None, source="nothing")


def judged(solver: str, right: Callable[[], Reference], answer: CellAnswer) -> Judgement:
    """The judgement of the answer of a solver by the reference that ``right`` returns."""
    truth = right()
    errors = _over_diagonal(answer.pressure - truth.pressure, truth.pressure, answer.closed)
    shear_error = 0.0 if truth.shear is None else float(np.abs(answer.shear - truth.shear).max())
    bound = np.maximum(ALLOWED_ERROR, UNCERTAINTY_FRACTION * answer.uncertainty)
    good = bool((errors <= bound).all() and shear_error <= bound.max())
    missed = f"error {errors.max():.2g} in A and {shear_error:.2g} in B, {bound.max():.2g} allowed, by {truth.source}"
    return Judgement(
        iterations=answer.iterations,
        right=good,
        error=float(errors.max()),
        numbers={"stated": answer.unsolved},
        message="the reference" * (truth.source == solver) if good else missed,
    )


def probe(gap: CellGap, solver: str, right: Callable[[], Reference]) -> Probe:
    """The probe that solves a gap by one solver; ``right`` returns the reference."""
    return Probe(
        group=gap.group,
        row=gap.name,
        column=solver,
        ask=lambda: answer_of(gap, solver),
        judge=partial(judged, solver, right),
        refused=gap.refused,
    )


def probes(nodes: int) -> Iterator[Probe]:
    """The probes of every gap by the default and, unless the gap must be refused, by every single solver.

    The reference of a gap is computed once.
    """
    for gap in gaps(nodes):
        right = cache(partial(reference, gap))
        for solver in [DEFAULT] if gap.refused else solvers():
            yield probe(gap, solver, right)


def solvers() -> list[str]:
    """The name of the default, followed by the names of the single solvers."""
    from roughfilm.rom.homogenization.solvers import SOLVERS  # numba is slow to import

    return [DEFAULT, *SOLVERS]


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: the results of each solver, and where its own estimate of the error is too small."""
    lines = []
    for name in solvers():
        own = [spot for spot in spots if spot.column == name and spot.group != "limits"]
        if good := [spot for spot in own if spot.outcome in GOOD]:
            worst = max(good, key=lambda spot: spot.error or 0)
            lines.append(
                f"{name}: {in_numbers(own)}; at most {max(spot.iterations or 0 for spot in good)} iterations and an "
                f"error of at most {worst.error:.1e} in A ({worst.group}: {worst.row}), "
                f"{sum(spot.cpu_s for spot in own):.2g} s in all."
            )
    over = {spot.place: (spot.error or 0.0) / left for spot in spots if (left := spot.numbers.get("stated"))}
    short = [spot for spot in spots if over.get(spot.place, 0.0) > 1 and (spot.error or 0.0) > ROUND_OFF]
    if short:
        most = max(short, key=lambda spot: over[spot.place])
        lines.append(
            f"{len(short)} errors above {ROUND_OFF:g} are larger than the solver's estimate of the remaining gain, at "
            f"most {over[most.place]:.2g} times ({most.place})."
        )
    if refused := in_groups(spots).get("limits"):
        right = count(refused, MapOutcome.REFUSED)
        lines.append(f"{right} of {len(refused)} invalid questions are refused.")
    default, others = ([spot for spot in spots if (spot.column == DEFAULT) is own] for own in (True, False))
    return lines + listed(default, *BAD) + listed(others, MapOutcome.WRONG)


CELL = StabilityMap(
    name="cell",
    title="Cell problems of homogenization",
    axes="Periodic gaps on {resolution} nodes along a side unless a row says otherwise (rows): contrasts of h³ "
    "to 10¹⁶, contact to 60 %, lays, pixels a hundred times as long as wide, odd, prime and tiny grids, gaps near "
    "sealing, offsets, and invalid input; by each solver alone and by the default, all in their order on "
    "nested grids (columns).",
    judge="A and B by formulas where there are any, else by sparse elimination; the error is that of A. It may "
    f"be {ALLOWED_ERROR:g} and {CLOSED_FRACTION:g} of the largest h³, or {UNCERTAINTY_FRACTION:g} of the default's "
    "uncertainty. Iterations are those of all three problems on the finest grid.",
    resolution=128,
    resolution_meaning="nodes along a side of the cells",
    least=64,
    most=512,
    allowed="the cells take 64 to 512 nodes along a side",
    solve=in_turn(probes),
    summary=summary,
)
