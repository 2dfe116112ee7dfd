"""Answers to many jobs: each is computed once, stored immediately and used again."""

from collections.abc import Sequence
from pathlib import Path

from roughfilm.batch.execute import Solved, expected_cost, run
from roughfilm.batch.executors import local
from roughfilm.batch.jobs import Failure, Job, store, stored
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.result import Result
from roughfilm.terminal.console import progress_bar


def answers_to(jobs: Sequence[Job], processes: int, scratch: Path) -> dict[Path, Result | Failure]:
    """The answer to every job by the path of its result, without fields.

    Answers that are stored are read, the others are computed and stored. A call after an interruption computes only
    what is missing.

    Parameters
    ----------
    jobs : the jobs.
    processes : number of processes that solve jobs.
    scratch : directory for temporary files.
    """
    answers: dict[Path, Result | Failure] = {}
    for job in jobs:
        fits = job.setting.model.applies(job.scene)
        refused = Failure(kind=InputError.__name__, message=fits.reason)
        if answer := stored(job, with_fields=False) if fits.applies else refused:
            answers[job.path] = answer
    missing = [job for job in jobs if job.path not in answers]
    try:
        if missing:
            with progress_bar(sum(map(expected_cost, missing))) as advance, local(processes, scratch) as executor:
                advance(0.0, f"starting {len(missing)} runs")
                spent = 0.0
                for job, new in run(missing, executor):
                    store(job, new.file if isinstance(new, Solved) else new)
                    answers[job.path] = new.result if isinstance(new, Solved) else new
                    spent += expected_cost(job)
                    advance(spent, f"{len(answers)} of {len(jobs)} runs")
    except (KeyboardInterrupt, SystemExit) as stop:
        stop.add_note(f"stopped at {len(answers)} of {len(jobs)} runs; the same command goes on")
        raise
    return answers
