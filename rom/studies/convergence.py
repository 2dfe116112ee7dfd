"""Grid convergence: the observed order, the extrapolated value, and its uncertainty."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.comparison import scale

GRIDS = 3
"""Number of finest grids that are used, that of the unknowns f0, C and p."""

ORDER_TOLERANCE = 0.1
"""Relative difference of an observed order from the formal one up to which it is trusted."""

TRUSTED_SAFETY = 1.25
"""Roache's safety factor for three grids whose observed order is near the formal one."""

SAFETY = 3.0
"""Roache's safety factor for all other grids."""

MIN_ORDER = 0.5
"""Observed order below which nothing is extrapolated."""

MAX_ORDER = 20.0
"""Largest observed order; a higher one is set to it."""


class ConvergenceKind(StrEnum):
    """The behaviour of the values as the cells shrink."""

    MONOTONE = "monotone"
    OSCILLATORY = "oscillatory"
    DIVERGENT = "divergent"
    ROUND_OFF = "at round-off"
    TWO_GRIDS = "two grids, formal order assumed"
    NO_FORMAL_ORDER = "no formal order"


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """One quantity on up to three grids, from coarse to fine.

    ``order`` is the observed one, ``order_used`` what was extrapolated with: the observed one, at most the formal one;
    None where there is none. ``value`` is the extrapolated one, or the finest where nothing can be extrapolated;
    ``uncertainty`` is absolute, in the unit of the values, and holds for ``value`` and for the finest of the values.
    """

    kind: ConvergenceKind
    grids: tuple[int, ...]
    values: tuple[float, ...]
    order: float | None
    order_used: float | None
    value: float
    uncertainty: float

    @property
    def order_text(self) -> str:
        """The observed order in short, with the one it was limited to; empty if none was observed."""
        if self.order is None:
            return ""
        order, used = f"{self.order:.2f}", f"{self.order_used:.2f}"
        return order if used == order else f"{order} → {self.order_used:g}"


def converge(
    grids: Sequence[int], values: Sequence[float], *, formal_order: int | None, noise: float = 0.0
) -> Convergence:
    """Fit f = f0 + C h^p to the finest three grids and judge the fit.

    The observed order p solves (f3 - f2) / (f2 - f1) = (h3^p - h2^p) / (h2^p - h1^p), with h1 the finest cells, of any
    ratio. The uncertainty is the grid convergence index Fs C h1^p = Fs |f1 - f0|, with Fs = 1.25 where p is within a
    tenth of the formal order and Fs = 3 elsewhere. A p above the formal order comes of errors that cancel: it is
    limited to the formal one, and C is the larger of those of the two pairs. Two grids take the formal order and
    Fs = 3. Values that oscillate, or whose steps shrink slower than at order 1/2, are not extrapolated, and 3 times
    their range is uncertain; without a formal order (spectral methods) the last step is.

    Parameters
    ----------
    grids
        Cells along one direction, increasing; cell sizes are their inverses.
    values
        The quantity on each grid, in any unit.
    formal_order
        That of the method; None if it has no fixed one.
    noise
        What the iteration leaves unresolved, in the unit of the values; no uncertainty is below it.

    Raises
    ------
    InputError
        For fewer than two grids, grids that do not get finer, or values that are not finite.

    Sources: Roache 1994, doi:10.1115/1.2910291; Celik et al. 2008, doi:10.1115/1.2960953; the range for what does not
    converge: Eça and Hoekstra 2014, doi:10.1016/j.jcp.2014.01.006.
    """
    if not (len(grids) == len(values) >= 2 and min(np.diff(grids)) > 0 < grids[0] and np.isfinite(values).all()):
        raise InputError(f"grids: got {[*grids]} with {[*values]}; give two or more, ever finer, with finite values")
    used, f = tuple(grids[-GRIDS:]), np.array(values[-GRIDS:], dtype=float)
    sizes, steps = 1 / np.array(used), np.diff(f)
    kind, order = (
        (ConvergenceKind.ROUND_OFF, None) if np.ptp(f) <= noise else _kind_and_order(sizes, steps, formal_order)
    )
    value, order_used = f[-1], None
    if formal_order is not None and kind in (ConvergenceKind.MONOTONE, ConvergenceKind.TWO_GRIDS):
        order_used = formal_order if order is None else min(order, formal_order)
        errors = steps / np.diff(sizes**order_used) * sizes[-1] ** order_used
        value = f[-1] - errors[-1]
        near = order is not None and abs(order - formal_order) <= ORDER_TOLERANCE * formal_order
        uncertainty = (TRUSTED_SAFETY if near else SAFETY) * np.abs(errors).max()
    else:
        uncertainty = abs(steps[-1]) if formal_order is None else SAFETY * np.ptp(f)
    return Convergence(
        kind=kind,
        grids=used,
        values=tuple(f.tolist()),
        order=order,
        order_used=order_used,
        value=float(value),
        uncertainty=max(float(uncertainty), noise),
    )


def _kind_and_order(sizes: Array, steps: Array, formal_order: int | None) -> tuple[ConvergenceKind, float | None]:
    if formal_order is None:
        return ConvergenceKind.NO_FORMAL_ORDER, None
    if steps.size == 1:
        return ConvergenceKind.TWO_GRIDS, None
    coarse, fine = steps
    if coarse * fine < 0:
        return ConvergenceKind.OSCILLATORY, None

    def excess(order: float) -> float:
        """Above zero if the steps shrink slower than at this order."""
        powers = np.diff(sizes**order)
        return float(fine * powers[0] / powers[1] / coarse - 1) if coarse else np.inf

    if excess(MIN_ORDER) > 0:
        return ConvergenceKind.DIVERGENT, None
    if excess(MAX_ORDER) < 0:
        return ConvergenceKind.MONOTONE, MAX_ORDER
    from scipy.optimize import brentq  # slow to import

    return ConvergenceKind.MONOTONE, float(brentq(excess, MIN_ORDER, MAX_ORDER))


def convergence(model: Model, runs: Sequence[Result]) -> Mapping[str, Convergence]:
    """The convergence of each compared quantity over the runs of a model; empty for fewer than two grids.

    What the iteration leaves unresolved is taken as the finest run's residual times the quantity's scale.
    """
    own = sorted((run for run in runs if run.model == model.name), key=lambda run: run.numerics.resolution)
    if len(own) < 2:
        return {}
    return {
        quantity: converge(
            [run.numerics.resolution for run in own],
            [run.quantities[quantity].value for run in own],
            formal_order=model.order,
            noise=own[-1].numerics.residual * scale(own[-1], quantity),
        )
        for quantity in kind_of(own[-1]).shared(*own)
    }
