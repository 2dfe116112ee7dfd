"""roughfilm batch: every case of a study by every model, in parallel; a stopped batch continues where it was."""

from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.batch.cluster import Cluster, dask
from roughfilm.batch.directory import alone
from roughfilm.batch.executors import local
from roughfilm.batch.plan import PLAN
from roughfilm.batch.progress import BatchProgress, State
from roughfilm.batch.shown import LISTED, duration, job_counts, print_failures, print_warned, state_table
from roughfilm.batch.solve import finished, solved_table, tasks_of
from roughfilm.contact.foundation.writing.kinds import entries_from
from roughfilm.ladder import models
from roughfilm.rom.ladder.provenance import code, commit, versions
from roughfilm.rom.studies.study import Study, load_study
from roughfilm.rom.studies.table import TABLE, table_beginning
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    Jobs,
    OutDirectory,
    make_directory,
    print_json,
    print_message,
    process_count,
    progress_bar,
)
from roughfilm.terminal.machines import WAIT, Keys, OnMachines, Scheduler, Wait, Where, waiting_time
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, table_of, written

EXAMPLES = (
    "roughfilm batch scripts/examples/studies/pocket.toml --out sweep --dry-run",
    "roughfilm batch scripts/examples/studies/pocket.toml --out sweep",
)


def command(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="The study file (TOML): a scene with lists.")],
    out: OutDirectory,
    jobs: Jobs = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show the jobs and their cost; solve nothing.")] = False,
    executor: OnMachines = Where.LOCAL,
    scheduler: Scheduler = None,
    tls: Keys = None,
    wait: Wait = WAIT,
    as_json: AsJson = False,
) -> None:
    """Solve every case of a study by every model and write table.csv and table.h5."""
    processes = process_count(jobs)
    limit = waiting_time(executor, scheduler, tls, wait)
    with nullcontext() if scheduler is None else dask(scheduler, wait=limit, tls=tls) as cluster:
        read = load_study(study, models if cluster is None else cluster.models)
        if cluster is not None:
            _say_lacking(cluster)
        progress = BatchProgress()
        if dry_run:
            finished(read, tasks_of(read, out), progress)
            _show_plan(read, progress, processes if cluster is None else max(cluster.count(), 1), as_json)
            return
        make_directory(out)
        refuse_unwritable(
            (out / "table.csv", table_beginning("case")), (out / "table.h5", TABLE), (out / PLAN, entries_from("name"))
        )
        with alone(out) as scratch:
            place = local(processes, scratch) if cluster is None else nullcontext(cluster)
            try:
                with progress_bar(1.0) as advance:
                    solved_table(read, out, progress, place, advance)
            except (KeyboardInterrupt, SystemExit) as stop:
                stop.add_note(f"stopped: {progress.words}; the same command goes on")
                raise
    _show_outcome(read, progress, out, as_json)
    if progress.failures:
        raise typer.Exit(NOT_CONVERGED)


def _say_lacking(cluster: Cluster) -> None:
    """Say in one line which models are left out because no worker can run them."""
    if cluster.lacking:
        by_reason: dict[str, list[str]] = {}
        for name, reason in cluster.lacking.items():
            by_reason.setdefault(reason, []).append(name)
        print_message("left out", "; ".join(f"{', '.join(names)}: {reason}" for reason, names in by_reason.items()))


def _show_plan(study: Study, progress: BatchProgress, processes: int, as_json: bool) -> None:
    if as_json:
        print_json(_plan_entries(study, progress, processes))
    else:
        print_all(_shown_plan(study, progress, processes))


def _plan_entries(study: Study, progress: BatchProgress, processes: int) -> dict[str, Any]:
    return {
        **_entries(study, progress),
        "first_cases": [{"name": case.name, "varied": dict(case.varied)} for case in study.cases[:LISTED]],
        "cpu_s": progress.cpu_s,
        "wall_s": progress.wall_s(processes),
        "processes": processes,
    }


def _shown_plan(study: Study, progress: BatchProgress, processes: int) -> Iterator[Table | str]:
    rows = [
        [str(number), *(str(case.varied.get(key, "-")) for key in study.keys)]
        for number, case in enumerate(study.cases[:LISTED], start=1)
    ]
    if len(study.cases) > LISTED:
        rows.append(["...", *("" for _ in study.keys)])
    yield table_of(("case", *study.keys), rows, title=f"{study.name}: {len(study.cases)} cases", left=1)
    yield state_table(progress)
    wall = duration(progress.wall_s(processes))
    yield f"to come: {duration(progress.cpu_s)} of CPU time, {wall} with {processes} processes"


def _show_outcome(study: Study, progress: BatchProgress, out: Path, as_json: bool) -> None:
    if as_json:
        failures = [
            {"case": job.path.parent.name, "setting": job.setting.name, **asdict(failure)}
            for job, failure in progress.failures
        ]
        tables = [str(out / name) for name in ("table.csv", "table.h5")]
        print_json({**_entries(study, progress), "failures": failures, "tables": tables})
    else:
        print_all([state_table(progress)])
    print_warned(progress)
    print_failures(progress)
    if not as_json:
        failed = f", {len(progress.failures)} jobs failed" if progress.failures else ""
        solved = sum(progress.total(state) for state in (State.FINISHED, State.SOLVED))
        answer = f"{solved} results by {len(progress.accounts)} models and resolutions{failed}"
        print_all([f"{written(answer, out / 'table.csv', out / 'table.h5')}; 'roughfilm report {out}' draws them"])


def _entries(study: Study, progress: BatchProgress) -> dict[str, Any]:
    return {
        "study": study.name,
        "cases": len(study.cases),
        "jobs": job_counts(progress),
        "provenance": {"code": code(), "commit": commit(), "versions": versions()},
    }
