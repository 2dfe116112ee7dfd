"""roughfilm models: the models of each kind of scene."""

import textwrap
from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from typing import Annotated

import typer
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import kind_names, kind_of_name
from roughfilm.rom.ladder.model import Availability, Model, Resolutions
from roughfilm.terminal.completion import kinds_beginning_with
from roughfilm.terminal.console import AsJson, output, print_json
from roughfilm.terminal.results import print_all, table_of
from roughfilm.words.cost import seconds

EXAMPLES = (
    "roughfilm models",
    "roughfilm models pocket",
)

TYPICAL_CPU_S = {
    "bearing": {
        "infinitely_wide": 0.007,
        "reynolds": 0.14,
        "reynolds_incompressible": 0.14,
        "reynolds_cavitating": 0.14,
        "homogenized": 0.3,
        "mixed": 0.4,
        "heat_balance": 0.9,
        "shear_thinning": 1,
        "adiabatic": 0.4,
        "across": 1.4,
        "direct": 1.3,
        "film": 0.06,
        "film_slope": 0.06,
        "stokes": 2.5,
        "navier_stokes": 3,
    },
    "dry_contact": {
        "bearing_area": 0.001,
        "greenwood_williamson": 0.001,
        "persson": 0.003,
        "elastic": 0.025,
        "elastic_plastic": 0.035,
    },
    "pocket": {
        "reynolds": 0.0002,
        "inertial_reynolds": 0.0002,
        "reynolds_cavitating": 0.007,
        "film": 0.025,
        "film_slope": 0.025,
        "stokes": 2.5,
        "navier_stokes": 2.5,
    },
    "rough_gap": {
        "smooth_gap": 0.0005,
        "homogenized": 0.03,
        "slope_corrected": 0.07,
        "stokes": 14,
        "navier_stokes": 14,
    },
    "seal": {"effective_medium": 0.01, "homogenized_leakage": 0.14, "direct_leakage": 2},
}
"""CPU seconds of a model at its default resolution, on one core, for the example scenes; without a surface's table."""

NOTES = {"bearing": "homogenized and mixed make a table of the surface too, in 10 s to minutes"}
"""A sentence on the costs of a kind that TYPICAL_CPU_S leaves out."""

MOST_WORDS = 43
"""Characters of the effects of a model; more are written as what it adds to another model."""

NARROW = 20
"""Fewer columns than this for the words of a model put them on a line of their own."""


def command(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="KIND", help="Explain the models of one kind.", autocompletion=kinds_beginning_with),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """List the models of each kind of scene: what each keeps, its cost, and whether it can run here."""
    if kind is not None and kind not in kind_names():
        near = get_close_matches(kind, kind_names(), 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise InputError(f"KIND: got {kind!r}; it must be one of {', '.join(kind_names())}{hint}")
    chosen = sorted(models(kind), key=lambda model: (model.kind, typical_cpu_s(model)))
    rows = [(model, model.available()) for model in chosen]
    if as_json:
        print_json({"models": [_entries(model, here) for model, here in rows]})
    elif kind is None:
        print_all(overview(rows))
    else:
        print_all(_explained(kind, rows))


def typical_cpu_s(model: Model) -> float:
    """The typical CPU time of a model, s; infinite where none is stated."""
    return TYPICAL_CPU_S.get(model.kind, {}).get(model.name, float("inf"))


def _typical(model: Model) -> str:
    """The typical CPU time of a model in a few characters."""
    time = typical_cpu_s(model)
    return "unknown" if time == float("inf") else seconds(time)


def _entries(model: Model, here: Availability) -> dict[str, object]:
    offered = model.resolutions
    return {
        "name": model.name,
        "kind": model.kind,
        "adds": model.summary,
        "keeps": sorted(model.keeps),
        "typical_cpu_s": TYPICAL_CPU_S.get(model.kind, {}).get(model.name),
        "resolution": offered.default if isinstance(offered, Resolutions) else None,
        "resolution_meaning": model.resolution_meaning,
        "schemes": model.schemes,
        "available": here.available,
        "detail": here.detail,
    }


def overview(rows: Sequence[tuple[Model, Availability]]) -> Iterator[str]:
    """The models of all kinds, a line each."""
    names = max(len(model.name) for model, _ in rows)
    room = output.width - names - 14
    for kind in dict.fromkeys(model.kind for model, _ in rows):
        yield f"{kind}: {kind_of_name(kind).summary}"
        own = [(model, here) for model, here in rows if model.kind == kind]
        for model, here in own:
            words = _kept(model, [other for other, _ in own])
            cost = _typical(model) if here.available else "not here"
            if room < NARROW:
                yield f"  {model.name}: {cost}; {words}"
                continue
            first, *more = textwrap.wrap(words, room)
            yield f"  {model.name:<{names}}  {first:<{room}}{cost:>10}"
            yield from (f"  {'':<{names}}    {line}" for line in more)
    yield ""
    yield from _absent(rows)
    able = sum(here.available for _, here in rows)
    yield f"{able} of {len(rows)} models can run here; explain one kind by 'roughfilm models KIND'"


def _kept(model: Model, others: Sequence[Model]) -> str:
    """The effects that a model keeps; where they are too many for the line, what it adds to another model."""
    listed = ", ".join(sorted(model.keeps)) or "viscous flow alone"
    if model.keeps and not model.complete:
        listed += " (approximate)"
    below = [other for other in others if other.keeps < model.keeps and other.complete]
    if len(listed) <= MOST_WORDS or not below:
        return listed
    base = max(below, key=lambda other: len(other.keeps))
    return f"as {base.name}, and {', '.join(sorted(model.keeps - base.keeps))}"


def _explained(kind: str, rows: Sequence[tuple[Model, Availability]]) -> Iterator[Table | str]:
    """The models of one kind in order of cost, with their summaries and resolutions."""
    yield f"{kind}: {kind_of_name(kind).summary}"
    cells = [(model.name, _typical(model) if here.available else "not here", model.summary) for model, here in rows]
    table = table_of(("model", "CPU", "what it adds"), cells, left=1)
    table.columns[2].justify = "left"
    yield table
    meanings: dict[str, list[str]] = {}
    for model, _ in rows:
        own = model.resolutions.default if isinstance(model.resolutions, Resolutions) else "the scene's own"
        meanings.setdefault(f"{own} {model.resolution_meaning}", []).append(model.name)
    for meaning, names in meanings.items():
        yield f"--resolution{'' if len(meanings) == 1 else f' of {_listed(names)}'}: {meaning}"
    schemes = {model.name: model.schemes for model, _ in rows if model.schemes}
    if schemes:
        yield f"--scheme of {_listed([*schemes])}: {' or '.join(next(iter(schemes.values())))}"
    yield from _absent(rows)
    if kind in NOTES:
        yield NOTES[kind]
    able = sum(here.available for _, here in rows)
    yield f"{able} of {len(rows)} models can run here, listed in order of their typical CPU time"


def _absent(rows: Sequence[tuple[Model, Availability]]) -> Iterator[str]:
    """The models that cannot run here, with the remedy."""
    reasons: dict[str, list[str]] = {}
    for model, here in rows:
        if not here.available:
            reasons.setdefault(here.detail, []).append(model.name)
    for reason, names in reasons.items():
        yield f"not here: {_listed([*dict.fromkeys(names)])}: {reason}"


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
