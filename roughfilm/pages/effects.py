"""The page of a bearing's effects."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roughfilm.figures import effects as effects_figures
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.words.effects import AT_FILM, SHOWN, UNDER_LOAD, Shown, cell, sentences, shown
from roughfilm.words.numbers import percent

MORE = "contact_share"
"""A column of the page's tables beside those that are drawn."""


@dataclass(frozen=True, kw_only=True)
class View:
    """One of the two views: at a film, and under a load."""

    title: str
    columns: Mapping[str, Shown]
    tables: Mapping[str, Sequence[tuple[str, Sequence[str]]]]
    figure: str
    words: Mapping[str, Sequence[str]]
    untold: Mapping[str, str]


def write_page(told: EffectAnalysis, entries: Mapping[str, Any], out: Path) -> None:
    """Write the page and its figures; InputError if a file cannot be written."""
    film = told.scene.geometry.film
    views = [_view(f"At the film of the scene, {film * 1e6:.4g} µm", told.at_film, AT_FILM, _beside(told))]
    if told.under_load is not None and told.scene.load is not None:
        title = f"Under {told.scene.load.pressure / 1e6:.4g} MPa over the nominal area"
        beside = {} if told.thicker is None else {"film": told.thicker}
        views.append(_view(title, told.under_load, UNDER_LOAD, beside))
    names = ("effects_at_film", "effects_under_load")
    write_figures({name: view.figure for name, view in zip(names, views, strict=False)}, out)
    kind = kind_of_name(told.scene.kind)
    render(
        "effects.html.j2",
        out / "report.html",
        name=told.scene.name,
        told=entries,
        views=views,
        treated=told.treated,
        left_out=told.left_out,
        numbers=[(kind.symbols[name], f"{value:.3g}") for name, value in kind.numbers(told.scene).items()],
        inertia=told.inertia,
        loaded=told.loaded_inertia,
        thicker=None if told.thicker is None else f"{cell(told.thicker, SHOWN['film'], sign=True)} µm",
        inertia_load=None if told.inertia is None else _share(told.inertia.amounts["load"], told.at_film),
    )


def _share(added: Amount, found: EffectStudy) -> str:
    name = next(iter(shown(found, ("load",))))
    part = percent(added.value / found.full[name].value).replace("-", "−")
    return f"{cell(added, SHOWN[name], sign=True)} {SHOWN[name].unit} ({part} of the load)"


def _beside(told: EffectAnalysis) -> dict[str, Amount]:
    """What inertia adds, by the names of the quantities that it is added to."""
    if told.inertia is None:
        return {}
    full = told.at_film.full
    return {
        (name if name in full else f"{name}_per_width"): told.inertia.amounts[name] for name in ("load", "friction")
    }


def _view(title: str, found: EffectStudy, drawn: Sequence[str], beside: Mapping[str, Amount]) -> View:
    columns = shown(found, (*drawn, MORE))

    def row(title: str, of: Mapping[str, Amount], *, sign: bool = True) -> tuple[str, list[str]]:
        return title, [cell(of.get(name), how, sign=sign) for name, how in columns.items()]

    on = [
        row("plain film", found.plain, sign=False),
        *(row(f"+ {one.name}", one.on) for one in found.contributions),
        row("all of it", found.full, sign=False),
    ]
    alone = [row(one.name, one.alone) for one in found.contributions]
    if beside:
        alone.append(row("inertia, not counted", beside))
    judged = {name: how for name, how in shown(found, drawn).items() if name != "side_leakage"}
    return View(
        title=title,
        columns=columns,
        tables={"Switched on one after the other": on, "Each added to all the others": alone},
        figure=effects_figures.waterfall(found, shown(found, drawn), beside),
        words={SHOWN[name].title: sentences(found, name, beside.get(name)) for name in judged},
        untold=found.unsolved,
    )
