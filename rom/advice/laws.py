"""Error laws of the models: sums of powers of dimensionless numbers, fitted to random scenes and read from a table."""

import math
import tomllib
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from typing import Any

from roughfilm.contact.foundation.timing import one_time

Numbers = Mapping[str, float]
"""Dimensionless numbers by name."""

TABLE = "laws.toml"


@dataclass(frozen=True, kw_only=True)
class Term:
    """The product C Π number^power of dimensionless numbers.

    Attributes
    ----------
    coefficient : C, above 0.
    powers : power of each number.
    """

    coefficient: float
    powers: Mapping[str, float] = field(default_factory=dict)

    def value(self, numbers: Numbers) -> float:
        """The product; infinite for a negative number, for one that is NaN, or if it overflows."""
        if any(numbers[name] < 0 for name in self.powers):
            return math.inf
        try:
            product: float = math.prod(
                (self.coefficient, *(numbers[name] ** power for name, power in self.powers.items()))
            )
        except (ZeroDivisionError, OverflowError):
            return math.inf
        return math.inf if math.isnan(product) else product


@dataclass(frozen=True, kw_only=True)
class Law:
    """The law Σ C Π number^power of an error over the quantity's size that 95 of 100 random scenes did not exceed.

    Attributes
    ----------
    terms : the terms of the sum, one for each cause of the error.
    reach : smallest and largest value of each number in the scenes of the fit.
    scenes : number of scenes in the fit.
    spread : ratio of the bound to the median error.
    within : names of further numbers that a scene must have; as of all in ``reach``, the law is not known above them.
    """

    terms: Sequence[Term]
    reach: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scenes: int = 0
    spread: float = 1.0
    within: Sequence[str] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the numbers in the terms."""
        return tuple(dict.fromkeys(name for term in self.terms for name in term.powers))

    def has_numbers(self, numbers: Numbers) -> bool:
        """Whether a scene has all numbers of the law."""
        return {*self.names, *self.within} <= numbers.keys()

    def error(self, numbers: Numbers, follows: Container[str] = ()) -> float:
        """The largest expected error over the size of the quantity; infinite for a number that is negative or NaN.

        Outside the range of the fit on the side of smaller errors, the value at the end of the range is used, except
        for the numbers in ``follows``, which measure the effect itself. A division by 0 gives infinity.
        """

        def inside(term: Term) -> Numbers:
            numbers_inside = {}
            for name, power in term.powers.items():
                least, greatest = (0.0, math.inf) if name in follows else self.reach.get(name, (0.0, math.inf))
                number = numbers[name]
                bounded = max(number, least) if power > 0 else min(number, greatest)
                numbers_inside[name] = number if number < 0 or math.isnan(number) else bounded
            return numbers_inside

        return math.fsum(term.value(inside(term)) for term in self.terms)

    def beyond(self, numbers: Numbers, follows: Container[str] = ()) -> str | None:
        """The name of a number outside the range of the fit on a side where the error may be larger, or None.

        Effects vanish as the numbers of a scene go to 0, so that this side is above the range, and below it if a
        power is negative. A number of the fit in no term showed no effect within the range; above it none is known.
        """
        for name in (one for one in dict.fromkeys((*self.names, *self.within, *self.reach)) if one in numbers):
            powers = [term.powers[name] for term in self.terms if name in term.powers] or [1.0]
            least, greatest = self.reach.get(name, (0.0, math.inf))
            above, below = numbers[name] > RANGE_FACTOR * greatest, numbers[name] < least / RANGE_FACTOR
            if (above and (max(powers) > 0 or name not in follows)) or (below and min(powers) < 0):
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
    measure : the number that measures the effect.
    left_out : by quantity, the law of the difference from the next model.
    """

    kind: str
    model: str
    towards: str
    adds: str
    measure: str
    left_out: Mapping[str, Law] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Promise:
    """The laws, by quantity, of the whole error of a model at a fine resolution, compared with independent solutions.

    A promise replaces the sum of the laws of all steps from the model to ``towards``, whose equations the independent
    solutions solve; an empty name stands for the most complete model.
    """

    kind: str
    model: str
    laws: Mapping[str, Law]
    towards: str = ""


@dataclass(frozen=True, kw_only=True)
class Grid:
    """The laws, by quantity, of the error by the resolution of a model."""

    kind: str
    model: str
    laws: Mapping[str, Law]


@dataclass(frozen=True, kw_only=True)
class Table:
    """The steps between models, their promises and the laws of their grids.

    A model takes its first step whose next model applies.
    """

    steps: Sequence[Step]
    grids: Sequence[Grid]
    provenance: Mapping[str, Any]
    promises: Sequence[Promise] = ()

    def step(self, kind: str, model: str, applying: Container[str]) -> Step | None:
        """The step of a model to the next one in ``applying``; None for the most complete and for an unknown model."""
        own = (step for step in self.steps if (step.kind, step.model) == (kind, model) and step.towards in applying)
        return next(own, None)

    def promise(self, kind: str, model: str) -> Promise:
        """The laws of the whole error of a model, which are empty if it has none."""
        own = (one for one in self.promises if (one.kind, one.model) == (kind, model))
        return next(own, Promise(kind=kind, model=model, laws={}))

    def grid(self, kind: str, model: str, quantity: str) -> Law | None:
        """The law of the error by the resolution of a model; None if it is unknown."""
        own = (one.laws.get(quantity) for one in self.grids if (one.kind, one.model) == (kind, model))
        return next(own, None)


def lawful(base: Table, kinds: Container[str], *, holds: bool) -> Table:
    """The table, without the laws of some kinds where they do not hold: of scenes whose film is sought under a load."""
    if holds:
        return base
    return replace(
        base,
        steps=tuple(replace(step, left_out={}) if step.kind in kinds else step for step in base.steps),
        grids=tuple(grid for grid in base.grids if grid.kind not in kinds),
        promises=tuple(promise for promise in base.promises if promise.kind not in kinds),
    )


def _law(entries: Mapping[str, Any]) -> Law:
    return Law(
        terms=tuple(Term(**term) for term in entries["terms"]),
        reach={name: (least, most) for name, (least, most) in entries["reach"].items()},
        scenes=entries.get("scenes", 0),
        spread=entries.get("spread", 1.0),
        within=tuple(entries.get("within", ())),
    )


def _laws(entries: Mapping[str, Any]) -> dict[str, Law]:
    return {quantity: _law(law) for quantity, law in entries.items()}


def read_table(text: str) -> Table:
    """Read the table of laws from TOML text."""
    entries = tomllib.loads(text)
    return Table(
        steps=tuple(Step(**{**step, "left_out": _laws(step.get("left_out", {}))}) for step in entries["step"]),
        promises=tuple(Promise(**{**one, "laws": _laws(one["laws"])}) for one in entries.get("promise", ())),
        grids=tuple(Grid(**{**grid, "laws": _laws(grid["laws"])}) for grid in entries["grid"]),
        provenance=entries["provenance"],
    )


@cache
@one_time("start")
def table() -> Table:
    """The table of laws that is part of this package."""
    return read_table(files(__package__).joinpath(TABLE).read_text(encoding="utf-8"))
