"""Fit the error laws of the models to the scenes of this study: python -m scripts.studies.coverage.fit --out OUT.

The laws of a kind are written into rom/advice/laws.toml, where they replace all laws of this kind.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Annotated

import typer
from rich.table import Table as ShownTable

from roughfilm.rom.advice.laws import Grid, Law, Promise, Step, Table, table
from roughfilm.rom.ladder.kind import kind_of_laws
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.studies.ordering import CERTAINTY
from roughfilm.terminal.console import in_one_line, make_directory, output, run_alone
from scripts.studies.coverage.__main__ import chosen
from scripts.studies.coverage.fit import resolutions, rows
from scripts.studies.coverage.fit.laws_file import OWN_FILE, text_of, write_table
from scripts.studies.coverage.fit.plans import PROMISES, RESOLUTIONS, STEPS, Terms
from scripts.studies.coverage.fit.regression import fitted
from scripts.studies.coverage.fit.rows import FitScene, Refinements, Rows
from scripts.studies.study import Out, counted

MIN_SCENES = 20
"""Smallest number of scenes for a law; below 20 no share of 95 of 100 can be calibrated."""

COMMAND = "python -m scripts.studies.coverage.fit --out OUT"


def laws(
    kind: str,
    terms: Terms,
    errors: Callable[[str], Rows],
    *,
    within: Sequence[str] = (),
    above: Mapping[str, float] | None = None,
) -> dict[str, Law]:
    """Return the laws of all quantities of a kind that have enough errors, which ``errors(quantity)`` returns.

    The other arguments are those of a :class:`scripts.studies.coverage.fit.plans.PlannedPromise`.
    """
    least = {name: 0.0 for term in terms for name in term} | dict.fromkeys(within, 0.0) | dict(above or {})
    found = {}
    for quantity in kind_of_laws(kind).titles if terms else ():
        usable = [
            (numbers, error)
            for numbers, error in errors(quantity)
            if error < math.inf and all(limit < numbers.get(name, 0) < math.inf for name, limit in least.items())
        ]
        if len(usable) >= MIN_SCENES:
            found[quantity] = fitted(usable, terms, within)
    return found


def fit(kind: str, scenes: Mapping[int, FitScene], refinements: Refinements) -> Table:
    """Return the steps, promises and resolutions of a kind with their laws."""
    steps = [
        Step(
            kind=kind,
            model=plan.model,
            towards=plan.towards,
            adds=plan.adds,
            measure=plan.measure,
            left_out=laws(
                kind, plan.terms, partial(getattr(rows, plan.rows), scenes, refinements, plan.model, plan.towards)
            ),
        )
        for plan in STEPS
        if plan.kind == kind
    ]
    promises = [
        Promise(
            kind=kind,
            model=model,
            towards=plan.towards,
            laws=laws(
                kind,
                plan.terms,
                partial(rows.promised, scenes, refinements, model, plan.towards),
                within=plan.within,
                above=plan.above,
            ),
        )
        for plan in PROMISES
        if plan.kind == kind
        for model in plan.models
    ]
    grids = [
        Grid(
            kind=kind,
            model=model,
            laws=laws(kind, plan.terms, partial(getattr(rows, plan.rows), scenes, refinements, model)),
        )
        for plan in RESOLUTIONS
        if plan.kind == kind
        for model in plan.models
    ]
    return Table(steps=steps, promises=promises, grids=[one for one in grids if one.laws], provenance={})


def replaced(known: Table, kind: str, own: Table, provenance: Mapping[str, object]) -> Table:
    """Return a table with the laws of one kind in place of its old ones."""
    return Table(
        steps=[*(one for one in known.steps if one.kind != kind), *own.steps],
        promises=[*(one for one in known.promises if one.kind != kind), *own.promises],
        grids=[*(one for one in known.grids if one.kind != kind), *own.grids],
        provenance={
            "command": COMMAND,
            "certainty": CERTAINTY,
            "fits": {**known.provenance.get("fits", {}), kind: dict(provenance)},
        },
    )


def shown(found: Table) -> ShownTable:
    """Return laws as a printed table."""
    printed = ShownTable("model", "law", "quantity", "bound", "scenes", "bound over middle")
    rows_ = [(one.model, f"step to {one.towards}", one.left_out) for one in found.steps]
    rows_ += [(one.model, "promise", one.laws) for one in found.promises]
    rows_ += [(one.model, "resolution", one.laws) for one in found.grids]
    for model, name, by_quantity in rows_:
        for quantity, law in by_quantity.items():
            printed.add_row(model, name, quantity, text_of(law), str(law.scenes), f"{law.spread:g}")
    return printed


@in_one_line
def command(
    out: Out,
    kinds: Annotated[str | None, typer.Option(help="Kinds, joined by commas (default: all).")] = None,
    refined: Annotated[int, typer.Option(help="Scenes of each kind that are solved at all resolutions.")] = 100,
    again: Annotated[bool, typer.Option(help="Fit to the runs that are there, without solving any.")] = False,
) -> None:
    """Fit the laws in terms.toml to the scenes in OUT, and write them into the table of the project."""
    make_directory(out)
    known = table()
    for kind in chosen(kinds):
        scenes = rows.fit_scenes(kind, out)
        seeds = sorted(scenes)
        names = [
            model for plan in RESOLUTIONS if (plan.kind, plan.rows) == (kind, "refinement") for model in plan.models
        ]
        if not again:
            with counted(len(seeds[:refined]) * len(names)) as advance:
                resolutions.refine(kind, names, seeds[:refined], out, advance)
        own = fit(kind, scenes, resolutions.read(out, kind))
        origin = {"scenes": len(seeds), "seeds": [seeds[0], seeds[-1]], "code": code()}
        known = replaced(known, kind, own, origin)
        output.print(shown(own))
    write_table(known, OWN_FILE)


if __name__ == "__main__":
    run_alone(command)
