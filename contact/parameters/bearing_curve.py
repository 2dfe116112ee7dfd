"""The bearing (Abbott, material ratio) curve of heights, and the core, peaks and valleys it is divided into."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import checked

CORE_WINDOW = 0.4
"""Material ratio over which the curve is taken as straight (ISO 25178-2, ISO 13565-2)."""

SAME_DROP = 1e-12
"""Of the whole height: windows whose secants differ by less are as flat as each other, and the first counts."""


@dataclass(frozen=True, kw_only=True)
class Core:
    """The straight line through the flattest part of the bearing curve, and what lies above and below its ends.

    Attributes
    ----------
    upper, lower : m, heights of the line at ratio 0 and 1, measured as the heights were.
    peak : Spk, m, height of the triangle with the area of the curve above ``upper`` and its base.
    valley : Svk, m, depth of that below ``lower``; positive.
    peak_ratio : Smr1, between 0 and 1: the part of the surface above ``upper``.
    valley_ratio : Smr2, between 0 and 1: the part of the surface above ``lower``.
    """

    upper: float
    lower: float
    peak: float
    valley: float
    peak_ratio: float
    valley_ratio: float

    @property
    def height(self) -> float:
        """Sk, m."""
        return self.upper - self.lower


def descending(heights: ArrayLike) -> Array:
    """All heights from the highest to the lowest, shape (n,), m: the exact bearing curve, at ratios (i + 1/2)/n.

    Raises
    ------
    InputError
        If there are none, one is not finite or beyond 1000 km, or all are the same but for rounding.
    """
    return np.sort(checked(heights), axis=None)[::-1]


def bearing_curve(heights: ArrayLike, count: int = 501) -> tuple[Array, Array]:
    """Height c above which a given part of the points lies, for drawing.

    Parameters
    ----------
    heights : any shape, m: valid points only.
    count : how many ratios.

    Returns
    -------
    ratio : shape (count,), from 0 to 1.
    height : shape (count,), m, falling; straight between neighbours of the ordered heights.

    Raises
    ------
    InputError
        If there are no heights, one is not finite, all are the same, or fewer than two ratios are asked for.
    """
    if count < 2:
        raise InputError(f"bearing curve: got {count} ratios; ask for at least 2")
    ordered = descending(heights)
    ratio = np.linspace(0.0, 1.0, count)
    return ratio, np.interp(ratio, (np.arange(ordered.size) + 0.5) / ordered.size, ordered)


def bearing_core(ordered: Array) -> Core:
    """Sk, Spk, Svk, Smr1, Smr2 of ISO 25178-2, from the ordered heights themselves.

    The window of 40 % of the points across which the heights drop least is found (the first, if several are as flat),
    a line z = a + b m fitted to them by least squares, and read at ratios m = 0 and 1: Sk = −b. The curve passes its
    upper end at Smr1, and with A the area of the curve above it, the triangle on Smr1 of the same area has the height
    Spk = 2A/Smr1; Svk likewise, on 1 − Smr2.

    Parameters
    ----------
    ordered : shape (n,), m, from `descending`.

    Returns
    -------
    Core : with Spk or Svk of 0 where nothing lies beyond the line.

    Notes
    -----
    The window is 0.4 n points wide, rounded; for a bounded smooth curve the rest is of second order in 1/n. A plateau
    that holds 40 % of the points is itself the core, with Sk = 0. Sorting takes O(n log n), the rest O(n).
    ISO 25178-2:2021, annex B; ISO 13565-2:1996.
    """
    n = ordered.size
    window = max(2, round(CORE_WINDOW * n))
    drop = ordered[: n - window + 1] - ordered[window - 1 :]
    first = int(np.argmax(drop <= drop.min() + SAME_DROP * (ordered[0] - ordered[-1])))
    inside = ordered[first : first + window]
    # Heights taken from one of them leave a plateau exactly level.
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


def _ratio(ordered: Array, height: float, above: int) -> float:
    """Material ratio at a height above which that many points lie."""
    n = ordered.size
    if above in (0, n):
        return above / n
    high, low = ordered[above - 1], ordered[above]
    return float(above - 0.5 + (high - height) / (high - low)) / n
