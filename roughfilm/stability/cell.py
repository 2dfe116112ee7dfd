"""Where the cell problems are solved: by every solver and by all in their order, judged by formulas and elimination."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.stability.form import BAD, GOOD, Judged, Map, Outcome, Spot, count, named, summed, tried
from roughfilm.stability.questions.cell import REFUSED, Probe, probes
from roughfilm.terminal.console import progress_bar

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
    from roughfilm.rom.homogenization.cell import solve_cell  # numba is slow to import
    from roughfilm.rom.homogenization.flow_factors import flow_factors

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


Truth = tuple[Array, Array | None, str]


def put(probe: Probe, solver: str, truth: Truth | None) -> Spot:
    """A probe put to a solver; what has no truth must be refused."""
    spot = partial(Spot, group=probe.group, row=probe.name, column=solver)

    def judge(found: Answer) -> Judged:
        assert truth is not None
        return judged(found, truth, solver)

    return tried(spot, lambda: asked(probe, solver), judge, refused=probe.expected == REFUSED)


def judged(found: Answer, truth: Truth, solver: str) -> Judged:
    """By what is taken for right."""
    right, shear, source = truth
    errors = _over_diagonal(found.pressure - right, right, found.traces)
    aside = 0.0 if shear is None else float(np.abs(found.shear - shear).max())
    bound = np.maximum(ALLOWED, PART * found.bar)
    good = bool((errors <= bound).all() and aside <= bound.max())
    missed = f"A is off by {errors.max():.2g} and B by {aside:.2g}, {bound.max():.2g} allowed, by {source}"
    return Judged(
        iterations=found.iterations,
        right=good,
        error=float(errors.max()),
        numbers={"told": found.told},
        message="taken for right" * (source == solver) if good else missed,
    )


@dataclass(frozen=True, kw_only=True)
class CellFamily:
    """The probes of the cell problems."""

    resolution: int = 128
    resolution_meaning: str = "nodes along a side of the cells"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:  # noqa: ARG002
        """Try every probe by every solver, one after the other: CPU times are to be compared."""
        if not 64 <= resolution <= 512:
            raise InputError(f"--resolution: got {resolution}; the cells take 64 to 512 nodes along a side")
        every = list(probes(resolution))
        spots: list[Spot] = []
        with progress_bar(len(every)) as advance:
            for number, probe in enumerate(every):
                advance(number, f"{probe.group}: {probe.name}")
                truth = None if probe.expected == REFUSED else truth_of(probe)
                spots += [put(probe, solver, truth) for solver in (solvers() if truth else [DEFAULT])]
        return Map(
            family="cell",
            title="Cell problems of homogenization",
            axes=f"Periodic gaps on {resolution} nodes along a side where nothing else is said (rows): contrasts of h³ "
            "to 10¹⁶, contact to 60 %, lays, pixels a hundred times as long as wide, odd, prime and tiny grids, "
            "gaps near "
            "sealing, offsets, and what makes no sense; by each solver alone and by the default, all in their order on "
            "nested grids (columns).",
            judge="A and B by formulas where there are any, else by sparse elimination; the error is that of A. It may "
            f"be {ALLOWED:g} and {TRACES:g} of the largest h³, or {PART:g} of the default's error bar. Iterations are "
            "those of all three problems on the finest grid.",
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=in_words(spots),
        )


def solvers() -> list[str]:
    """The default, and each by itself."""
    from roughfilm.rom.homogenization.solvers import SOLVERS  # numba is slow to import

    return [DEFAULT, *SOLVERS]


def by_solver(spots: Sequence[Spot]) -> dict[str, list[Spot]]:
    """Those that have an answer."""
    answerable = [spot for spot in spots if spot.group != "limits"]
    return {name: [spot for spot in answerable if spot.column == name] for name in solvers()}


def in_words(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know."""
    lines = []
    for name, own in by_solver(spots).items():
        if good := [spot for spot in own if spot.outcome in GOOD]:
            worst = max(good, key=lambda spot: spot.error or 0)
            lines.append(
                f"{name}: {summed(own)}; at most {max(spot.iterations or 0 for spot in good)} iterations, A off by at "
                f"most {worst.error:.1e} ({worst.group}: {worst.row}), {sum(spot.cpu_s for spot in own):.2g} s in all."
            )
    over = {spot.place: (spot.error or 0.0) / told for spot in spots if (told := spot.numbers.get("told"))}
    short = [spot for spot in spots if over.get(spot.place, 0.0) > 1 and (spot.error or 0.0) > ROUNDING]
    if short:
        most = max(short, key=lambda spot: over[spot.place])
        lines.append(
            f"{len(short)} errors above {ROUNDING:g} are larger than what the solver says is left to gain, at most "
            f"{over[most.place]:.2g} times ({most.place})."
        )
    refused = [spot for spot in spots if spot.group == "limits"]
    if refused:
        lines.append(f"{count(refused, Outcome.REFUSED)} of {len(refused)} questions that make no sense are refused.")
    default = [spot for spot in spots if spot.column == DEFAULT]
    return lines + named(default, *BAD) + named([s for s in spots if s.column != DEFAULT], Outcome.WRONG)


CELL = CellFamily()
