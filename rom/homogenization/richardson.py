"""How far off flow factors may be, from those on coarser grids."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors

SAFETY = 1.5
"""Of an error estimated from three grids.

On 360 random gaps (self-affine, with lays, sums of a few waves, plateaus; open to 40 % contact, shortest waves of 4
nodes and up, 64² and 128²) 97 of 100 values of A₁₁, A₂₂ and B₁ were within; for 95 of them 1.25 would do.
"""

LOOSEST, TIGHTEST = 1e-4, 1e-10
"""Tolerances of linear systems that are chosen from."""

SPARE = 100
"""A tolerance is so many times below what its grid is expected to be off by."""


def uncertainty_of(found: Sequence[FlowFactors]) -> FlowFactors:
    """Of the last of up to three on grids each twice as fine, by Richardson's rule at the order seen, one to two.

    Infinite where there is no coarser grid. In contact d and e have no limit, as at an edge <1/h> grows with the
    logarithm of the nodes: of these two the change from grid to grid is told, no more.
    """

    def each(name: str) -> Array:
        return off([np.asarray(getattr(factors, name), dtype=float) for factors in found])

    return replace(
        found[-1],
        mean_gap=0.0,
        pressure=each("pressure"),
        shear=each("shear"),
        couette=float(each("couette")),
        shear_couette=float(each("shear_couette")),
    )


def off(values: Sequence[Array]) -> Array:
    """How far the last of up to three values on grids each twice as fine may be off, as :func:`uncertainty_of` says."""
    if len(values) < 2:
        return np.full_like(values[0], np.inf)
    last = np.abs(values[-1] - values[-2])
    if len(values) < 3:
        return np.asarray(SAFETY * last)
    before = np.abs(values[-2] - values[-3])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.clip(np.where(last > 0, before / last, 4.0), 2.0, 4.0)
    return np.asarray(SAFETY * np.maximum(last, before / 4) / (ratio - 1))


def sufficient(found: Sequence[Array]) -> float:
    """A tolerance for the next finer grid: of its error in flows, if those on the last two grids tell what it will be.

    A hundredth of what the grid is expected to be off by, 1e-10 to 1e-4.
    """
    if len(found) < 2:
        return LOOSEST
    before, last = found[-2:]
    with np.errstate(divide="ignore", invalid="ignore"):
        change = np.abs(last - before) / last
    expected = float(np.min(change[last > 0], initial=np.inf)) / 4
    return min(max(expected / SPARE, TIGHTEST), LOOSEST)
