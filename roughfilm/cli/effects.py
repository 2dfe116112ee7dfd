"""roughfilm effects: what each effect of a bearing adds to load, friction and flow, switched on one at a time."""

import json
import math
import os
import time
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.interface.curves import checked_cells
from roughfilm.ladder import models
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis, analyse_effects
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.rom.bearing.effects.inertia import InertiaAdded
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    ScenePath,
    in_one_line,
    make_directory,
    messages,
    output,
    print_json,
    progress_bar,
)
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.words.effects import AT_FILM, UNDER_LOAD, cell, sentences, shown

SOURCES = (
    "10.1098/rstl.1886.0005",
    "10.1115/1.3251669",
    "10.1016/j.triboint.2007.02.021",
    "10.1016/j.jmaa.2005.09.036",
    "10.1115/1.1828067",
    "Sahlin 2008, Paper E",
)


@in_one_line
def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="The page, its figures and the numbers go here.")],
    load: Annotated[
        str | None, typer.Option(help="Over the nominal area, e.g. 2MPa; by default that of the scene, if it has one.")
    ] = None,
    resolution: Annotated[
        int | None, typer.Option(help="Cells along and across; by default 128, of an infinitely wide bearing 1024.")
    ] = None,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Switch the effects of a bearing on one at a time: what each adds to load, friction and flow, and to the film."""
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    overrides = [*(set_ or ()), *([] if load is None else [f"load.pressure={load}"])]
    read = load_scene(scene, overrides)
    if not isinstance(read, Bearing):
        raise InputError(
            f"{scene}: kind: got {read.kind!r}; effects are those of a bearing (scripts/examples/scenes/pad.toml)"
        )
    cells = checked_cells(read, resolution)
    make_directory(out)
    refuse_unwritable(out / "report.html")
    with progress_bar(1.0) as advance:
        found = analyse_effects(read, cells, models(), advance)
    entries = entries_of(found) | {
        "numerics": {
            "resolution": cells,
            "residual": max(one.residual for one in (found.at_film, found.under_load) if one is not None),
            "balance": 0.0 if found.under_load is None else found.under_load.balance,
            "cpu_s": sum(os.times()[:4]) - cpu,
            "wall_s": time.perf_counter() - started,
        }
    }
    with replacing(out / "effects.json") as scratch:
        scratch.write_text(json.dumps(entries, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    from roughfilm.pages.effects import write_page  # matplotlib is slow to import

    write_page(found, entries, out)
    if as_json:
        print_json({**entries, "report": str(out / "report.html")})
        return
    _say(found, out)


def entries_of(told: EffectAnalysis) -> dict[str, Any]:
    """The object of ``--json``, but for what it cost."""
    found = [one for one in (told.at_film, told.under_load) if one is not None]
    under = {} if told.under_load is None else told.under_load.full
    return {
        "quantities": {name: asdict(one) for name, one in told.at_film.full.items()}
        | {f"{name} under load": asdict(one) for name, one in under.items()},
        "numbers": {name: _number(value) for name, value in bearing_numbers(told.scene).items()},
        "treatments": [asdict(one) for one in told.treated],
        "left_out": told.left_out,
        "at_film": _study(told.at_film),
        "under_load": None if told.under_load is None else _study(told.under_load),
        "inertia": _inertia(told.inertia),
        "inertia_under_load": _inertia(told.loaded_inertia)
        and {**(_inertia(told.loaded_inertia) or {}), "thicker": asdict(told.thicker) if told.thicker else None},
        "provenance": {
            "scene": scene_entries(told.scene),
            "warnings": list(dict.fromkeys(warning for one in found for warning in one.warnings)),
            "sources": list(SOURCES),
            **circumstances(),
        },
    }


def _study(one: EffectStudy) -> dict[str, Any]:
    return {
        "plain": {name: asdict(told) for name, told in one.plain.items()},
        "contributions": [asdict(part) for part in one.contributions],
        "full": {name: asdict(told) for name, told in one.full.items()},
        "untold": dict(one.unsolved),
    }


def _inertia(one: InertiaAdded | None) -> dict[str, Any] | None:
    return None if one is None else asdict(one)


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _say(told: EffectAnalysis, out: Path) -> None:
    views = [("at the film of the scene", told.at_film, AT_FILM)]
    if told.under_load is not None and told.scene.load is not None:
        views.append((f"under {told.scene.load.pressure / 1e6:.4g} MPa", told.under_load, UNDER_LOAD))
    for title, found, names in views:
        columns = shown(found, names)
        table = Table("", *(f"{how.title}, {how.unit}" for how in columns.values()), title=title)
        for column in table.columns[1:]:
            column.justify = "right"
        table.add_row("plain film", *(cell(found.plain.get(name), how) for name, how in columns.items()))
        for one in found.contributions:
            table.add_row(f"+ {one.name}", *(cell(one.on.get(name), how, sign=True) for name, how in columns.items()))
        table.add_row("all of it", *(cell(found.full[name], how) for name, how in columns.items()), style="bold")
        output.print(table)
    load = next(iter(shown(told.at_film, ("load",))))
    for sentence in sentences(told.at_film, load, told.inertia.amounts["load"] if told.inertia else None):
        output.print(f"load, {escape(sentence)}", soft_wrap=True)
    for treated in told.treated:
        output.print(f"{treated.effect} by {treated.model}: {escape(treated.why)}", soft_wrap=True)
    if missing := told.left_out:
        output.print(f"left out, as the scene has none of it: {', '.join(missing)}", soft_wrap=True)
    output.print(f"report: {escape(str(out / 'report.html'))}", soft_wrap=True)
    for warning in dict.fromkeys((*told.at_film.warnings, *(told.under_load.warnings if told.under_load else ()))):
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)
