"""Values of the models of a kind at all their resolutions, over the scenes to which laws are fitted."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from scripts.studies.coverage import store
from scripts.studies.coverage.drawing import drawn

FINEST_FACTOR = 3
"""Ratio of the resolution whose values stand for the truth of a model in this process to the finest of its series."""


@dataclass(frozen=True, kw_only=True)
class Refinement:
    """The values of a model by resolution and quantity; a resolution at which it failed has none."""

    kind: str
    seed: int
    model: str
    values: Mapping[int, Mapping[str, float]]


def path_of(out: Path, kind: str) -> Path:
    """Return the file of the refinements of a kind."""
    return out / f"resolutions_{kind}.jsonl"


def read(out: Path, kind: str) -> dict[tuple[int, str], Refinement]:
    """Return the refinements of a kind by seed and model: the runs behind the truths of its scenes, and the others."""
    judged = store.read(store.path_of(out, kind)).values()
    found = {
        (one.seed, one.by): Refinement(kind=kind, seed=one.seed, model=one.by, values=one.runs)
        for one in judged
        if one.runs
    }
    for entries in store.lines(path_of(out, kind)):
        values = {int(resolution): quantities for resolution, quantities in entries["values"].items()}
        found[entries["seed"], entries["model"]] = Refinement(**{**entries, "values": values})
    return found


def resolutions_of(model: Model, scene: Scene) -> tuple[int, ...]:
    """Return the series of a model; with a finer one if it converges with an order and runs in this process.

    The series of a model on the points of a surface ends with all of them.
    """
    series = model.resolutions_of(scene)
    return series if model.outside or model.order_of(scene) is None else (*series, FINEST_FACTOR * max(series))


def refine(kind: str, names: Sequence[str], seeds: Sequence[int], out: Path, advance: Callable[[str], None]) -> None:
    """Solve what the files lack of these models, and append it."""
    path = path_of(out, kind)
    known = read(out, kind)
    for seed in seeds:
        scene = drawn(kind, seed)
        for model in (find(scene.kind, name) for name in names):
            advance(f"{kind} {seed}, {model.name}")
            if (seed, model.name) in known or not (model.available().available and model.applies(scene).applies):
                continue
            values = {resolution: _values(model, scene, resolution) for resolution in resolutions_of(model, scene)}
            with path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(Refinement(kind=kind, seed=seed, model=model.name, values=values))) + "\n")


def _values(model: Model, scene: Scene, resolution: int) -> dict[str, float]:
    try:
        result = model.solve(scene, Request(resolution=resolution))
    except (ConvergenceError, InputError):
        return {}
    return {name: quantity.value for name, quantity in result.quantities.items()}
