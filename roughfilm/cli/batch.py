"""roughfilm batch: every case of a study by every model, in parallel; a batch that was stopped goes on where it was."""

import os
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Column, Table

from roughfilm.batch.directory import alone
from roughfilm.batch.executors import dask, local
from roughfilm.batch.progress import State, Tally
from roughfilm.batch.solve import finished, solved_table, tasks_of
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.ladder.provenance import code, commit, versions
from roughfilm.rom.studies.study import Study, load_study
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    in_one_line,
    make_directory,
    messages,
    output,
    print_json,
    progress_bar,
)

SHOWN = 5
"""How many cases and failures are listed; the rest is counted."""


class Where(StrEnum):
    """Where the jobs run."""

    LOCAL = "local"
    DASK = "dask"


@in_one_line
def command(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="The study file (TOML): a scene with lists.")],
    out: Annotated[Path, typer.Option(help="Cases, results and tables go here; finished results are used again.")],
    jobs: Annotated[int | None, typer.Option(help="Processes; by default one for each core.")] = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would be done, and what it would cost.")] = False,
    executor: Annotated[Where, typer.Option(help="Where the jobs run.")] = Where.LOCAL,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="The dask scheduler: tcp://HOST:PORT.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Solve every case of a study by every model and write table.csv and table.h5."""
    processes = len(os.sched_getaffinity(0)) if jobs is None else jobs
    if processes < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    if (executor is Where.DASK) != (scheduler is not None):
        raise InputError(f"--scheduler: got {scheduler} with --executor {executor}; dask needs one, local takes none")
    read = load_study(study, models())
    tally = Tally()
    if dry_run:
        finished(read, tasks_of(read, out), tally)
        _tell_plan(read, tally, processes, as_json)
        return
    make_directory(out)
    with alone(out) as scratch:
        place = local(processes, scratch) if scheduler is None else dask(scheduler)
        _solved(read, out, tally, place)
    _tell_outcome(read, tally, out, as_json)
    if tally.failures:
        raise typer.Exit(NOT_CONVERGED)


def _solved(study: Study, out: Path, tally: Tally, place: AbstractContextManager[Executor]) -> None:
    """Solve with a bar of progress."""
    try:
        with progress_bar(1.0) as advance:
            solved_table(study, out, tally, place, advance)
    except (KeyboardInterrupt, SystemExit) as stop:
        stop.add_note(f"stopped: {tally.words}; the same command goes on")
        raise


def _tell_plan(study: Study, tally: Tally, processes: int, as_json: bool) -> None:
    wall = tally.wall_s(processes)
    if as_json:
        shown = [{"name": case.name, "varied": dict(case.varied)} for case in study.cases[:SHOWN]]
        print_json(
            {
                **_entries(study, tally),
                "first_cases": shown,
                "cpu_s": tally.cpu_s,
                "wall_s": wall,
                "processes": processes,
            }
        )
        return
    table = Table(*study.keys, title=f"{escape(study.name)}: {len(study.cases)} cases")
    for case in study.cases[:SHOWN]:
        table.add_row(*(escape(str(case.varied.get(key, "-"))) for key in study.keys))
    if len(study.cases) > SHOWN:
        table.add_row(*("..." for _ in study.keys))
    output.print(table)
    output.print(_table_of(tally))
    output.print(f"to come: {_duration(tally.cpu_s)} of CPU time, {_duration(wall)} with {processes} processes")


def _tell_outcome(study: Study, tally: Tally, out: Path, as_json: bool) -> None:
    if as_json:
        failures = [
            {"case": job.path.parent.name, "setting": job.setting.name, **asdict(failure)}
            for job, failure in tally.failures
        ]
        tables = [str(out / name) for name in ("table.csv", "table.h5")]
        print_json({**_entries(study, tally), "failures": failures, "tables": tables})
    else:
        output.print(_table_of(tally))
        output.print(f"table: {escape(str(out / 'table.csv'))} (.h5)", soft_wrap=True)
    if tally.warned:
        messages.print(f"[yellow]warning:[/] {tally.warned} results carry one; see the table", soft_wrap=True)
    for job, failure in tally.failures[:SHOWN]:
        told = f"{job.path.parent.name} by {job.setting.name}: {failure.kind}: {failure.message}"
        messages.print(f"[yellow]failed:[/] {escape(told)}", soft_wrap=True)
    if len(tally.failures) > SHOWN:
        messages.print(f"[yellow]failed:[/] {len(tally.failures) - SHOWN} more; see the table", soft_wrap=True)


def _entries(study: Study, tally: Tally) -> dict[str, Any]:
    return {
        "study": study.name,
        "cases": len(study.cases),
        "jobs": {name: {state.value: n for state, n in a.jobs.items()} for name, a in tally.accounts.items()},
        "provenance": {"code": code(), "commit": commit(), "versions": versions()},
    }


def _table_of(tally: Tally) -> Table:
    shown = [state for state in State if tally.total(state)]
    come = ["CPU to come"] if tally.total(State.TO_DO) else []
    table = Table(Column("setting", no_wrap=True), *(Column(head, justify="right") for head in [*shown, *come]))
    for name, account in tally.accounts.items():
        cells = [str(account.jobs[state]) for state in shown]
        table.add_row(name, *cells, *([_duration(account.remaining)] if come else []))
    return table


def _duration(seconds: float) -> str:
    for unit, size in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
