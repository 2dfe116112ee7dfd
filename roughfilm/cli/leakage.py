"""roughfilm leakage: what a seal lets through from the first touch to where it is sealed."""

import math
import os
import time
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.rom.seal.leakage.curve import Ready, chosen_loads, columns_of, ready_seal, sealing, solved
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.scene import Seal
from roughfilm.rom.studies.table import Column, write_csv, write_hdf5
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    ScenePath,
    Threads,
    in_one_line,
    make_directory,
    messages,
    output,
    print_json,
    progress_bar,
)
from roughfilm.terminal.load_range import loads_of
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.words.leakage import WORDS, in_words, leaks
from roughfilm.words.numbers import digits

SOURCES = ("Sahlin 2008, Paper F", "10.1016/S0043-1648(99)00113-1", "10.1016/j.triboint.2006.02.069")


HEADS = ("x, direct", "y, direct", "x, averaged", "y, averaged")


@in_one_line
def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="Directory for contacts, tables and the page; loads in it are kept.")],
    loads: Annotated[
        str | None,
        typer.Option(
            metavar="LOADS", help="Mean pressures: 1kPa..1MPa:25, a list, or one; else from touching to sealed."
        ),
    ] = None,
    set_: Overrides = None,
    threads: Threads = None,
    as_json: AsJson = False,
) -> None:
    """Press a seal from the first touch until it is sealed: contact, gap, and leakage both directly and averaged."""
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    read = load_scene(scene, set_ or ())
    if not isinstance(read, Seal):
        raise InputError(f"scene.kind: got {read.kind!r}; leakage takes scenes of kind 'seal'")
    asked = None if loads is None else loads_of(loads)
    if asked is not None and asked[-1] > read.hardness:
        raise InputError(
            f"--loads: up to {asked[-1] / 1e6:.10g} MPa, above the hardness of {read.hardness / 1e6:.10g} MPa, which "
            "is all that the whole area can bear; lower them"
        )
    sharing = checked_threads(threads)
    make_directory(out)
    refuse_unwritable(out / "report.html")
    with (
        alone(out / "leakage.h5", "series"),
        alone(out / "contacts.h5", "series of contacts"),
        progress_bar(1.0) as advance,
    ):
        advance(0.0, "reading the surface")
        body = ready_seal(read, out)
        found = sealing(body, lambda done, words: advance(0.2 * done, words))
        series = chosen_loads(body, found) if asked is None else asked
        rows, known = solved(body, series, sharing, lambda done, words: advance(0.2 + 0.7 * done, words))
        told = _told(read, body, rows, found, known)
        _write_tables(read, rows, out)
        advance(0.95, "drawing the page")
        from roughfilm.pages.leakage import write_page  # matplotlib is slow to import

        told["numerics"] |= {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - started}
        write_page(read, body, rows, found, told, out)
    _tell(read, told, rows, found, out, as_json)


def _told(scene: Seal, body: Ready, rows: dict[float, Row], found: dict[str, Threshold], known: int) -> dict[str, Any]:
    """The object of ``--json``."""
    quantities: dict[str, Any] = {}
    for name, threshold in found.items():
        quantities[f"seals_{name}"] = {"value": float(threshold.sealed is not None), "unit": "1"}
        if threshold.found:
            quantities[f"sealing_load_{name}"] = {"value": threshold.load, "unit": "Pa"}
            quantities[f"sealing_area_{name}"] = {"value": threshold.area_fraction, "unit": "1"}
    return {
        "series": [_numbers(scene, row) for row in rows.values()],
        "units": {name: unit for name, (unit, _) in columns_of(scene, list(rows.values())).items()},
        "quantities": quantities,
        "thresholds": {
            name: {
                end: None if side is None else asdict(side) for end, side in (("open", t.open), ("sealed", t.sealed))
            }
            for name, t in found.items()
        },
        "numerics": {"points": body.surface.heights.size, "loads": len(rows), "loads_found": known},
        "provenance": {
            "scene": scene_entries(scene),
            "warnings": _warnings(scene, body, rows, found),
            "sources": list(SOURCES),
            **circumstances(),
        },
    }


def _numbers(scene: Seal, row: Row) -> dict[str, float | None]:
    """A row as JSON can hold it: None where a surface flattened out has no valleys, and an error no bar."""
    columns = columns_of(scene, [row])
    return {name: value if math.isfinite(value) else None for name, (_, (value,)) in columns.items()}


def _write_tables(scene: Seal, rows: dict[float, Row], out: Path) -> None:
    columns = columns_of(scene, list(rows.values()))
    table = {name: Column(values=values, unit=unit) for name, (unit, values) in columns.items()}
    write_csv(table, out / "table.csv")
    write_hdf5(table, out / "table.h5")


def _warnings(scene: Seal, body: Ready, rows: dict[float, Row], found: dict[str, Threshold]) -> list[str]:
    """What must be known: what never seals, joints that do, loads at which the liquid would lift the surface."""
    told = []
    for name, threshold in found.items():
        if threshold.sealed is None:
            limit = "the hardness" if math.isfinite(body.press.hardness) else "E*, beyond which it is no linear solid"
            told.append(f"{WORDS[name]}: stays open up to {body.most / 1e6:.4g} MPa, {limit}")
        elif threshold.open is None and np.ptp(body.surface.heights) > 0:
            told.append(f"{WORDS[name]}: is sealed under any load")
    if not scene.geometry.described:
        told += _of_joints(body, rows)
    lifted = sum(row.load < scene.flow.pressure_drop for row in rows.values())
    if lifted:
        told.append(
            f"at {lifted} of {len(rows)} loads the pressure drop is above the load: such a liquid lifts the surface, "
            "which is left out here"
        )
    return told


def _of_joints(body: Ready, rows: dict[float, Row]) -> list[str]:
    """What the joints of a surface do that does not repeat itself by its making."""
    from roughfilm.contact.mechanics.store import load_contact
    from roughfilm.rom.seal.leakage.joint import joint_seals

    mismatch, where = periodicity_mismatch(body.surface), []
    for number, axis in enumerate("xy"):
        shut = next((load for load, row in rows.items() if getattr(row, f"direct_{axis}_sealed")), None)
        if shut is not None and joint_seals(load_contact(body.contacts, shut).gap)[number]:
            where.append(axis)
    sealing_first = f"it is these that seal it first in {' and '.join(where)}" if where else ""
    if mismatch > MISMATCH_THRESHOLD:
        done = sealing_first or "they may throttle it"
        return [f"the surface meets itself badly at its joints (mismatch {mismatch:.2g}); {done}: prepare it better"]
    told = (
        [] if body.surface.periodic else ["the surface does not say that it repeats itself; it is taken as one period"]
    )
    if where:
        told.append(
            f"the surface fits at its joints (mismatch {mismatch:.2g}), but {sealing_first}: "
            "that threshold may be one of the preparation, compare another window"
        )
    return told


def _tell(
    scene: Seal, told: dict[str, Any], rows: dict[float, Row], found: dict[str, Threshold], out: Path, as_json: bool
) -> None:
    if as_json:
        print_json(told)
    else:
        output.print(_table_of(scene, rows))
        for name, threshold in found.items():
            output.print(f"{WORDS[name]}: {in_words(threshold)}", soft_wrap=True)
        output.print(f"report: {escape(str(out / 'report.html'))}", soft_wrap=True)
    known = told["numerics"]["loads_found"]
    if known:
        messages.print(f"found: {known} of {len(rows)} loads, not solved again", soft_wrap=True)
    for warning in told["provenance"]["warnings"]:
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


def _table_of(scene: Seal, rows: dict[float, Row]) -> Table:
    """The series as people read it."""
    heads = ("load, MPa", "area, %", "mean gap, µm", *HEADS)
    table = Table(*heads, title=f"{escape(scene.name)}: leakage in kg/h for each metre")
    for column in table.columns:
        column.justify = "right"
    for row in rows.values():
        told = (row.load * 1e-6, row.area_fraction * 100, row.mean_gap * 1e6)
        table.add_row(*(digits(value) for value in told), *(leaks(scene, row, name) for name in SOUGHT))
    return table
