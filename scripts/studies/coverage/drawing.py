"""Random scenes by kind and seed: to some of them the laws of the project are fitted, the others judge it."""

import importlib
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import read_scene

FIRST_SEED = {"fit": 10_000, "check": 20_000}
"""First seed of the scenes to which laws may be fitted, and of those that only judge; 10 000 seeds each."""


def part_of(seed: int) -> str:
    """Return whether a seed belongs to the scenes to fit or to check."""
    return next(part for part, first in FIRST_SEED.items() if first <= seed < first + 10_000)


def seeds(count: int) -> list[int]:
    """Return so many seeds, in turn to fit and to check."""
    return [first + number // 2 for number, first in zip(range(count), list(FIRST_SEED.values()) * count, strict=False)]


def drawn(kind: str, seed: int) -> Scene:
    """Return the scene of a kind and a seed, named by both: the first valid one that ``scenes/<kind>.py`` draws."""
    module: Any = importlib.import_module(f"scripts.studies.coverage.scenes.{kind}")
    rng = np.random.default_rng([seed, *kind.encode()])
    while True:
        try:
            return read_scene({"name": f"{kind} {seed}", "kind": kind, **module.draw(rng)})
        except InputError:  # grooves that overlap, an arc steeper than a half circle
            continue
