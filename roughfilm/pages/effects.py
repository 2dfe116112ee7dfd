"""The page of a bearing's effects."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.figures import effects as effects_figures
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.words.effects import AT_FILM, SHOWN, UNDER_LOAD, cell, sentences, shown_quantities
from roughfilm.words.numbers import percent

LAST_COLUMN = "contact_share"
"""The last column of the tables, which is not drawn."""


def write_page(analysis: EffectAnalysis, entries: Mapping[str, Any], out: Path) -> None:
    """Write the page and its figures; InputError if a file cannot be written."""
    title = f"{analysis.which_film.capitalize()}, {analysis.film * 1e6:.4g} µm"
    views = [_view(title, analysis.at_film, AT_FILM, _beside(analysis))]
    if analysis.under_load is not None and analysis.scene.load_pressure is not None:
        title = f"Under {analysis.scene.load_pressure / 1e6:.4g} MPa over the nominal area"
        beside = {} if analysis.thicker is None else {"film": analysis.thicker}
        views.append(_view(title, analysis.under_load, UNDER_LOAD, beside))
    names = ("effects_at_film", "effects_under_load")
    write_figures({name: view["figure"] for name, view in zip(names, views, strict=False)}, out)
    kind = kind_of_name(analysis.scene.kind)
    render(
        "effects.html.j2",
        out / "report.html",
        name=analysis.scene.name,
        which_film=analysis.which_film,
        entries=entries,
        views=views,
        treated=analysis.treated,
        left_out=analysis.left_out,
        numbers=[(kind.symbols[name], f"{value:.3g}") for name, value in kind.numbers(analysis.scene).items()],
        inertia=analysis.inertia,
        loaded=analysis.loaded_inertia,
        thicker=None if analysis.thicker is None else f"{cell(analysis.thicker, SHOWN['film'], sign=True)} µm",
        inertia_load=None if analysis.inertia is None else _of_load(analysis.inertia.amounts["load"], analysis.at_film),
    )


def _of_load(added: Amount, study: EffectStudy) -> str:
    name = next(iter(shown_quantities(study, ("load",))))
    fraction = percent(added.value / study.full[name].value)
    return f"{cell(added, SHOWN[name], sign=True)} {SHOWN[name].unit} ({fraction} of the load)"


def _beside(analysis: EffectAnalysis) -> dict[str, Amount]:
    """What inertia adds, by the names of the quantities that it is added to."""
    if analysis.inertia is None:
        return {}
    full = analysis.at_film.full
    return {
        (name if name in full else f"{name}_per_width"): analysis.inertia.amounts[name] for name in ("load", "friction")
    }


def _view(title: str, study: EffectStudy, drawn: Sequence[str], beside: Mapping[str, Amount]) -> dict[str, Any]:
    """The title, tables, figure and sentences of a study at a film, or under a load."""
    columns = shown_quantities(study, (*drawn, LAST_COLUMN))

    def row(title: str, of: Mapping[str, Amount], *, sign: bool = True) -> tuple[str, list[str]]:
        return title, [cell(of.get(name), how, sign=sign) for name, how in columns.items()]

    on = [
        row("plain film", study.plain, sign=False),
        *(row(f"+ {one.name}", one.on) for one in study.contributions),
        row("all of it", study.full, sign=False),
    ]
    alone = [row(one.name, one.alone) for one in study.contributions]
    if beside:
        alone.append(row("inertia, not counted", beside))
    judged = {name: how for name, how in shown_quantities(study, drawn).items() if name != "side_leakage"}
    return {
        "title": title,
        "columns": columns,
        "tables": {"Switched on one after the other": on, "Each added to all the others": alone},
        "figure": effects_figures.waterfall(study, shown_quantities(study, drawn), beside),
        "words": {SHOWN[name].title: sentences(study, name, beside.get(name)) for name in judged},
        "untold": study.unsolved,
    }
