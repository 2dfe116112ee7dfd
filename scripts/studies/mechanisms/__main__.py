"""Compare two ways in which a parallel film over a textured wall carries load: inertia and cavitation.

python -m scripts.studies.mechanisms --out OUT. Pockets solve the first (``film``), bearings the second
(``reynolds_cavitating``). No model of the ladder has both: the page says which of them is larger, not their joint
effect.
"""

from collections.abc import Mapping
from pathlib import Path

from rich.table import Table

from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.mechanisms import data, figures
from scripts.studies.mechanisms.data import DRAWN_TENSION, GAPS, SPEEDS, TENSIONS, pocket, slider, solve
from scripts.studies.study import Out, counted, publish


@in_one_line
def command(out: Out, as_json: AsJson = False) -> None:
    """Solve two textures by both mechanisms at many speeds and film thicknesses."""
    make_directory(out)
    with counted(len(data.REYNOLDS_NUMBERS) + len(data.CAVITATION_NUMBERS) + len(GAPS) * len(SPEEDS)) as advance:
        laws = data.laws("waves", advance)
        loads = {gap: data.loads_of(gap, advance) for gap in GAPS}
    drawn = {
        gap: {
            speed: (solve(pocket(gap, speed), "film"), solve(slider(gap, speed, DRAWN_TENSION), "reynolds_cavitating"))
            for speed in data.DRAWN_SPEEDS
        }
        for gap in GAPS
    }
    rows = {gap: rows_of(found) for gap, found in loads.items()}
    publish(
        Path(__file__).parent,
        out,
        {
            "pressures": figures.pressures(drawn, DRAWN_TENSION),
            "loads": figures.loads(loads),
            "rule": figures.rule(laws, TENSIONS),
        },
        {"speeds": SPEEDS, "mean_pressure": loads, "provenance": circumstances()},
        tables=[table(GAPS[gap], found) for gap, found in rows.items()],
        as_json=as_json,
        rows=rows,
        gaps=GAPS,
        tensions=TENSIONS,
        drawn_tension=DRAWN_TENSION,
    )


def rows_of(loads: Mapping[str, list[float]]) -> list[dict[str, float]]:
    """Return every third speed with its Reynolds number and mean pressures, Pa."""
    return [
        {"speed": speed, "reynolds_number": data.DENSITY * speed * data.FILM / data.VISCOSITY}
        | {name: values[number] for name, values in loads.items()}
        for number, speed in enumerate(SPEEDS)
        if number % 3 == 2
    ]


def table(title: str, rows: list[dict[str, float]]) -> Table:
    """Return the rows of one gap as a printed table."""
    shown = Table("speed, m/s", "Re", "inertia, Pa", *(f"{t * 1e-3:g} kPa below, Pa" for t in TENSIONS), title=title)
    for row in rows:
        shown.add_row(*(f"{value:.4g}" for value in row.values()))
    return shown


if __name__ == "__main__":
    run_alone(command)
