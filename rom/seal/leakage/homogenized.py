"""Flow through a periodic gap in x and in y by homogenization."""

from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import unmasked
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.seal.leakage.passage import Leakage, Passage, shut


def homogenized_leakage(gap: ArrayLike, spacing: tuple[float, float]) -> Leakage:
    """Compute the permeabilities A₁₁ and A₂₂, m³, of a periodic gap by homogenization; a closed gap is sealed.

    Parameters
    ----------
    gap : h >= 0, m, shape (nx, ny); one period.
    spacing : (dx, dy), m.

    Raises
    ------
    InputError, ConvergenceError
        If :func:`roughfilm.rom.homogenization.flow_factors.flow_factors` raises it.

    Source: Sahlin 2008, F.8 to F.10.
    """
    h = unmasked("gap", gap)
    if h.ndim == 2 and h.size and not h.any():
        return Leakage(along=shut(h.shape), across=shut(h.shape))
    cell = flow_factors(h, spacing)

    def one(i: int) -> Passage:
        closed = cell.factors.sealed[i]
        return Passage(
            permeability=float(cell.factors.pressure[i, i]),
            uncertainty=float(cell.uncertainty.pressure[i, i]),
            sealed=closed,
            corrector=cell.correctors[i],
            unsolved=0.0 if closed else cell.unsolved,
            iterations=cell.iterations,
            residual=cell.residual,
        )

    return Leakage(along=one(0), across=one(1))
