"""The answers of the models of a scene's kind at their default resolutions, of bearings in the plane also at others."""

import hashlib
import json
import zlib
from functools import cache

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.interface.solving import solve
from roughfilm.ladder import models
from roughfilm.rom.advice.laws import table
from roughfilm.rom.ladder.kind import Scene, kind_of_scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import scene_entries
from scripts.studies.coverage.store import Answer

MAX_OUTSIDE_CPU_S = 60.0
"""Largest expected CPU time of a model that another program runs, s."""


@cache
def code_and_laws(kind: str) -> str:
    """Return a digest of the code of all models and of the error laws of a kind: equal digests give equal answers."""
    laws = table()
    own = [one for entries in (laws.steps, laws.promises, laws.grids) for one in entries if one.kind == kind]
    return hashlib.sha256(f"{code()} {own}".encode()).hexdigest()[:16]


def answers(scene: Scene, outside: bool = False) -> dict[str, Answer]:
    """Return the answers of every applicable model that runs in this process, by name; also of others if asked."""
    ladder = [
        model
        for model in models(scene.kind)
        if model.applies(scene).applies
        and (not model.outside or (outside and model.cost(scene, model.resolution_of(scene)) <= MAX_OUTSIDE_CPU_S))
    ]
    return {model.name: answer(model, scene) for model in ladder if model.available().available}


def answer(model: Model, scene: Scene) -> Answer:
    """Return the answer of one model to a scene."""
    try:
        found = solve(scene, model=model.name, resolution=judged_resolution(model, scene))
    except (ConvergenceError, InputError) as error:
        return Answer(failure=f"{type(error).__name__}: {error}")
    quantities = found.quantities
    return Answer(
        values={name: one.value for name, one in quantities.items()},
        uncertainty={name: one.uncertainty for name, one in quantities.items() if one.uncertainty is not None},
        expected_error=dict(found.expected_error),
        cpu_s=found.numerics.cpu_s,
        resolution=found.numerics.resolution,
        warnings=(*found.outside, *found.warnings),
    )


def judged_resolution(model: Model, scene: Scene) -> int:
    """Return the resolution at which a model is judged on a scene: the default, or a coarser one for some bearings.

    Of bearings with a width 15 of 16 are judged on a grid four or eight times coarser, whose truth takes less time; if
    the wall moves freely all are, one of 16 on a grid two times coarser, and one line on 256 cells.
    """
    default, moving = model.resolution_of(scene), kind_of_scene(scene).name_of_laws != scene.kind
    if scene.kind != "bearing" or model.name == "infinitely_wide" or getattr(scene, "wide", False):
        return default // 16 if moving and scene.kind == "bearing" else default
    lot = zlib.crc32(json.dumps(scene_entries(scene), sort_keys=True).encode()) % 16
    coarser = (2 if lot == 0 else 4 if lot < 8 else 8) if moving else (1 if lot == 0 else 4 if lot < 10 else 8)
    return max(default // coarser, model.offered(scene).least)
