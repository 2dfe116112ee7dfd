"""The runs of models behind a map: each solved once, stored as it comes, and used again."""

from collections.abc import Sequence
from pathlib import Path

from contact.errors import InputError
from rom.result import Result
from scripts.common import messages, progress_bar
from scripts.executors import local
from scripts.runs import Failure, Job, store, stored
from scripts.sweep import Solved, expected_cost, run


def answers_to(jobs: Sequence[Job], processes: int, scratch: Path) -> dict[Path, Result | Failure]:
    """The answer of every job by its file, from disk or solved now, without fields; stopped, the next call goes on."""
    answers: dict[Path, Result | Failure] = {}
    for job in jobs:
        fits = job.setting.model.applies(job.scene)
        refused = Failure(kind=InputError.__name__, message=fits.reason)
        if found := stored(job, with_fields=False) if fits.applies else refused:
            answers[job.path] = found
    missing = [job for job in jobs if job.path not in answers]
    try:
        if missing:
            with progress_bar(sum(map(expected_cost, missing))) as advance, local(processes, scratch) as executor:
                advance(0.0, f"starting {len(missing)} runs")
                spent = 0.0
                for job, answer in run(missing, executor):
                    store(job, answer.file if isinstance(answer, Solved) else answer)
                    answers[job.path] = answer.result if isinstance(answer, Solved) else answer
                    spent += expected_cost(job)
                    advance(spent, f"{len(answers)} of {len(jobs)} runs")
    except (KeyboardInterrupt, SystemExit):
        messages.print(f"stopped at {len(answers)} of {len(jobs)} runs; the same command goes on", soft_wrap=True)
        raise
    return answers
