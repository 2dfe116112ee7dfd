"""Where the cell problems are solved: by every solver and by all in their order, judged by formulas and elimination."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from contact.errors import ConvergenceError, InputError
from rom.gap import Array
from scripts import stability_spots as spots_of
from scripts.cell_probes import REFUSED, Probe, probes
from scripts.common import progress_bar
from scripts.stability_made import Made
from scripts.stability_spots import MEANING as ALWAYS
from scripts.stability_spots import State, columns_of, count, entries_of, in_groups, in_rows, table_of

SLOW = 100
"""More iterations than this, on the finest grid and of all three problems together, are slow."""

DEFAULT, TRUTH, OTHERWISE = "default", "elimination", "multigrid_double"
"""All solvers in their order, on nested grids; the one that the others are judged by, and what judges it."""

TOLERANCE, ALLOWED = 1e-8, 1e-6
"""Of A, asked of a solver by itself, and the most that it may be off; B over the mean gap may be off by the same."""

PART = 0.1
"""Of its own error bar: so much of it the default's linear systems may take."""

ROUNDING = 1e-9
"""Errors below it are not compared with what is told of them."""

TRACES = 1e-13
"""Of the largest h³: by so much more A may be off, as conductances below 1e-14 of it are closed."""


MEANING: Mapping[State, str] = {
    State.CONVERGED: f"A within {ALLOWED:g}, and {TRACES:g} of the largest h³; or {PART:g} of the default's error bar",
    State.SLOW: f"the same, after more than {SLOW} iterations",
    **ALWAYS,
}


@dataclass(frozen=True, kw_only=True)
class Spot(spots_of.Spot):
    """What became of one question to one solver; None where there was no answer.

    ``error`` is that of A₁₁ or A₂₂, the larger, over A, ``told`` what the solver says of it.
    """

    error: float | None = None
    told: float | None = None


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a solver found.

    Attributes
    ----------
    pressure, shear : A, m³, and B over the mean gap.
    told : what is left to gain of A, over A, the larger direction.
    bar : the error bar of A, over √(A_ii A_jj); 0 but of the default.
    traces : what A may be off besides, m³.
    """

    pressure: Array
    shear: Array
    told: float
    bar: Array
    iterations: int
    traces: float


def asked(probe: Probe, solver: str, tolerance: float = TOLERANCE) -> Answer:
    """The answer of a solver, or of the default, to a probe."""
    from rom.homogenization.cell import solve_cell  # numba is slow to import
    from rom.homogenization.flow_factors import flow_factors

    if solver == DEFAULT:
        found = flow_factors(probe.gap, probe.spacing, offset=probe.offset)
        factors, iterations, told = found.factors, found.iterations, found.unsolved
        bar = _over_diagonal(found.uncertainty.pressure, factors.pressure, 0.0)
    else:
        cell = solve_cell(np.add(probe.gap, probe.offset), probe.spacing, tolerance=tolerance, solvers=(solver,))
        factors, iterations, bar = cell.factors, cell.iterations, np.zeros((2, 2))
        own = np.diag(factors.relative.pressure)
        told = float(np.max(cell.unsolved[:2][own > 0] / own[own > 0], initial=0.0))
    return Answer(
        pressure=factors.pressure,
        shear=factors.shear / factors.mean_gap,
        told=told,
        bar=bar,
        iterations=iterations,
        traces=TRACES * float(np.max(probe.gap) + probe.offset) ** 3,
    )


def _over_diagonal(values: Array, pressure: Array, traces: float) -> Array:
    """Over √(A_ii A_jj), less what may be off besides; infinite where there is none."""
    size = np.sqrt(np.outer(np.diag(pressure), np.diag(pressure)))
    more = np.maximum(np.abs(values) - traces, 0.0)
    return np.divide(more, size, out=np.where(more == 0, 0.0, np.inf), where=size > 0)


def truth_of(probe: Probe) -> tuple[Array, Array | None, str]:
    """A and B that are taken for right, and where from: a formula, elimination, or where that fails multigrid."""
    if probe.exact is not None:
        along, cross, across = probe.exact
        return np.array([[along, cross], [cross, across]]), None, "a formula"
    for name, tolerance in ((TRUTH, TOLERANCE), (OTHERWISE, 1e-12)):
        try:
            found = asked(probe, name, tolerance)
            return found.pressure, found.shear, name
        except ConvergenceError:
            continue
    return np.full((2, 2), np.nan), None, "nothing"


def tried(probe: Probe, solver: str, truth: tuple[Array, Array | None, str] | None) -> Spot:
    """Put a probe to a solver and judge the answer; whatever else is raised is wrong."""
    spot = partial(Spot, group=probe.group, row=probe.name, column=solver)
    cpu = time.process_time()
    try:
        found = asked(probe, solver)
    except Exception as error:  # a question must end in an answer or in an error of the project's, and is told if not
        spent = time.process_time() - cpu
        if isinstance(error, InputError):
            state = State.REFUSED if probe.expected == REFUSED and "\n" not in str(error) else State.WRONG
        else:
            state = State.STALLED if isinstance(error, ConvergenceError) else State.WRONG
        known = isinstance(error, InputError | ConvergenceError)
        message = str(error) if known else f"{type(error).__name__}: {error}"
        return spot(state=state, iterations=getattr(error, "iterations", None), cpu_s=spent, message=message)
    spent = time.process_time() - cpu
    if truth is None:
        return spot(state=State.WRONG, cpu_s=spent, message="an answer: none exists")
    return _judged(spot(state=State.CONVERGED, iterations=found.iterations, cpu_s=spent), found, truth)


def _judged(spot: Spot, found: Answer, truth: tuple[Array, Array | None, str]) -> Spot:
    """With the error, and what it makes of the answer."""
    right, shear, source = truth
    errors = _over_diagonal(found.pressure - right, right, found.traces)
    error, told = float(errors.max()), found.told
    aside = 0.0 if shear is None else float(np.abs(found.shear - shear).max())
    bound = np.maximum(ALLOWED, PART * found.bar)
    if not ((errors <= bound).all() and aside <= bound.max()):
        message = f"A is off by {error:.2g} and B by {aside:.2g}, {bound.max():.2g} allowed, by {source}"
        return replace(spot, state=State.WRONG, error=error if np.isfinite(error) else None, told=told, message=message)
    state = State.SLOW if (spot.iterations or 0) > SLOW else State.CONVERGED
    return replace(spot, state=state, error=error, told=told, message="taken for right" * (source == spot.column))


@dataclass(frozen=True, kw_only=True)
class CellFamily:
    """The probes of the cell problems."""

    resolution: int = 128
    resolution_meaning: str = "nodes along a side of the cells"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Made:  # noqa: ARG002
        """Try every probe by every solver, one after the other: CPU times are to be compared."""
        if not 64 <= resolution <= 512:
            raise InputError(f"--resolution: got {resolution}; the cells take 64 to 512 nodes along a side")
        every = list(probes(resolution))
        spots: list[Spot] = []
        with progress_bar(len(every)) as advance:
            for number, probe in enumerate(every):
                advance(number, f"{probe.group}: {probe.name}")
                truth = None if probe.expected == REFUSED else truth_of(probe)
                spots += [tried(probe, solver, truth) for solver in (solvers() if truth else [DEFAULT])]
        return Made(
            entries=entries_of("cell", resolution, spots, in_words(spots)),
            columns=columns_of(spots, ("error", "told")),
            table=table_of(in_groups(spots) | by_solver(spots)),
            template="stability_cell.html.j2",
            page={
                "tables": {name: in_rows(found) for name, found in in_groups(spots).items()},
                "solvers": solvers(),
                "states": [(state, MEANING[state], count(spots, state)) for state in State],
                "told": in_words(spots),
            },
        )


def solvers() -> list[str]:
    """The default, and each by itself."""
    from rom.homogenization.solvers import SOLVERS  # numba is slow to import

    return [DEFAULT, *SOLVERS]


def by_solver(spots: Sequence[Spot]) -> dict[str, list[Spot]]:
    """Those that have an answer."""
    answerable = [spot for spot in spots if spot.group != "limits"]
    return {name: [spot for spot in answerable if spot.column == name] for name in solvers()}


def in_words(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know."""
    lines = []
    for name, own in by_solver(spots).items():
        good = [spot for spot in own if spot.state in (State.CONVERGED, State.SLOW)]
        if not good:
            continue
        worst = max(good, key=lambda spot: spot.error or 0)
        lines.append(
            f"{name}: {len(good)} of {len(own)} right, {count(own, State.SLOW)} of these slowly, "
            f"{count(own, State.STALLED)} stalled, {count(own, State.WRONG)} wrong; at most "
            f"{max(spot.iterations or 0 for spot in good)} iterations, A off by at most {worst.error:.1e} "
            f"({worst.group}: {worst.row}), {sum(spot.cpu_s for spot in own):.2g} s in all."
        )
    short = [spot for spot in spots if spot.told and spot.error and spot.error > max(spot.told, ROUNDING)]
    if short:
        most = max(short, key=lambda spot: (spot.error or 0) / (spot.told or 1))
        lines.append(
            f"{len(short)} errors above {ROUNDING:g} are larger than what the solver says is left to gain, at most "
            f"{(most.error or 0) / (most.told or 1):.2g} times ({most.column}, {most.group}: {most.row})."
        )
    refused = [spot for spot in spots if spot.group == "limits"]
    if refused:
        lines.append(f"{count(refused, State.REFUSED)} of {len(refused)} questions that make no sense are refused.")
    return lines + [
        f"{spot.state.capitalize()}: {spot.column}: {spot.group}: {spot.row}: {spot.message}"
        for spot in spots
        if spot.state is State.WRONG or (spot.state is State.STALLED and spot.column == DEFAULT)
    ]


CELL = CellFamily()
