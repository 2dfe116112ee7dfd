"""The bearing (Abbott, material ratio) curve of heights: its core, its volumes, and heights at material ratios."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import checked

CORE_WINDOW = 0.4
"""Width in material ratio of the window in which the core line is fitted (ISO 25178-2, ISO 13565-2)."""

EQUAL_SLOPE_TOLERANCE = 1e-12
"""Difference of secants, relative to the total height, below which two windows count as equally flat."""


@dataclass(frozen=True, kw_only=True)
class Core:
    """The straight line through the flattest part of a bearing curve, and the peaks and valleys beyond its ends.

    Attributes
    ----------
    upper, lower : height of the line at material ratio 0 and 1, m, from the origin of the heights.
    peak : Spk, m; height of the triangle on Smr1 whose area is that of the curve above ``upper``.
    valley : Svk, m; depth of the triangle on 1 − Smr2 whose area is that of the curve below ``lower``; positive.
    peak_ratio : Smr1, 0 to 1; fraction of the surface above ``upper``.
    valley_ratio : Smr2, 0 to 1; fraction of the surface above ``lower``.
    """

    upper: float
    lower: float
    peak: float
    valley: float
    peak_ratio: float
    valley_ratio: float

    @property
    def height(self) -> float:
        """The core height Sk, m."""
        return self.upper - self.lower


def descending(heights: ArrayLike) -> Array:
    """The heights in descending order, shape (n,), m: the exact bearing curve at the ratios (i + 1/2)/n.

    Raises
    ------
    InputError
        If there are no heights, one is not finite or above 1e6 m, or all are equal to rounding.
    """
    return np.sort(checked(heights), axis=None)[::-1]


def bearing_curve(heights: ArrayLike, count: int = 501) -> tuple[Array, Array]:
    """The bearing curve: material ratios, and the heights above which these fractions of the points lie.

    Parameters
    ----------
    heights : any shape, m; valid points only.
    count : number of ratios.

    Returns
    -------
    ratio : shape (count,), uniform from 0 to 1.
    height : shape (count,), m, descending; interpolated linearly between the sorted heights.

    Raises
    ------
    InputError
        If there are no heights, one is not finite, all are equal, or ``count`` is below 2.
    """
    if count < 2:
        raise InputError(f"bearing curve: got {count} ratios; ask for at least 2")
    ordered = descending(heights)
    ratio = np.linspace(0.0, 1.0, count)
    return ratio, np.interp(ratio, (np.arange(ordered.size) + 0.5) / ordered.size, ordered)


def bearing_core(ordered: Array) -> Core:
    """The core parameters Sk, Spk, Svk, Smr1, Smr2 of ISO 25178-2, computed from the sorted heights without binning.

    A line z = a + b m is fitted by least squares in the window of 40 % of the points with the smallest drop in height
    (the first of equals), and Sk = −b. The curve crosses the upper end of the line at Smr1; the triangle on Smr1 with
    the area A of the curve above has the height Spk = 2A/Smr1. Svk follows in the same way, on 1 − Smr2.

    Parameters
    ----------
    ordered : shape (n,), m, from `descending`.

    Returns
    -------
    Core : Spk or Svk is 0 where no height lies beyond the line.

    Notes
    -----
    The window has 0.4 n points, rounded; otherwise the error for a bounded smooth curve is of second order in 1/n. A
    plateau of 40 % of the points is itself the core, with Sk = 0. The cost is O(n). Source: ISO 25178-2:2021, annex B;
    ISO 13565-2:1996.
    """
    n = ordered.size
    window = max(2, round(CORE_WINDOW * n))
    drop = ordered[: n - window + 1] - ordered[window - 1 :]
    first = int(np.argmax(drop <= drop.min() + EQUAL_SLOPE_TOLERANCE * (ordered[0] - ordered[-1])))
    inside = ordered[first : first + window]
    # Subtracting one of the heights gives a slope of exactly 0 on a plateau.
    level = inside[window // 2]
    place = (np.arange(window) - (window - 1) / 2) / n
    slope = float(place @ (inside - level)) / float(place @ place)
    middle = float(level + (inside - level).mean())
    centre = (first + window / 2) / n
    upper, lower = middle - slope * centre, middle + slope * (1 - centre)
    above, below = int(np.count_nonzero(ordered > upper)), int(np.count_nonzero(ordered < lower))
    peak_ratio, valley_ratio = _ratio(ordered, upper, above), _ratio(ordered, lower, n - below)
    peak_area, valley_area = (ordered[:above] - upper).sum() / n, (lower - ordered[n - below :]).sum() / n
    return Core(
        upper=upper,
        lower=lower,
        peak=2 * float(peak_area) / peak_ratio if above else 0.0,
        valley=2 * float(valley_area) / (1 - valley_ratio) if below else 0.0,
        peak_ratio=peak_ratio,
        valley_ratio=valley_ratio,
    )


def material_ratio(ordered: Array, height: float) -> float:
    """The material ratio Smr(c) or Rmr(c) at a height c: the fraction of the points above it, 0 to 1.

    Parameters
    ----------
    ordered : shape (n,), m, from `descending`.
    height : c, m, from the same origin as the heights.

    Notes
    -----
    The curve is interpolated linearly between the sorted heights. Source: ISO 25178-2:2021, 4.5; ISO 21920-2:2021.

    Examples
    --------
    >>> curve = descending([0.0, 1.0, 2.0, 3.0])
    >>> material_ratio(curve, 1.5), height_at_ratio(curve, 0.5)
    (0.5, 1.5)
    """
    return _ratio(ordered, height, int(np.count_nonzero(ordered > height)))


def height_at_ratio(ordered: Array, ratio: float) -> float:
    """The height Smc(p) or Rmc(p), m, above which the fraction p of the points lies; the inverse of `material_ratio`.

    The difference of two of them is Sdc(p, q) or Rdc(p, q); Sxp is Sdc(2.5 %, 50 %).

    Parameters
    ----------
    ordered : shape (n,), m, from `descending`.
    ratio : p, 0 to 1.

    Raises
    ------
    InputError
        If the ratio is not from 0 to 1.
    """
    if not 0 <= ratio <= 1:
        raise InputError(f"material ratio: got {ratio!r}; give a fraction from 0 to 1")
    place = min(max(ratio * ordered.size - 0.5, 0.0), ordered.size - 1.0)
    before = min(int(place), ordered.size - 2)
    return float(ordered[before] + (place - before) * (ordered[before + 1] - ordered[before]))


def material_volume(ordered: Array, ratio: float) -> float:
    """The material volume Vm(p) = ∫₀ᵖ (Smc(r) − Smc(p)) dr above the height Smc(p), m³/m².

    Parameters
    ----------
    ordered : shape (n,), m, from `descending`.
    ratio : p, 0 to 1.

    Raises
    ------
    InputError
        If the ratio is not from 0 to 1.

    Notes
    -----
    The mean over all points of their height above Smc(p): no error but that of Smc(p), of second order in 1/n for a
    smooth curve. Source: ISO 25178-2:2021, 4.5.
    """
    height = height_at_ratio(ordered, ratio)
    above = int(np.count_nonzero(ordered > height))
    return float((ordered[:above] - height).sum()) / ordered.size


def void_volume(ordered: Array, ratio: float) -> float:
    """The void volume Vv(p) = ∫ₚ¹ (Smc(p) − Smc(r)) dr below the height Smc(p), m³/m²; like `material_volume`."""
    height = height_at_ratio(ordered, ratio)
    below = int(np.count_nonzero(ordered < height))
    return float((height - ordered[ordered.size - below :]).sum()) / ordered.size


def _ratio(ordered: Array, height: float, above: int) -> float:
    """Material ratio at a height above which ``above`` points lie."""
    n = ordered.size
    if above in (0, n):
        return above / n
    high, low = ordered[above - 1], ordered[above]
    return float(above - 0.5 + (high - height) / (high - low)) / n
