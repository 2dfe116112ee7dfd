"""The page of a sweep: its answers first, then the models that would have done, their cost, and their errors."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.batch.plan import TO_COME, Batch
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.figures import answers as drawn
from roughfilm.figures.rendering import draw_apart, embedded
from roughfilm.figures.sweep import errors_in_order, sweep_chart
from roughfilm.figures.view import View, views
from roughfilm.ladder import models
from roughfilm.pages.render import render
from roughfilm.rom.ladder.kind import Kind, kinds
from roughfilm.rom.ladder.provenance import machine
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.answers import (
    Answer,
    Optimum,
    answer_of,
    asked_quantities,
    base_of,
    optimum,
    wanted_quantity,
)
from roughfilm.rom.studies.error_table import MIN_CASES, cases_left_out, orderings, reference_bars, setting_row
from roughfilm.rom.studies.parameters import Parameter, parameters
from roughfilm.rom.studies.reference import Order, Ranking, Reference, ranking, reference_of
from roughfilm.rom.studies.sufficient import (
    TOLERANCES,
    InertiaChange,
    Suitability,
    cheapest_sufficient,
    finest_settings,
    inertia_changes,
    suitability,
)
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep, read_sweep, restricted
from roughfilm.words.headline import included, left_out
from roughfilm.words.numbers import finite, percent, share
from roughfilm.words.scales import Scale, common_scale
from roughfilm.words.sweep import (
    best_sentence,
    count_text,
    decision_sentence,
    edited_sentences,
    largest_error_text,
    missing_sentences,
    optimum_sentence,
    outside_sentences,
    place_of,
    title_of,
    uncertainty_words,
    unranked_sentence,
)

EDITED = "the case was edited"
"""Beginning of the warnings of a generated case that was edited before it was run."""

SUFFICIENT = 0.05
"""Error within which a model would have done."""

LISTED_FAILURES = 20
"""Failed jobs in the list of failures."""

FIRST_ROWS = 30
"""Cases in the table of the cases that is open; the others are in a closed one."""

MAX_PANELS = 9
"""Other quantities that are drawn."""

MAX_TABLE_QUANTITIES = 3
"""Quantities in the table of the cases."""


@dataclass(frozen=True, kw_only=True)
class Study:
    """A sweep with what its page needs.

    Attributes
    ----------
    batch : content of the directory.
    sweep : all cases of the plan.
    kind, view : kind of its scenes, and the view of this kind.
    parameters : the entries that vary.
    reference : the best model's setting, with its uncertainty, of the solved cases.
    solved : the cases with a result.
    settings : the other settings with a result.
    per_model : the setting of each model that is drawn, by model, the reference last.
    units : units of the quantities.
    edited : the warnings of the cases that were edited since they were generated, by their number, by setting.
    """

    batch: Batch
    sweep: Sweep
    kind: Kind
    view: View
    parameters: tuple[Parameter, ...]
    reference: Reference
    solved: Sweep
    settings: tuple[str, ...]
    per_model: Mapping[str, str]
    units: Mapping[str, str]
    edited: Mapping[str, Mapping[int, str]]


@dataclass(frozen=True, kw_only=True)
class Shown:
    """An answer with its words: title, unit, optimum, sentences, and how sure it is."""

    answer: Answer
    title: str
    scale: Scale
    optimum: Optimum | None
    optimum_along: Parameter | None
    sentences: tuple[str, ...]
    sure: str


def study_of(batch: Batch) -> Study:
    """The sweep of a batch with its parameters and reference.

    Raises
    ------
    InputError
        If the batch has one case, no result, or scenes of several kinds.
    """
    table = {
        name: np.asarray(column.values, dtype=str if column.unit == "" else float)
        for name, column in batch.table.items()
    }
    sweep = read_sweep(table, _kind(table))
    kind = kind_of_sweep(sweep)
    if len(sweep.names) < 2:
        remedy = "give a list of values in the study, or use 'roughfilm compare' for one scene"
        raise InputError(f"{batch.directory}: holds one case; {remedy}")
    known = np.any([np.isfinite(cpu) for cpu in sweep.cpu_s.values()], axis=0)
    solved = restricted(sweep, known)
    ladder = models(kind.name)
    reference = reference_of(solved, ladder)
    top = reference.setting.split("-")[0]
    per_model = {**finest_settings(solved, ladder), top: reference.setting}
    per_model[top] = per_model.pop(top)
    return Study(
        batch=batch,
        sweep=sweep,
        kind=kind,
        view=views()[kind.name],
        parameters=_parameters(batch, sweep),
        reference=reference,
        solved=solved,
        settings=tuple(
            name for name in sweep.found if name != reference.setting and np.isfinite(sweep.cpu_s[name]).any()
        ),
        per_model=per_model,
        units={name: column.unit for name, column in batch.table.items()},
        edited=_edited(batch, sweep),
    )


def _edited(batch: Batch, sweep: Sweep) -> dict[str, dict[int, str]]:
    """The warnings of the edited cases by their number, by setting; settings without such cases are left out."""
    names = ("case", "setting", "warnings")
    found: dict[str, dict[int, str]] = {}
    if "warnings" in batch.table:
        for case, setting, words in zip(*(map(str, batch.table[name].values) for name in names), strict=True):
            if words.startswith(EDITED):
                found.setdefault(setting, {})[sweep.names.index(case)] = words
    return found


def _kind(table: Mapping[str, Any]) -> str:
    names = set(map(str, table.get("kind", ())))
    if len(names) != 1 or not names <= set(kinds()):
        raise InputError("the table does not name one kind of scenes; run the study again")
    return names.pop()


def _parameters(batch: Batch, sweep: Sweep) -> tuple[Parameter, ...]:
    """The parameters by the plan of the batch; without a plan those columns whose names are in the names of cases."""
    cases = [str(name) for name in batch.table["case"].values]
    rows = [cases.index(name) for name in sweep.names]
    if batch.plan is not None:
        varied = {name: [batch.plan.cases[case].get(name) for case in sweep.names] for name in batch.plan.keys}
        return parameters(varied, batch.table, rows)
    names = [name for name in sweep.given if any(f"{name}-" in case for case in sweep.names)]
    columns = {name: [batch.table[name].values[row] for row in rows] for name in names if name in batch.table}
    units = {name: batch.table[name].unit for name in columns}
    texts = {
        name: [
            value if isinstance(value, str) or np.isnan(value) else f"{value!r} {units[name]}".removesuffix(" 1")
            for value in values
        ]
        for name, values in columns.items()
    }
    return parameters({name: [None if value != value else value for value in values] for name, values in texts.items()})


def shown_answers(study: Study, want: str | None) -> list[Shown]:
    """The answer that is asked for, then those of the other compared quantities, then of all others that vary."""
    top = study.reference.setting
    first = wanted_quantity(study.sweep, top, want)
    asked = asked_quantities(study.sweep, top)
    names = dict.fromkeys([first, *asked, *study.kind.titles, *study.sweep.found[top]])
    shown_bases = {base_of(name) for name in asked}
    shown = []
    for name in names:
        if name not in (first, *asked) and base_of(name) in shown_bases:
            continue
        values = study.sweep.found[top].get(name)
        if values is None or not np.isfinite(values).any():
            continue
        answer = answer_of(study.sweep, top, name, study.edited.get(top, ()))
        title, scale = title_of(study.kind, name), common_scale(study.units.get(name, "1"), values)
        found = [(one, best) for one in study.parameters if (best := optimum(study.parameters, one, answer))]
        sentences = [decision_sentence(answer, scale)]
        sentences += [optimum_sentence(best, one, answer, title, scale) for one, best in found]
        shown.append(
            Shown(
                answer=answer,
                title=title,
                scale=scale,
                optimum=found[0][1] if found else None,
                optimum_along=found[0][0] if found else None,
                sentences=tuple(filter(None, sentences)),
                sure=uncertainty_words(answer),
            )
        )
    return shown


def headline(study: Study, shown: Shown) -> str:
    """The sentence with the best case, and whether it is outside the range of the model."""
    sentence = best_sentence(shown.answer, shown.title, shown.scale, study.parameters)
    outside = study.sweep.outside.get(shown.answer.setting, ())
    beyond = bool(outside) and bool(shown.answer.order) and bool(outside[shown.answer.best])
    return f"{sentence} (outside the range of the model, error unknown)" if beyond else sentence


def write_sweep(study: Study, want: str | None, path: Path, *, overwrite: bool = False) -> tuple[dict[str, Any], str]:
    """Write the page of a sweep; returns the entries of its JSON file and the sentence with the best case.

    Raises
    ------
    InputError
        If the best model has no such quantity, or the page cannot be written.
    """
    shown = shown_answers(study, want)
    asked = {shown[0].answer.quantity, *asked_quantities(study.sweep, study.reference.setting)}
    main = [one for one in shown if one.answer.quantity in asked]
    rest = [one for one in shown if one.answer.quantity not in asked and _varies(one)][:MAX_PANELS]
    solved = {name: np.isfinite(study.sweep.cpu_s[name]) for name in study.sweep.found}
    missing = missing_sentences(solved, study.sweep.failures, len(study.batch.missing))
    outside = outside_sentences(study.sweep.outside)
    failures = [one for one in study.sweep.failures if not one[2].startswith(("left out", TO_COME))]
    edited = edited_sentences(study.edited)
    unranked = unranked_sentence(shown[0].answer, _reason(study, shown[0].answer))
    judged, ordered = _judgement(study), _ordered(study)
    pictures = _chosen_cases(study, shown[0])
    model, missing_effects = _model_in_words(study, shown[0].answer.best)
    render(
        "sweep.html.j2",
        path,
        overwrite=overwrite,
        name=study.batch.plan.name if study.batch.plan else study.batch.directory.name,
        study=study,
        sweep=study.sweep,
        headline=headline(study, shown[0]),
        model=model,
        left_out=missing_effects,
        others=[headline(study, one) for one in main[1:]],
        missing=[*missing, *filter(None, [unranked])],
        edited=edited,
        outside=outside,
        failures=failures,
        listed_failures=LISTED_FAILURES,
        answers=[(one, *_figures(study, one)) for one in main],
        rest=drawn.several(
            study.parameters, [(one.answer, one.title, one.scale) for one in rest], study.view, _best(shown)
        )
        if rest
        else "",
        fixed=_fixed(study, shown[0].answer.best),
        cases=_case_rows(study, shown, path),
        heads=[one.scale.label(one.title) for one in shown[:MAX_TABLE_QUANTITIES]],
        first_rows=FIRST_ROWS,
        table=os.path.relpath(study.batch.directory / "table.csv", path.parent)
        if (study.batch.directory / "table.csv").is_file() and not study.batch.missing
        else "",
        pictures=pictures,
        reference=study.reference.setting,
        view=study.view,
        compared=study.kind.compared,
        machine=machine(),
        tolerances=[f"{tolerance:g}" for tolerance in TOLERANCES],
        sufficient=SUFFICIENT,
        **judged,
        **ordered,
    )
    entries = {
        "reference": study.reference.setting,
        "reference_uncertainty": ordered["bars"],
        "cases": len(study.sweep.names),
        "settings": ordered["rows"],
        "ranking": [_rank_entries(one) for one, _ in ordered["ranks"]],
        "failures": list(study.sweep.failures),
        "missing": missing,
        "outside": outside,
        "unranked": unranked,
        "edited": edited,
        "answers": [_answer_entries(study, one) for one in main],
        "inertia": judged["inertia_rows"],
        "sufficient": judged["cheapest"],
    }
    return entries, headline(study, shown[0])


def _model_in_words(study: Study, best: int) -> tuple[str, str]:
    """The best model with what it includes, and what it leaves out in the best case; empty without its result."""
    result = _result(study.batch.result_path(study.sweep.names[best], study.reference.setting))
    if result is None:
        return "", ""
    ladder = models(study.kind.name)
    model = next(one for one in ladder if one.name == result.model)
    try:
        scene = read_scene(result.provenance["scene"])
        return included(scene, model, ladder), left_out(scene, model, ladder)
    except (InputError, ConvergenceError, KeyError):
        return "", ""


def _varies(one: Shown) -> bool:
    """Whether a quantity differs from case to case by more than rounding."""
    values = one.answer.values[np.isfinite(one.answer.values)]
    return values.size > 1 and float(np.ptp(values)) > one.scale.negligible


def _reason(study: Study, answer: Answer) -> str:
    """The first warning of the first case that is not ranked; empty without one."""
    if not answer.unranked:
        return ""
    columns = (study.batch.table[name].values for name in ("case", "setting", "warnings"))
    of_case = (study.sweep.names[answer.unranked[0]], answer.setting)
    found = next((str(words) for case, setting, words in zip(*columns, strict=True) if (case, setting) == of_case), "")
    return found.split("; ")[0]


def _best(shown: Sequence[Shown]) -> int:
    return shown[0].answer.best


def _figures(study: Study, one: Shown) -> tuple[str, str | None]:
    """The figure of an answer over what varies, and the slices through the best case beside a map."""
    quantity = one.answer.quantity
    answers = [
        answer_of(study.sweep, setting, quantity, study.edited.get(setting, ()))
        for setting in reversed([*study.per_model.values()])
        if np.isfinite(study.sweep.found[setting][quantity]).any()
    ]
    plane = drawn.planes_of(study.parameters)
    found = one.optimum if plane and one.optimum_along is plane[0] and len(study.parameters) == 1 else None
    figure = drawn.over_parameters(study.parameters, answers, one.title, one.scale, study.view, found)
    several = len(study.parameters) > 1
    return figure, drawn.slices(study.parameters, answers, one.title, one.scale, study.view) if several else None


def _fixed(study: Study, best: int) -> str:
    """The sentence on the parameters that the figures fix at the best case; empty without any."""
    plane = drawn.planes_of(study.parameters)
    _, fixed = drawn.panels_of(study.parameters, plane, best)
    if not fixed:
        return ""
    return f"Other entries are as in the best case: {place_of(fixed, best)}."


def _case_rows(study: Study, shown: Sequence[Shown], path: Path) -> list[dict[str, Any]]:
    """The rows of the table of the cases, the best case first."""
    answer = shown[0].answer
    rest = [case for case in range(len(study.sweep.names)) if case not in set(answer.order)]
    rows = []
    for case in (*answer.order, *rest):
        name = study.sweep.names[case]
        place = study.batch.result_path(name, study.reference.setting)
        rows.append(
            {
                "number": case + 1,
                "varied": [one.text(case).removesuffix(f" {one.unit}") for one in study.parameters],
                "quantities": [
                    one.scale.number(one.answer.values[case], float(one.answer.uncertainty[case]))
                    for one in shown[:MAX_TABLE_QUANTITIES]
                ],
                "directory": os.path.relpath(place.parent, path.parent),
                "result": os.path.relpath(place, path.parent) if place.is_file() else "",
            }
        )
    return rows


def _chosen_cases(study: Study, shown: Shown) -> dict[str, Any]:
    """The pressure profiles of the best, the middle and the worst case, and the figures of the best and worst."""
    answer, names = shown.answer, ("largest", "middle", "smallest")
    if answer.sense != "unclear":
        names = ("best", "middle", "worst")
    chosen = dict(zip((answer.best, answer.middle, answer.worst), names, strict=True))
    chosen = {answer.best: names[0], **{case: name for case, name in chosen.items() if case != answer.best}}
    lines, label, figures = {}, "", []
    for case, name in chosen.items():
        result = _result(study.batch.result_path(study.sweep.names[case], study.reference.setting))
        if result is None:
            continue
        where = place_of(study.parameters, case)
        title = f"{name} case, {case + 1}{f': {where}' if where else ''}"
        if (profile := drawn.profile_of(result)) is not None:
            lines[title], label = profile[:2], profile[2]
        if name != "middle":
            drawn_along = profile is not None
            pictures = _pictures(study, result, case, flow=case == answer.best, drawn_along=drawn_along)
            figures.append((title, *pictures))
    return {"profiles": drawn.profiles(lines, label) if lines else "", "figures": figures}


def _result(path: Path) -> Result | None:
    try:
        return load(path)
    except InputError:
        return None


def _pictures(study: Study, result: Result, case: int, *, flow: bool, drawn_along: bool) -> tuple[list[str], str]:
    """The figures of the kind of scene for a result, and the address of a picture of the flow that it resolves.

    Without the pressure along the film if that is ``drawn_along`` already.
    """
    try:
        scene = read_scene(result.provenance["scene"])
        found = study.view.plots(scene, {result.model: result}, result.model)
        plots = [one.svg for name, one in found.items() if one.svg and not (drawn_along and name == study.view.line)]
    except (InputError, KeyError):
        return [], ""
    if not flow or "vertices" not in result.fields or not study.view.drawing:
        return plots, ""
    file = study.batch.result_path(study.sweep.names[case], study.reference.setting)
    with scratch_directory() as scratch:
        picture = scratch / "flow.png"
        return plots, embedded(picture) if draw_apart(study.view.drawing, file, picture).available else ""


def _judgement(study: Study) -> dict[str, Any]:
    """Which model would have done: errors, counts, the cheapest sufficient model, and the change by inertia."""
    solved, reference = study.solved, study.reference
    mask = np.array([name in set(solved.names) for name in study.sweep.names])
    varied = tuple(
        Parameter(name=one.name, values=one.values[mask], unit=one.unit, along=one.along) for one in study.parameters
    )
    others = [setting for setting in study.per_model.values() if setting != reference.setting]
    quantities = [name for name in study.kind.compared if np.isfinite(solved.found[reference.setting][name]).any()]
    suited = {
        name: [one for setting in others if (one := suitability(solved, setting, reference, name)).cases]
        for name in quantities
    }
    numbers = [place + 1 for place, known in enumerate(mask) if known]
    cheapest = {
        f"{tolerance:g}": cheapest_sufficient(solved, others, reference, quantities, tolerance)
        for tolerance in TOLERANCES
    }
    changes = {
        name: inertia_changes(solved, models(study.kind.name), study.per_model, reference, name) for name in quantities
    }
    changes = {name: found for name, found in changes.items() if found}
    strip = cheapest[f"{SUFFICIENT:g}"]
    return {
        "suited": [_suited_row(study, one, reference, numbers, varied) for found in suited.values() for one in found],
        "error_figures": [
            drawn.errors_along(
                varied,
                {study.kind.compared[name]: found for name, found in suited.items() if found},
                {study.kind.compared[name]: reference.uncertainty[name] for name in suited},
                SUFFICIENT,
                study.view,
            ),
            drawn.cheapest_models(varied, strip, SUFFICIENT, study.view),
        ]
        if any(suited.values())
        else [],
        "cheapest": {tolerance: _counted(found) for tolerance, found in cheapest.items()},
        "inertia_rows": [_inertia_row(study, one, numbers, varied) for found in changes.values() for one in found],
        "inertia_figure": drawn.inertia_along(
            varied, {study.kind.compared[name]: found for name, found in changes.items()}, study.view
        )
        if changes
        else "",
    }


def _counted(found: Sequence[str | None]) -> dict[str, int]:
    """The number of cases of each setting, the most frequent first."""
    names = [name for name in found if name is not None]
    return {name: names.count(name) for name in sorted(set(names), key=lambda name: (-names.count(name), name))}


def _suited_row(
    study: Study, one: Suitability, reference: Reference, numbers: Sequence[int], varied: Sequence[Parameter]
) -> dict[str, Any]:
    assert one.worst is not None
    bar = reference.uncertainty[one.quantity]
    return {
        "setting": one.setting,
        "quantity": study.kind.compared[one.quantity],
        "largest": largest_error_text(one.largest, float(bar[one.worst])),
        "place": f"case {numbers[one.worst]}",
        "where": place_of(varied, one.worst),
        "within": {f"{tolerance:g}": count_text(count, one.cases) for tolerance, count in one.within.items()},
        "cpu_s": float(np.nanmedian(study.solved.cpu_s[one.setting])),
    }


def _inertia_row(
    study: Study, one: InertiaChange, numbers: Sequence[int], varied: Sequence[Parameter]
) -> dict[str, Any]:
    low, high = int(np.nanargmin(one.change)), int(np.nanargmax(one.change))
    largest = low if abs(one.change[low]) > abs(one.change[high]) else high
    return {
        "pair": f"{one.setting} minus {one.without}",
        "quantity": study.kind.compared[one.quantity],
        "least": percent(float(one.change[low])),
        "most": percent(float(one.change[high])),
        "median": share(float(np.nanmedian(np.abs(one.change)))),
        "place": f"case {numbers[largest]}",
        "where": place_of(varied, largest),
    }


def _ordered(study: Study) -> dict[str, Any]:
    """The rows and figures of the settings: cost, pairs that can be distinguished, numbers that order the errors."""
    solved, reference, compared = study.solved, study.reference, study.kind.compared
    pairs = [(setting, quantity) for setting in study.settings for quantity in compared]
    numbers = {(setting, quantity): orderings(solved, setting, reference, quantity) for setting, quantity in pairs}
    chosen = {key: orders["chosen"] for key, orders in numbers.items() if orders}
    ranks = [
        found
        for quantity in compared
        for pair in combinations(study.settings, 2)
        if (found := ranking(solved, pair, reference, quantity)) is not None
    ]
    settings = [setting for setting in study.settings if any(key[0] == setting for key in chosen)]
    mapped = study.view.maps if chosen and len(study.parameters) > 1 else None
    return {
        "rows": [setting_row(solved, setting, reference, numbers) for setting in (*study.settings, reference.setting)],
        "bars": {quantity: reference_bars(solved, reference, quantity) for quantity in compared},
        "ranks": [(one, _verdict(one)) for one in ranks],
        "chart": sweep_chart(solved, reference, study.settings) if study.settings else "",
        "order": errors_in_order(solved, reference, chosen, settings) if settings else "",
        "unordered": _unordered(study) if study.settings and not chosen else "",
        "maps": {key: mapped(solved, key[0], reference, key[1]) for key in chosen} if mapped else {},
    }


def _unordered(study: Study) -> str:
    """The sentence on why no number that orders the errors is sought."""
    setting, quantity = study.settings[0], next(iter(study.kind.compared))
    reasons = cases_left_out(study.solved, setting, study.reference, quantity)
    left = len(study.solved.names) - sum(reasons.values())
    why = "; ".join(f"{count} left out: {reason}" for reason, count in reasons.items())
    return (
        f"A number that the errors grow with is sought from {MIN_CASES} cases on; {setting} has {left} of "
        f"{len(study.solved.names)} beside {study.reference.setting}{f' ({why})' if why else ''}."
    )


def _rank_entries(one: Ranking) -> dict[str, Any]:
    nearer = dict(zip(one.settings, one.nearer, strict=True))
    return {"quantity": one.quantity, "settings": list(one.settings), "nearer": nearer, "order": _verdict(one)}


def _verdict(one: Ranking) -> str:
    named = {Order.FIRST: one.settings[0], Order.SECOND: one.settings[1]}
    return f"{named[one.order]} is nearer" if one.order in named else str(one.order)


def _answer_entries(study: Study, one: Shown) -> dict[str, Any]:
    """The entries of an answer in JSON, in SI units."""
    answer = one.answer

    def case(number: int) -> dict[str, Any]:
        return {
            "case": study.sweep.names[number],
            "number": number + 1,
            "varied": {parameter.name: parameter.text(number) for parameter in study.parameters},
            "value": float(answer.values[number]),
            "uncertainty": finite(float(answer.uncertainty[number])),
        }

    best = None
    if one.optimum is not None and one.optimum_along is not None:
        found = one.optimum
        best = {
            "along": one.optimum_along.name,
            "unit": one.optimum_along.unit,
            "place": found.place,
            "place_uncertainty": found.place_uncertainty,
            "value": found.value,
            "value_uncertainty": found.value_uncertainty,
        }
    return {
        "quantity": answer.quantity,
        "unit": study.units.get(answer.quantity, "1"),
        "setting": answer.setting,
        "sense": str(answer.sense),
        "best": case(answer.best),
        "worst": case(answer.worst),
        "decided": answer.decided,
        "optimum": best,
        "sentence": headline(study, one),
    }
