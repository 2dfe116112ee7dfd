"""roughfilm leakage: the leakage of a seal over the load, from the first touch until it is sealed."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, is_joined_at_pixel_0, joint_mismatch
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.rom.seal.at_load import SealAtLoad, seal_at_load
from roughfilm.rom.seal.leakage.curve import SealSetup, chosen_loads, columns_of, seal_setup, sealing, solved
from roughfilm.rom.seal.leakage.joint import EDGE_REMEDY, joint_seals
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.scene import Seal
from roughfilm.rom.studies.table import TABLE, Column, table_beginning, write_csv, write_hdf5
from roughfilm.terminal.console import (
    AsJson,
    Jobs,
    OutDirectory,
    Overrides,
    ScenePath,
    Threads,
    Windows,
    make_directory,
    process_count,
    progress_bar,
)
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.terminal.scenes import refuse_jobs, requested_loads, seal_of
from roughfilm.words.leakage import (
    WORDS,
    UnderLoad,
    answer_in_words,
    in_words,
    leakage_scale,
    leaks,
    range_warnings,
    scatter_in_words,
)
from roughfilm.words.numbers import digits, finite
from roughfilm.words.outside import outside_in_words

EXAMPLES = (
    "roughfilm leakage scripts/examples/scenes/seal.toml --out seal",
    "roughfilm leakage scripts/examples/scenes/seal.toml --out seal --loads 1MPa",
)

SOURCES = ("Sahlin 2008, Paper F", "10.1016/S0043-1648(99)00113-1", "10.1016/j.triboint.2006.02.069")
HEADS = ("load, MPa", "area, %", "mean gap, µm", "x, direct", "y, direct", "x, averaged", "y, averaged")


def command(
    scene: ScenePath,
    out: OutDirectory,
    loads: Annotated[
        str | None,
        typer.Option(
            metavar="LOADS",
            help="Mean pressures: a range 1kPa..1MPa:25, a list, or one "
            "(default: the scene's load, and from the first touch until sealed).",
        ),
    ] = None,
    windows: Windows = None,
    set_: Overrides = None,
    threads: Threads = None,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Compute contact, gap and leakage of a seal, directly and averaged, from the first touch until it is sealed."""
    if windows is not None:
        from roughfilm.cli.sets.leakage import leakage_of_set  # only a set of windows needs it

        leakage_of_set(scene, windows, out, loads, set_ or (), threads, process_count(jobs), as_json=as_json)
        return
    refuse_jobs(jobs)
    spent, seal = stopwatch(), seal_of(load_scene(scene, set_ or ()))
    requested = None if loads is None else requested_loads(loads, seal)
    workers, page = checked_threads(threads), out / "report.html"
    make_directory(out)
    refuse_unwritable((page, PAGE), (out / "table.csv", table_beginning("load (Pa)")), (out / "table.h5", TABLE))
    with (
        alone(out / "leakage.h5", "series"),
        alone(out / "contacts.h5", "series of contacts"),
        progress_bar(1.0) as advance,
    ):
        advance(0.0, "reading the surface")
        body = seal_setup(seal, out)
        thresholds = sealing(body, lambda done, words: advance(0.2 * done, words))
        own = seal.load.pressure
        series = tuple(sorted({own, *chosen_loads(body, thresholds)})) if requested is None else requested
        rows, known = solved(body, series, workers, lambda done, words: advance(0.2 + 0.7 * done, words))
        answer = seal_at_load(seal, load_contact(body.contacts, own if own in rows else series[-1]))
        entries, columns = _entries(seal, body, rows, thresholds, answer)
        write_csv(columns, out / "table.csv")
        write_hdf5(columns, out / "table.h5")
        advance(0.95, "drawing the page")
        from roughfilm.pages.leakage import write_page  # matplotlib is slow to import

        entries["numerics"] |= {"loads_found": known, **spent()}
        write_page(seal, body, rows, thresholds, answer, entries, out)

    def shown() -> Iterator[Table | str]:
        scale = leakage_scale(answer)
        cells = (
            [
                *map(digits, (row.load * 1e-6, row.area_fraction * 100, row.mean_gap * 1e6)),
                *(leaks(seal, row, name, scale) for name in SOUGHT),
            ]
            for row in rows.values()
        )
        yield table_of(HEADS, cells, title=f"{seal.name}: leakage per width, {scale.unit}")
        yield from (f"{WORDS[name]}: {in_words(threshold)}" for name, threshold in thresholds.items())
        if np.ptp(body.surface.heights) > 0:
            yield scatter_in_words(body.spread)

    name = f"direct_{seal.flow.direction}"
    beyond = outside_in_words(entries["outside"])
    sealing_words = f"{WORDS[name]}: {in_words(thresholds[name])}"
    words = "; ".join(filter(None, [beyond, answer_in_words(seal, answer), sealing_words]))
    summary = written(words, page, out / "table.csv")
    show_result(entries, shown(), as_json=as_json, reused="loads", summary=summary)


def _entries(
    seal: Seal, body: SealSetup, rows: Mapping[float, Row], thresholds: Mapping[str, Threshold], answer: SealAtLoad
) -> tuple[dict[str, Any], dict[str, Column]]:
    """The object of ``--json``, and the rows as columns of the table."""
    columns = {
        name: Column(values=values, unit=unit) for name, (unit, values) in columns_of(seal, [*rows.values()]).items()
    }
    leaks = np.array([column.values for column in columns.values() if column.unit == "kg/(m*s)"], dtype=float)
    loaded = {
        load: UnderLoad(
            load=load, area_fraction=row.area_fraction, peak=row.pressure_max, leakage=float(np.nanmax(largest))
        )
        for (load, row), largest in zip(rows.items(), leaks.T, strict=True)
    }
    asked = replace(loaded[answer.load], leakage=answer.leakage_per_width.value)
    quantities: dict[str, Any] = {
        "load": {"value": answer.load, "unit": "Pa"},
        "sealed": {"value": float(answer.sealed), "unit": "1"},
        **{name: asdict(getattr(answer, name)) for name in ("leakage_per_width", "area_fraction", "mean_gap")},
    }
    for name, threshold in thresholds.items():
        quantities[f"seals_{name}"] = {"value": float(threshold.sealed is not None), "unit": "1"}
        if threshold.bracketed:
            quantities[f"sealing_load_{name}"] = {"value": threshold.load, "unit": "Pa"}
            quantities[f"sealing_area_{name}"] = {"value": threshold.area_fraction, "unit": "1"}
    entries = {
        "series": [
            {name: finite(float(column.values[place])) for name, column in columns.items()}
            for place in range(len(rows))
        ],
        "units": {name: column.unit for name, column in columns.items()},
        "quantities": quantities,
        "thresholds": {
            name: {end: side and asdict(side) for end, side in (("open", both.open), ("sealed", both.sealed))}
            for name, both in thresholds.items()
        },
        "numerics": {"points": body.surface.heights.size, "loads": len(rows)},
        "outside": list(asked.outside(seal)),
        "provenance": origin(
            SOURCES,
            [*range_warnings(seal, loaded.values()), *_warnings(seal, body, rows, thresholds)],
            scene=scene_entries(seal),
        ),
    }
    return entries, columns


def _warnings(seal: Seal, body: SealSetup, rows: Mapping[float, Row], thresholds: Mapping[str, Threshold]) -> list[str]:
    """Warnings of directions that never seal or are always sealed, of edges that do not fit, and of lifted surfaces."""
    warnings = []
    for name, threshold in thresholds.items():
        if threshold.sealed is None:
            limit = "the hardness" if math.isfinite(body.press.hardness) else "E*, the limit of a linear solid"
            warnings.append(f"{WORDS[name]}: stays open up to {body.most / 1e6:.4g} MPa, {limit}")
        elif threshold.open is None and np.ptp(body.surface.heights) > 0:
            warnings.append(f"{WORDS[name]}: is sealed under any load")
    if not seal.geometry.described:
        warnings += _edge_warnings(body, rows)
    lifted = sum(row.load < seal.flow.pressure_drop for row in rows.values())
    if lifted:
        warnings.append(
            f"at {lifted} of {len(rows)} loads the pressure drop is above the load: the liquid would lift the surface, "
            "which this model leaves out"
        )
    return warnings


def _edge_warnings(body: SealSetup, rows: Mapping[float, Row]) -> list[str]:
    """Warnings of the edges of a measured surface, which is repeated periodically."""
    mismatch, where = joint_mismatch(body.surface), []
    for number, axis in enumerate("xy" if is_joined_at_pixel_0(body.surface) else ""):
        first = next((load for load, row in rows.items() if getattr(row, f"direct_{axis}_sealed")), None)
        if first is not None and joint_seals(load_contact(body.contacts, first).gap)[number]:
            where.append(axis)
    edges = f"the edge in {' and '.join(where)}"
    if mismatch > MISMATCH_THRESHOLD:
        effect = f"seals first at {edges}" if where else "may leak less across its edges"
        return [f"the surface is not periodic (edge mismatch {mismatch:.2g}) and {effect}; {EDGE_REMEDY}"]
    warnings = [] if body.surface.periodic else ["the surface is not marked as periodic; it is taken as one period"]
    if where:
        warnings.append(
            f"the surface is periodic (edge mismatch {mismatch:.2g}), but seals first at {edges}: the threshold may "
            "depend on the preparation; compare another window"
        )
    return warnings
