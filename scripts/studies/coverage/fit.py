"""Fit the promises of models to independent solutions: python -m scripts.studies.coverage.fit --out OUT.

The laws are written into rom/advice/laws.toml, where they replace those of the same models; other laws are kept.
"""

import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table as ShownTable

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find, models
from roughfilm.rom.advice.estimates import over
from roughfilm.rom.advice.laws import Grid, Law, Numbers, Promise, Table, on_grid, table
from roughfilm.rom.ladder.kind import Kind, kind_of_name
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.terminal.console import in_one_line, make_directory, output, run_alone
from scripts.studies.advice.laws_file import OWN_FILE, text_of, write_table
from scripts.studies.coverage import resolutions, store
from scripts.studies.coverage.drawing import part_of
from scripts.studies.coverage.fitting import fitted
from scripts.studies.coverage.store import Judged
from scripts.studies.study import Out, counted

Rows = list[tuple[Numbers, float]]
"""The numbers of scenes, each with an error."""

MAX_TRUTH_UNCERTAINTY = 0.02
"""Largest relative uncertainty of a truth to which a law is fitted."""


MIN_SCENES = 40
"""Smallest number of scenes for a law."""


@dataclass(frozen=True, kw_only=True)
class PlannedLaw:
    """A law of some models without its coefficients: the numbers in each of its terms."""

    kind: str
    part: str
    models: tuple[str, ...]
    terms: tuple[tuple[str, ...], ...]


PLANNED: tuple[PlannedLaw, ...] = tuple(
    PlannedLaw(
        kind=one["kind"],
        part=one["part"],
        models=tuple(one["models"]),
        terms=tuple(tuple(term) for term in one["terms"]),
    )
    for one in tomllib.loads(Path(__file__).with_name("promises.toml").read_text(encoding="utf-8"))["law"]
)


@dataclass(frozen=True, kw_only=True)
class FitScene:
    """A scene to which laws are fitted, with its numbers, its relative truth and the size of its errors."""

    judged: Judged
    numbers: Numbers
    kind: Kind

    def size(self, quantity: str, values: Mapping[str, float]) -> float:
        """The size by which an error is divided; ``values`` are used for quantities without a truth."""
        truth = {name: value for name, (value, _) in self.judged.truth.items()}
        return float(self.kind.scale({**values, **truth}, quantity))

    def error(self, quantity: str, values: Mapping[str, float]) -> float:
        """The relative difference of values from the truth."""
        return over(abs(values[quantity] - self.judged.truth[quantity][0]), self.size(quantity, values))


def fit_scenes(kind: str, out: Path) -> dict[int, FitScene]:
    """Return the scenes of a kind to which laws are fitted, by seed, without those whose truth is uncertain."""
    own_kind, found = kind_of_name(kind), {}
    for seed, one in store.read(store.path_of(out, kind)).items():
        if part_of(seed) == "fit" and not one.failure:
            found[seed] = FitScene(judged=one, numbers=own_kind.numbers(read_scene(one.scene)), kind=own_kind)
    return found


def promise_rows(scenes: Mapping[int, FitScene], kind: str, model: str, quantity: str, out: Path) -> Rows:
    """Return the errors of a model against the truth; of one that another program runs at its default resolution."""
    own, rows = find(kind, model), []
    refinements = resolutions.read(resolutions.path_of(out, kind)) if own.outside else {}
    for seed, one in scenes.items():
        if not own.outside and model in one.judged.models:
            values, resolution = one.judged.models[model].values, one.judged.models[model].resolution
        elif (seed, model) in refinements:
            resolution = own.resolution_of(read_scene(one.judged.scene))
            values = refinements[seed, model].values.get(resolution, {})
        else:
            continue
        if quantity in values and quantity in one.judged.truth and _certain(one, quantity, values):
            rows.append((on_grid(one.numbers, resolution), one.error(quantity, values)))
    return rows


def resolution_rows(scenes: Mapping[int, FitScene], plan: PlannedLaw, model: str, quantity: str, out: Path) -> Rows:
    """Return the errors of a model by its resolution.

    The truth is that of the scene for the most complete model, and otherwise the value at the finest resolution; if
    that is one of the usual ones, it is extrapolated from the two finest.
    """
    rows: Rows = []
    own, top = find(plan.kind, model), best(models(plan.kind))
    for (seed, name), one in resolutions.read(resolutions.path_of(out, plan.kind)).items():
        scene = scenes.get(seed)
        known = {resolution: values for resolution, values in one.values.items() if quantity in values}
        if name != model or scene is None or len(known) < 2:
            continue
        *_, second, last = sorted(known)
        finest, limit = known[last], known[last][quantity]
        if own.outside:
            ratio = (last / second) ** (own.order or 1)
            limit += (limit - known[second][quantity]) / (ratio - 1)
        for resolution, values in known.items():
            numbers = on_grid(scene.numbers, resolution)
            if own is top and _certain(scene, quantity, values):
                rows.append((numbers, scene.error(quantity, values)))
            elif own is not top and (own.outside or resolution < last):
                rows.append((numbers, abs(values[quantity] - limit) / float(scene.kind.scale(finest, quantity))))
    return rows


def _certain(one: FitScene, quantity: str, values: Mapping[str, float]) -> bool:
    """Whether the uncertainty of the truth is small compared with the size, or with the error."""
    uncertainty = over(one.judged.truth[quantity][1], one.size(quantity, values))
    return uncertainty <= max(MAX_TRUTH_UNCERTAINTY, one.error(quantity, values) / 5)


def laws_of(plan: PlannedLaw, model: str, scenes: Mapping[int, FitScene], out: Path) -> dict[str, Law]:
    """Return the laws of a model by quantity."""
    laws = {}
    known = {name for one in scenes.values() for name in one.judged.truth}
    for quantity in (name for name in kind_of_name(plan.kind).titles if name in known):
        if plan.part == "promise":
            rows = promise_rows(scenes, plan.kind, model, quantity, out)
        else:
            rows = resolution_rows(scenes, plan, model, quantity, out)
        names = {name for term in plan.terms for name in term}
        usable = [(numbers, error) for numbers, error in rows if _usable(numbers, names) and error < math.inf]
        if len(usable) >= MIN_SCENES:
            laws[quantity] = fitted(usable, plan.terms)
    return laws


def _usable(numbers: Numbers, names: Iterable[str]) -> bool:
    return all(name in numbers and 0 < numbers[name] < math.inf for name in names)


def with_laws(known: Table, plan: PlannedLaw, model: str, laws: Mapping[str, Law]) -> Table:
    """Return the table with these laws in place of those of the same part and model; a promise replaces steps."""
    own = (plan.kind, model)
    if plan.part == "promise":
        steps = [
            replace(one, left_out={}, seen_from="", seen={}) if (one.kind, one.model) == own else one
            for one in known.steps
        ]
        others = [one for one in known.promises if (one.kind, one.model) != own]
        return replace(known, steps=steps, promises=[*others, Promise(kind=plan.kind, model=model, laws=laws)])
    grids = [one for one in known.grids if (one.kind, one.model) != own]
    return replace(known, grids=[*grids, Grid(kind=plan.kind, model=model, laws=laws)])


def planned_kinds(kinds: str | None) -> Sequence[str]:
    """Return the kinds named in a text with commas, or all kinds of the planned laws."""
    known = tuple(dict.fromkeys(plan.kind for plan in PLANNED))
    names = known if kinds is None else tuple(kinds.split(","))
    if unknown := [name for name in names if name not in known]:
        raise InputError(f"--kinds: got {unknown[0]!r}; it must be among {', '.join(known)}, joined by commas")
    return names


@in_one_line
def command(
    out: Out,
    refined: Annotated[int, typer.Option(help="Scenes that are solved at all resolutions.")] = 100,
    again: Annotated[bool, typer.Option(help="Fit to the runs that are there, without solving any.")] = False,
    kinds: Annotated[str | None, typer.Option(help="Kinds, joined by commas (default: all).")] = None,
) -> None:
    """Fit the laws in promises.toml to the scenes in OUT, and write them into the table of the project."""
    make_directory(out)
    known = table()
    shown = ShownTable("model", "law", "quantity", "bound", "scenes", "bound over middle")
    for kind in planned_kinds(kinds):
        scenes = fit_scenes(kind, out)
        if not again:
            seeds = sorted(scenes)[:refined]
            with counted(len(seeds) * len(resolutions.refined(kind))) as advance:
                resolutions.refine(kind, seeds, out, advance)
        for plan in (one for one in PLANNED if one.kind == kind):
            for model in plan.models:
                laws = laws_of(plan, model, scenes, out)
                known = with_laws(known, plan, model, laws)
                for quantity, law in laws.items():
                    shown.add_row(model, plan.part, quantity, text_of(law), str(law.scenes), f"{law.spread:g}")
        seeds = sorted(scenes)
        found = circumstances()
        origin = {
            "scenes": len(seeds),
            "seeds": [seeds[0], seeds[-1]],
            "commit": found["commit"],
            "code": found["code"],
        }
        fits = {**known.provenance.get("fits", {}), kind: {"command": COMMAND, **origin}}
        known = replace(known, provenance={**known.provenance, "fits": fits})
    write_table(known, OWN_FILE)
    output.print(shown)


COMMAND = "python -m scripts.studies.coverage.fit --out OUT"

if __name__ == "__main__":
    run_alone(command)
