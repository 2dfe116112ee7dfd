"""Error laws of the models: products of powers of dimensionless numbers, fitted to sweeps and read from a table."""

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
    """The law C Π number^power of an error over the quantity's size that 95 of 100 scenes of a sweep did not exceed.

    Attributes
    ----------
    coefficient : C.
    powers : power of each number.
    reach : smallest and largest value of each number in the sweep.
    scenes : number of scenes in the fit.
    spread : ratio of the bound to the median error.
    """

    coefficient: float
    powers: Mapping[str, float]
    reach: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scenes: int = 0
    spread: float = 1.0

    def knows(self, numbers: Numbers) -> bool:
        """Whether a scene has all numbers of the law."""
        return self.powers.keys() <= numbers.keys()

    def error(self, numbers: Numbers, follows: Container[str] = ()) -> float:
        """The largest expected error over the size of the quantity; infinite for a number that is negative or NaN.

        Below the range of the sweep the error decreases only with the numbers in ``follows``, which measure the effect
        itself; for other numbers the smallest value of the sweep is used. A division by 0 gives infinity.
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
        error = self.coefficient * math.prod(parts)
        return math.inf if math.isnan(error) else error

    def beyond(self, numbers: Numbers, follows: Container[str] = ()) -> str | None:
        """The name of a number outside the range of the sweep on a side where the error may be larger, or None.

        Effects vanish as the numbers of a scene go to 0, so that this side is above the range, and below it if the
        power is negative.
        """
        for name, power in self.powers.items():
            least, greatest = self.reach.get(name, (0.0, math.inf))
            above, below = numbers[name] > RANGE_FACTOR * greatest, numbers[name] < least / RANGE_FACTOR
            if (above and (power > 0 or name not in follows)) or (below and power < 0):
                return name
        return None


RESOLVING = ("resolution", "points_per_wave")
"""Names of the numbers that depend on the grid."""


def on_grid(numbers: Numbers, resolution: int) -> Numbers:
    """The numbers of a scene with the resolution, and the points per wave if the numbers contain ``waves``."""
    extended = {**numbers, "resolution": float(resolution)}
    if "waves" in numbers:
        extended["points_per_wave"] = resolution / numbers["waves"] if numbers["waves"] > 0 else math.inf
    return extended


RANGE_FACTOR = 1.2
"""Factor by which a number may lie outside the range of a sweep."""


@dataclass(frozen=True, kw_only=True)
class Step:
    """The step from a model to the next one, which includes more effects.

    Attributes
    ----------
    kind, model, towards : the kind of scene, the model and the next one.
    adds : the effect that the next one adds, in words.
    tells : the number that measures the effect.
    left_out : by quantity, the law of the difference from the next model.
    seen_from : a simpler model, used if the next model is expensive.
    seen : by quantity, the law of the difference from the next model as a function of the difference from the simpler
        model, ``correction``.
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
    """The laws, by quantity, of the error by the resolution of a model."""

    kind: str
    model: str
    laws: Mapping[str, Law]


@dataclass(frozen=True, kw_only=True)
class Table:
    """The steps between models and the laws of their grids; a model takes its first step whose next model applies."""

    steps: Sequence[Step]
    grids: Sequence[Grid]
    provenance: Mapping[str, Any]

    def step(self, kind: str, model: str, applying: Container[str]) -> Step | None:
        """The step of a model to the next one in ``applying``; None for the most complete and for an unknown model."""
        own = (step for step in self.steps if (step.kind, step.model) == (kind, model) and step.towards in applying)
        return next(own, None)

    def grid(self, kind: str, model: str, quantity: str) -> Law | None:
        """The law of the error by the resolution of a model; None if it is unknown."""
        own = (grid.laws.get(quantity) for grid in self.grids if (grid.kind, grid.model) == (kind, model))
        return next(own, None)


def _law(entries: Mapping[str, Any]) -> Law:
    return Law(**{**entries, "reach": {name: (least, most) for name, (least, most) in entries["reach"].items()}})


def _laws(entries: Mapping[str, Any]) -> dict[str, Law]:
    return {quantity: _law(law) for quantity, law in entries.items()}


def read_table(text: str) -> Table:
    """Read the table of laws from TOML text."""
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
    """The table of laws that is part of this package."""
    return read_table(files(__package__).joinpath(TABLE).read_text(encoding="utf-8"))
