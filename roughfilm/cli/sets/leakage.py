"""The leakage of a seal whose surface is known in several windows."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.seal.leakage.series import SOUGHT
from roughfilm.rom.seal.leakage.windows import SealOfWindows, columns_of_windows
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.rom.studies.table import TABLE, Column, table_beginning, write_csv, write_hdf5
from roughfilm.sampling.cells import Cells, place_of, read_cells, scenes_of
from roughfilm.sampling.leakage import leakage_of_windows
from roughfilm.terminal.console import make_directory, progress_bar
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.terminal.scenes import requested_loads, seal_of
from roughfilm.words.average import HEADS, cells_of, count_in_words, in_words
from roughfilm.words.leakage import WORDS, UnderLoad, range_warnings, sealing_in_words
from roughfilm.words.numbers import digits, finite_entries, share
from roughfilm.words.outside import outside_in_words
from roughfilm.words.scales import Scale, scale_for

SOURCES = ("Sahlin 2008, Paper F", "10.1016/S0043-1648(99)00113-1", "10.1016/j.triboint.2006.02.069")

MICROMETRE = Scale(factor=1e-6, unit="µm")


def leakage_of_set(
    scene: Path,
    directory: Path,
    out: Path,
    loads: str | None,
    overrides: Sequence[str],
    threads: int | None,
    processes: int,
    *,
    as_json: bool,
) -> None:
    """Compute the leakage of each window of a set and of a seal of very many such windows, and write tables and page.

    Parameters
    ----------
    scene, out, loads, overrides, threads : the options of the command.
    directory : directory of the set of windows.
    processes : number of processes.
    as_json : whether one JSON object is printed.
    """
    spent, cells = stopwatch(), read_cells(directory)
    scenes = scenes_of(scene, overrides, "geometry.surface", cells, seal_of)
    seal, page = scenes[0], out / "report.html"
    requested = None if loads is None else requested_loads(loads, seal)
    workers = checked_threads(threads) if processes == 1 else 1
    make_directory(out)
    refuse_unwritable((page, PAGE), (out / "table.csv", table_beginning("load (Pa)")), (out / "table.h5", TABLE))
    with alone(out / "leakage.h5", "series"), progress_bar(1.0) as advance:
        places = [place_of(out, path) for path in cells.paths]
        answer, windows = leakage_of_windows(
            scenes, places, requested, cells.independent, processes=processes, threads=workers, progress=advance
        )
        columns = {
            name: Column(values=values, unit=unit) for name, (unit, values) in columns_of_windows(seal, answer).items()
        }
        entries = _entries(seal, answer, columns, cells)
        write_csv(columns, out / "table.csv")
        write_hdf5(columns, out / "table.h5")
        from roughfilm.pages.sets.leakage import write_page  # matplotlib is slow to import

        advance(1.0, "drawing the page")
        known = sum(window.known for window in windows)
        entries["numerics"] |= {"loads_found": known, **spent()}
        write_page(seal, answer, entries, page)

    def shown() -> Iterator[Table | str]:
        name = f"direct_{seal.flow.direction}"
        leaks = [one.scaled(leakage_of(seal, 1.0)) for one in answer.numbers[name]]
        scale = scale_for("kg/(m*s)", answer.answer["leakage_per_width"].value)
        heads = ("load, MPa", "area, %", f"{seal.flow.direction}, direct", *HEADS, "sealed, %")
        rows = (
            [
                digits(load * 1e-6),
                digits(100 * answer.numbers["area_fraction"][number].value),
                *cells_of(leaks[number], scale),
                f"{100 * leaks[number].zeros:.3g}",
            ]
            for number, load in enumerate(answer.loads)
        )
        count = count_in_words(answer.count, answer.independent)
        yield table_of(heads, rows, title=f"{seal.name}: leakage per width, {scale.unit}, mean over {count}")
        yield from (f"{WORDS[name]}: {sealing_in_words(one)}" for name, one in answer.sealing.items())
        yield f"mean gap at {digits(answer.load * 1e-6)} MPa: {in_words(answer.answer['mean_gap'], MICROMETRE)}"

    leak = answer.answer["leakage_per_width"]
    scale = scale_for("kg/(m*s)", leak.value)
    words = f"along {seal.flow.direction} at {digits(answer.load * 1e-6)} MPa: {in_words(leak, scale)}"
    sealed = f"; {share(leak.zeros)} of the windows are sealed" if leak.zeros else ""
    beyond = outside_in_words(entries["outside"])
    summary = written("; ".join(filter(None, [beyond, f"{words}{sealed}"])), page, out / "table.csv")
    show_result(entries, shown(), as_json=as_json, reused="rows", summary=summary)


def _entries(seal: Seal, answer: SealOfWindows, columns: dict[str, Column], cells: Cells) -> dict[str, Any]:
    """The object of ``--json``, without the cost."""
    leak = answer.answer["leakage_per_width"]
    quantities: dict[str, Any] = {
        "load": {"value": answer.load, "unit": "Pa"},
        "sealed": {"value": leak.zeros, "unit": "1"},
        "leakage_per_width": {**leak.entries("kg/(m*s)"), "in_series": answer.answer_in_series},
        "area_fraction": answer.answer["area_fraction"].entries("1"),
        "mean_gap": answer.answer["mean_gap"].entries("m"),
    }
    for name in SOUGHT:
        sealing = answer.sealing[name]
        quantities[f"seals_{name}"] = {"value": sealing.sealing, "unit": "1"}
        if sealing.load is not None and sealing.area_fraction is not None:
            quantities[f"sealing_load_{name}"] = sealing.load.entries("Pa")
            quantities[f"sealing_area_{name}"] = sealing.area_fraction.entries("1")
    entries: dict[str, Any] = {
        "series": [
            {name: float(column.values[place]) for name, column in columns.items()}
            for place in range(len(answer.loads))
        ],
        "units": {name: column.unit for name, column in columns.items()},
        "quantities": quantities,
        "windows": {**cells.entries(), "periods": list(answer.periods)},
        "numerics": {
            "points": int(np.prod(seal.surface().shape)),
            "loads": len(answer.loads),
            "rows": len(answer.loads) * answer.count,
        },
        "outside": list(_asked(answer).outside(seal)),
        "provenance": origin(SOURCES, [*cells.warnings, *_warnings(seal, answer)], scene=scene_entries(seal)),
    }
    finite: dict[str, Any] = finite_entries(entries)
    return finite


def _asked(answer: SealOfWindows) -> UnderLoad:
    """The seal at its own load, or at the largest one."""
    return UnderLoad(
        load=answer.load,
        area_fraction=answer.answer["area_fraction"].value,
        peak=answer.peaks[answer.loads.index(answer.load)],
        leakage=answer.answer["leakage_per_width"].value,
    )


def _warnings(seal: Seal, answer: SealOfWindows) -> list[str]:
    """Warnings of loads out of range, of windows that never seal, and of lifted surfaces."""
    factor = leakage_of(seal, 1.0)
    loaded = [
        UnderLoad(
            load=load,
            area_fraction=answer.numbers["area_fraction"][number].value,
            peak=answer.peaks[number],
            leakage=factor * max(answer.numbers[name][number].value for name in SOUGHT),
        )
        for number, load in enumerate(answer.loads)
    ]
    warnings = range_warnings(seal, loaded)
    for name, sealing in answer.sealing.items():
        if sealing.sealing < 1:
            limit = "the hardness" if math.isfinite(seal.hardness) else "E*, the limit of a linear solid"
            warnings.append(f"{WORDS[name]}: {share(1 - sealing.sealing)} of the windows stay open up to {limit}")
    lifted = sum(load < seal.flow.pressure_drop for load in answer.loads)
    if lifted:
        warnings.append(
            f"at {lifted} of {len(answer.loads)} loads the pressure drop is above the load: the liquid would lift the "
            "surface, which this model leaves out"
        )
    return warnings
