"""Uncertainty of flow factors from their values on coarser grids."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors

SAFETY_FACTOR = 1.5
"""Safety factor of an error estimated from three grids.

On 360 random gaps (self-affine, with lays, sums of a few waves, plateaus; open to 40 % contact, shortest waves of 4
nodes and up, 64² and 128²) it covers 97 of 100 values of A₁₁, A₂₂ and B₁; 1.25 would cover 95.
"""

LOOSEST_TOLERANCE = 1e-4
"""Largest solver tolerance that is chosen."""

TIGHTEST_TOLERANCE = 1e-10
"""Smallest solver tolerance that is chosen."""

DISCRETISATION_TO_SOLVER_ERROR = 100
"""Ratio of the expected discretisation error to the solver tolerance."""


def uncertainty_of(factors: Sequence[FlowFactors]) -> FlowFactors:
    """Uncertainty of the last of up to three sets of factors, on grids each twice as fine as the one before.

    Richardson's rule with the observed order between one and two; infinite without a coarser grid. With contact d and e
    do not converge, since <1/h> at an edge grows with the logarithm of the number of nodes: for them it is only an
    estimate of the change from grid to grid.
    """

    def each(name: str) -> Array:
        return off([np.asarray(getattr(one, name), dtype=float) for one in factors])

    return replace(
        factors[-1],
        mean_gap=0.0,
        pressure=each("pressure"),
        shear=each("shear"),
        couette=float(each("couette")),
        shear_couette=float(each("shear_couette")),
    )


def off(values: Sequence[Array]) -> Array:
    """Uncertainty of the last of up to three values on grids each twice as fine; see :func:`uncertainty_of`."""
    if len(values) < 2:
        return np.full_like(values[0], np.inf)
    last = np.abs(values[-1] - values[-2])
    if len(values) < 3:
        return np.asarray(SAFETY_FACTOR * last)
    before = np.abs(values[-2] - values[-3])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.clip(np.where(last > 0, before / last, 4.0), 2.0, 4.0)
    return np.asarray(SAFETY_FACTOR * np.maximum(last, before / 4) / (ratio - 1))


def sufficient(values: Sequence[Array], loosest: float) -> Array:
    """Solver tolerances for the next finer grid: a hundredth of the expected discretisation error of each value.

    The error is extrapolated from the values on the last two grids; the tolerance is 1e-10 to ``loosest``, which it is
    with fewer grids, and for a value of 0.
    """
    if len(values) < 2:
        return np.array(loosest)
    before, last = values[-2:]
    expected = np.divide(np.abs(last - before), 4 * last, out=np.full(last.shape, np.inf), where=last > 0)
    return np.asarray(np.clip(expected / DISCRETISATION_TO_SOLVER_ERROR, TIGHTEST_TOLERANCE, loosest))
