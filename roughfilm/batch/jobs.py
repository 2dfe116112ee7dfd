"""Jobs, which are solved once, stored immediately, and used again while scene, code and versions stay the same."""

import traceback
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any

from rich.markup import escape

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome, UnavailableError
from roughfilm.contact.foundation.files import replacing, write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import model_code, versions
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import STORED, as_bytes, load
from roughfilm.rom.studies.convergence import GRIDS
from roughfilm.terminal.console import messages, progress_bar

QUICK_S = 0.1
"""CPU time, s, of a model below which its time is the shortest of ``REPEATS`` runs, without the start-up."""

REPEATS = 7

MAX_RECORD_BYTES = 10_000_000
"""Largest size of the record of a failure that is read, bytes."""

NEEDED = ("machine", "load_average", "sources")
"""Entries of the provenance of a stored result without which it is computed again."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """A scene with a setting (model, resolution and scheme) and the file of the result, ``path``."""

    scene: Scene
    setting: Setting
    path: Path

    @property
    def failure_path(self) -> Path:
        """The file with the reason if there is no result."""
        return self.path.with_suffix(".failed.json")


@dataclass(frozen=True, kw_only=True)
class Failure:
    """The reason why a job has no result.

    A solver that diverges, stalls or runs out of iterations is an answer: the job runs again only if scene, code or
    versions change. Any other failure (a worker that died, a full disk) does not depend on the scene: the job runs
    again the next time.

    Attributes
    ----------
    kind : name of the error class.
    message : message of the error.
    notes : the last lines of the log or of the traceback.
    outcome : way in which a solver failed to converge; empty for other errors.
    iterations : number of iterations done; None if unknown.
    cpu_s : CPU time, s; None if unknown.
    """

    kind: str
    message: str
    notes: tuple[str, ...] = ()
    outcome: str = ""
    iterations: int | None = None
    cpu_s: float | None = None

    @property
    def is_answer(self) -> bool:
        """Whether another run would end in the same way."""
        return self.kind == ConvergenceError.__name__ and self.outcome != Outcome.FAILED


@dataclass(frozen=True, kw_only=True)
class Identity:
    """All that determines the answer to a job: its setting and scene, and the code, versions and programs."""

    setting: str
    scene: Mapping[str, Any]
    code: str
    versions: Mapping[str, Any]
    needs: str


@dataclass(frozen=True, kw_only=True)
class FailureRecord:
    """The content of the file of a failure."""

    failure: Failure
    identity: Identity


def failure_of(error: Exception) -> Failure:
    """The record of an error; for an error of another package its notes are the traceback."""
    meant = isinstance(error, InputError | ConvergenceError | UnavailableError)
    return Failure(
        kind=type(error).__name__,
        message=" ".join(str(error).split()) or "no word",
        notes=tuple(getattr(error, "__notes__", ()) if meant else traceback.format_exception(error)),
        outcome=str(getattr(error, "outcome", "")),
        iterations=getattr(error, "iterations", None),
    )


def stored(job: Job, *, with_fields: bool = True) -> Result | Failure | None:
    """The stored answer to a job; None if there is none for the same scene, code and versions."""
    if job.path.is_file():
        try:
            result = load(job.path, with_fields=with_fields)
            if _same(result, job):
                return result
        except InputError:
            pass  # an unreadable file is computed again and replaced
    try:
        record = read_failure(job.failure_path)
    except InputError:
        return None
    return record.failure if record.failure.is_answer and asdict(record.identity) == _identity(job) else None


def read_failure(path: Path) -> FailureRecord:
    """The record of a failure; InputError if there is none, or it is damaged."""
    try:
        return from_json(read_bytes(path, MAX_RECORD_BYTES, "start the batch again"), FailureRecord)
    except ValueError as error:
        raise InputError(f"{path}: is not the record of a failure; start the batch again") from error


def store(job: Job, answer: bytes | Failure) -> None:
    """Write the bytes of a result or the record of a failure to its file; InputError if it cannot be written."""
    if isinstance(answer, bytes):
        with replacing(job.path, STORED) as scratch:
            scratch.write_bytes(answer)
        job.failure_path.unlink(missing_ok=True)
        return
    write_json({"failure": asdict(answer), "identity": _identity(job)}, job.failure_path)


def _identity(job: Job) -> dict[str, Any]:
    return {
        "setting": job.setting.name,
        "scene": scene_entries(job.scene),
        "code": model_code(job.scene.kind, job.setting.model.name),
        "versions": versions(),
        "needs": job.setting.model.available().detail,
    }


def _same(result: Result, job: Job) -> bool:
    origin, setting, identity = result.provenance, job.setting, _identity(job)
    return (
        result.model == setting.model.name
        and setting.resolution in (None, result.numerics.resolution)
        and setting.scheme in (None, result.numerics.scheme)
        and all(origin.get(name) == identity[name] for name in ("scene", "code", "versions"))
        and all(name in origin for name in NEEDED)
        and ("collected" in origin or origin.get("openfoam") in (None, identity["needs"]))
    )


def solved_once(job: Job, step: Progress) -> Result:
    """The stored result of a job, or a new one, which is stored; raises the errors of the model."""
    answer = stored(job)
    if answer is None:
        repeats = REPEATS if job.setting.cost(job.scene) < QUICK_S else 1
        try:
            answer = _fastest([job.setting.solve(job.scene, step) for _ in range(repeats)])
        except ConvergenceError as error:
            store(job, failure_of(error))
            raise
        store(job, as_bytes(answer))
    if isinstance(answer, Failure):
        raise ConvergenceError(answer.message)
    return answer


def _fastest(results: Sequence[Result]) -> Result:
    """The result of the shortest run, with the one-time costs of all runs."""
    fastest = min(results, key=lambda one: one.numerics.cpu_s)
    costs = [one.numerics.one_time for one in results]
    one_time = {name: sum(cost.get(name, 0.0) for cost in costs) for name in dict.fromkeys(chain(*costs))}
    return replace(fastest, numerics=replace(fastest.numerics, one_time=one_time))


def jobs_of(scene: Scene, models: Sequence[Model], directory: Path, grids: int = GRIDS) -> list[Job]:
    """The jobs of every model at its default resolution and at others, for the chart and the convergence study.

    If ``grids`` exceeds ``GRIDS``, a model with an order of convergence gets additional grids, each with twice as many
    cells along a direction as the one before.
    """
    settings = []
    for model in models:
        default = model.resolution_of(scene)
        finer = [default * 2**k for k in range(1, grids - GRIDS + 1)] if model.order_of(scene) else []
        others = [n for n in (*model.resolutions_of(scene), *finer) if n != default]
        settings += [Setting(model=model, resolution=resolution) for resolution in (None, *others)]
    return [Job(scene=scene, setting=setting, path=directory / f"{setting.name}.h5") for setting in settings]


def run_all(jobs: Sequence[Job], failed: dict[str, str]) -> list[tuple[Job, Result]]:
    """The jobs that have a result, with the result; jobs without a stored result are solved.

    The message of a model that fails at its default resolution is added to ``failed``. Another grid on which it fails,
    or on which the scene leaves its range, is left out.
    """
    done: list[tuple[Job, Result]] = []
    costs = [job.setting.cost(job.scene) for job in jobs]
    with progress_bar(sum(costs)) as advance:
        for number, job in enumerate(jobs):
            try:
                done.append(
                    (job, solved_once(job, _within(advance, job.setting.name, sum(costs[:number]), costs[number])))
                )
            except (ConvergenceError, InputError) as error:
                if isinstance(error.__cause__, OSError):  # a full disk ends the others in the same way
                    raise
                if job.setting.resolution is None:
                    failed[job.setting.model.name] = str(error)
                else:
                    reason = f"[yellow]grid left out:[/] {job.setting.name}: {escape(str(error))}"
                    messages.print(reason, soft_wrap=True)
    return done


def _within(advance: Progress, name: str, spent: float, cost: float) -> Progress:
    def step(done: float, words: str) -> None:
        advance(spent + done * cost, f"{name}: {words}")

    step(0.0, "starting")
    return step
