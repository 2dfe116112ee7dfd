"""roughfilm windows: the scatter of a surface between many windows or seeds, and the value of the whole surface."""

from collections.abc import Iterator, Mapping
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.batch.cluster import dask
from roughfilm.batch.executors import local
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range, whole_in_range
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import PAGE, entries_from
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.preparation.recipe import Recipe, load_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.store import FIRST_KEY, LIST, WindowSet, save_windows, stored_list
from roughfilm.rom.bearing.mixed.stribeck import MAX_CELLS, MIN_CELLS
from roughfilm.rom.studies.table import TABLE, table_beginning, write_csv, write_hdf5
from roughfilm.sampling.answer import answer_of
from roughfilm.sampling.asked import Asked, asked_of
from roughfilm.sampling.plan import COUNT, Plan, planned
from roughfilm.sampling.run import examined
from roughfilm.sampling.tabulate import FIRST_COLUMN
from roughfilm.sampling.tabulate import table_of as columns_of
from roughfilm.terminal.console import (
    NUMERICS,
    AsJson,
    Jobs,
    OutDirectory,
    make_directory,
    print_message,
    process_count,
    progress_bar,
)
from roughfilm.terminal.machines import WAIT, Keys, OnMachines, Scheduler, Wait, Where, waiting_time
from roughfilm.terminal.output_file import alone, refuse_same, refuse_unwritable
from roughfilm.terminal.ranges import in_si
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.numbers import share
from roughfilm.words.windows import entries_of, headline, heads, quantity_cells

EXAMPLES = (
    "roughfilm windows measured.x3p --out windows",
    "roughfilm windows measured.x3p --scene scripts/examples/scenes/seal.toml --size 0.2mm --windows 64 --out windows",
    "roughfilm windows scripts/examples/surfaces/ground.toml --gap 2um --out seeds",
)

SEALED = ("leakage_per_width",)
"""Quantities that are 0 where a window is sealed."""

SOURCES = ("10.1080/10691898.2005.11910638", "10.1093/biomet/26.4.404", "ISO 25178-2:2021")

PREPARED, EXAMINED = 0.1, 0.95
"""Done fractions after the preparation of the windows, and after all quantities."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A measured surface, or a description (TOML).")],
    out: OutDirectory,
    scene: Annotated[
        Path | None,
        typer.Option(
            metavar="SCENE",
            help="A dry contact, seal or rough bearing, whose surface each window replaces (default: roughness "
            "parameters).",
        ),
    ] = None,
    windows: Annotated[int, typer.Option("--windows", help="Windows, or seeds, of each size.")] = COUNT,
    size: Annotated[
        str | None,
        typer.Option(
            metavar="L",
            help="Side of the largest windows, e.g. 0.4mm (default: five decay lengths Sal, or more if they fit).",
        ),
    ] = None,
    sizes: Annotated[
        str | None,
        typer.Option(metavar="L,L", help="Further sides, or none (default: a half and a quarter of the largest)."),
    ] = None,
    tolerance: Annotated[
        str, typer.Option(metavar="T", help="Tolerance of the mean for which windows are counted.")
    ] = "5%",
    gap: Annotated[
        str | None, typer.Option(metavar="GAP", help="Without a scene: add the flow factors at this mean gap.")
    ] = None,
    sealing: Annotated[
        bool, typer.Option("--sealing", help="Seek the load at which each window of a seal closes.")
    ] = False,
    resolution: Annotated[
        int, typer.Option(help="Cells along and across a bearing.", rich_help_panel=NUMERICS)
    ] = Asked().resolution,
    recipe: Annotated[Path | None, typer.Option("--prepare", help="The recipe (TOML; default: the usual one).")] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Override a key of it, e.g. form=tilt; repeatable."),
    ] = None,
    jobs: Jobs = None,
    executor: OnMachines = Where.LOCAL,
    scheduler: Scheduler = None,
    tls: Keys = None,
    wait: Wait = WAIT,
    as_json: AsJson = False,
) -> None:
    """Take many windows of a surface, or seeds: their scatter, and how many are needed."""
    spent, processes = stopwatch(), process_count(jobs)
    refuse_same({"FILE": file, "--prepare": recipe, "--scene": scene, "--out": out})
    resolution = whole_in_range("--resolution", resolution, MIN_CELLS, MAX_CELLS)
    allowed, steps = _tolerance(tolerance), load_recipe(recipe, set_ or ())
    limit = waiting_time(executor, scheduler, tls, wait)
    with (
        nullcontext() if scheduler is None else dask(scheduler, wait=limit, tls=tls) as cluster,
        progress_bar(1.0) as advance,
    ):
        advance(0.0, f"reading {file.name}")
        given = _given(file, steps, described=bool(recipe or set_))
        make_directory(out)
        page, stored = out / "report.html", out / LIST
        refuse_unwritable(
            (page, PAGE),
            (stored, entries_from(FIRST_KEY)),
            (out / "table.csv", table_beginning(FIRST_COLUMN)),
            (out / "table.h5", TABLE),
        )
        with alone(stored, "run"), scratch_directory() as scratch:
            plan = planned(
                given,
                steps,
                count=windows,
                size=None if size is None else in_si("--size", size, "m"),
                sizes=None if sizes is None else _lengths(sizes),
                name=file.name,
                progress=lambda done, words: advance(PREPARED * done, words),
            )
            asked = _asked(plan, scene, gap, sealing, resolution, scratch)
            _say_changes(out, plan, asked)
            rows = examined(
                plan,
                asked,
                directory=out,
                place=local(processes, scratch) if cluster is None else nullcontext(cluster),
                progress=lambda done, words: advance(PREPARED + (EXAMINED - PREPARED) * done, words),
            )
            answer = answer_of(plan, asked, rows, allowed)
            entries = {
                **entries_of(answer),
                "asked": _asked_entries(asked),
                "numerics": {
                    "windows": sum(len(group.cells) for group in plan.groups),
                    "windows_found": rows.found,
                    **(own := spent()),
                    "cpu_s": own["cpu_s"] + rows.cpu_s,
                },
                "provenance": origin(SOURCES, answer.warnings, surface=dict(plan.source), scene=dict(asked.scene)),
            }
            main = plan.groups[0]
            kept = WindowSet(
                cells=main.cells,
                windows=main.windows,
                size=main.size,
                independent=main.independent,
                source=plan.source,
                answers=entries,
            )
            advance(EXAMINED, "writing the cells")
            save_windows(kept, out)
            table = columns_of(plan, rows)
            write_csv(table, out / "table.csv")
            write_hdf5(table, out / "table.h5")
            from roughfilm.pages.windows import write_page  # matplotlib is slow to import

            advance(EXAMINED, "drawing the page")
            write_page(plan, answer, asked.kind, entries, heads(allowed), page)

    def shown() -> Iterator[Table | str]:
        yield table_of(
            heads(allowed),
            [quantity_cells(name, one, asked.kind) for name, one in answer.quantities.items()],
            title=f"{answer.count} windows of {1e6 * answer.size:.4g} µm, worth {answer.independent:.3g} independent "
            "ones",
            left=1,
        )
        for name, one in answer.quantities.items():
            if name in SEALED and one.scatter.zeros > 0:
                low, high = one.scatter.zeros_interval
                yield f"{share(one.scatter.zeros)} of the windows are sealed, 95 %: {share(low)} to {share(high)}"

    show_result(
        {**entries, "report": str(page)},
        shown(),
        as_json=as_json,
        reused="windows",
        summary=written(headline(answer, asked.kind), page, out / "table.csv"),
    )


def _given(file: Path, recipe: Recipe, *, described: bool) -> Surface | Path:
    """The measured surface, or the file of a description, which takes no recipe."""
    if file.suffix.lower() == ".toml":
        if described:
            raise InputError(f"{file}: is described and periodic; leave out --prepare and --set")
        return file
    return read_surface(file, **dict(recipe.read))


def _asked(plan: Plan, scene: Path | None, gap: str | None, sealing: bool, resolution: int, scratch: Path) -> Asked:
    """The computation that the options request; InputError if they do not fit together."""
    if scene is None:
        if sealing:
            raise InputError("--sealing: needs --scene with a seal")
        return Asked(gap=None if gap is None else in_range("--gap", in_si("--gap", gap, "m"), "m"))
    if gap is not None:
        raise InputError(f"--gap: got {gap} with --scene, whose load determines the gap; leave one out")
    first = scratch / "first.h5"
    save_surface(plan.groups[0].cells[0], first)
    asked = asked_of(scene, first, sealing=sealing, resolution=resolution)
    if sealing and asked.kind != "seal":
        raise InputError(f"--sealing: {scene} is of the kind {asked.kind!r}; it needs a seal")
    return asked


def _asked_entries(asked: Asked) -> dict[str, Any]:
    return {"digest": asked.digest, "kind": asked.kind, "gap": asked.gap, "sealing": asked.sealing}


def _say_changes(out: Path, plan: Plan, asked: Asked) -> None:
    """Say what is not that of the last finished run in this directory, whose windows are then computed again."""
    before = stored_list(out)
    if before is None:
        return
    changed = [] if dict(before.windows_of) == dict(plan.source) else ["surface or the recipe"]
    last = before.answers.get("asked")
    if not isinstance(last, Mapping) or last.get("digest") != asked.digest:
        changed.append("scene")
    if changed:
        print_message("changed", f"the {' and the '.join(changed)} since the last run; such windows are computed again")


def _lengths(text: str) -> list[float]:
    return [] if text.strip() == "none" else [in_si("--sizes", one, "m") for one in text.split(",")]


def _tolerance(text: str) -> float:
    try:
        value = to_si(text, "%") / 100 if text.rstrip().endswith("%") else float(text)
    except ValueError:
        raise InputError(f"--tolerance: got {text!r}; give a percentage such as 5%") from None
    if not 0 < value < 1:
        raise InputError(f"--tolerance: got {text!r}; it must be above 0 and below 100 %")
    return value
