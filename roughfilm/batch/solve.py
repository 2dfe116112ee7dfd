"""Solution of every case of a study by every model, and the table of all results."""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path

from roughfilm.batch.directory import CASES, places, put_scene
from roughfilm.batch.execute import Solved, Workers, run
from roughfilm.batch.jobs import Failure, Job, store, stored
from roughfilm.batch.plan import plan_of, write_plan
from roughfilm.batch.progress import BatchProgress
from roughfilm.batch.tabulate import TableRow, columns, row_of, warned
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.studies.study import Case, Study
from roughfilm.rom.studies.table import write_csv, write_hdf5

Tasks = Mapping[Path, tuple[Case, Job]]
"""The cases and jobs by the file of the result."""


def tasks_of(study: Study, out: Path) -> Tasks:
    """The jobs of a study, with the results of each case in its own directory below ``out``."""
    known, tasks = places(out), {}
    for case in study.cases:
        place = known.get(case.digest, out / CASES / case.name)
        for setting in study.settings:
            job = Job(scene=case.scene, setting=setting, path=place / f"{setting.name}.h5")
            tasks[job.path] = (case, job)
    return tasks


def finished(study: Study, tasks: Tasks, counts: BatchProgress) -> tuple[dict[Path, TableRow], list[Job]]:
    """The rows that need no solution, by file, and the jobs that need one; both are counted in ``counts``."""
    rows, missing = {}, []
    for path, (case, job) in tasks.items():
        fits = job.setting.model.applies(job.scene)
        answer = stored(job, with_fields=False) if fits.applies else Failure(kind="left out", message=fits.reason)
        if answer is None:
            counts.expect(job)
            missing.append(job)
            continue
        rows[path] = row_of(study.keys, case, job, answer)
        if fits.applies:
            counts.reuse(job, answer)
        else:
            counts.leave_out(job)
    return rows, missing


def solved_table(
    study: Study, out: Path, counts: BatchProgress, place: AbstractContextManager[Workers | None], progress: Progress
) -> None:
    """Solve the missing jobs of a study, store each answer immediately, and write ``table.csv`` and ``table.h5``.

    Before the first job is solved, the plan of the batch is written to ``study.json``.

    Parameters
    ----------
    study : the study.
    out : directory of the results and tables.
    counts : progress of the batch, which is updated.
    place : context manager of the workers, of None for this process; it is entered only if jobs are missing.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a file cannot be written; stored answers are kept, and the same call continues with the missing ones.
    UnavailableError
        If the scheduler of the workers stops, or all workers are gone.
    """
    tasks = tasks_of(study, out)
    write_plan(plan_of(study, {case.digest: path.parent.name for path, (case, _) in tasks.items()}), out)
    progress(0.0, "looking for finished results")
    rows, missing = finished(study, tasks, counts)
    if missing:
        progress(0.0, f"starting {len(missing)} jobs")
        with place as workers:
            for job, answer in run(missing, workers):
                case, _ = tasks[job.path]
                put_scene(case, job.path.parent)
                store(job, answer.file if isinstance(answer, Solved) else answer)
                result = answer.result if isinstance(answer, Solved) else answer
                rows[job.path] = row_of(study.keys, case, job, result)
                counts.receive(job, result)
                progress(counts.done, counts.words)
    table = columns([rows[path] for path in tasks])
    counts.warned = warned(rows.values())
    write_csv(table, out / "table.csv")
    write_hdf5(table, out / "table.h5")
