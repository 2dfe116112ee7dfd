"""Averaged roughness whose lay is nearly along or across the sliding, in films whose walls move freely."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

JUDGED_GAP = 3.0
"""Mean gap over the rms height at which a lay is judged to be oblique."""

MAX_OBLIQUE = 0.1
"""Largest cross flow over the flow along or across the sliding there that is left out."""


@dataclass(frozen=True)
class StraightFactors:
    """Flow factors without the cross flow that an oblique lay, or chance in a small surface, gives."""

    factors: FactorsOverGap

    @property
    def origin(self) -> Mapping[str, Any]:
        """The entries for the provenance of a result; empty for factors without a table."""
        return getattr(self.factors, "origin", {})

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors, each of the shape of ``separation``."""
        own = self.factors(separation)
        zero = np.zeros_like(own.cross)
        return replace(own, cross=zero, drag_across=zero)


def oblique(own: GapFactors) -> Array:
    """The larger of |A₁₂|/√(A₁₁A₂₂) and |B₂|/B₁: the cross flow that pressure and sliding drive, over that along it."""
    along, drag = np.sqrt(own.along * own.across), own.drag
    by_pressure = np.divide(np.abs(own.cross), along, out=np.zeros_like(along), where=along > 0)
    by_sliding = np.divide(np.abs(own.drag_across), drag, out=np.zeros_like(drag), where=drag > 0)
    return np.asarray(np.maximum(by_pressure, by_sliding))


def straight(problem: Problem, rms: float) -> Problem:
    """The problem without the cross flow of its averaged roughness.

    Raises
    ------
    InputError
        If the lay is oblique: the cross flow at a mean gap of 3 rms heights, or at the smallest one whose flow factors
        are known if that is larger, is above ``MAX_OBLIQUE``.
    """
    factors = problem.shape.roughness
    assert factors is not None
    known = getattr(factors, "narrowest", 0.0)
    size = float(oblique(factors(np.array([max(JUDGED_GAP * rms, known)])))[0])
    if size > MAX_OBLIQUE:
        raise InputError(
            f"roughness: got an oblique lay, whose cross flow is {size:.2g} times the flow along it, for walls that "
            f"move freely; at most {MAX_OBLIQUE:g} is allowed, take roughness along or across the sliding"
        )
    return replace(problem, shape=replace(problem.shape, roughness=StraightFactors(factors)))


def lay_error(solution: Solution, *, even: bool) -> float:
    """The relative error of a film by the cross flow that was left out, from its mean weighted by the pressure.

    The load and the flow of a film that is symmetric about the middle of its width do not depend on the sign of the
    cross flow, so that their error is its square.
    """
    factors = solution.problem.shape.roughness
    if not isinstance(factors, StraightFactors):
        return 0.0
    weights = solution.grid.areas * np.maximum(solution.state.pressure, 0.0)
    own = oblique(factors.factors(solution.faces.thickness)) ** (2 if even else 1)
    return float((weights * own).sum() / (float(weights.sum()) or 1.0))
