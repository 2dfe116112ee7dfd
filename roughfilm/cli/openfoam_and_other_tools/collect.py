"""roughfilm collect: the results and the table of the OpenFOAM cases that 'generate' wrote."""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from roughfilm.batch.directory import alone
from roughfilm.batch.executors import local
from roughfilm.batch.progress import State
from roughfilm.batch.shown import job_counts, print_failures, print_listed, print_warned, state_table
from roughfilm.contact.foundation.errors import InputError
from roughfilm.generated.collect import collect
from roughfilm.generated.manifest import read_manifest
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import NOT_CONVERGED, AsJson, Jobs, print_json, process_count, progress_bar
from roughfilm.terminal.results import print_all, written

EXAMPLES = ("roughfilm collect sweep",)


def command(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", help="The directory that 'generate' wrote; its cases may still run.")
    ],
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Read the generated OpenFOAM cases that have finished, and write the results and tables of 'batch'."""
    if not directory.is_dir():
        raise InputError(f"{directory}: is not a directory; name one that 'roughfilm generate' wrote")
    read_manifest(directory)
    with alone(directory) as scratch, progress_bar(1.0) as advance:
        found = collect(directory, local(process_count(jobs), scratch), advance)
    progress = found.progress
    unfinished = [f"{_name(case, setting)}: {reason}" for case, setting, reason in found.unfinished]
    edited = [f"{_name(case, setting)}: {'; '.join(edits)}" for case, setting, edits in found.edited]
    tables = [directory / name for name in ("table.csv", "table.h5")]
    if as_json:
        print_json(
            {
                "study": found.study.name,
                "cases": len(found.study.cases),
                "jobs": job_counts(progress),
                "failures": [
                    {"case": job.path.parent.name, "setting": job.setting.name, **asdict(failure)}
                    for job, failure in progress.failures
                ],
                "unfinished": [dict(zip(("case", "setting", "reason"), one, strict=True)) for one in found.unfinished],
                "edited": [dict(zip(("case", "setting", "edits"), one, strict=True)) for one in found.edited],
                "tables": [str(table) for table in tables],
                "provenance": circumstances(),
            }
        )
    else:
        print_all([state_table(progress)])
    print_listed("edited", edited, "see the column warnings of the table")
    print_warned(progress)
    print_listed("not finished", unfinished, "see the column outcome of the table")
    print_failures(progress)
    if not as_json:
        solved = progress.total(State.FINISHED, State.SOLVED)
        cases = "1 case has" if len(unfinished) == 1 else f"{len(unfinished)} cases have"
        lacking = f", {cases} not finished" if unfinished else ""
        failed = f", {len(progress.failures)} failed" if progress.failures else ""
        print_all([written(f"{solved} results{lacking}{failed}", *tables)])
    if progress.failures:
        raise typer.Exit(NOT_CONVERGED)


def _name(case: str, setting: str) -> str:
    return f"{case} by {setting}" if case else setting
