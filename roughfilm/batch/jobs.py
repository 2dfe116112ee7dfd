"""Jobs: each solved once, its answer stored as soon as it is there, used again when nothing changed."""

import json
import traceback
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.markup import escape

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome, UnavailableError
from roughfilm.contact.foundation.files import replacing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import model_code, versions
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import as_bytes, load
from roughfilm.rom.studies.convergence import GRIDS
from roughfilm.terminal.console import messages, progress_bar

QUICK_S = 0.1
"""Models that cost less are timed as the fastest of ``REPEATS`` runs, so that start-up does not hide them."""

REPEATS = 7

Advance = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Job:
    """One scene in one setting, and the file of its result."""

    scene: Scene
    setting: Setting
    path: Path

    @property
    def failure_path(self) -> Path:
        """The file that says why there is no result."""
        return self.path.with_suffix(".failed.json")


@dataclass(frozen=True, kw_only=True)
class Failure:
    """Why a job has no result: the kind of error, what it said, and the last lines of the log or of the traceback.

    Of a solver that does not converge also what became of it, after how many iterations, and its CPU seconds.

    A solver that diverges, stalls or comes to no end has answered: it is asked again only when scene, code or versions
    change. Anything else (a worker that died, a full disk) says nothing of the scene, and the job is tried again the
    next time.
    """

    kind: str
    message: str
    notes: tuple[str, ...] = ()
    outcome: str = ""
    iterations: int | None = None
    cpu_s: float | None = None

    @property
    def is_answer(self) -> bool:
        """Whether asking again would give the same."""
        return self.kind == ConvergenceError.__name__ and self.outcome != Outcome.FAILED


def failure_of(error: Exception) -> Failure:
    """An error as a record; one that no model raises on purpose brings its traceback."""
    meant = isinstance(error, InputError | ConvergenceError | UnavailableError)
    return Failure(
        kind=type(error).__name__,
        message=" ".join(str(error).split()) or "no word",
        notes=tuple(getattr(error, "__notes__", ()) if meant else traceback.format_exception(error)),
        outcome=str(getattr(error, "outcome", "")),
        iterations=getattr(error, "iterations", None),
    )


def stored(job: Job, *, with_fields: bool = True) -> Result | Failure | None:
    """The answer on disk, if it was given for the same scene by the same code and versions."""
    if job.path.is_file():
        try:
            result = load(job.path, with_fields=with_fields)
            if _same(result, job):
                return result
        except InputError:
            pass  # an unreadable file is computed again and replaced
    try:
        record = json.loads(job.failure_path.read_text(encoding="utf-8"))
        failure = Failure(**{**record["failure"], "notes": tuple(record["failure"]["notes"])})
        return failure if failure.is_answer and record["identity"] == _identity(job) else None
    except (OSError, ValueError, LookupError, TypeError):
        return None


def store(job: Job, answer: bytes | Failure) -> None:
    """Write a result's file or a failure's record; InputError if it cannot be written."""
    if isinstance(answer, bytes):
        with replacing(job.path) as scratch:
            scratch.write_bytes(answer)
        job.failure_path.unlink(missing_ok=True)
        return
    with replacing(job.failure_path) as scratch:
        record = {"failure": asdict(answer), "identity": _identity(job)}
        scratch.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def _identity(job: Job) -> dict[str, Any]:
    return {
        "setting": job.setting.name,
        "scene": scene_entries(job.scene),
        "code": _code(job),
        "versions": versions(),
        "needs": job.setting.model.available().detail,
    }


def _code(job: Job) -> str:
    return model_code(job.scene.kind, job.setting.model.name)


def _same(result: Result, job: Job) -> bool:
    origin, setting = result.provenance, job.setting
    return (
        result.model == setting.model.name
        and setting.resolution in (None, result.numerics.resolution)
        and setting.scheme in (None, result.numerics.scheme)
        and (origin.get("scene"), origin.get("code")) == (scene_entries(job.scene), _code(job))
        and origin.get("versions") == versions()
        and origin.get("openfoam") in (None, setting.model.available().detail)
    )


def solved_once(job: Job, step: Advance) -> Result:
    """The stored answer if there is one; else a new one, stored; raises what the model raises."""
    answer = stored(job)
    if answer is None:
        repeats = REPEATS if job.setting.cost(job.scene) < QUICK_S else 1
        try:
            answer = min(
                (job.setting.solve(job.scene, step) for _ in range(repeats)), key=lambda one: one.numerics.cpu_s
            )
        except ConvergenceError as error:
            store(job, failure_of(error))
            raise
        store(job, as_bytes(answer))
    if isinstance(answer, Failure):
        raise ConvergenceError(answer.message)
    return answer


def jobs_of(scene: Scene, models: Sequence[Model], directory: Path, grids: int = GRIDS) -> list[Job]:
    """The default job of every model, then its other resolutions for the chart and the convergence.

    Beyond ``GRIDS``, a model of formal order gets more ``grids``, each twice as fine as the one before.
    """
    settings = []
    for model in models:
        default = model.resolution_of(scene)
        finer = [default * 2**k for k in range(1, grids - GRIDS + 1)] if model.order else []
        others = [n for n in (*model.resolutions_of(scene), *finer) if n != default]
        settings += [Setting(model=model, resolution=resolution) for resolution in (None, *others)]
    return [Job(scene=scene, setting=setting, path=directory / f"{setting.name}.h5") for setting in settings]


def run_all(jobs: Sequence[Job], failed: dict[str, str]) -> list[tuple[Job, Result]]:
    """Solve what is not solved already; a model that fails at its default resolution is put among the failed."""
    done: list[tuple[Job, Result]] = []
    costs = [job.setting.cost(job.scene) for job in jobs]
    with progress_bar(sum(costs)) as advance:
        for number, job in enumerate(jobs):
            try:
                done.append(
                    (job, solved_once(job, _within(advance, job.setting.name, sum(costs[:number]), costs[number])))
                )
            except ConvergenceError as error:
                if job.setting.resolution is None:
                    failed[job.setting.model.name] = str(error)
                else:
                    told = f"[yellow]grid left out:[/] {job.setting.name}: {escape(str(error))}"
                    messages.print(told, soft_wrap=True)
    return done


def _within(advance: Advance, name: str, spent: float, cost: float) -> Advance:
    def step(done: float, words: str) -> None:
        advance(spent + done * cost, f"{name}: {words}")

    step(0.0, "starting")
    return step
