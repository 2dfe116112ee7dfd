"""Flow factors of a profile by sums over a finite number of nodes, as in the source."""

from enum import StrEnum

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.grids import sampled
from roughfilm.rom.homogenization.line import LineFactors, checked_profile

MAX_NODES = 2**24


class Rule(StrEnum):
    """Quadrature rule."""

    TRAPEZOID = "trapezoid"
    """Powers of h at the nodes with equal weights."""
    SIMPSON = "Simpson"
    """Powers of h at the nodes with weights 2/3 and 4/3."""
    DIFFERENCES = "differences"
    """Second-order differences of the cell problems, with h halfway between nodes."""


def line_factors_on(gap: ArrayLike, nodes: int, *, rule: Rule = Rule.SIMPSON) -> LineFactors:
    """Homogenized coefficients of a profile by a quadrature rule; ``line_factors`` integrates exactly.

    The nodes are evenly spaced on the straight lines between the points of the profile, the first at the first point.
    With as many nodes as points ``TRAPEZOID`` sums over the heights, independent of their order.

    Parameters
    ----------
    gap : h >= 0, m, shape (n,); one period, evenly spaced.
    nodes : N, 4 to 2²⁴; even for ``SIMPSON``.
    rule : quadrature rule.

    Returns
    -------
    ``uncertainty`` is the change from half as many nodes; it does not include the effect of the gap between the points.

    Raises
    ------
    InputError
        As in ``line_factors``, and if the number of nodes does not fit the rule.

    The error of ``TRAPEZOID`` and ``DIFFERENCES`` is of order N⁻²; for a profile, differences equal the midpoint rule,
    with half the error of the trapezoid and the opposite sign. ``SIMPSON`` has N⁻⁴ where N is an even multiple of n,
    and N⁻² elsewhere, because pairs of steps then straddle corners of the profile.

    Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025, section 3.2.
    """
    h = checked_profile(gap)
    if isinstance(nodes, bool) or not isinstance(nodes, int) or not 4 <= nodes <= MAX_NODES:
        raise InputError(f"nodes: got {nodes!r}; write a whole number from 4 to {MAX_NODES}")
    if rule is Rule.SIMPSON and nodes % 2:
        raise InputError(f"nodes: got {nodes} for Simpson's rule; write an even number")
    fewer = 2 * (nodes // 4) if rule is Rule.SIMPSON else nodes // 2
    closed, scale = not h.all(), float(h.mean())
    coarse, fine = (
        _on_nodes(sampled((h / scale)[:, None], count, 0)[:, 0], rule, closed=closed).scaled(scale)
        for count in (fewer, nodes)
    )
    return LineFactors(factors=fine, uncertainty=_apart(fine, coarse))


def _apart(one: FlowFactors, other: FlowFactors) -> FlowFactors:
    return FlowFactors(
        mean_gap=abs(one.mean_gap - other.mean_gap),
        pressure=np.abs(one.pressure - other.pressure),
        shear=np.abs(one.shear - other.shear),
        couette=abs(one.couette - other.couette),
        shear_couette=abs(one.shear_couette - other.shear_couette),
        sealed=one.sealed,
    )


def _on_nodes(h: Array, rule: Rule, *, closed: bool) -> FlowFactors:
    if rule is Rule.DIFFERENCES:
        return _by_differences((h + np.roll(h, -1)) / 2, closed=closed)
    weights = np.full(h.size, 1 / h.size)
    if rule is Rule.SIMPSON:
        weights[::2] *= 2 / 3
        weights[1::2] *= 4 / 3
    open_to = h > 0
    inverse = np.divide(1, h, out=np.zeros_like(h), where=open_to)
    couette = float(weights @ inverse)
    pressure = shear = squared = 0.0
    if not closed:
        squared = float(weights @ inverse**2)
        pressure = float(1 / (weights @ inverse**3))
        shear = squared * pressure
    return _ridges_across(
        mean_gap=float(weights @ h),
        along_ridges=float(weights @ h**3),
        pressure=pressure,
        shear=shear,
        couette=couette,
        shear_couette=couette - shear * squared,
    )


def _by_differences(middle: Array, *, closed: bool) -> FlowFactors:
    """Factors from (h³(1 + χ'))' = 0 and (h - h³ χ₃')' = 0, periodic, with the gap halfway between nodes."""
    count = middle.size
    cubed = middle**3
    inverse = np.divide(1, middle, out=np.zeros_like(middle), where=middle > 0)
    couette = shear_couette = float(inverse.mean())
    pressure = shear = 0.0
    if not closed:
        step = 1 / count
        # row i balances the faces i - 1 and i; the last node is fixed at 0
        bands = np.zeros((2, count - 1))
        bands[0, 1:] = -cubed[: count - 2]
        bands[1] = cubed[: count - 1] + np.roll(cubed, 1)[: count - 1]
        sources = np.stack([cubed - np.roll(cubed, 1), np.roll(middle, 1) - middle], axis=1)[: count - 1] * step
        solved = np.concatenate([scipy.linalg.solveh_banded(bands, sources), np.zeros((1, 2))])
        along, sliding = ((np.roll(solved, -1, axis=0) - solved) / step).T
        pressure = float((cubed * (1 + along)).mean())
        shear = float((middle - cubed * sliding).mean())
        shear_couette = float((middle * sliding).mean())
    return _ridges_across(
        mean_gap=float(middle.mean()),
        along_ridges=float(cubed.mean()),
        pressure=pressure,
        shear=shear,
        couette=couette,
        shear_couette=shear_couette,
    )


def _ridges_across(
    *, mean_gap: float, along_ridges: float, pressure: float, shear: float, couette: float, shear_couette: float
) -> FlowFactors:
    return FlowFactors(
        mean_gap=mean_gap,
        pressure=np.diag([pressure, along_ridges]),
        shear=np.array([shear, 0.0]),
        couette=couette,
        shear_couette=shear_couette,
        sealed=(pressure == 0, False),
    )
