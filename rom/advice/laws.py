"""How far off a rung is, by the numbers of a scene: products of powers, fitted to sweeps, read from a table."""

import math
import tomllib
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any

Numbers = Mapping[str, float]
"""Dimensionless numbers by name."""

TABLE = "laws.toml"


@dataclass(frozen=True, kw_only=True)
class Law:
    """An error, over the size of the quantity, that 95 of 100 scenes of a sweep did not exceed: C Π number^power.

    Attributes
    ----------
    coefficient : C.
    powers : of the numbers.
    reach : the least and the greatest value of each in the sweep.
    scenes : how many were fitted to.
    spread : the factor between the bound and the middle of the errors.
    """

    coefficient: float
    powers: Mapping[str, float]
    reach: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scenes: int = 0
    spread: float = 1.0

    def knows(self, numbers: Numbers) -> bool:
        """Whether a scene has all the numbers that are asked for."""
        return self.powers.keys() <= numbers.keys()

    def error(self, numbers: Numbers, follows: Container[str] = ()) -> float:
        """What is to be expected at most; infinite where a number vanishes by which it divides, or is none.

        Beyond the sweep an error shrinks with the number that it ``follows`` alone, which takes the effect itself away;
        of the others a power says nothing there.
        """
        parts = []
        for name, power in self.powers.items():
            least, greatest = (0.0, math.inf) if name in follows else self.reach.get(name, (0.0, math.inf))
            number = max(numbers[name], least) if power > 0 else min(numbers[name], greatest)
            if numbers[name] < 0:
                return math.inf
            try:
                parts.append(number**power)
            except (ZeroDivisionError, OverflowError):
                return math.inf
        found = self.coefficient * math.prod(parts)
        return math.inf if math.isnan(found) else found

    def beyond(self, numbers: Numbers, follows: Container[str] = ()) -> str | None:
        """The number that lies where nothing was swept and errors may be larger; None if there is none.

        As effects vanish with a scene's numbers, that is above the sweep, and below it where the error grows there.
        """
        for name, power in self.powers.items():
            least, greatest = self.reach.get(name, (0.0, math.inf))
            above, below = numbers[name] > FARTHER * greatest, numbers[name] < least / FARTHER
            if (above and (power > 0 or name not in follows)) or (below and power < 0):
                return name
        return None


RESOLVING = ("resolution", "points_per_wave")
"""Numbers that a grid makes greater at will."""


def on_grid(numbers: Numbers, resolution: int) -> Numbers:
    """A scene's numbers with those of a grid: its resolution, and points per wave of a surface that has ``waves``."""
    told = {**numbers, "resolution": float(resolution)}
    if "waves" in numbers:
        told["points_per_wave"] = resolution / numbers["waves"] if numbers["waves"] > 0 else math.inf
    return told


FARTHER = 1.2
"""So far beyond the scenes of a sweep a law still counts."""


@dataclass(frozen=True, kw_only=True)
class Step:
    """From a rung to the next one that keeps more.

    Attributes
    ----------
    kind, model, towards : the kind of scene, the rung and the next one.
    adds : what that keeps and this one leaves out, in words.
    tells : the number that an engineer would look at.
    left_out : by quantity, the difference to the next rung.
    seen_from : the rung below, for rungs whose next one is dear.
    seen : by quantity, the difference to the next rung where that to the rung below is ``correction`` large.
    """

    kind: str
    model: str
    towards: str
    adds: str
    tells: str
    left_out: Mapping[str, Law]
    seen_from: str = ""
    seen: Mapping[str, Law] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Grid:
    """What the ``resolution`` of a rung is worth, by quantity."""

    kind: str
    model: str
    laws: Mapping[str, Law]


@dataclass(frozen=True, kw_only=True)
class Table:
    """The steps between rungs, the first of those from a rung whose next one applies being its own, and their grids."""

    steps: Sequence[Step]
    grids: Sequence[Grid]
    provenance: Mapping[str, Any]

    def step(self, kind: str, model: str, applying: Container[str]) -> Step | None:
        """That of a rung where these apply; None at the top, and for a rung that is not known."""
        own = (step for step in self.steps if (step.kind, step.model) == (kind, model) and step.towards in applying)
        return next(own, None)

    def grid(self, kind: str, model: str, quantity: str) -> Law | None:
        """What a rung's resolution is worth; None where it is not known."""
        own = (grid.laws.get(quantity) for grid in self.grids if (grid.kind, grid.model) == (kind, model))
        return next(own, None)


def _law(entries: Mapping[str, Any]) -> Law:
    return Law(**{**entries, "reach": {name: (least, most) for name, (least, most) in entries["reach"].items()}})


def _laws(entries: Mapping[str, Any]) -> dict[str, Law]:
    return {quantity: _law(law) for quantity, law in entries.items()}


def read_table(text: str) -> Table:
    """A table from its text."""
    entries = tomllib.loads(text)
    return Table(
        steps=tuple(
            Step(**{**step, "left_out": _laws(step.get("left_out", {})), "seen": _laws(step.get("seen", {}))})
            for step in entries["step"]
        ),
        grids=tuple(Grid(**{**grid, "laws": _laws(grid["laws"])}) for grid in entries["grid"]),
        provenance=entries["provenance"],
    )


@cache
def table() -> Table:
    """The table that comes with the project."""
    return read_table(files(__package__).joinpath(TABLE).read_text(encoding="utf-8"))
