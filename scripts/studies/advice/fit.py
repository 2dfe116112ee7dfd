"""Fit the error laws of the advice to random scenes: python -m scripts.studies.advice.fit --out OUT.

The laws are written to rom/advice/laws.toml.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table as ShownTable

from roughfilm.batch.directory import alone
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.laws import Grid, Law, Numbers, Step, Table, Term, on_grid
from roughfilm.rom.advice.laws import table as laws_table
from roughfilm.rom.ladder.kind import Kind, Scene, kinds
from roughfilm.rom.ladder.model import Model, Resolutions, best
from roughfilm.rom.studies.convergence import ConvergenceKind as Way
from roughfilm.rom.studies.convergence import converge
from roughfilm.rom.studies.ordering import CERTAINTY
from roughfilm.terminal.console import in_one_line, make_directory, output, run_alone
from scripts.studies.advice.laws_file import OWN_FILE, text_of, write_table
from scripts.studies.advice.runs import PARTS, DrawnScene, Run, draw, read
from scripts.studies.advice.scenes import random_scene
from scripts.studies.advice.steps import GRIDS, KINDS, STEPS, PlannedStep

Rows = list[tuple[Numbers, float]]
"""The numbers of scenes, each with an error."""

ROUND_OFF = 1e-7
"""Relative difference below which answers differ by round-off alone."""

LEAST_SCENES = 12
"""Least number of scenes for a fit of powers; fewer scenes give a bound alone."""

POWER_STEP = 0.05
"""Step of the powers, which are its multiples."""

RIDGE = 0.02
"""Ridge parameter per scene: keeps the powers of correlated numbers from growing against each other."""

LARGEST_POWER = 6.0


@dataclass(frozen=True, kw_only=True)
class SolvedScene:
    """A random scene that was solved: its numbers, the answer of every model, and the best answer by quantity."""

    seed: int
    scene: Scene
    numbers: Numbers
    runs: Mapping[tuple[str, int], Run]
    best: str
    truth: Mapping[str, float]
    bar: Mapping[str, float]

    def finest(self, model: str) -> Run | None:
        """Return the run of a model at its finest resolution; None if there is none."""
        return next(reversed(self.grids(model)), None)

    def grids(self, model: str) -> list[Run]:
        """Return the runs of a model from coarse to fine."""
        own = [run for (name, _), run in self.runs.items() if name == model and not run.failure]
        return sorted(own, key=lambda run: run.resolution)


def truths(kind: Kind, top: Model, runs: Sequence[Run]) -> tuple[dict[str, float], dict[str, float]]:
    """Return the best model's value and uncertainty of every compared quantity, extrapolated where possible."""
    value, bar = {}, {}
    for quantity in kind.compared:
        known = [run for run in runs if quantity in run.values]
        if not known:
            continue
        value[quantity], bar[quantity] = known[-1].values[quantity], known[-1].uncertainty.get(quantity, 0.0)
        if top.order and len(known) > 1 and top.outside:
            found = converge(
                [run.resolution for run in known],
                [run.values[quantity] for run in known],
                formal_order=top.order,
                noise=1e-12,
            )
            bar[quantity] = found.uncertainty
            if found.kind in (Way.MONOTONE, Way.TWO_GRIDS):
                value[quantity] = found.value
    return value, bar


def cases(kind: str, drawn: Sequence[DrawnScene]) -> list[SolvedScene]:
    """Return the scenes whose best model has an answer."""
    found, ladder, own_kind = [], models(kind), kinds()[kind]
    for one in drawn:
        scene = random_scene(kind, one.seed)
        top = best([model for model in ladder if model.applies(scene).applies])
        own = (run for run in one.runs if run.model == top.name and not run.failure)
        runs = sorted(own, key=lambda run: run.resolution)
        if not runs:
            continue
        value, bar = truths(own_kind, top, runs)
        found.append(
            SolvedScene(
                seed=one.seed,
                scene=scene,
                numbers=own_kind.numbers(scene),
                runs={(run.model, run.resolution): run for run in one.runs},
                best=top.name,
                truth=value,
                bar=bar,
            )
        )
    return found


def apart(kind: Kind, case: SolvedScene, one: Mapping[str, float], other: Mapping[str, float], quantity: str) -> float:
    """Return the difference of two answers divided by the size of the best one."""
    top = case.finest(case.best)
    assert top is not None
    return abs(one[quantity] - other[quantity]) / float(kind.scale({**top.values, **case.truth}, quantity))


def fitted(rows: Rows, features: Sequence[str]) -> Law | None:
    """Fit the law of these errors; None where there are none.

    Least squares of logarithms with a ridge, then the coefficient that bounds ``CERTAINTY`` of the errors.
    """
    if not rows:
        return None
    usable = [
        (n, e) for n, e in rows if all(n.get(f, 0) > 0 and math.isfinite(n[f]) for f in features) and e > ROUND_OFF
    ]
    reach = {name: (min(n[name] for n, _ in usable), max(n[name] for n, _ in usable)) for name in features if usable}
    powers: dict[str, float] = {}
    if len(usable) >= LEAST_SCENES and features:
        x = np.log([[numbers[name] for name in features] for numbers, _ in usable])
        y = np.log([error for _, error in usable])
        powers = _powers(x, y, features)
    errors = np.array([error for _, error in (usable or rows)])
    shapes = np.array([math.prod(n[name] ** p for name, p in powers.items()) for n, _ in (usable or rows)])
    ratios = np.maximum(errors, ROUND_OFF) / shapes
    bound, middle = float(np.quantile(ratios, CERTAINTY)), float(np.median(ratios))
    return Law(
        terms=(Term(coefficient=float(f"{bound:.3g}"), powers=powers),),
        reach={name: (float(f"{a:.3g}"), float(f"{b:.3g}")) for name, (a, b) in reach.items() if name in powers},
        scenes=len(usable or rows),
        spread=float(f"{bound / middle:.3g}"),
    )


def _powers(x: Array, y: Array, features: Sequence[str]) -> dict[str, float]:
    centred, size = x - x.mean(axis=0), x.shape[0]
    spread = centred.std(axis=0)
    varied = spread > 1e-6
    scaled = centred[:, varied] / spread[varied]
    slopes = np.linalg.solve(scaled.T @ scaled + RIDGE * size * np.eye(scaled.shape[1]), scaled.T @ (y - y.mean()))
    found = np.zeros(x.shape[1])
    found[varied] = np.clip(slopes / spread[varied], -LARGEST_POWER, LARGEST_POWER)
    rounded = np.round(found / POWER_STEP) * POWER_STEP
    return {name: round(float(power), 2) for name, power in zip(features, rounded, strict=True) if power}


def step_rows(
    kind: Kind, plan: PlannedStep, found: Sequence[SolvedScene], quantity: str
) -> list[tuple[SolvedScene, float]]:
    """Return the scenes with the difference of a model to the next one, both at their finest; the best extrapolated."""
    rows = []
    for case in found:
        own, above = case.finest(plan.model), case.finest(plan.towards)
        if own is None or above is None:
            continue
        values = {**above.values, **case.truth} if above.model == case.best else above.values
        if quantity in own.values and quantity in values:
            rows.append((case, apart(kind, case, own.values, values, quantity)))
    return rows


def seen_rows(kind: Kind, plan: PlannedStep, found: Sequence[SolvedScene], quantity: str) -> Rows:
    """Return the scenes' numbers with the size of the step from the model below, and the error that is left."""
    rows: Rows = []
    for case, left in step_rows(kind, plan, found, quantity):
        below, own = case.finest(plan.seen_from), case.finest(plan.model)
        if below is not None and own is not None:
            correction = apart(kind, case, below.values, own.values, quantity)
            rows.append(({**case.numbers, "correction": correction}, left))
    return rows


def grid_rows(kind: Kind, model: str, found: Sequence[SolvedScene], quantity: str) -> Rows:
    """Return the scenes' numbers with the resolution, and each grid's difference to the finest or the extrapolated."""
    rows: Rows = []
    for case in found:
        grids = [run for run in case.grids(model) if quantity in run.values]
        if len(grids) < 2:
            continue
        top = {**grids[-1].values, **(case.truth if model == case.best else {})}
        rows += [
            (on_grid(case.numbers, run.resolution), apart(kind, case, run.values, top, quantity))
            for run in (grids if model == case.best else grids[:-1])
        ]
    return rows


def fit_step(kind: Kind, plan: PlannedStep, found: Sequence[SolvedScene]) -> Step:
    """Return a step with its laws by quantity."""
    left_out: dict[str, Law] = {}
    seen: dict[str, Law] = {}
    for quantity in kind.compared:
        rows = [(case.numbers, error) for case, error in step_rows(kind, plan, found, quantity)]
        if (law := fitted(rows, plan.features)) is not None:
            left_out[quantity] = law
        if plan.seen_from:
            law = fitted(seen_rows(kind, plan, found, quantity), ("correction", *plan.seen))
            seen |= {} if law is None else {quantity: law}
    return Step(
        kind=kind.name,
        model=plan.model,
        towards=plan.towards,
        adds=plan.adds,
        tells=plan.tells,
        left_out=left_out,
        seen_from=plan.seen_from,
        seen=seen,
    )


def fit_grid(kind: Kind, model: str, found: Sequence[SolvedScene]) -> Grid:
    """Return the error law of a model's resolution by quantity."""
    features = GRIDS.get((kind.name, model), GRIDS[kind.name, ""])
    laws = {q: law for q in kind.compared if (law := fitted(grid_rows(kind, model, found, q), features)) is not None}
    return Grid(kind=kind.name, model=model, laws=laws)


def settles_itself(model: Model) -> bool:
    """Return whether a model refines itself until its residual is met, as quadratures do."""
    return model.order is None and isinstance(model.resolutions, Resolutions)


def fit(kind: Kind, found: Sequence[SolvedScene]) -> tuple[list[Step], list[Grid]]:
    """Return all steps of a kind and the grids of its models."""
    names = [model.name for model in models(kind.name) if not settles_itself(model)]
    grids = [fit_grid(kind, model, found) for model in names]
    return [fit_step(kind, plan, found) for plan in STEPS if plan.kind == kind.name], [
        grid for grid in grids if grid.laws
    ]


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="Runs go here and are used again.")],
    jobs: Annotated[int, typer.Option(help="Processes.")] = 2,
    table: Annotated[Path, typer.Option(help="Where the laws are written; by default the project's own.")] = OWN_FILE,
    again: Annotated[bool, typer.Option(help="Fit to the runs that are there, without solving any.")] = False,
) -> None:
    """Solve random scenes by every model, fit laws, and write their table."""
    make_directory(out)
    if jobs < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    if not again:
        with alone(out) as scratch:
            for kind in KINDS:
                draw("fit", kind, out, jobs, scratch)
    steps: list[Step] = []
    grids: list[Grid] = []
    counts: dict[str, int] = {}
    circumstances: Mapping[str, Any] = {}
    for name in KINDS:
        drawn, circumstances = read("fit", name, out)
        solved = cases(name, drawn)
        counts[name] = len(solved)
        own_steps, own_grids = fit(kinds()[name], solved)
        steps += own_steps
        grids += own_grids
        output.print(table_of(name, own_steps, own_grids))
    origin = {
        "command": "python -m scripts.studies.advice.fit --out OUT",
        "certainty": CERTAINTY,
        "scenes": counts,
        "seeds": {name: [seeds.start, seeds.stop - 1] for name, seeds in PARTS["fit"].items()},
        "commit": circumstances["commit"],
        "code": circumstances["code"],
        "processor": circumstances["machine"]["processor"],
    }
    known = laws_table()
    write_table(
        Table(
            steps=[*(step for step in known.steps if step.kind not in KINDS), *steps],
            promises=known.promises,
            grids=[*(grid for grid in known.grids if grid.kind not in KINDS), *grids],
            provenance={**known.provenance, **origin},
        ),
        table,
    )


def table_of(kind: str, steps: Sequence[Step], grids: Sequence[Grid]) -> ShownTable:
    """Return the laws of a kind as a printed table."""
    shown = ShownTable("model", "law", "quantity", "bound", "scenes", "bound over middle", title=kind)
    laws = [(step.model, f"to {step.towards}", step.left_out) for step in steps]
    laws += [(step.model, f"seen from {step.seen_from}", step.seen) for step in steps if step.seen]
    laws += [(grid.model, "grid", grid.laws) for grid in grids]
    for model, name, by_quantity in laws:
        for quantity, law in by_quantity.items():
            shown.add_row(model, name, quantity, text_of(law), str(law.scenes), f"{law.spread:g}")
    return shown


if __name__ == "__main__":
    run_alone(command)
