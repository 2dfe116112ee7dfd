"""Numbers at logarithmic axes: plain ones, and powers of ten alone where an axis has many decades."""

import math

import numpy as np
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogFormatterMathtext, NullFormatter

MINOR = (2, 5)
"""Multiples of a power of ten that have a number on an axis with fewer than two powers of ten."""

MOST_PLAIN = 5
"""Largest number of powers of ten on an axis that are written as plain numbers."""


def plain_logarithmic(*axes: Axis) -> None:
    """Write the numbers at logarithmic axes as 0.1, 10 or 200, and as powers where an axis has many powers of ten.

    Numbers between powers of ten stand only on axes with fewer than two of these.
    """
    for axis in axes:
        powers = LogFormatterMathtext()
        powers.set_axis(axis)

        def at_power(value: float, _place: object, axis: Axis = axis, powers: LogFormatterMathtext = powers) -> str:
            return f"{value:g}" if _powers_of_ten(axis) <= MOST_PLAIN else str(powers(value))

        def between(value: float, _place: object, axis: Axis = axis) -> str:
            multiple = round(value / 10.0 ** math.floor(math.log10(value) + 1e-9))
            return f"{value:g}" if _powers_of_ten(axis) < 2 and multiple in MINOR else ""

        axis.set_major_formatter(FuncFormatter(at_power))
        axis.set_minor_formatter(FuncFormatter(between))


def _powers_of_ten(axis: Axis) -> int:
    """The number of powers of ten in the range of a logarithmic axis."""
    low, high = np.log10(sorted(axis.get_view_interval()))
    return int(np.floor(high + 1e-9) - np.ceil(low - 1e-9)) + 1


def whole_decades(*axes: Axis) -> None:
    """Write the powers of ten alone at logarithmic axes, each of which shows two of them at least."""
    for axis in axes:
        low, high = np.log10(axis.get_view_interval())
        if np.floor(high) - np.ceil(low) < 1:
            axis.set_view_interval(10 ** np.floor(low), 10 ** max(np.ceil(high), np.floor(low) + 1), ignore=True)
        axis.set_minor_formatter(NullFormatter())
