"""The trend of a quantity with the size of its window, and its value on the whole surface."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

NORMAL = 1.959964
"""The 0.975 quantile of the normal distribution."""

MAX_GROWTH = 0.1
"""Largest exponent β of Sq ∝ L^β between the two largest windows at which the spectrum counts as rolled off.

For a correlation length ξ much below L, Sq deviates from its limit by (ξ/L)²; β is 0.1 for windows of about seven times
the decay length Sal. For self-affine surfaces without a roll-off β is the Hurst exponent.
"""

MAX_PART = 0.5
"""Largest part of the mean that is due to the size of the window at which it is extrapolated."""

UNLIKELY = 0.01
"""Probability below which the means do not follow the regression."""


class Verdict(StrEnum):
    """Whether the value of the whole surface follows from the trend with the size of the window."""

    EXTRAPOLATED = "extrapolated"
    NOT_RESOLVED = "no effect of the size is resolved"
    NO_PLATEAU = "cannot be extrapolated: Sq still grows with the window"
    TOO_STRONG = "cannot be extrapolated: more than half of the value is due to the size of the window"
    UNKNOWN = "cannot be extrapolated: too few sizes or independent windows"


@dataclass(frozen=True, kw_only=True)
class SizeTrend:
    """The regression of the mean over windows on the inverse of their side.

    Attributes
    ----------
    sizes : sides L of the windows, from the largest on, m.
    means : mean of the quantity at each size, in its unit.
    uncertainties : half widths of the 95 % confidence intervals of the means.
    slope : b of the regression a + b/L, in the unit times m; NaN where it is unknown.
    limit : value a of the whole surface; None where it cannot be extrapolated.
    limit_uncertainty : half width of its 95 % confidence interval.
    part : part of the mean of the largest windows that is due to their size, b/L; None where it is unknown.
    part_uncertainty : half width of its 95 % confidence interval.
    growth : exponent of Sq ∝ L^β between the two largest sizes; NaN where it is unknown.
    verdict : whether the value is extrapolated, and if not, why.
    """

    sizes: Array
    means: Array
    uncertainties: Array
    slope: float
    limit: float | None
    limit_uncertainty: float | None
    part: float | None
    part_uncertainty: float | None
    growth: float
    verdict: Verdict


def growth_of(sizes: Sequence[float], heights: Sequence[float]) -> float:
    """The exponent β of Sq ∝ L^β between the two largest windows; NaN for one size.

    Parameters
    ----------
    sizes : sides L, m.
    heights : mean Sq of the windows of each side, m.
    """
    if len(sizes) < 2 or min(heights) <= 0:
        return math.nan
    (first, high), (second, low) = sorted(zip(sizes, heights, strict=True), reverse=True)[:2]
    return math.log(high / low) / math.log(first / second)


def size_trend(
    sizes: Sequence[float], means: Sequence[float], uncertainties: Sequence[float | None], growth: float
) -> SizeTrend:
    """Extrapolate the mean over windows of several sizes to the whole surface by a weighted regression on 1/L.

    Effects of the joined or free edges of a window act on a margin whose fraction of the area is proportional to 1/L;
    long waves that do not fit into it act with 1/L² where the spectrum has rolled off. The regression a + b/L has the
    weights 1/σ² of the means. The uncertainty of its limit a is the sum of that of the regression, which is scaled up
    where the means do not lie on a line (χ² test), and of the difference from a regression on 1/L². It is not
    extrapolated if Sq grows by more than L^0.1 between the two largest sizes, since longer waves then add to every
    quantity, or if more than half of the value would be due to the size.

    Parameters
    ----------
    sizes : sides L of the windows, m, all different.
    means : mean of the quantity at each size.
    uncertainties : half width of the 95 % confidence interval of each mean; None if unknown.
    growth : exponent of Sq between the two largest sizes, from `growth_of`.

    Raises
    ------
    InputError
        If two sizes are the same, or one is not above 0.

    Notes
    -----
    Means at different sizes come from the same measurement, so that their errors have a common part. It shifts the
    limit by at most as much as independent errors of this size.

    Examples
    --------
    >>> trend = size_trend([4.0, 2.0, 1.0], [1.25, 1.5, 2.0], [0.01, 0.01, 0.01], growth=0.0)
    >>> round(trend.limit, 3), round(trend.part, 3)
    (1.0, 0.25)
    """
    if len(set(sizes)) < len(sizes) or min(sizes, default=0.0) <= 0:
        raise InputError(f"sizes: got {list(sizes)!r:.60}; give different lengths above 0")
    order = np.argsort(sizes)[::-1]
    known = [one for one in order if uncertainties[one] is not None]
    lengths, values = np.asarray(sizes, dtype=float)[known], np.asarray(means, dtype=float)[known]
    widths = np.array([float(uncertainties[one] or 0.0) for one in known])
    if len(known) < 2 or not np.isfinite(values).all():
        return SizeTrend(
            sizes=lengths,
            means=values,
            uncertainties=widths,
            slope=math.nan,
            limit=None,
            limit_uncertainty=None,
            part=None,
            part_uncertainty=None,
            growth=growth,
            verdict=Verdict.UNKNOWN,
        )
    limit, slope, of_limit, of_slope = _regression(1 / lengths, values, widths)
    other = _regression(1 / lengths**2, values, widths)[0]
    part, of_part = slope / float(lengths[0]), of_slope / float(lengths[0])
    if not growth <= MAX_GROWTH:
        verdict = Verdict.NO_PLATEAU
    elif abs(part) > MAX_PART * abs(values[0]):
        verdict = Verdict.TOO_STRONG
    else:
        verdict = Verdict.EXTRAPOLATED if abs(part) > of_part else Verdict.NOT_RESOLVED
    known_limit = verdict in (Verdict.EXTRAPOLATED, Verdict.NOT_RESOLVED)
    return SizeTrend(
        sizes=lengths,
        means=values,
        uncertainties=widths,
        slope=slope,
        limit=limit if known_limit else None,
        limit_uncertainty=of_limit + abs(limit - other) if known_limit else None,
        part=part,
        part_uncertainty=of_part,
        growth=growth,
        verdict=verdict,
    )


def _regression(x: Array, values: Array, widths: Array) -> tuple[float, float, float, float]:
    """The limit and slope of a weighted line through values, and the half widths of their 95 % intervals.

    Values without uncertainty, such as those of a flat surface, get the same weights.
    """
    sigma = np.where(widths > 0, widths / NORMAL, widths.max() / NORMAL or 1.0)
    design = np.column_stack([np.ones_like(x), x]) / sigma[:, None]
    scale = np.array([1.0, x.max()])
    covariance = np.linalg.inv((design / scale).T @ (design / scale)) / np.outer(scale, scale)
    limit, slope = covariance @ design.T @ (values / sigma)
    free = len(x) - 2
    misfit = float(np.sum(((values - limit - slope * x) / sigma) ** 2))
    factor = 1.0
    if free > 0 and scipy.special.chdtrc(free, misfit) < UNLIKELY:
        factor = math.sqrt(misfit / free)
    if not widths.any():
        factor = 0.0
    of_limit, of_slope = NORMAL * factor * np.sqrt(np.diag(covariance))
    return float(limit), float(slope), float(of_limit), float(of_slope)
