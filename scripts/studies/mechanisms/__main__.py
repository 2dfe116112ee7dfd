"""Two ways in which a parallel film over a textured wall carries load: inertia, and cavitation.

python -m scripts.studies.mechanisms --out OUT. Pockets solve the one (``film``), bearings the other
(``reynolds_cavitating``);
no model of the ladder keeps both, so the page says which of them rules where, and not what they do together.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.files import replacing
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import (
    AsJson,
    in_one_line,
    make_directory,
    output,
    print_json,
    progress_bar,
    run_alone,
)
from scripts.studies.mechanisms.data import (
    CAVITATION_NUMBERS,
    DENSITY,
    FILM,
    GAPS,
    NUMBERS,
    SPEEDS,
    TENSIONS,
    VISCOSITY,
    laws,
    loads_of,
    pocket,
    slider,
    solve,
)

SUCKED = 20e3
"""The tension at which pressures are drawn, Pa."""

SHOWN = (5.0, 20.0, 53.333)
"""Speeds at which pressures are drawn, m/s."""


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures and the numbers go here.")], as_json: AsJson = False
) -> None:
    """Solve two textures both ways over speed and film thickness, and write mechanisms.html."""
    from scripts.studies.mechanisms import figures as mechanisms_figures  # matplotlib is slow to import

    make_directory(out)
    done = 0
    with progress_bar(len(NUMBERS) + len(CAVITATION_NUMBERS) + len(GAPS) * len(SPEEDS)) as bar:

        def advance(words: str) -> None:
            nonlocal done
            bar(done, words)
            done += 1

        rule = laws("waves", advance)
        loads = {gap: loads_of(gap, advance) for gap in GAPS}
    drawn = {
        gap: {s: (solve(pocket(gap, s), "film"), solve(slider(gap, s, SUCKED), "reynolds_cavitating")) for s in SHOWN}
        for gap in GAPS
    }
    plots = {
        "pressures": mechanisms_figures.pressures(drawn, SUCKED),
        "loads": mechanisms_figures.loads(loads),
        "rule": mechanisms_figures.rule(rule, TENSIONS),
    }
    write_figures(plots, out)
    rows = {gap: table(found) for gap, found in loads.items()}
    told = {"speeds": list(SPEEDS), "mean_pressure": loads, "provenance": circumstances()}
    with replacing(out / "mechanisms.json") as scratch:
        scratch.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "mechanisms.html",
        plots=plots,
        rows=rows,
        gaps=GAPS,
        tensions=TENSIONS,
        sucked=SUCKED,
    )
    if as_json:
        print_json({**told, "report": str(out / "mechanisms.html")})
        return
    for gap, found in rows.items():
        shown = Table(
            "speed, m/s", "Re", "inertia, Pa", *(f"{t * 1e-3:g} kPa below, Pa" for t in TENSIONS), title=GAPS[gap]
        )
        for row in found:
            shown.add_row(*(f"{value:.4g}" for value in row.values()))
        output.print(shown)
    output.print(f"page: {escape(str(out / 'mechanisms.html'))}", soft_wrap=True)


def table(loads: Mapping[str, list[float]]) -> list[dict[str, float]]:
    """Every third speed with its Reynolds number and mean pressures, Pa."""
    return [
        {"speed": speed, "reynolds_number": DENSITY * speed * FILM / VISCOSITY}
        | {name: values[number] for name, values in loads.items()}
        for number, speed in enumerate(SPEEDS)
        if number % 3 == 2
    ]


if __name__ == "__main__":
    run_alone(command)
