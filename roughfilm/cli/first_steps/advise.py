"""roughfilm advise: the cheapest model that is accurate enough for a scene, and why."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE, Advice, ModelVerdict, Verdict, advise, shortfall, wanted
from roughfilm.rom.advice.estimates import Estimate
from roughfilm.rom.advice.laws import table as laws_table
from roughfilm.rom.advice.stated import BY_LAWS, entries_of_errors, percent
from roughfilm.rom.advice.window import input_note, window_note
from roughfilm.rom.ladder.kind import Scene, kind_of_scene
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    Overrides,
    ScenePath,
    print_json,
    progress_bar,
)
from roughfilm.terminal.results import print_all, table_of
from roughfilm.words.numbers import finite

EXAMPLES = (
    "roughfilm advise scripts/examples/scenes/pocket.toml",
    "roughfilm advise scripts/examples/scenes/journal.toml --within 10%",
)

Want = Annotated[
    str | None,
    typer.Option(
        "--want", help="Quantity of --within, any that the kind reports, such as load (default: the first of the kind)."
    ),
]

DEFAULT_WITHIN = f"{100 * DEFAULT_TOLERANCE:g}%"


def command(
    scene: ScenePath,
    within: Annotated[str, typer.Option(help="Tolerated error, for example 2%.")] = DEFAULT_WITHIN,
    quantity: Want = None,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Choose the cheapest model and resolution that are accurate enough, with their expected error and cost."""
    read = load_scene(scene, set_ or ())
    compared, fraction = wanted(read, quantity), tolerance_of(within)
    with progress_bar(1.0) as advance:
        advice = advise(read, models(read.kind), quantity=compared, within=fraction, progress=advance)
    judged = kind_of_scene(read).steady(read)
    if as_json:
        notes = {"window": window_note(read, fraction), "input": input_note(judged, advice.quantity, fraction)}
        in_time = {} if advice.in_time is None else advice.in_time.entries
        lines = list(kind_of_scene(judged).composed(judged))
        print_json({**entries_of(advice), "composition": lines, **notes, **in_time})
    else:
        print_all(_shown(judged, advice))
    if advice.chosen is None:
        raise typer.Exit(NOT_CONVERGED)


def tolerance_of(text: str) -> float:
    """A fraction from text: 5%, 5 % or 0.05; InputError for any other text."""
    try:
        number = text.strip()
        fraction = float(number[:-1]) / 100 if number.endswith("%") else float(number)
    except ValueError:
        raise InputError(f"--within: got {text!r}; write a fraction such as 5% or 0.05") from None
    if not 0 < fraction < 1:
        meant = f"{number}%" if 1 <= fraction < 100 and not number.endswith("%") else "5%"
        raise InputError(f"--within: got {text!r}; it must be above 0 and below 100 %, for example {meant}")
    return fraction


def _shown(scene: Scene, advice: Advice) -> Iterator[Table | str]:
    """The advice for people."""
    kind = kind_of_scene(scene)
    if advice.in_time is not None:
        yield from advice.in_time.lines
    judged = [one for one in advice.considered if one.resolution is not None]
    table = table_of(
        ("model", "resolution", "CPU s", "error", ""),
        [(one.model, str(one.resolution), f"{one.cpu_s:.2g}", _short(one), one.verdict) for one in judged],
        title=f"{scene.name}: error in {advice.title}",
        left=1,
    )
    table.columns[0].no_wrap = True
    table.columns[4].justify = "left"
    for row, one in zip(table.rows, judged, strict=True):
        row.style = "green" if one.verdict is Verdict.CHOSEN else "default"
    yield table
    yield from _verdicts(advice)
    yield from (f"  {line}" for line in kind.composed(scene))
    applying = [one for one in advice.considered if one.verdict is not Verdict.DOES_NOT_APPLY]
    measured = (omission for omission in advice.omitted.values() if omission.source != BY_LAWS)
    for reason in dict.fromkeys(omission.reason for omission in measured):
        names = [name for name, omission in advice.omitted.items() if omission.reason == reason]
        yield f"{'all of them' if len(names) == len(applying) else ', '.join(names)}: {reason}"
    notes = input_note(scene, advice.quantity, advice.within), window_note(scene, advice.within)
    yield from filter(None, notes)
    numbers = [f"{kind.symbols[name]} = {value:.3g}" for name, value in advice.numbers.items() if name in kind.symbols]
    if numbers:
        yield f"numbers of the scene: {', '.join(numbers)}"
    laws = laws_table().provenance
    fit = laws["fits"].get(kind.name_of_laws)
    origin = f"{fit['scenes']} random scenes, {laws['command']}" if fit else "none are fitted to such scenes yet"
    yield f"{advice.spent_cpu_s:.2g} CPU s spent on the advice; laws: {origin}"
    yield f"{scene.name}: {in_one_line(advice)}"


def _verdicts(advice: Advice) -> Iterator[str]:
    """The verdict on each model with its reason; models with the same ones share a line."""
    models: dict[str, list[str]] = {}
    for one in advice.considered:
        models.setdefault(f"{one.verdict}: {one.why}", []).append(one.model)
    yield from (f"{', '.join(names)}: {why}" for why, names in models.items())


def in_one_line(advice: Advice) -> str:
    """The advice in one line: the model, its error and cost, or that no model is known to be accurate enough."""
    chosen = advice.chosen
    if chosen is None or chosen.stated is None:
        return shortfall(advice)
    return (
        f"{advice.title} within {percent(advice.within)} by {chosen.model}, resolution {chosen.resolution}: "
        f"error {chosen.stated.words}; {chosen.cpu_s:.2g} CPU s"
    )


def _short(one: ModelVerdict) -> str:
    if one.estimate is None:
        return "unknown"
    return "outside the fitted range" if one.stated is None else one.stated.amount


def entries_of(advice: Advice) -> dict[str, Any]:
    """The object of ``--json``."""
    chosen = advice.chosen
    return {
        "model": chosen.model if chosen else None,
        "resolution": chosen.resolution if chosen else None,
        "expected_error": chosen.error if chosen else None,
        "error_source": chosen.stated.source if chosen and chosen.stated else None,
        "expected_cpu_s": chosen.cpu_s if chosen else None,
        "enough": chosen is not None,
        "want": advice.quantity,
        "within": advice.within,
        "nearest": advice.nearest.model if advice.nearest else None,
        "finer": {"model": advice.finer.model, "resolution": advice.finer.resolution} if advice.finer else None,
        "reasons": [f"{one.model}: {one.verdict}: {one.why}" for one in advice.considered],
        "omitted": {name: {**asdict(one), "part": finite(one.part)} for name, one in advice.omitted.items()},
        "considered": [_entries(one) for one in advice.considered],
        "numbers": {name: finite(value) for name, value in advice.numbers.items()},
        "spent_cpu_s": advice.spent_cpu_s,
        "provenance": dict(laws_table().provenance),
    }


def _entries(one: ModelVerdict) -> dict[str, Any]:
    return {
        "model": one.model,
        "resolution": one.resolution,
        "expected_cpu_s": one.cpu_s,
        "verdict": one.verdict.value,
        "reason": one.reason,
        "error": entries_of_errors({one.model: one.stated}).get(one.model) if one.stated else None,
        "a_priori": _estimate(one.a_priori),
        "a_posteriori": _estimate(one.a_posteriori),
    }


def _estimate(estimate: Estimate | None) -> dict[str, Any] | None:
    if estimate is None:
        return None
    return {"error": finite(estimate.error), "reasons": list(estimate.reasons), "within_the_sweeps": estimate.sure}
