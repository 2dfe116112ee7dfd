"""What every answer must keep, whatever model gave it: each kind of scene has laws that no model may break."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from roughfilm.rom.ladder.result import Result
from roughfilm.stability.checks.film_invariants import bearing, pocket
from roughfilm.stability.checks.roughness_invariants import dry_contact, rough_gap, seal

Law = Callable[[Any, Result], Iterator[str]]
"""law(scene, result): what is broken, each in words."""

LAWS: Mapping[str, Law] = {
    "pocket": pocket,
    "bearing": bearing,
    "dry_contact": dry_contact,
    "seal": seal,
    "rough_gap": rough_gap,
}


RECOMPUTED = 2.0
"""A residual that is found afresh, in fields read back from files, may be so many tolerances."""


def broken(scene: Any, result: Result) -> list[str]:
    """What an answer breaks, in words; nothing of a good one."""
    faults = [*_not_finite(result), *_not_solved(result)]
    return faults if faults or _out_of_range(result) else list(LAWS[scene.kind](scene, result))


def _out_of_range(result: Result) -> bool:
    """Whether an estimate says of itself that it is none."""
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
    told = [(one.uncertainty or 0.0) / abs(one.value) for one in result.quantities.values() if one.value]
    allowed = RECOMPUTED * max([numerics.tolerance, *told])
    if not (numerics.residual <= allowed or result.warnings):
        yield f"the residual is {numerics.residual:.2g}, above {allowed:.2g}, and neither warning nor error bar says so"
    if min(numerics.cpu_s, numerics.wall_s, numerics.iterations) < 0 or numerics.degrees_of_freedom < 1:
        yield f"counts that cannot be: {numerics}"
