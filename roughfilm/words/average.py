"""Means over windows in words: the numerical uncertainty, the scatter and the interval for one window apart."""

from roughfilm.contact.windows.average import WindowAverage
from roughfilm.words.scales import Scale

HEADS = ("±, numerical", "±, windows", "one window")
"""The heads of the columns behind a mean over windows; :func:`cells_of` has the numbers."""


MOST = 10.0
"""Uncertainty over the value above which it is written as unknown."""


def rounded(uncertainty: float | None, value: float) -> str:
    """An uncertainty with two digits; "?" if it is unknown or more than ten times the value.

    An infinite ``value`` stands for a quantity that may be near 0, whose uncertainty is always shown.
    """
    if uncertainty is None or not uncertainty <= MOST * abs(value):
        return "?"
    return _plain(uncertainty, 2)


def cells_of(average: WindowAverage, scale: Scale) -> list[str]:
    """The mean in the unit of a scale, its numerical uncertainty, its scatter, and the interval for one window."""
    one = average.scaled(1 / scale.factor)
    interval = "?" if one.interval is None else " to ".join(_plain(end, 3) for end in one.interval)
    ends = (rounded(uncertainty, one.value) for uncertainty in (one.uncertainty, one.scatter))
    return [_plain(one.value, 3), *ends, interval]


def in_words(average: WindowAverage, scale: Scale) -> str:
    """A mean with both uncertainties, such as "2.31 ± 0.02 (numerical) ± 0.4 (windows) g/s"."""
    value, numerical, scattered, _ = cells_of(average, scale)
    return f"{value} ± {numerical} (numerical) ± {scattered} (windows) {scale.unit}".strip()


def count_in_words(count: int, independent: float) -> str:
    """The number of windows, such as "20 windows, worth 17 independent ones"."""
    worth = f", worth {independent:.3g} independent ones" if independent < count - 0.05 else ""
    return f"{count} windows{worth}"


def _plain(value: float, count: int) -> str:
    """A value with some digits, without a power of ten below a million."""
    return f"{float(f'{value:.{count}g}'):.6g}".replace("-", "−")
