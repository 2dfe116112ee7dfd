"""Numbers at logarithmic axes, without powers of ten."""

import math

from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter

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
