"""Conductance, drag and friction of the faces between neighbouring nodes of a gap."""

from dataclasses import dataclass
from enum import StrEnum
from math import log

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import allocating, compiled, inlined

CLOSED_CUBE = 1e-14
"""Nodes whose h³ is below this fraction of the largest are contact: round-off exceeds their flow."""

SERIES_BEND = 1e-4
"""Relative difference of two gaps below which ln(h₂/h₁) is computed by its series."""


class FaceRule(StrEnum):
    """Interpolation of the gap between two nodes."""

    LINEAR = "linear"
    """Linear: <h⁻³>⁻¹ = 2h₁²h₂²/(h₁+h₂)."""
    HARMONIC = "harmonic"
    """Constant on each half: exact to all orders for a smooth gap that varies along the flow alone."""


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Means over the faces between a node and the next one in x (``east``) or y (``north``), periodic.

    Attributes
    ----------
    east, north : conductance <h⁻³>⁻¹, shape (nx, ny); 0 where the gap is closed at either node.
    drag : <h⁻²>/<h⁻³> in x, shape (nx, ny): the uniform gap with the same Couette flow.
    inverse : mean of <h⁻¹> over all faces in x, closed ones as 0.
    inside : mean of <h⁻¹> − <h⁻²>²/<h⁻³> over the same faces: the contribution to e from inside the faces.
    """

    east: Array
    north: Array
    drag: Array
    inverse: float
    inside: float


def without_traces(gap: Array) -> Array:
    """The gap with h = 0 wherever h³ is below ``CLOSED_CUBE`` of the largest."""
    return np.where(gap > CLOSED_CUBE ** (1 / 3) * gap.max(), gap, 0.0)


def faces(gap: Array, rule: FaceRule = FaceRule.LINEAR) -> Faces:
    """Faces of a gap h >= 0, shape (nx, ny), in any unit; their means are in powers of that unit.

    The means are second-order accurate where h is smooth; a node where h = 0 closes its four faces.
    """
    east, north, drag = (np.empty(gap.shape) for _ in range(3))
    inverse, inside = _set_faces(np.ascontiguousarray(gap), rule is FaceRule.LINEAR, east, north, drag)
    return Faces(east=east, north=north, drag=drag, inverse=inverse / gap.size, inside=inside / gap.size)


@inlined
def _conductance(first, second, straight):  # type: ignore[no-untyped-def]
    """<h⁻³>⁻¹ between two nodes."""
    if first == 0.0 or second == 0.0:
        return 0.0
    if straight:
        product = first * second
        return 2 * product * product / (first + second)
    one, two = first * first * first, second * second * second
    return 2 * one * two / (one + two)


@inlined
def _inside(first, second):  # type: ignore[no-untyped-def]
    """<h⁻¹> − <h⁻²>²/<h⁻³> of a straight gap: ln(h₂/h₁)/(h₂ − h₁) − 2/(h₁ + h₂)."""
    bend = (second - first) / (first + second)
    if abs(bend) < SERIES_BEND:
        return 2 / (first + second) * bend * bend / 3
    return log(second / first) / (second - first) - 2 / (first + second)


@allocating
def straight_inverse(gap):  # type: ignore[no-untyped-def]
    """<h⁻¹> of straight lines from each node of h > 0, shape (nx, ny), to the next in x, periodic; 0 if closed."""
    count, length = gap.shape
    inverse = np.zeros((count, length))
    for i in range(count):
        own, after = gap[i], gap[i + 1 if i + 1 < count else 0]
        for j in range(length):
            if own[j] > 0 and after[j] > 0:
                inverse[i, j] = 2 / (own[j] + after[j]) + _inside(own[j], after[j])
    return inverse


@compiled
def _set_faces(gap, straight, east, north, drag):  # type: ignore[no-untyped-def]
    """Compute the arrays of :class:`Faces` in place; return its two sums."""
    count, length = gap.shape
    all_inverse = all_inside = 0.0
    for i in range(count):
        own, after = gap[i], gap[i + 1 if i + 1 < count else 0]
        for j in range(length):
            h, ahead = own[j], after[j]
            north[i, j] = _conductance(h, own[j + 1 if j + 1 < length else 0], straight)
            conductance = _conductance(h, ahead, straight)
            east[i, j] = conductance
            if conductance == 0.0:
                drag[i, j] = 0.0
                continue
            if straight:
                square = 2 * h * ahead / (h + ahead)
                inside = _inside(h, ahead)
                inverse = 2 / (h + ahead) + inside
            else:
                one, two = 1 / h, 1 / ahead
                squares = (one * one + two * two) / 2
                square = squares * conductance
                inverse = (one + two) / 2
                inside = inverse - squares * square
            drag[i, j] = square
            all_inverse += inverse
            all_inside += inside
    return all_inverse, all_inside
