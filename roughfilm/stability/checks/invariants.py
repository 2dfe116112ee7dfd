"""Physical laws that the results of every model must satisfy; each kind of scene has its own laws."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from roughfilm.rom.ladder.result import Result
from roughfilm.stability.checks.film_invariants import bearing, pocket
from roughfilm.stability.checks.roughness_invariants import dry_contact, rough_gap, seal

Law = Callable[[Any, Result], Iterator[str]]
"""Type of a function law(scene, result) that yields every violation in words."""

LAWS: Mapping[str, Law] = {
    "pocket": pocket,
    "bearing": bearing,
    "dry_contact": dry_contact,
    "seal": seal,
    "rough_gap": rough_gap,
}
"""The laws by kind of scene."""

MAX_RESIDUAL_RATIO = 2.0
"""Largest residual over the tolerance; a residual recomputed from stored fields may exceed the tolerance."""


def broken(scene: Any, result: Result) -> list[str]:
    """The violations of a result in words; empty if there are none.

    The laws of the kind are checked only if the result is finite, solved, and without a warning about its range.
    """
    faults = [*_not_finite(result), *_not_solved(result)]
    return faults if faults or _out_of_range(result) else list(LAWS[scene.kind](scene, result))


def _out_of_range(result: Result) -> bool:
    """Whether an estimate warns that it is out of its range."""
    return any(warning.startswith("out of its range") for warning in result.warnings)


def _not_finite(result: Result) -> Iterator[str]:
    for name, quantity in result.quantities.items():
        if not np.isfinite(quantity.value):
            yield f"{name} is {quantity.value}"
        if quantity.uncertainty is not None and not 0 <= quantity.uncertainty < np.inf:
            yield f"the uncertainty of {name} is {quantity.uncertainty}"
    for name, field in result.fields.items():
        if not (np.isfinite(field.values).all() and field.values.size):
            yield f"the field {name} is empty or not finite"


def _not_solved(result: Result) -> Iterator[str]:
    numerics = result.numerics
    uncertainties = [(one.uncertainty or 0.0) / abs(one.value) for one in result.quantities.values() if one.value]
    allowed = MAX_RESIDUAL_RATIO * max([numerics.tolerance, *uncertainties])
    if not (numerics.residual <= allowed or result.warnings):
        yield f"the residual is {numerics.residual:.2g}, above {allowed:.2g}, without a warning"
    if min(numerics.cpu_s, numerics.wall_s, numerics.iterations) < 0 or numerics.degrees_of_freedom < 1:
        yield f"impossible counts: {numerics}"
