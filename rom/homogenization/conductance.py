"""What the faces between neighbouring nodes of a gap let through, drag along and rub."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rom.gap import Array

CLOSED = 1e-14
"""Of the largest h³: a node with less is contact, as rounding on coarse grids would hide what it lets through."""


class FaceRule(StrEnum):
    """How the gap runs between two nodes."""

    LINEAR = "linear"
    """Straight: <h⁻³>⁻¹ = 2h₁²h₂²/(h₁+h₂)."""
    HARMONIC = "harmonic"
    """As if each half had its node's gap: exact to all orders in a smooth gap that varies along the flow alone."""


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Means over faces, shape (nx, ny), between a node and the next one in x (``east``) or y (``north``), periodic.

    Attributes
    ----------
    east, north : conductance <h⁻³>⁻¹; 0 where the gap is closed at either node.
    drag : <h⁻²>/<h⁻³> in x, which carries as much of the sliding wall's flow as the gap does.
    inverse : <h⁻¹> in x; 0 at closed faces.
    """

    east: Array
    north: Array
    drag: Array
    inverse: Array


def without_traces(gap: Array) -> Array:
    """The gap with h = 0 wherever h³ is below ``CLOSED`` of the largest."""
    return np.where(gap > CLOSED ** (1 / 3) * gap.max(), gap, 0.0)


def faces(gap: Array, rule: FaceRule = FaceRule.LINEAR) -> Faces:
    """Faces of a gap h >= 0, shape (nx, ny), in any unit; their means are in powers of that unit.

    Second order in the spacing where h is smooth; a node where h = 0 closes its four faces.
    """
    means = _linear if rule is FaceRule.LINEAR else _harmonic
    east, drag, inverse = means(gap, np.roll(gap, -1, axis=0))
    north = means(gap, np.roll(gap, -1, axis=1))[0]
    shut = ~(east > 0)
    for part in (east, drag, inverse):
        part[shut] = 0.0
    north[~(north > 0)] = 0.0
    return Faces(east=east, north=north, drag=drag, inverse=inverse)


def _linear(first: Array, second: Array) -> tuple[Array, Array, Array]:
    """<h⁻³>⁻¹, <h⁻²>/<h⁻³> and <h⁻¹> of a straight gap."""
    total, product = first + second, first * second
    with np.errstate(divide="ignore", invalid="ignore"):
        drag = 2 * product / total
        bend = (second - first) / total
        # artanh(s)/s is ln(h₂/h₁)/(h₂ − h₁) (h₁ + h₂)/2, by its series where the two gaps are nearly one
        inverse = 2 / total * np.where(np.abs(bend) < 1e-4, 1 + bend * bend / 3, np.arctanh(bend) / bend)
    return drag * product, drag, inverse


def _harmonic(first: Array, second: Array) -> tuple[Array, Array, Array]:
    """<h⁻³>⁻¹, <h⁻²>/<h⁻³> and <h⁻¹> of a gap that jumps in the middle."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = 1 / first, 1 / second
        cubes = one * one * one + two * two * two
        return 2 / cubes, (one * one + two * two) / cubes, (one + two) / 2
