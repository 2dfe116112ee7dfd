"""roughfilm batch: every case of a study by every model, in parallel; a stopped batch continues where it was."""

from collections.abc import Iterator
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.batch.directory import alone
from roughfilm.batch.executors import dask, local
from roughfilm.batch.progress import BatchProgress, State
from roughfilm.batch.solve import finished, solved_table, tasks_of
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.ladder.provenance import code, commit, versions
from roughfilm.rom.studies.study import Study, load_study
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    Jobs,
    OutDirectory,
    make_directory,
    messages,
    print_json,
    process_count,
    progress_bar,
)
from roughfilm.terminal.results import print_all, table_of

LISTED = 5
"""Cases and failures that are listed; the others are counted."""


class Where(StrEnum):
    """The machines on which the jobs run."""

    LOCAL = "local"
    DASK = "dask"


def command(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="The study file (TOML): a scene with lists.")],
    out: OutDirectory,
    jobs: Jobs = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show the jobs and their cost; solve nothing.")] = False,
    executor: Annotated[Where, typer.Option(help="Run the jobs on this machine, or on a dask cluster.")] = Where.LOCAL,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Address of the dask scheduler: tcp://HOST:PORT.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Solve every case of a study by every model and write table.csv and table.h5."""
    processes = process_count(jobs)
    if (executor is Where.DASK) != (scheduler is not None):
        raise InputError(f"--scheduler: got {scheduler} with --executor {executor}; dask needs one, local takes none")
    read = load_study(study, models())
    progress = BatchProgress()
    if dry_run:
        finished(read, tasks_of(read, out), progress)
        if as_json:
            print_json(_plan_entries(read, progress, processes))
        else:
            print_all(_shown_plan(read, progress, processes))
        return
    make_directory(out)
    with alone(out) as scratch:
        place = local(processes, scratch) if scheduler is None else dask(scheduler)
        try:
            with progress_bar(1.0) as advance:
                solved_table(read, out, progress, place, advance)
        except (KeyboardInterrupt, SystemExit) as stop:
            stop.add_note(f"stopped: {progress.words}; the same command goes on")
            raise
    _show_outcome(read, progress, out, as_json)
    if progress.failures:
        raise typer.Exit(NOT_CONVERGED)


def _plan_entries(study: Study, progress: BatchProgress, processes: int) -> dict[str, Any]:
    return {
        **_entries(study, progress),
        "first_cases": [{"name": case.name, "varied": dict(case.varied)} for case in study.cases[:LISTED]],
        "cpu_s": progress.cpu_s,
        "wall_s": progress.wall_s(processes),
        "processes": processes,
    }


def _shown_plan(study: Study, progress: BatchProgress, processes: int) -> Iterator[Table | str]:
    table = Table(*study.keys, title=f"{escape(study.name)}: {len(study.cases)} cases")
    for case in study.cases[:LISTED]:
        table.add_row(*(escape(str(case.varied.get(key, "-"))) for key in study.keys))
    if len(study.cases) > LISTED:
        table.add_row(*("..." for _ in study.keys))
    yield table
    yield _state_table(progress)
    wall = _duration(progress.wall_s(processes))
    yield f"to come: {_duration(progress.cpu_s)} of CPU time, {wall} with {processes} processes"


def _show_outcome(study: Study, progress: BatchProgress, out: Path, as_json: bool) -> None:
    if as_json:
        failures = [
            {"case": job.path.parent.name, "setting": job.setting.name, **asdict(failure)}
            for job, failure in progress.failures
        ]
        tables = [str(out / name) for name in ("table.csv", "table.h5")]
        print_json({**_entries(study, progress), "failures": failures, "tables": tables})
    else:
        print_all((_state_table(progress), f"table: {out / 'table.csv'} (.h5); page: roughfilm report {out}"))
    if progress.warned:
        results = "1 result has" if progress.warned == 1 else f"{progress.warned} results have"
        messages.print(f"[yellow]warning:[/] {results} warnings; see the column warnings of the table", soft_wrap=True)
    for job, failure in progress.failures[:LISTED]:
        message = f"{job.path.parent.name} by {job.setting.name}: {failure.kind}: {failure.message}"
        messages.print(f"[yellow]failed:[/] {escape(message)}", soft_wrap=True)
    if len(progress.failures) > LISTED:
        messages.print(f"[yellow]failed:[/] {len(progress.failures) - LISTED} more; see the table", soft_wrap=True)


def _entries(study: Study, progress: BatchProgress) -> dict[str, Any]:
    counts = {name: {state.value: n for state, n in one.jobs.items()} for name, one in progress.accounts.items()}
    return {
        "study": study.name,
        "cases": len(study.cases),
        "jobs": counts,
        "provenance": {"code": code(), "commit": commit(), "versions": versions()},
    }


def _state_table(progress: BatchProgress) -> Table:
    states = [state for state in State if progress.total(state)]
    to_come = ["CPU to come"] if progress.total(State.TO_DO) else []
    rows = [
        [name, *(str(one.jobs[state]) for state in states), *([_duration(one.remaining)] if to_come else [])]
        for name, one in progress.accounts.items()
    ]
    table = table_of(["setting", *states, *to_come], rows, left=1)
    table.columns[0].no_wrap = True
    return table


def _duration(seconds: float) -> str:
    for unit, size in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
