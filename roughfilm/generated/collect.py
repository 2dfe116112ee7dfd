"""Collect the results of generated cases: whatever has finished, judged as the runs of this library are."""

import hashlib
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from roughfilm.batch.directory import CASES, put_scene
from roughfilm.batch.execute import Solved, Workers, run
from roughfilm.batch.jobs import Failure, Job, failure_of, store, stored
from roughfilm.batch.plan import TO_COME
from roughfilm.batch.progress import BatchProgress
from roughfilm.batch.tabulate import TableRow, columns, row_of, warned
from roughfilm.contact.foundation.errors import InputError, Outcome
from roughfilm.foamcases.openfoam.allrun import DIGESTS, FINISHED
from roughfilm.foamcases.openfoam.dialect import dialect_named
from roughfilm.foamcases.openfoam.kept import digests_at_end, exit_code, is_finished, runner, was_started
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.foamcases.openfoam.program import failure
from roughfilm.generated.edits import edits_of
from roughfilm.generated.manifest import MANIFEST, Generated, Manifest, digest, read_manifest
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import model_code, versions
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.store import as_bytes, load
from roughfilm.rom.studies.study import Case, Study
from roughfilm.rom.studies.table import write_csv, write_hdf5

COLLECTED = "collected"
"""Entry in the provenance of a collected result: the digest of what was read, and the edits of the case."""

NOT_STARTED = "was not started"
NOT_ENDED = "is running, or was interrupted"
NO_DIRECTORY = "its directory is missing"


@dataclass(kw_only=True)
class Collection:
    """What a collection found.

    Attributes
    ----------
    study : the study.
    progress : jobs by state, and those that failed.
    unfinished : case, setting and reason of each generated case that has not finished.
    edited : case, setting and edits of each case that has finished or failed and was edited.
    """

    study: Study
    progress: BatchProgress = field(default_factory=BatchProgress)
    unfinished: list[tuple[str, str, str]] = field(default_factory=list)
    edited: list[tuple[str, str, tuple[str, ...]]] = field(default_factory=list)


def collect(out: Path, place: AbstractContextManager[Workers | None], progress: Progress) -> Collection:
    """Collect the results of the generated cases in a directory, and write ``table.csv`` and ``table.h5``.

    A case that has finished is read and checked as the runs of this library are, and its result is stored where
    ``batch`` stores it. A case that runs or was not started is listed. The models of the study that do not run OpenFOAM
    are solved here. A further call reads what has changed since.

    Parameters
    ----------
    out : the directory of the manifest.
    place : context manager of the workers, or of None for this process, for models that do not run OpenFOAM.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If the directory holds no manifest of this version, or a file cannot be written.
    """
    manifest = read_manifest(out)
    study = manifest.study(out)
    found = Collection(study=study)
    generated = {(one.case, one.setting): one for one in manifest.generated}
    rows: dict[Path, TableRow] = {}
    tasks: dict[Path, tuple[Case, Job]] = {}
    missing: list[Job] = []
    jobs = [(case, setting) for case in study.cases for setting in study.settings]
    for number, (case, setting) in enumerate(jobs):
        progress(number / len(jobs), f"reading {number + 1} of {len(jobs)}")
        directory = out.resolve() / CASES / case.name if case.name else out.resolve()
        job = Job(scene=case.scene, setting=setting, path=directory / f"{setting.name}.h5")
        tasks[job.path] = (case, job)
        fits = setting.model.applies(case.scene)
        one = generated.get((case.name, setting.name))
        answer: Result | Failure | None
        if not fits.applies:
            answer = Failure(kind="left out", message=fits.reason)
            found.progress.leave_out(job)
        elif one is not None:
            answer = _collected(manifest, one, job, out, found)
        elif (answer := stored(job, with_fields=False)) is None:
            found.progress.expect(job)
            missing.append(job)
            continue
        else:
            found.progress.reuse(job, answer)
        rows[job.path] = row_of(study.keys, case, job, answer)
    if missing:
        progress(0.0, f"starting {len(missing)} jobs of models without OpenFOAM")
        with place as workers:
            for job, new in run(missing, workers):
                case, _ = tasks[job.path]
                put_scene(case, job.path.parent)
                store(job, new.file if isinstance(new, Solved) else new)
                answer = new.result if isinstance(new, Solved) else new
                rows[job.path] = row_of(study.keys, case, job, answer)
                found.progress.receive(job, answer)
    table = columns([rows[path] for path in tasks])
    found.progress.warned = warned(rows.values())
    write_csv(table, out / "table.csv")
    write_hdf5(table, out / "table.h5")
    return found


def _collected(manifest: Manifest, generated: Generated, job: Job, out: Path, found: Collection) -> Result | Failure:
    """The answer of a generated case, which is counted and stored; a failure that is not stored if it runs."""
    directory, progress = out / generated.directory, found.progress
    reason = _unfinished(directory)
    if not reason:
        before = _state(directory, generated)
        kept = _kept(job, before)
        if kept is not None and _is_current(kept, job):
            progress.reuse(job, kept)
            _note_edits(found, generated, kept.provenance[COLLECTED]["edits"])
            return kept
        edits: tuple[str, ...] = ()
        try:
            edits = _edits(manifest, generated, job, directory)
            answer: Result | Failure = _judged(manifest, generated, job, directory, before, edits)
        except Exception as error:  # a case in any state is a failure of this case alone
            failed = failure_of(error)
            message = "; ".join((failed.message, *_edited(edits)))
            answer = replace(failed, message=message, outcome=str(Outcome.FAILED))
        if before == _state(directory, generated):
            progress.expect(job)
            progress.receive(job, answer)
            if isinstance(answer, Failure) and kept is None:
                job.path.unlink(missing_ok=True)  # the result of another run of the case
            store(job, as_bytes(answer) if isinstance(answer, Result) else answer)
            _note_edits(found, generated, edits)
            return answer
        reason = NOT_ENDED
    progress.expect(job)
    found.unfinished.append((generated.case, generated.setting, reason))
    return Failure(kind=TO_COME, message=reason)


def _unfinished(directory: Path) -> str:
    """The reason for which a case has no result yet; "" if it has finished."""
    if not directory.is_dir():
        return NO_DIRECTORY
    if is_finished(directory):
        return ""
    if place := runner(directory):
        return f"is running on {place}, or was interrupted"
    return NOT_ENDED if was_started(directory) else NOT_STARTED


def _state(directory: Path, generated: Generated) -> str:
    """A digest of the written files as they are, of the logs, and of the end of a case; "" if it has not finished."""
    try:
        end = (directory / FINISHED).stat()
    except OSError:
        return ""
    known = hashlib.sha256(f"{end.st_size}".encode())
    logs = sorted(path.relative_to(directory).as_posix() for path in directory.glob("**/log.*"))
    for name in (*generated.files, *logs):
        known.update(f"{name} {digest(directory / name)}\n".encode())
    return known.hexdigest()


def _kept(job: Job, state: str) -> Result | None:
    """The stored result of a case, without its fields, if the case has not changed since."""
    if not job.path.is_file():
        return None
    try:
        result = load(job.path, with_fields=False)
    except InputError:
        return None
    return result if result.provenance.get(COLLECTED, {}).get("state") == state else None


def _is_current(result: Result, job: Job) -> bool:
    """Whether a result was read from its case by this version of the library."""
    same = {"versions": versions(), "code": model_code(job.scene.kind, job.setting.model.name)}
    return all(result.provenance.get(name) == value for name, value in same.items())


def _edits(manifest: Manifest, generated: Generated, job: Job, directory: Path) -> tuple[str, ...]:
    """The edits of a case in words."""
    model = job.setting.model
    assert isinstance(model, CaseModel)
    request = Request(
        resolution=job.setting.resolution,
        tolerance=manifest.tolerance,
        scheme=job.setting.scheme,
        processes=manifest.processes,
    )
    dialect = dialect_named(manifest.dialect)
    return edits_of(directory, generated, lambda place: model.write(job.scene, place, request, dialect=dialect))


def _edited(edits: Sequence[str]) -> list[str]:
    """The words that say what was edited in a case; empty without edits."""
    return [f"the case was edited: {'; '.join(edits)}"] if edits else []


def _judged(
    manifest: Manifest, generated: Generated, job: Job, directory: Path, state: str, edits: Sequence[str]
) -> Result:
    """The result of a case that has finished, with a warning for each way in which it is not what was generated.

    ConvergenceError if ``Allrun`` failed, or a file that it left is another one by now.
    """
    model = job.setting.model
    assert isinstance(model, CaseModel)
    result = model.read(job.scene, directory, model.kept_run(directory))
    if (code := exit_code(directory)) != "0":
        raise failure(f"Allrun ended with the exit code {code:.20}; see its logs, and run the case again", "")
    known = digests_at_end(directory)
    judged = {name: one for name, one in known.items() if name not in generated.files and _is_read(directory, name)}
    changed = [name for name, one in judged.items() if digest(directory / name) != one]
    if changed:
        more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
        raise failure(f"{changed[0]}{more} was changed after the run; run the case again", "")
    warnings = [*_edited(edits), *result.warnings]
    if not known:
        warnings.append(f"there is no {DIGESTS}, so whether the results are those of the run is not known")
    if not manifest.has_digest:
        warnings.append(
            f"{MANIFEST} has version {manifest.version}, without a digest, so whether it was edited is not known"
        )
    if manifest.settings[job.setting.name].code != result.provenance["code"]:
        warnings.append("the case was written by another version of roughfilm than the one that read its result")
    origin: Mapping[str, Any] = {**result.provenance, COLLECTED: {"state": state, "edits": list(edits)}}
    return replace(result, warnings=tuple(warnings), provenance=origin)


def _is_read(directory: Path, name: str) -> bool:
    """Whether a file of a run may be read: it is there, and belongs to the whole mesh.

    The reading of a result says itself which file it lacks. The parts of the processes are often removed.
    """
    return (directory / name).exists() and not any(part.startswith("processor") for part in Path(name).parts)


def _note_edits(found: Collection, generated: Generated, edits: Sequence[str]) -> None:
    if edits:
        found.edited.append((generated.case, generated.setting, tuple(edits)))
