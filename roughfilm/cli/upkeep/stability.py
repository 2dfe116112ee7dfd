"""roughfilm stability: maps of where solvers converge, and of how they fail elsewhere."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from roughfilm.batch.directory import alone
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.foundation.writing.kinds import PAGE, entries_from
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.rom.studies.table import write_csv
from roughfilm.stability.cavitation import CAVITATION
from roughfilm.stability.cell import CELL
from roughfilm.stability.contact import CONTACT
from roughfilm.stability.form import BAD, GOOD, MEANING, MapOutcome, StabilityMap, columns_of, table_of
from roughfilm.stability.gap import GAP
from roughfilm.stability.laws import MIXED, SEAL
from roughfilm.stability.load import LOAD
from roughfilm.stability.motion import MOTION
from roughfilm.stability.pocket import DIMPLES, PADS, POCKET
from roughfilm.stability.thermal import THERMAL
from roughfilm.stability.windows import WINDOWS
from roughfilm.terminal.console import NUMERICS, AsJson, Jobs, OutDirectory, make_directory, print_json, process_count
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, print_left_out, written

EXAMPLES = (
    "roughfilm stability cell --out stability",
    "roughfilm stability all --out stability",
)

FAMILIES: dict[str, StabilityMap] = {
    one.name: one
    for one in (POCKET, DIMPLES, PADS, CAVITATION, CONTACT, CELL, SEAL, MIXED, LOAD, MOTION, THERMAL, GAP, WINDOWS)
}

MAX_BYTES = 100_000_000
"""Largest size of a stored map that is read, bytes."""

ALL = "all"

Entries = Mapping[str, Any]
"""A map, as its file holds it."""


def command(
    family: Annotated[
        str, typer.Argument(metavar="FAMILY", help=f"The solvers to map: {', '.join(FAMILIES)}, or all of them: {ALL}.")
    ],
    out: OutDirectory,
    resolution: Annotated[
        int | None,
        typer.Option(
            help="; ".join(f"{name}: {one.resolution_meaning}" for name, one in FAMILIES.items()) + ".",
            rich_help_panel=NUMERICS,
        ),
    ] = None,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Map where solvers converge, and write stability.csv, .json and report.html."""
    if family not in (*FAMILIES, ALL):
        raise InputError(f"FAMILY: got {family!r}; it must be one of {', '.join(FAMILIES)}, {ALL}")
    processes = process_count(jobs)
    if family == ALL and resolution is not None:
        raise InputError(f"--resolution: got {resolution} for {ALL}; every map counts it in its own way, leave it out")
    make_directory(out)
    refuse_unwritable((out / "report.html", PAGE), (out / "stability.json", entries_from("family")))
    if family != ALL:
        maps = [_mapped(family, out, resolution, processes)]
        entries: dict[str, Any] = dict(maps[0])
    else:
        maps = [known or _mapped(name, out / name, None, processes) for name, known in _known(out).items()]
        entries = {"family": ALL, "maps": maps}
        _write(maps, {one["family"]: out / one["family"] for one in maps}, entries, out)
    absent = {name: reason for one in maps for name, reason in one["absent"].items()}
    if as_json:
        print_json(entries)
        return
    counted = {one["family"]: one["runs"] for one in maps} if family == ALL else _by_group(maps[0])
    print_all([table_of(counted, "family" if family == ALL else "group")])
    print_left_out(absent)
    runs = [run for one in maps for run in one["runs"]]
    good, bad = (sum(run["outcome"] in outcomes for run in runs) for outcomes in (GOOD, BAD))
    answer = f"{good} of {len(runs)} runs converge, {bad} stall or are wrong"
    print_all([written(answer, out / "report.html", out / "stability.csv")])


def _by_group(one: Entries) -> dict[str, list[Entries]]:
    groups: dict[str, list[Entries]] = {}
    for run in one["runs"]:
        groups.setdefault(run["group"], []).append(run)
    return groups


def _known(out: Path) -> dict[str, Entries | None]:
    """The map of each family that is stored already, if the same code made it at the default resolution."""
    return {name: _same(out / name / "stability.json", one.resolution) for name, one in FAMILIES.items()}


def _same(path: Path, resolution: int) -> Entries | None:
    try:
        stored: dict[str, Any] = json.loads(read_bytes(path, MAX_BYTES, "map again"))
        made = stored["provenance"]
        same = (made["code"], made["versions"], stored["resolution"]) == (code(), versions(), resolution)
        return stored if same else None
    except (OSError, ValueError, LookupError, TypeError):
        return None


def _mapped(family: str, out: Path, resolution: int | None, processes: int) -> Entries:
    """Make and write one map."""
    chosen = FAMILIES[family]
    make_directory(out)
    with alone(out) as scratch:
        entries, figures = chosen.make(resolution=resolution, out=out, processes=processes, scratch=scratch)
        write_figures(figures, out)
        _write([entries], {family: out}, entries, out)
    return entries


def _write(maps: Sequence[Entries], places: Mapping[str, Path], entries: Entries, out: Path) -> None:
    """Write the table, the page and, last, the entries, which mark the map as complete."""
    write_csv(columns_of(maps), out / "stability.csv")
    figures = {
        family: {path.stem: path.read_text(encoding="utf-8") for path in sorted(place.glob("*.svg"))}
        for family, place in places.items()
    }
    bad = [(one["family"], run) for one in maps for run in one["runs"] if run["outcome"] in BAD]
    total = {outcome.value: sum(one["counts"][outcome] for one in maps) for outcome in MapOutcome}
    render(
        "stability.html.j2",
        out / "report.html",
        maps=maps,
        total={**total, "all": sum(total.values()), "good": sum(total[outcome] for outcome in GOOD)},
        groups={one["family"]: [_as_table(*group) for group in _by_group(one).items()] for one in maps},
        outcomes=[outcome.value for outcome in MapOutcome],
        meaning=MEANING,
        figures=figures,
        bad=bad,
    )
    write_json(entries, out / "stability.json")


def _as_table(name: str, runs: Sequence[Entries]) -> dict[str, Any]:
    """The runs of a group by row and column; without columns where no two rows share one."""
    rows: dict[str, dict[str, Entries]] = {}
    for run in runs:
        rows.setdefault(run["row"], {})[run["column"]] = run
    columns = list(dict.fromkeys(run["column"] for run in runs))
    shared = len(rows) == 1 or any(sum(column in cells for cells in rows.values()) > 1 for column in columns)
    few = len(columns) <= max(map(len, rows.values())) + 2
    return {"name": name, "rows": rows, "columns": columns if shared and few else []}
