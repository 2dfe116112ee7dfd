"""roughfilm advise: the cheapest rung that is enough for a scene, and why."""

from dataclasses import asdict
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import Advice, Considered, Verdict, advise, shortfall, wanted
from roughfilm.rom.advice.estimates import Estimate, percent
from roughfilm.rom.advice.laws import table
from roughfilm.rom.ladder.kind import Scene, kind_of_name
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    Overrides,
    ScenePath,
    in_one_line,
    output,
    print_json,
    progress_bar,
)

Want = Annotated[
    str | None, typer.Option("--want", help="The quantity that counts, such as load; by default the kind's first.")
]


@in_one_line
def command(
    scene: ScenePath,
    within: Annotated[str, typer.Option(help="How far off it may be, for example 5%.")],
    quantity: Want = None,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Say which model and resolution are enough, how far off they are and what they cost."""
    read = load_scene(scene, set_ or ())
    found = advice_for(read, quantity, within)
    if as_json:
        print_json({**entries_of(found), "composition": list(kind_of_name(read.kind).composed(read))})
    else:
        tell(read, found)
    if found.chosen is None:
        raise typer.Exit(NOT_CONVERGED)


def tolerance_of(text: str) -> float:
    """A part from text: 5%, 5 % or 0.05; InputError for anything else."""
    try:
        number = text.strip()
        return float(number[:-1]) / 100 if number.endswith("%") else float(number)
    except ValueError:
        raise InputError(f"--within: got {text!r}; write a part such as 5% or 0.05") from None


def advice_for(scene: Scene, quantity: str | None, within: str) -> Advice:
    """Advise with a bar of progress; InputError for what cannot be asked."""
    compared, part = wanted(scene, quantity), tolerance_of(within)
    with progress_bar(1.0) as advance:
        return advise(scene, models(scene.kind), quantity=compared, within=part, progress=advance)


def tell(scene: Scene, found: Advice) -> None:
    """For people."""
    kind = kind_of_name(scene.kind)
    title = kind.compared[found.quantity]
    chosen = found.chosen
    if chosen is None:
        output.print(f"[bold]{escape(scene.name)}[/]: {escape(shortfall(found, title))}", soft_wrap=True)
    else:
        output.print(
            f"[bold]{escape(scene.name)}[/]: {title} within {percent(found.within)} by [bold green]{chosen.model}[/], "
            f"resolution {chosen.resolution}: expected within {percent(chosen.error or 0.0)}, {chosen.cpu_s:.2g} CPU s",
            soft_wrap=True,
        )
    shown = Table("model", "resolution", "CPU s", "off, by its numbers", "by the next rung", "")
    for column in shown.columns[1:5]:
        column.justify = "right"
    ran = [one for one in found.considered if one.resolution is not None]
    for one in ran:
        style = "green" if one.verdict is Verdict.CHOSEN else "default"
        cells = (one.model, str(one.resolution), f"{one.cpu_s:.2g}", _short(one.a_priori), _short(one.a_posteriori))
        shown.add_row(*cells, one.verdict, style=style)
    output.print(shown)
    for one in found.considered:
        output.print(f"[bold]{one.model}[/]: {one.verdict}: {escape(one.reason)}", soft_wrap=True)
    for line in kind.composed(scene):
        output.print(f"  {escape(line)}", soft_wrap=True)
    if found.omitted is not None:
        output.print(f"[bold]all of them[/]: {escape(found.omitted.reason)}", soft_wrap=True)
    numbers = ", ".join(
        f"{kind.symbols[name]} = {value:.3g}" for name, value in found.numbers.items() if name in kind.symbols
    )
    if numbers:
        output.print(f"numbers of the scene: {escape(numbers)}", soft_wrap=True)
    output.print(f"{found.spent_cpu_s:.2g} CPU s spent to be sure; laws: {_origin()}", soft_wrap=True)


def _short(estimate: Estimate | None) -> str:
    if estimate is None:
        return ""
    return percent(estimate.error) + ("" if estimate.sure else ", beyond the sweeps")


def _origin() -> str:
    origin = table().provenance
    return f"{sum(origin['scenes'].values())} random scenes, {origin['command']}"


def entries_of(found: Advice) -> dict[str, Any]:
    """For JSON."""
    chosen = found.chosen
    return {
        "model": chosen.model if chosen else None,
        "resolution": chosen.resolution if chosen else None,
        "expected_error": chosen.error if chosen else None,
        "expected_cpu_s": chosen.cpu_s if chosen else None,
        "enough": chosen is not None,
        "want": found.quantity,
        "within": found.within,
        "nearest": found.nearest.model if found.nearest else None,
        "reasons": [f"{one.model}: {one.verdict}: {one.reason}" for one in found.considered],
        "omitted": asdict(found.omitted) if found.omitted else None,
        "considered": [_entries(one) for one in found.considered],
        "numbers": {name: _finite(value) for name, value in found.numbers.items()},
        "spent_cpu_s": found.spent_cpu_s,
        "provenance": dict(table().provenance),
    }


def _entries(one: Considered) -> dict[str, Any]:
    return {
        "model": one.model,
        "resolution": one.resolution,
        "expected_cpu_s": one.cpu_s,
        "verdict": one.verdict.value,
        "reason": one.reason,
        "a_priori": _estimate(one.a_priori),
        "a_posteriori": _estimate(one.a_posteriori),
    }


def _estimate(estimate: Estimate | None) -> dict[str, Any] | None:
    if estimate is None:
        return None
    return {"error": _finite(estimate.error), "reasons": list(estimate.reasons), "within_the_sweeps": estimate.sure}


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None
