"""The steps between models whose laws are fitted, read from steps.toml: what each adds, and what orders its error."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, kw_only=True)
class PlannedStep:
    """A step without its laws; names as in :class:`roughfilm.rom.advice.laws.Step`.

    ``features`` order what the model leaves out, ``seen`` what is left beside the size of the step before.
    """

    kind: str
    model: str
    towards: str
    adds: str
    tells: str
    features: tuple[str, ...]
    seen_from: str = ""
    seen: tuple[str, ...] = ()


_TABLE = tomllib.loads(Path(__file__).with_name("steps.toml").read_text(encoding="utf-8"))

STEPS: tuple[PlannedStep, ...] = tuple(
    PlannedStep(**{**step, "features": tuple(step["features"]), "seen": tuple(step.get("seen", ()))})
    for step in _TABLE["step"]
)
KINDS = tuple(dict.fromkeys(step.kind for step in STEPS))

GRIDS: Mapping[tuple[str, str], tuple[str, ...]] = {
    (grid["kind"], grid.get("model", "")): tuple(grid["features"]) for grid in _TABLE["grid"]
}
"""Names of the numbers on which the error of a resolution depends, by kind and model; "" is for all other models."""
