"""Predict half of the windows of measured surfaces from a description fitted to the other half.

python -m scripts.studies.windows --surfaces DIR --out OUT; a stopped run goes on.
"""

from collections.abc import Sequence
from pathlib import Path

from rich.table import Table

from roughfilm.fitting.quantities import NAMES
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.study import Out, Surfaces, counted, publish
from scripts.studies.windows import figures
from scripts.studies.windows.data import AREAS, BAD, POINTS, SEEDS, WINDOWS, Coverage, examined, present


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Count held-out windows within the 95 % intervals of the seeds of fitted descriptions."""
    make_directory(out)
    names = present(surfaces)
    found = []
    with counted(max(1, len(names) * len(AREAS))) as advance:
        for area in AREAS:
            for name in names:
                assert surfaces is not None
                advance(f"{name} at {100 * area:g} % contact")
                found.append(examined(surfaces / name, area, out / "kept", lambda words: advance(words, steps=0)))
    coverages = [one for each in found for one in each.coverages]
    publish(
        Path(__file__).parent,
        out,
        {f"coverage_{100 * area:g}": figures.coverage(coverages, area) for area in AREAS} if coverages else {},
        {"examined": found, "totals": totals(coverages), "provenance": circumstances()},
        tables=[table(coverages, area) for area in AREAS] if coverages else ["no measured surface is here"],
        as_json=as_json,
        examined=found,
        totals=totals(coverages),
        areas=AREAS,
        quantities=NAMES,
        bad=BAD,
        settings={"windows": WINDOWS, "points": POINTS, "seeds": SEEDS},
    )


def totals(coverages: Sequence[Coverage]) -> list[dict[str, float | str]]:
    """Return the sums over all surfaces that are not bad measurements, by area, halves and quantity."""
    found: list[dict[str, float | str]] = []
    for area in AREAS:
        for halves in ("random", "spatial"):
            for name in NAMES:
                own = [
                    one
                    for one in coverages
                    if (one.area, one.halves, one.quantity) == (area, halves, name) and one.surface not in BAD
                ]
                inside, count = sum(one.inside for one in own), sum(one.count for one in own)
                found.append({"area": area, "halves": halves, "quantity": name, "inside": inside, "count": count})
    return found


def table(coverages: Sequence[Coverage], area: float) -> Table:
    """Return the fractions at one contact area as a printed table: random halves, spatial halves."""
    shown = Table(
        "surface", *NAMES, title=f"held-out windows inside, random / spatial halves, {100 * area:g} % contact"
    )
    for name in dict.fromkeys(one.surface for one in coverages):
        cells = []
        for quantity in NAMES:
            own = [o for o in coverages if (o.surface, o.quantity, o.area) == (name, quantity, area)]
            cells.append(" / ".join(f"{100 * one.fraction:.0f} %" for one in own))
        shown.add_row(name, *cells)
    return shown


if __name__ == "__main__":
    run_alone(command)
