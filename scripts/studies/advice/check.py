"""Put the advice to the test on scenes to which no law was fitted: python -m scripts.studies.advice.check --out OUT."""

import json
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
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.units import Quantity
from roughfilm.figures.base import svg
from roughfilm.ladder import find, models
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.advice.advise import Verdict, advise
from roughfilm.rom.advice.laws import table
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Numerics, Result
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, output, print_json, progress_bar, run_alone
from scripts.studies.advice.fit import Case, cases
from scripts.studies.advice.runs import PARTS, Run, draw, read

TOLERANCES = (0.02, 0.05, 0.10)

ASKED = 0.95
"""The part of the scenes whose true error is to be within what was asked."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One scene and tolerance: what was advised, what was expected, and what is true.

    ``error`` and ``bar`` are of the best rung's size: how far the chosen one is off, and how far the best one may be.
    ``spent_cpu_s`` is of all that was run to advise and to answer, ``advice_cpu_s`` of the advice alone, and
    ``best_cpu_s`` of the best rung as it runs by default.
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
        """Whether the true error is beyond what was asked."""
        return self.error is not None and not self.error <= self.within

    @property
    def cost_ratio(self) -> float:
        """What it all took, over the best rung."""
        return (self.spent_cpu_s + self.advice_cpu_s) / self.best_cpu_s


def as_result(case: Case, run: Run) -> Result:
    """A row of a table as a result without fields."""
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


def tried(case: Case, within: float, quantity: str) -> Trial:
    """Ask for advice on a quantity and judge it; rungs that the table has are looked up there, others are run."""
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
    """How often the advice was right over some trials, and what it cost."""

    scenes: int
    answered: int
    kept: int
    cost_ratio: float

    @property
    def share(self) -> float:
        """Of the scenes that were answered, those whose error is within what was asked."""
        return self.kept / self.answered if self.answered else float("nan")


def score(trials: Sequence[Trial]) -> Score:
    """Of trials at one tolerance."""
    answered = [one for one in trials if one.error is not None]
    return Score(
        scenes=len(trials),
        answered=len(answered),
        kept=sum(not one.missed for one in answered),
        cost_ratio=median(one.cost_ratio for one in trials) if trials else float("nan"),
    )


def scores(trials: Sequence[Trial]) -> dict[str, dict[float, Score]]:
    """By kind and quantity, and tolerance; of all together, and of scenes whose best rung is Navier–Stokes."""
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
    """How often each rung was advised, by tolerance."""
    names = sorted({(one.kind, one.model or "none") for one in trials})
    return {
        (kind, model): {
            within: sum((one.kind, one.model or "none", one.within) == (kind, model, within) for one in trials)
            for within in TOLERANCES
        }
        for kind, model in names
    }


def figure(trials: Sequence[Trial]) -> str:
    """What was expected against what is true, and what it cost against the best rung."""
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
    left.set(xlabel="expected error, at most", ylabel="true error against the best rung", ylim=(1e-7, 1))
    right.set(xlabel="CPU time of advice and answer over that of the best rung", ylabel="% of the scenes")
    right.axvline(0.01, color="0.4", linewidth=0.8)
    left.legend(fontsize=8)
    return svg(drawn)


def entries_of(trials: Sequence[Trial]) -> dict[str, Any]:
    """For JSON."""
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
    out: Annotated[Path, typer.Option(help="Runs, table and page go here; finished runs are used again.")],
    jobs: Annotated[int, typer.Option(help="Processes.")] = 2,
    again: Annotated[bool, typer.Option(help="Judge the runs that are there, without solving any.")] = False,
    as_json: AsJson = False,
) -> None:
    """Advise on random scenes to which nothing was fitted, and compare with the best rung."""
    make_directory(out)
    if jobs < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    if not again:
        with alone(out) as scratch:
            for kind in PARTS["check"]:
                draw("check", kind, out, jobs, scratch)
    known = [case for kind in PARTS["check"] for case in cases(kind, read("check", kind, out)[0])]
    trials: list[Trial] = []
    asked = [(case, quantity) for case in known for quantity in kinds()[case.scene.kind].compared]
    with progress_bar(len(asked) * len(TOLERANCES)) as advance:
        for case, quantity in asked:
            for within in TOLERANCES:
                advance(len(trials), f"{case.scene.name}, {quantity} within {within:.0%}")
                trials.append(tried(case, within, quantity))
    entries = entries_of(trials)
    with replacing(out / "advice.json") as file:
        file.write_text(json.dumps(entries, indent=1) + "\n", encoding="utf-8")
    plots = {"advice": figure(trials)}
    write_figures(plots, out)
    render(
        Path(__file__).parent / "page.html.j2",
        out / "advice.html",
        asked=ASKED,
        tolerances=TOLERANCES,
        entries=entries,
        misses=[one for one in trials if one.missed],
        choices=choices(trials),
        scores=scores(trials),
        plots=plots,
    )
    if as_json:
        print_json({name: entries[name] for name in ("scores", "misses", "provenance")})
        return
    output.print(_told(scores(trials)))
    for one in trials:
        if one.missed:
            output.print(f"missed: {escape(_miss(one))}", soft_wrap=True)
    output.print(f"page: {escape(str(out / 'advice.html'))}", soft_wrap=True)


def _miss(one: Trial) -> str:
    return (
        f"{one.kind} {one.seed}, {one.quantity} at {one.within:.0%}: {one.model}, {one.resolution}: "
        f"{100 * (one.error or 0):.2g} % off "
        f"(expected {100 * (one.expected or 0):.2g} %; the best rung is known to {100 * one.bar:.2g} %): {one.reason}"
    )


def _told(found: Mapping[str, Mapping[float, Score]]) -> Table:
    shown = Table("scenes", *(f"within {within:.0%}" for within in TOLERANCES), "median cost over the best rung's")
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
