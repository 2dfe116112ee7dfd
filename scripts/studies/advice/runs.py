"""Answers of every model to random scenes at every resolution, solved once, in parallel, and stored in a table."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from roughfilm.batch.answers import answers_to
from roughfilm.batch.jobs import Failure, Job
from roughfilm.contact.foundation.files import replacing
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import Scene, kind_of
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.rough_gap.scene import RoughGap
from scripts.studies.advice.scenes import random_scene

PARTS: Mapping[str, Mapping[str, range]] = {
    "fit": {
        "pocket": range(3000, 3080),
        "rough_gap": range(3000, 3036),
        "bearing": range(3000, 3120),
        "dry_contact": range(3000, 3070),
        "seal": range(3000, 3070),
    },
    "check": {
        "pocket": range(7000, 7070),
        "rough_gap": range(7000, 7040),
        "bearing": range(7000, 7080),
        "dry_contact": range(7000, 7050),
        "seal": range(7000, 7050),
    },
}
"""Seeds of the scenes to which laws are fitted, and of those on which the advice is tested."""

MESHED = (16, 32, 48)
"""Mesh columns for random gaps; the last is the number of their points and finer than the default."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """Answer of one model at one resolution with its uncertainty and CPU seconds, or the reason of its failure."""

    model: str
    resolution: int
    values: Mapping[str, float] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    cpu_s: float = 0.0
    failure: str = ""


@dataclass(frozen=True, kw_only=True)
class DrawnScene:
    """A random scene and its runs."""

    kind: str
    seed: int
    runs: tuple[Run, ...]


def settings_of(scene: Scene, part: str) -> list[Setting]:
    """Return every available model at every resolution; of OpenFOAM models the check takes only the best."""
    applicable = [model for model in models(scene.kind) if model.applies(scene).applies and model.available().available]
    return [
        Setting(model=model, resolution=resolution)
        for model in applicable
        if part == "fit" or not model.outside or model is best(applicable)
        for resolution in (MESHED if _is_random_gap(scene) and model.outside else model.resolutions_of(scene))
    ]


def _is_random_gap(scene: Scene) -> bool:
    return isinstance(scene, RoughGap) and scene.surface().shape == (MESHED[-1], MESHED[-1])


def run_of(job: Job, answer: Result | Failure) -> Run:
    """Return the row of the table for one job."""
    asked = job.setting
    assert asked.resolution is not None
    if isinstance(answer, Failure):
        return Run(model=asked.model.name, resolution=asked.resolution, failure=f"{answer.kind}: {answer.message}")
    kind = kind_of(answer)
    return Run(
        model=answer.model,
        resolution=asked.resolution,
        values={name: quantity.value for name, quantity in answer.quantities.items()},
        uncertainty={
            name: bar
            for name in kind.compared
            if name in answer.quantities and (bar := answer[name].uncertainty) is not None
        },
        cpu_s=answer.numerics.cpu_s,
    )


def draw(part: str, kind: str, out: Path, processes: int, scratch: Path) -> tuple[DrawnScene, ...]:
    """Solve what is missing and write the table ``out``/part-kind.json."""
    scenes = {seed: random_scene(kind, seed) for seed in PARTS[part][kind]}
    jobs = {
        seed: [
            Job(scene=scene, setting=one, path=out / "found" / part / kind / str(seed) / f"{one.name}.h5")
            for one in settings_of(scene, part)
        ]
        for seed, scene in scenes.items()
    }
    answers = answers_to([job for own in jobs.values() for job in own], processes, scratch)
    drawn = tuple(
        DrawnScene(kind=kind, seed=seed, runs=tuple(run_of(job, answers[job.path]) for job in own))
        for seed, own in jobs.items()
    )
    entries = {"part": part, "kind": kind, "scenes": [asdict(one) for one in drawn], "provenance": circumstances()}
    with replacing(out / f"{part}-{kind}.json") as file:
        file.write_text(json.dumps(entries) + "\n", encoding="utf-8")
    return drawn


def read(part: str, kind: str, out: Path) -> tuple[Sequence[DrawnScene], Mapping[str, Any]]:
    """Return the table that :func:`draw` wrote, and its provenance."""
    entries = json.loads((out / f"{part}-{kind}.json").read_text(encoding="utf-8"))
    scenes = [
        DrawnScene(kind=one["kind"], seed=one["seed"], runs=tuple(Run(**run) for run in one["runs"]))
        for one in entries["scenes"]
    ]
    return scenes, entries["provenance"]
