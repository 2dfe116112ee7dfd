"""How far off a rung is, by the numbers of a scene: products of powers, fitted to sweeps, read from a table."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any

Numbers = Mapping[str, float]
"""Dimensionless numbers by name."""

CERTAINTY = 0.95
"""The part of the scenes that were fitted to whose errors a law bounds."""

TABLE = "laws.toml"


@dataclass(frozen=True, kw_only=True)
class Law:
    """An error, over the size of the quantity, that 95 of 100 scenes of a sweep did not exceed: C Π number^power.

    Attributes
    ----------
    coefficient : C.
    powers : of the numbers.
    reach : the least and the greatest value of each in the sweep, and of the product, under ``""``.
    scenes : how many were fitted to.
    spread : the factor between the bound and the middle of the errors.
    """

    coefficient: float
    powers: Mapping[str, float]
    reach: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scenes: int = 0
    spread: float = 1.0

    def error(self, numbers: Numbers) -> float:
        """What is to be expected at most; infinite where a number vanishes by which it divides."""
        try:
            parts: list[float] = [numbers[name] ** power for name, power in self.powers.items()]
        except ZeroDivisionError:
            return math.inf
        return self.coefficient * math.prod(parts)

    def beyond(self, numbers: Numbers) -> str | None:
        """The number that lies where errors grow beyond those of the sweep; None if there is none."""
        for name, power in self.powers.items():
            least, greatest = self.reach.get(name, (0.0, math.inf))
            if (power > 0 and numbers[name] > FARTHER * greatest) or (power < 0 and numbers[name] < least / FARTHER):
                return name
        return None


FARTHER = 1.2
"""So far beyond the scenes of a sweep a law still counts."""


@dataclass(frozen=True, kw_only=True)
class Step:
    """From a rung to the next cheap one that keeps more.

    Attributes
    ----------
    towards : the rungs that are next, the first of them that applies to a scene.
    adds : what they keep that this one leaves out, in words.
    tells : the number that an engineer would look at.
    left_out : by quantity, the difference to the next rung.
    grid : by quantity, what the resolution is worth; a law of ``resolution`` too.
    seen : by quantity, the error that is left where the step from the rung before, ``seen_from``, is ``correction``
        large: for rungs whose next one is dear.
    """

    towards: tuple[str, ...] = ()
    adds: str = ""
    tells: str = ""
    left_out: Mapping[str, Law] = field(default_factory=dict)
    grid: Mapping[str, Law] = field(default_factory=dict)
    seen: Mapping[str, Law] = field(default_factory=dict)
    seen_from: str = ""


@dataclass(frozen=True, kw_only=True)
class Table:
    """The steps of every kind of scene, by rung, and where their laws come from."""

    steps: Mapping[str, Mapping[str, Step]]
    provenance: Mapping[str, Any]

    def step(self, kind: str, model: str) -> Step:
        """That of a rung; an empty one for a rung that the table does not know."""
        return self.steps.get(kind, {}).get(model, Step())


def _laws(entries: Mapping[str, Any]) -> dict[str, Law]:
    return {
        quantity: Law(**{**law, "reach": {name: (least, most) for name, (least, most) in law["reach"].items()}})
        for quantity, law in entries.items()
    }


def _step(entries: Mapping[str, Any]) -> Step:
    laws = {name: _laws(entries.get(name, {})) for name in ("left_out", "grid", "seen")}
    return Step(
        towards=tuple(entries.get("towards", ())),
        adds=entries.get("adds", ""),
        tells=entries.get("tells", ""),
        seen_from=entries.get("seen_from", ""),
        left_out=laws["left_out"],
        grid=laws["grid"],
        seen=laws["seen"],
    )


def read_table(text: str) -> Table:
    """A table from its text."""
    entries = tomllib.loads(text)
    provenance = entries.pop("provenance")
    steps = {kind: {model: _step(step) for model, step in rungs.items()} for kind, rungs in entries.items()}
    return Table(steps=steps, provenance=provenance)


@cache
def table() -> Table:
    """The table that comes with the project."""
    return read_table(files(__package__).joinpath(TABLE).read_text(encoding="utf-8"))
