"""Runs of models for a study: each solved once, in parallel, and stored when it is done."""

import hashlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from rich.markup import escape

from roughfilm.batch.directory import alone
from roughfilm.batch.execute import Solved, Workers, run
from roughfilm.batch.executors import local
from roughfilm.batch.jobs import Failure, Job, store, stored
from roughfilm.ladder import find
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.ladder.setting import Setting
from roughfilm.terminal.console import messages, progress_bar

FOUND = "found"
"""Name of the folder of stored results beside the page."""


@dataclass(frozen=True, kw_only=True)
class ModelRun:
    """A run: a scene, a model, and its resolution."""

    scene: Scene
    model: str
    resolution: int

    @property
    def key(self) -> str:
        """The name of the stored result, which is equal for equal runs."""
        digest = hashlib.sha256(json.dumps(scene_entries(self.scene), sort_keys=True).encode()).hexdigest()
        return f"{digest[:16]}-{self.model}-{self.resolution}"


Answers = Mapping[str, Result]
"""Results without fields by :attr:`ModelRun.key`; failed runs are left out."""

Place = Callable[[int, Path], AbstractContextManager[Workers]]


def answers(asked: Sequence[ModelRun], folder: Path, place: Place = local) -> tuple[Answers, dict[str, str]]:
    """Return stored results, solve the missing ones, and return the reason of each failure, both by key.

    A model that is not available on this machine fails for every run.
    """
    failed: dict[str, str] = {}
    found: dict[str, Result] = {}
    missing: dict[Path, tuple[str, Job]] = {}
    for one in {each.key: each for each in asked}.values():
        model = find(one.scene.kind, one.model)
        available = model.available()
        if not available.available:
            failed[one.key] = available.detail
            continue
        setting = Setting(model=model, resolution=one.resolution)
        job = Job(scene=one.scene, setting=setting, path=folder / f"{one.key}.h5")
        answer = stored(job, with_fields=False)
        if isinstance(answer, Result):
            found[one.key] = answer
        elif isinstance(answer, Failure):
            failed[one.key] = answer.message
        else:
            missing[job.path] = (one.key, job)
    if missing:
        _solve(missing, folder, place, found, failed)
    return found, failed


def _solve(
    missing: Mapping[Path, tuple[str, Job]],
    folder: Path,
    place: Place,
    found: dict[str, Result],
    failed: dict[str, str],
) -> None:
    costs = {path: job.setting.cost(job.scene) for path, (_, job) in missing.items()}
    done = 0.0
    processes = len(os.sched_getaffinity(0))
    try:
        with alone(folder) as scratch, progress_bar(sum(costs.values())) as bar:
            bar(0.0, f"starting {len(missing)} runs")
            with place(processes, scratch) as executor:
                for number, (job, answer) in enumerate(run([job for _, job in missing.values()], executor), 1):
                    key, _ = missing[job.path]
                    store(job, answer.file if isinstance(answer, Solved) else answer)
                    if isinstance(answer, Solved):
                        found[key] = answer.result
                    else:
                        failed[key] = answer.message
                        note = f"[yellow]left out:[/] {job.setting.name}: {escape(answer.message)}"
                        messages.print(note, soft_wrap=True)
                    done += costs[job.path]
                    bar(done, f"{number} of {len(missing)} runs")
    except (KeyboardInterrupt, SystemExit) as stop:
        stop.add_note("stopped; the same command goes on")
        raise
