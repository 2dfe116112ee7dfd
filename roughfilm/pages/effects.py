"""The page of a bearing's effects."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.figures import effects as effects_figures
from roughfilm.figures.effects import Panel
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.words.effects import AT_FILM, SHOWN, UNDER_LOAD, Shown, cell, of_whole, shown_quantities

Beside = Mapping[str, Mapping[str, Amount]]
"""Changes by effects that a study does not include, by effect and quantity."""

LAST_COLUMN = "contact_share"
"""The last column of the tables, which is not drawn."""

NOT_DRAWN = ("effective_temperature",)
"""Quantities of tables that are not drawn, as the plain film does not have them."""


def write_page(analysis: EffectAnalysis, entries: Mapping[str, Any], out: Path) -> None:
    """Write the page and its figures; InputError if a file cannot be written."""
    at_film = f"{analysis.which_film}, {analysis.film * 1e6:.4g} µm"
    first = _panels(analysis.at_film, ("load", "friction"), at_film, analysis.not_counted)
    views: list[tuple[str, EffectStudy, tuple[str, ...], Beside, str]]
    views = [(at_film, analysis.at_film, AT_FILM, analysis.not_counted, "effects_at_film")]
    if analysis.under_load is not None and analysis.scene.load_pressure is not None:
        under = f"under {analysis.scene.load_pressure / 1e6:.4g} MPa over the nominal area"
        beside: Beside = {} if analysis.thicker is None else {"inertia": {"film": analysis.thicker}}
        first[1:1] = _panels(analysis.under_load, ("film",), under, beside)
        views.append((under, analysis.under_load, UNDER_LOAD, beside, "effects_under_load"))
    shown = [_view(*view, [panel.name for panel in first]) for view in views]
    figure = effects_figures.waterfall(first)
    write_figures({"effects": figure, **{view["file"]: view["figure"] for view in shown if view["figure"]}}, out)
    kind = kind_of_name(analysis.scene.kind)
    render(
        "effects.html.j2",
        out / "report.html",
        name=analysis.scene.name,
        which_film=analysis.which_film,
        at_film=at_film,
        entries=entries,
        cards=[(_value(panel), panel.how.title, panel.where) for panel in first],
        coefficient=_coefficient(views[-1][1], views[-1][0]),
        most=_most(first[0]),
        columns=[(panel.how.title, panel.how.unit, panel.where) for panel in first],
        rows=_rows(first),
        figure=figure,
        views=shown,
        treated=analysis.treated,
        left_out=analysis.left_out,
        not_switched=analysis.not_switched,
        numbers=[
            (name.replace("_", " "), kind.symbols[name], f"{value:.3g}")
            for name, value in kind.numbers(analysis.scene).items()
        ],
        inertia=analysis.inertia,
        thicker=None if analysis.thicker is None else f"{cell(analysis.thicker, SHOWN['film'], sign=True)} µm",
        not_counted={effect: _of_load(first[0], added) for effect, added in first[0].beside.items()},
    )


def _panels(study: EffectStudy, names: Sequence[str], where: str, beside: Beside) -> list[Panel]:
    return [
        Panel(study=study, name=name, how=how, where=where, beside=_of(beside, name))
        for name, how in shown_quantities(study, names).items()
    ]


def _value(panel: Panel) -> str:
    return f"{cell(panel.study.full[panel.name], panel.how)} {panel.how.unit}"


def _coefficient(study: EffectStudy, where: str) -> tuple[str, str] | None:
    """The friction coefficient with all effects, and where that is; None if the film carries no load."""
    found = study.full.get("friction_coefficient")
    return None if found is None else (cell(found, Shown(title="", unit="")), where)


def _most(panel: Panel) -> str:
    """The effect that changes a quantity most when it is switched on next, in words."""
    known = [one for one in panel.study.contributions if panel.name in one.on]
    if not known:
        return ""
    most = max(known, key=lambda one: abs(one.on[panel.name].value))
    return f"{most.name}, by {cell(most.on[panel.name], panel.how, sign=True)} {panel.how.unit}"


def _rows(panels: Sequence[Panel]) -> list[tuple[str, list[tuple[str, str]]]]:
    """A row for each effect: for each panel what it adds when switched on next, and that over the whole."""

    def row(title: str, amounts: Sequence[Amount | None], *, sign: bool) -> tuple[str, list[tuple[str, str]]]:
        return title, [
            (
                cell(amount, panel.how, sign=sign),
                "" if amount is None or not sign else of_whole(amount, panel.study.full[panel.name].value),
            )
            for panel, amount in zip(panels, amounts, strict=True)
        ]

    effects = [one.name for one in panels[0].study.contributions]
    rows = [row("plain film", [panel.study.plain.get(panel.name) for panel in panels], sign=False)]
    for number, name in enumerate(effects):
        rows.append(
            row(f"+ {name}", [panel.study.contributions[number].on.get(panel.name) for panel in panels], sign=True)
        )
    rows.append(row("all effects", [panel.study.full[panel.name] for panel in panels], sign=False))
    beside = dict.fromkeys(effect for panel in panels for effect in panel.beside)
    return rows + [
        row(f"{effect}, not counted", [panel.beside.get(effect) for panel in panels], sign=True) for effect in beside
    ]


def _of_load(panel: Panel, added: Amount) -> str:
    part = of_whole(added, panel.study.full[panel.name].value)
    return f"{cell(added, panel.how, sign=True)} {panel.how.unit}{f' ({part} of the load)' if part else ''}"


def _of(beside: Beside, name: str) -> dict[str, Amount]:
    """The changes of one quantity by effect."""
    return {effect: amounts[name] for effect, amounts in beside.items() if name in amounts}


def _view(
    where: str,
    study: EffectStudy,
    drawn: Sequence[str],
    beside: Beside,
    file: str,
    elsewhere: Sequence[str],
) -> dict[str, Any]:
    """The title and tables of a study at a film, or under a load, and a figure of what is drawn nowhere else."""
    columns = shown_quantities(study, (*drawn, LAST_COLUMN))

    def row(title: str, of: Mapping[str, Amount], *, sign: bool = True) -> tuple[str, list[str]]:
        return title, [cell(of.get(name), how, sign=sign) for name, how in columns.items()]

    on = [
        row("plain film", study.plain, sign=False),
        *(row(f"+ {one.name}", one.on) for one in study.contributions),
        row("all effects", study.full, sign=False),
    ]
    alone = [row(one.name, one.alone) for one in study.contributions]
    alone += [row(f"{effect}, not counted", amounts) for effect, amounts in beside.items()]
    panels = [panel for panel in _panels(study, drawn, "", beside) if panel.name not in (*elsewhere, *NOT_DRAWN)]
    return {
        "title": f"{where[:1].upper()}{where[1:]}",
        "columns": columns,
        "tables": {"Switched on one after the other": on, "Each added to all the others": alone},
        "file": file,
        "figure": effects_figures.waterfall(panels) if panels else "",
        "unsolved": study.unsolved,
    }
