"""The flow through a gap that goes on and on, in both directions, from its cell."""

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.seal.leakage.passage import Leakage, Passage, shut


def homogenized_leakage(gap: ArrayLike, spacing: tuple[float, float]) -> Leakage:
    """A₁₁ and A₂₂ of a periodic gap as :func:`roughfilm.rom.homogenization.flow_factors.flow_factors` finds them.

    A gap that is closed everywhere is sealed.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period.
    spacing : (dx, dy), m.

    Raises
    ------
    InputError, ConvergenceError
        As flow factors do.

    Source: Sahlin 2008, F.8 to F.10.
    """
    h = np.asarray(gap)
    if h.ndim == 2 and h.size and not h.any():
        return Leakage(along=shut(h.shape), across=shut(h.shape))
    found = flow_factors(h, spacing)

    def one(i: int) -> Passage:
        closed = found.factors.sealed[i]
        return Passage(
            permeability=float(found.factors.pressure[i, i]),
            uncertainty=0.0 if closed else float(found.uncertainty.pressure[i, i]),
            sealed=closed,
            corrector=found.correctors[i],
            unsolved=0.0 if closed else found.unsolved,
            iterations=found.iterations,
            residual=found.residual,
        )

    return Leakage(along=one(0), across=one(1))
