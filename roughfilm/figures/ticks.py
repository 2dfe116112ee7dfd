"""Numbers at logarithmic axes: plain ones, and powers of ten alone where an axis has many decades."""

import math

import numpy as np
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, NullFormatter

MINOR = (2, 5)
"""Multiples of a power of ten that have a number where an axis is shorter than a decade."""


def plain_logarithmic(*axes: Axis) -> None:
    """Write the numbers at logarithmic axes as 0.1, 10 or 200; between powers of ten only on axes below a decade."""
    for axis in axes:

        def between(value: float, _place: object, axis: Axis = axis) -> str:
            low, high = sorted(axis.get_view_interval())
            multiple = round(value / 10.0 ** math.floor(math.log10(value) + 1e-9))
            return f"{value:g}" if high < 10 * low and multiple in MINOR else ""

        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(FuncFormatter(between))


def whole_decades(*axes: Axis) -> None:
    """Write the powers of ten alone at logarithmic axes, each of which shows two of them at least."""
    for axis in axes:
        low, high = np.log10(axis.get_view_interval())
        if np.floor(high) - np.ceil(low) < 1:
            axis.set_view_interval(10 ** np.floor(low), 10 ** max(np.ceil(high), np.floor(low) + 1), ignore=True)
        axis.set_minor_formatter(NullFormatter())
