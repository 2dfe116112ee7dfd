"""The jobs of a batch on the terminal: their states by setting, and those that failed."""

from collections.abc import Mapping, Sequence

from rich.table import Table

from roughfilm.batch.progress import BatchProgress, State
from roughfilm.terminal.console import print_message
from roughfilm.terminal.results import table_of

LISTED = 5
"""Jobs of one kind that are listed; the others are counted."""

UNITS = (("d", 86400), ("h", 3600), ("min", 60))


def state_table(progress: BatchProgress) -> Table:
    """The number of jobs by setting and state, and the expected CPU time of those to come."""
    states = [state for state in State if progress.total(state)]
    to_come = ["CPU to come"] if progress.total(State.TO_DO) else []
    rows = [
        [name, *(str(one.jobs[state]) for state in states), *([duration(one.remaining)] if to_come else [])]
        for name, one in progress.accounts.items()
    ]
    return table_of(["setting", *states, *to_come], rows, left=1)


def job_counts(progress: BatchProgress) -> dict[str, Mapping[str, int]]:
    """The number of jobs by setting and state, for JSON."""
    return {name: {state.value: n for state, n in one.jobs.items()} for name, one in progress.accounts.items()}


def print_warned(progress: BatchProgress) -> None:
    """Print how many results have warnings."""
    if progress.warned:
        results = "1 result has" if progress.warned == 1 else f"{progress.warned} results have"
        print_message("warning", f"{results} warnings; see the column warnings of the table")


def print_failures(progress: BatchProgress) -> None:
    """Print the jobs that failed, with the reasons."""
    lines = [
        f"{job.path.parent.name} by {job.setting.name}: {failure.kind}: {failure.message}"
        for job, failure in progress.failures
    ]
    print_listed("failed", lines, "see the table")


def print_listed(head: str, lines: Sequence[str], remedy: str) -> None:
    """Print the first ``LISTED`` lines on standard error, each behind the head, and how many there are beyond."""
    for line in lines[:LISTED]:
        print_message(head, line)
    if len(lines) > LISTED:
        print_message(head, f"{len(lines) - LISTED} more; {remedy}")


def duration(seconds: float) -> str:
    """A time in the largest unit of which it has two at least.

    >>> duration(7300)
    '2 h'
    """
    for unit, size in UNITS:
        if seconds >= 2 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
