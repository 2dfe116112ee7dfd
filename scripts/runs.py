"""Every run a comparison needs: each solved once, stored as soon as it is done, used again when nothing changed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.markup import escape

from contact.errors import ConvergenceError, InputError
from rom.convergence import GRIDS
from rom.ladder import Model
from rom.provenance import code, versions
from rom.result import Result
from rom.scene import Scene, scene_entries
from rom.store import load, save
from scripts.common import messages, progress_bar

QUICK_S = 0.1
"""Models that cost less are timed as the fastest of ``REPEATS`` runs, so that start-up does not hide them."""

REPEATS = 7

Advance = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Job:
    """One model at its default resolution (None) or at a given one for the chart, and the file of its result."""

    model: Model
    resolution: int | None
    path: Path

    def cost(self, scene: Scene) -> float:
        """Expected CPU seconds."""
        return self.model.cost(scene, self.resolution or self.model.resolution)

    def __str__(self) -> str:
        return f"{self.model.name} at {self.resolution or 'its default'}"


def jobs_of(models: Sequence[Model], directory: Path, grids: int = GRIDS) -> list[Job]:
    """The default job of every model, then its other resolutions for the chart and the convergence.

    Beyond ``GRIDS``, a model of formal order gets more ``grids``, each twice as fine as the one before.
    """
    jobs = []
    for model in models:
        jobs.append(Job(model=model, resolution=None, path=directory / f"{model.name}.h5"))
        finer = [model.resolution * 2**k for k in range(1, grids - GRIDS + 1)] if model.order else []
        jobs += [
            Job(model=model, resolution=n, path=directory / f"{model.name}-{n}.h5")
            for n in (*model.resolutions, *finer)
            if n != model.resolution
        ]
    return jobs


def run_all(scene: Scene, jobs: Sequence[Job], failed: dict[str, str]) -> list[tuple[Job, Result]]:
    """Solve what is not solved already; a model that fails at its default resolution is put among the failed."""
    done: list[tuple[Job, Result]] = []
    with progress_bar(sum(job.cost(scene) for job in jobs)) as advance:
        spent = 0.0
        for job in jobs:
            try:
                done.append((job, solved_once(scene, job, _within(advance, job, spent, scene))))
            except ConvergenceError as error:
                if job.resolution is None:
                    failed[job.model.name] = str(error)
                else:
                    messages.print(f"[yellow]grid left out:[/] {job}: {escape(str(error))}", soft_wrap=True)
            spent += job.cost(scene)
    return done


def _within(advance: Advance, job: Job, spent: float, scene: Scene) -> Advance:
    def step(done: float, words: str) -> None:
        advance(spent + done * job.cost(scene), f"{job}: {words}")

    step(0.0, "starting")
    return step


def solved_once(scene: Scene, job: Job, step: Advance) -> Result:
    """The stored result if it was computed from the same scene by the same code; else a new one, stored."""
    if job.path.is_file():
        try:
            stored = load(job.path)
            if _same(stored, scene, job):
                return stored
        except InputError:
            pass  # an unreadable file is computed again and replaced
    repeats = REPEATS if job.cost(scene) < QUICK_S else 1
    tries = [job.model.solve(scene, resolution=job.resolution, progress=step) for _ in range(repeats)]
    result = min(tries, key=lambda one: one.numerics.cpu_s)
    save(result, job.path)
    return result


def _same(stored: Result, scene: Scene, job: Job) -> bool:
    origin = stored.provenance
    return (
        stored.model == job.model.name
        and job.resolution in (None, stored.numerics.resolution)
        and (origin.get("scene"), origin.get("code")) == (scene_entries(scene), code())
        and origin.get("versions") == versions()
        and origin.get("openfoam") in (None, job.model.available().detail)
    )
