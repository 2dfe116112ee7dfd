"""Test the advice on scenes to which no law was fitted: python -m scripts.studies.advice.check --out OUT."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Annotated, Any

import numpy as np
import typer
from matplotlib.figure import Figure
from rich.markup import escape
from rich.table import Table

from roughfilm.batch.directory import alone
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import Verdict, advise
from roughfilm.rom.advice.laws import table
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Numerics, Result
from roughfilm.terminal.console import (
    AsJson,
    in_one_line,
    make_directory,
    output,
    print_json,
    run_alone,
)
from scripts.studies.advice.fit import SolvedScene, cases
from scripts.studies.advice.runs import PARTS, Run, draw, read
from scripts.studies.study import Out, counted, write

TOLERANCES = (0.02, 0.05, 0.10)

REQUIRED_FRACTION = 0.95
"""Least fraction of the scenes whose true error is within the tolerance."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """Advice for one scene, quantity and tolerance, its expected error and its true error.

    ``error`` and ``bar`` are relative to the best model: the error of the chosen one, and the uncertainty of the best.
    ``spent_cpu_s`` is the CPU time of all runs for advice and answer, ``advice_cpu_s`` that of the advice alone, and
    ``best_cpu_s`` that of the best model at its default resolution.
    """

    kind: str
    seed: int
    quantity: str
    within: float
    model: str | None
    resolution: int | None
    expected: float | None
    error: float | None
    bar: float
    spent_cpu_s: float
    advice_cpu_s: float
    best: str
    best_cpu_s: float
    reason: str

    @property
    def missed(self) -> bool:
        """Whether the true error exceeds the tolerance."""
        return self.error is not None and not self.error <= self.within

    @property
    def cost_ratio(self) -> float:
        """CPU time of advice and answer divided by that of the best model."""
        return (self.spent_cpu_s + self.advice_cpu_s) / self.best_cpu_s


def as_result(case: SolvedScene, run: Run) -> Result:
    """Return a row of a table as a result without fields."""
    return Result(
        model=run.model,
        quantities={
            name: Quantity(value=value, unit="1", uncertainty=run.uncertainty.get(name))
            for name, value in run.values.items()
        },
        fields={},
        numerics=Numerics(
            residual=0.0,
            iterations=0,
            cpu_s=run.cpu_s,
            wall_s=0.0,
            degrees_of_freedom=0,
            resolution=run.resolution,
            tolerance=0.0,
            scheme="",
        ),
        provenance={"scene": {"kind": case.scene.kind}},
    )


def tried(case: SolvedScene, within: float, quantity: str) -> Trial:
    """Ask for advice on a quantity and judge it; models in the table are looked up there, others are run."""
    kind = kinds()[case.scene.kind]
    ladder = models(kind.name)
    solving = 0.0

    def run(model: Model, resolution: int) -> Result:
        nonlocal solving
        found = case.runs.get((model.name, resolution))
        if found is None:
            begun = time.process_time()
            result = model.solve(case.scene, Request(resolution=resolution))
            solving += time.process_time() - begun
            return result
        if found.failure:
            raise InputError(found.failure)
        return as_result(case, found)

    begun = time.process_time()
    advice = advise(case.scene, ladder, quantity=quantity, within=within, run=run)
    own = time.process_time() - begun - solving
    chosen, best = advice.chosen, case.finest(case.best)
    assert best is not None
    spent, error = advice.spent_cpu_s, None
    size = float(kind.scale({**best.values, **case.truth}, quantity))
    if chosen is not None and chosen.resolution is not None:
        result = advice.result
        if result is None:
            result = run(find(kind.name, chosen.model), chosen.resolution)
            spent += result.numerics.cpu_s
        error = abs(result.quantities[quantity].value - case.truth[quantity]) / size
    default = case.runs.get((case.best, find(kind.name, case.best).resolution_of(case.scene)), best)
    reasons = [one.reason for one in advice.considered if one.verdict is Verdict.CHOSEN]
    return Trial(
        kind=kind.name,
        seed=case.seed,
        quantity=quantity,
        within=within,
        model=chosen.model if chosen else None,
        resolution=chosen.resolution if chosen else None,
        expected=chosen.error if chosen else None,
        error=error,
        bar=case.bar[quantity] / size,
        spent_cpu_s=spent,
        advice_cpu_s=own,
        best=case.best,
        best_cpu_s=default.cpu_s,
        reason=reasons[0] if reasons else "",
    )


@dataclass(frozen=True, kw_only=True)
class Score:
    """The numbers of right advice in some trials, and its cost."""

    scenes: int
    answered: int
    kept: int
    cost_ratio: float

    @property
    def share(self) -> float:
        """Fraction of the answered scenes whose error is within the tolerance."""
        return self.kept / self.answered if self.answered else float("nan")


def score(trials: Sequence[Trial]) -> Score:
    """Return the score of trials at one tolerance."""
    answered = [one for one in trials if one.error is not None]
    return Score(
        scenes=len(trials),
        answered=len(answered),
        kept=sum(not one.missed for one in answered),
        cost_ratio=median(one.cost_ratio for one in trials) if trials else float("nan"),
    )


def scores(trials: Sequence[Trial]) -> dict[str, dict[float, Score]]:
    """Return scores by kind, quantity and tolerance; also of all trials, and of those with Navier–Stokes."""
    groups: dict[str, Sequence[Trial]] = {
        f"{kind}, {kinds()[kind].compared[quantity]}": [o for o in trials if (o.kind, o.quantity) == (kind, quantity)]
        for kind, quantity in dict.fromkeys((one.kind, one.quantity) for one in trials)
    }
    groups["all"] = trials
    groups["with Navier–Stokes"] = [one for one in trials if one.best == "navier_stokes"]
    return {
        name: {within: score([one for one in group if one.within == within]) for within in TOLERANCES}
        for name, group in groups.items()
    }


def choices(trials: Sequence[Trial]) -> dict[tuple[str, str], dict[float, int]]:
    """Return how often each model was advised, by tolerance."""
    names = sorted({(one.kind, one.model or "none") for one in trials})
    return {
        (kind, model): {
            within: sum((one.kind, one.model or "none", one.within) == (kind, model, within) for one in trials)
            for within in TOLERANCES
        }
        for kind, model in names
    }


def figure(trials: Sequence[Trial]) -> Figure:
    """Draw expected and true errors, and the cost relative to the best model."""
    drawn = Figure(figsize=(10, 4.2), layout="constrained")
    left, right = drawn.subplots(1, 2)
    known = [one for one in trials if one.error is not None and one.expected]
    for kind in dict.fromkeys(one.kind for one in known):
        own = [one for one in known if one.kind == kind]
        expected = [one.expected or 0.0 for one in own]
        left.loglog(expected, [max(one.error or 0.0, 1e-7) for one in own], ".", label=kind, markersize=4)
        ratios = np.sort([one.cost_ratio for one in trials if one.kind == kind])
        right.semilogx(ratios, np.linspace(0, 100, ratios.size), label=kind)
    ends = np.array([1e-5, 0.1])
    left.loglog(ends, ends, color="0.4", linewidth=0.8)
    left.set(xlabel="expected error, at most", ylabel="true error against the best model", ylim=(1e-7, 1))
    right.set(xlabel="CPU time of advice and answer over that of the best model", ylabel="% of the scenes")
    right.axvline(0.01, color="0.4", linewidth=0.8)
    left.legend(fontsize=8)
    return drawn


def entries_of(trials: Sequence[Trial]) -> dict[str, Any]:
    """Return the numbers of the page."""
    return {
        "scores": {
            name: {f"{within:g}": {**asdict(one), "share": one.share} for within, one in by.items() if one.answered}
            for name, by in scores(trials).items()
        },
        "misses": [asdict(one) for one in trials if one.missed],
        "unanswered": [asdict(one) for one in trials if one.error is None],
        "trials": [asdict(one) for one in trials],
        "seeds": {kind: [seeds.start, seeds.stop - 1] for kind, seeds in PARTS["check"].items()},
        "laws": dict(table().provenance),
        "provenance": circumstances(),
    }


@in_one_line
def command(
    out: Out,
    jobs: Annotated[int, typer.Option(help="Processes.")] = 2,
    again: Annotated[bool, typer.Option(help="Judge finished runs without solving any.")] = False,
    as_json: AsJson = False,
) -> None:
    """Ask for advice on random scenes to which nothing was fitted, and compare it with the best model."""
    make_directory(out)
    if jobs < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    if not again:
        with alone(out) as scratch:
            for kind in PARTS["check"]:
                draw("check", kind, out, jobs, scratch)
    known = [case for kind in PARTS["check"] for case in cases(kind, read("check", kind, out)[0])]
    asked = [
        (case, quantity, within)
        for case in known
        for quantity in kinds()[case.scene.kind].compared
        for within in TOLERANCES
    ]
    trials: list[Trial] = []
    with counted(len(asked)) as advance:
        for case, quantity, within in asked:
            advance(f"{case.scene.name}, {quantity} within {within:.0%}")
            trials.append(tried(case, within, quantity))
    entries, page = write(
        Path(__file__).parent,
        out,
        {"advice": figure(trials)},
        entries_of(trials),
        asked=REQUIRED_FRACTION,
        tolerances=TOLERANCES,
        entries=entries_of(trials),
        misses=[one for one in trials if one.missed],
        choices=choices(trials),
        scores=scores(trials),
    )
    if as_json:
        print_json({name: entries[name] for name in ("scores", "misses", "provenance")})
        return
    output.print(_table(scores(trials)))
    for one in trials:
        if one.missed:
            output.print(f"missed: {escape(_miss(one))}", soft_wrap=True)
    output.print(f"page: {escape(str(page))}", soft_wrap=True)


def _miss(one: Trial) -> str:
    return (
        f"{one.kind} {one.seed}, {one.quantity} at {one.within:.0%}: {one.model}, {one.resolution}: "
        f"{100 * (one.error or 0):.2g} % off "
        f"(expected {100 * (one.expected or 0):.2g} %; best model ± {100 * one.bar:.2g} %): {one.reason}"
    )


def _table(found: Mapping[str, Mapping[float, Score]]) -> Table:
    shown = Table("scenes", *(f"within {within:.0%}" for within in TOLERANCES), "median cost over the best model's")
    for name, by in found.items():
        cells = [
            f"{one.kept} of {one.answered} ({one.share:.1%}), {one.scenes - one.answered} none" for one in by.values()
        ]
        shown.add_row(
            f"{name} ({next(iter(by.values())).scenes})", *cells, ", ".join(f"{o.cost_ratio:.2%}" for o in by.values())
        )
    return shown


if __name__ == "__main__":
    run_alone(command)
