"""roughfilm effects: the contribution of each effect of a bearing to load, friction, flow and film."""

from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE
from roughfilm.interface.curves import checked_cells
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis, analyse_effects
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.terminal.console import AsJson, Overrides, ScenePath, make_directory, progress_bar
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.effects import AT_FILM, UNDER_LOAD, cell, sentences, shown_quantities
from roughfilm.words.numbers import finite_entries
from roughfilm.words.outside import outside_in_words

EXAMPLES = ("roughfilm effects scripts/examples/scenes/pad.toml --out pad",)

SOURCES = (
    "10.1098/rstl.1886.0005",
    "10.1115/1.3251669",
    "10.1016/j.triboint.2007.02.021",
    "10.1016/j.jmaa.2005.09.036",
    "10.1115/1.1828067",
    "Sahlin 2008, Paper E",
)


def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="Output directory of the page, its figures and the numbers.")],
    load: Annotated[
        str | None,
        typer.Option(help="Mean pressure on the nominal area, e.g. 2MPa (default: the scene's load)."),
    ] = None,
    resolution: Annotated[
        int | None, typer.Option(help="Cells along and across (default: 128; 1024 for an infinitely wide bearing).")
    ] = None,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Switch the effects of a bearing on one at a time: what each adds to load, friction and flow, and to the film."""
    spent, page = stopwatch(), out / "report.html"
    bearing = load_scene(scene, [*(set_ or ()), *([] if load is None else [f"load.pressure={load}"])])
    if not isinstance(bearing, Bearing):
        raise InputError(
            f"{scene}: kind: got {bearing.kind!r}; effects are those of a bearing (scripts/examples/scenes/pad.toml)"
        )
    cells, in_time = checked_cells(bearing, resolution), KIND.in_time(bearing, DEFAULT_TOLERANCE)
    bearing = KIND.steady(bearing)
    make_directory(out)
    refuse_unwritable((page, PAGE), (out / "effects.json", JSON))
    with alone(page, "analysis"):
        with progress_bar(1.0) as advance:
            analysis = analyse_effects(bearing, cells, models(), advance)
        entries = _entries(analysis) | ({} if in_time is None else dict(in_time.entries))
        entries["numerics"] = {
            "resolution": cells,
            "residual": max(study.residual for study in _studies(analysis)),
            "balance": 0.0 if analysis.under_load is None else analysis.under_load.balance,
            **spent(),
        }
        write_json(entries, out / "effects.json")
        from roughfilm.pages.effects import write_page  # matplotlib is slow to import

        write_page(analysis, entries, out)
    summary = written(_in_words(analysis), page, out / "effects.json")
    shown = [*([] if in_time is None else in_time.lines), *_shown(analysis)]
    show_result({**entries, "report": str(page)}, shown, as_json=as_json, summary=summary)


def _studies(analysis: EffectAnalysis) -> list[EffectStudy]:
    return [study for study in (analysis.at_film, analysis.under_load) if study is not None]


def _entries(analysis: EffectAnalysis) -> dict[str, Any]:
    """The object of ``--json``, without the cost."""
    film, loaded, inertia = analysis.at_film, analysis.under_load, analysis.loaded_inertia
    thicker = analysis.thicker and asdict(analysis.thicker)
    entries = {
        "quantities": {name: asdict(one) for name, one in film.full.items()}
        | {f"{name} under load": asdict(one) for name, one in (loaded.full.items() if loaded else ())},
        "numbers": bearing_numbers(analysis.scene),
        "treatments": [asdict(one) for one in analysis.treated],
        "left_out": analysis.left_out,
        "not_switched": analysis.not_switched,
        "at_film": _study_entries(film),
        "under_load": loaded and _study_entries(loaded),
        "inertia": analysis.inertia and asdict(analysis.inertia),
        "inertia_under_load": inertia and {**asdict(inertia), "thicker": thicker},
        "provenance": origin(
            SOURCES,
            dict.fromkeys(warning for study in _studies(analysis) for warning in _warnings(study)),
            scene=scene_entries(analysis.scene),
        ),
    }
    return {name: finite_entries(one) for name, one in entries.items()}


def _warnings(study: EffectStudy) -> list[str]:
    beyond = outside_in_words(study.outside)
    return [*([beyond] if beyond else []), *study.warnings]


def _study_entries(study: EffectStudy) -> dict[str, Any]:
    return {
        "plain": {name: asdict(amount) for name, amount in study.plain.items()},
        "contributions": [asdict(contribution) for contribution in study.contributions],
        "full": {name: asdict(amount) for name, amount in study.full.items()},
        "unsolved": dict(study.unsolved),
        "outside": list(study.outside),
    }


def _in_words(analysis: EffectAnalysis) -> str:
    """The load with all effects, and the effect that changes it most, as a sentence."""
    study = analysis.at_film
    name, how = next(iter(shown_quantities(study, ("load",)).items()))
    known = [one for one in study.contributions if name in one.on]
    most = max(known, key=lambda one: abs(one.on[name].value), default=None)
    part = "" if most is None else f"; {most.name} changes it most, by {cell(most.on[name], how, sign=True)} {how.unit}"
    beyond = outside_in_words(study.outside)
    before = f"{beyond}; " if beyond else ""
    return f"{before}load {cell(study.full[name], how)} {how.unit} {analysis.which_film}{part}"


def _shown(analysis: EffectAnalysis) -> Iterator[Table | str]:
    views = [(analysis.which_film, analysis.at_film, AT_FILM)]
    if analysis.under_load is not None and analysis.scene.load_pressure is not None:
        views.append((f"under {analysis.scene.load_pressure / 1e6:.4g} MPa", analysis.under_load, UNDER_LOAD))
    for title, study, names in views:
        columns = shown_quantities(study, names)
        rows = [
            ("plain film", study.plain, False),
            *((f"+ {one.name}", one.on, True) for one in study.contributions),
            ("all of it", study.full, False),
        ]
        table = table_of(
            ("", *(f"{how.title}, {how.unit}" for how in columns.values())),
            [
                (name, *(cell(amounts.get(key), how, sign=sign) for key, how in columns.items()))
                for name, amounts, sign in rows
            ],
            title=title,
            left=1,
        )
        table.rows[-1].style = "bold"
        yield table
    load = next(iter(shown_quantities(analysis.at_film, ("load",))))
    yield from (f"load, {sentence}" for sentence in sentences(analysis.at_film, load, analysis.not_counted))
    yield from (f"{treated.effect} by {treated.model}: {treated.why}" for treated in analysis.treated)
    yield from (f"{name}, not switched off: {reason}" for name, reason in analysis.not_switched.items())
    if analysis.left_out:
        yield f"left out, because the scene does not have them: {', '.join(analysis.left_out)}"
