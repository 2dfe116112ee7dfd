"""Numbers as text, to the digits that their uncertainty leaves."""

import math
import sys

DIGITS = 3
"""Digits of a value without an uncertainty."""

MIN_UNCERTAINTY = 1e-6
"""Uncertainties below this fraction of the value are left out."""

POWER_LIMIT = 1e6
"""From this number on, and below its inverse, powers of ten are written."""

MIN_PLAIN_UNCERTAINTY = 1e-3
"""Smallest uncertainty that is written without a power of ten behind a value of zero."""

TWO_DIGIT_MANTISSA = 2.0
"""An uncertainty has two digits below this mantissa, else one."""


def round_off(size: float, count: int) -> float:
    """The round-off of a sum of ``count`` parts, whose sizes add up to ``size``: size times count times epsilon."""
    return size * count * sys.float_info.epsilon


def with_error(value: float, uncertainty: float | None) -> str:
    """A value with its uncertainty, to the digits that the uncertainty leaves; "± ?" if the uncertainty is not finite.

    A value without an uncertainty, or with a negligible one, has three digits. A value that is zero within a small
    uncertainty is 0.

    Examples
    --------
    >>> with_error(97.77, 13.2), with_error(0.02142, 0.00034), with_error(5.27, math.inf), with_error(-1e-9, 6e-6)
    ('98 ± 13', '0.0214 ± 0.0003', '5.27 ± ?', '0 ± 6e-6')
    """
    if uncertainty is not None and not math.isfinite(uncertainty):
        return f"{value:.{DIGITS}g} ± ?"
    if not uncertainty or not math.isfinite(value) or uncertainty < MIN_UNCERTAINTY * abs(value):
        return f"{value:.{DIGITS}g}"
    mantissa, exponent = f"{uncertainty:.1e}".split("e")
    last = int(exponent) - (float(mantissa) < TWO_DIGIT_MANTISSA)
    if uncertainty < MIN_PLAIN_UNCERTAINTY and round(value, -last) == 0:
        return f"0 ± {_rounded(uncertainty / 10.0 ** int(exponent), last - int(exponent))}e{int(exponent)}"
    size = max(abs(value), uncertainty)
    if not 1 / POWER_LIMIT <= size < POWER_LIMIT:
        power = math.floor(math.log10(size))
        parts = [_rounded(number / 10.0**power, last - power) for number in (value, uncertainty)]
        return f"({' ± '.join(parts)})e{power}"
    return f"{_rounded(value, last)} ± {_rounded(uncertainty, last)}"


def share(fraction: float) -> str:
    """A fraction without sign in per cent, with two digits below 100 %; "unknown" if it is not finite.

    Examples
    --------
    >>> share(0.0123), share(0.25), share(2.52), share(math.inf)
    ('1.2 %', '25 %', '252 %', 'unknown')
    """
    if not math.isfinite(fraction):
        return "unknown"
    percent = 100 * fraction
    return f"{percent:.0f} %" if percent >= 99.5 else f"{percent:.2g} %"


def _rounded(value: float, last: int) -> str:
    """A value rounded to 10 to the power of ``last``, without a sign before zero."""
    return f"{round(value, -last) + 0.0:.{max(-last, 0)}f}"
