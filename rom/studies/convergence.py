"""Grid convergence of quantities: observed order, extrapolated value and uncertainty."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import Scene, kind_of
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.comparison import scale

GRIDS = 3
"""Largest number of grids that are used, the finest ones; it equals the number of the unknowns f0, C and p."""

ORDER_TOLERANCE = 0.1
"""Largest relative difference between an observed order and the formal one at which the order is trusted."""

TRUSTED_SAFETY = 1.25
"""Roache's safety factor for three grids whose observed order is near the formal one."""

SAFETY = 3.0
"""Roache's safety factor for all other grids."""

MIN_ORDER = 0.5
"""Smallest observed order at which values are extrapolated."""

MAX_ORDER = 20.0
"""Upper limit of the observed order; a higher order is set to this value."""


class ConvergenceKind(StrEnum):
    """The behaviour of a quantity as the grid is refined."""

    MONOTONE = "monotone"
    OSCILLATORY = "oscillatory"
    DIVERGENT = "divergent"
    ROUND_OFF = "at round-off"
    TWO_GRIDS = "two grids, formal order assumed"
    NO_FORMAL_ORDER = "no formal order"


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """The grid convergence of one quantity.

    Attributes
    ----------
    kind : behaviour of the values.
    grids : cells along one direction, up to three grids from coarse to fine.
    values : quantity on each of these grids.
    order : observed order; None if it cannot be computed.
    order_used : order of the extrapolation, which is at most the formal order; None without extrapolation.
    value : extrapolated value, or the value on the finest grid without extrapolation.
    uncertainty : uncertainty of ``value`` and of the value on the finest grid, in the unit of the values.
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
        """The observed order as text, followed by the order used if it differs; empty without an observed order."""
        if self.order is None:
            return ""
        order, used = f"{self.order:.2f}", f"{self.order_used:.2f}"
        return order if used == order else f"{order} → {self.order_used:g}"


def converge(
    grids: Sequence[int], values: Sequence[float], *, formal_order: int | None, noise: float = 0.0
) -> Convergence:
    """Fit f = f0 + C h^p to the finest three grids and judge the fit.

    The observed order p solves (f3 - f2) / (f2 - f1) = (h3^p - h2^p) / (h2^p - h1^p), with h1 the finest cells; the
    ratios of the cell sizes are arbitrary. The uncertainty is the grid convergence index Fs C h1^p = Fs |f1 - f0|, with
    Fs = 1.25 where p differs from the formal order by at most a tenth of it, and Fs = 3 elsewhere. An order p above the
    formal one results from errors that cancel: p is limited to the formal order, and C is the larger of the values from
    the two pairs of grids. Two grids use the formal order and Fs = 3. Values that oscillate, or whose differences
    decrease more slowly than with order 1/2, are not extrapolated; the uncertainty is then 3 times their range. Without
    a formal order (spectral methods) nothing is extrapolated, and the uncertainty is the last difference |f1 - f2|.

    Parameters
    ----------
    grids
        Cells along one direction, increasing; cell sizes are their inverses.
    values
        The quantity on each grid, in any unit.
    formal_order
        Order of the method; None if the method has no fixed order.
    noise
        Error of the iterative solution, in the unit of the values; the uncertainty is at least this.

    Raises
    ------
    InputError
        For fewer than two grids, grids that do not get finer, or values that are not finite.

    Sources: Roache 1994, doi:10.1115/1.2910291; Celik et al. 2008, doi:10.1115/1.2960953; the range of values that
    do not converge: Eça and Hoekstra 2014, doi:10.1016/j.jcp.2014.01.006.
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
        """A number above zero if the differences of the values decrease more slowly than with this order."""
        powers = np.diff(sizes**order)
        return float(fine * powers[0] / powers[1] / coarse - 1) if coarse else np.inf

    if excess(MIN_ORDER) > 0:
        return ConvergenceKind.DIVERGENT, None
    if excess(MAX_ORDER) < 0:
        return ConvergenceKind.MONOTONE, MAX_ORDER
    from scipy.optimize import brentq  # slow to import

    return ConvergenceKind.MONOTONE, float(brentq(excess, MIN_ORDER, MAX_ORDER))


def convergence(model: Model, runs: Sequence[Result], scene: Scene) -> Mapping[str, Convergence]:
    """The convergence of each compared quantity over the runs of a model on a scene; empty for fewer than two grids.

    The error of the iterative solution is estimated as the residual of the finest run times the scale of the quantity.
    """
    own = sorted((run for run in runs if run.model == model.name), key=lambda run: run.numerics.resolution)
    if len(own) < 2:
        return {}
    return {
        quantity: converge(
            [run.numerics.resolution for run in own],
            [run.quantities[quantity].value for run in own],
            formal_order=model.order_of(scene),
            noise=own[-1].numerics.residual * scale(own[-1], quantity),
        )
        for quantity in kind_of(own[-1]).shared(*own)
    }
