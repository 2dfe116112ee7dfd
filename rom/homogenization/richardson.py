"""How far off flow factors may be, from those on coarser grids."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rom.gap import Array
from rom.homogenization.factors import FlowFactors

SAFETY = 1.5
"""Of an error estimated from three grids.

On 360 random gaps (self-affine, with lays, sums of a few waves, plateaus; open to 40 % contact, shortest waves of 4
nodes and up, 64² and 128²) 97 of 100 values of A₁₁, A₂₂ and B₁ were within; for 95 of them 1.25 would do.
"""


def uncertainty_of(found: Sequence[FlowFactors]) -> FlowFactors:
    """Of the last of up to three on grids each twice as fine, by Richardson's rule at the order seen, one to two.

    Infinite where there is no coarser grid. In contact d and e have no limit, as at an edge <1/h> grows with the
    logarithm of the nodes: of these two the change from grid to grid is told, no more.
    """

    def off(values: list[Array]) -> Array:
        if len(values) < 2:
            return np.full_like(values[0], np.inf)
        last = np.abs(values[-1] - values[-2])
        if len(values) < 3:
            return SAFETY * last
        before = np.abs(values[-2] - values[-3])
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.clip(np.where(last > 0, before / last, 4.0), 2.0, 4.0)
        return np.asarray(SAFETY * np.maximum(last, before / 4) / (ratio - 1))

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
