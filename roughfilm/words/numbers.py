"""Numbers as text: with an uncertainty, such as 98 ± 13 and 0.0214 ± 0.0003, in per cent, or in a unit."""

import math

from roughfilm.contact.foundation.units import Quantity

DIGITS = 3
"""Digits of a value without an uncertainty."""

MIN_UNCERTAINTY = 1e-6
"""Uncertainties below this fraction of the value are left out."""

POWER_LIMIT = 1e6
"""From this number on, and below its inverse, powers of ten are written."""

TWO_DIGIT_MANTISSA = 2.0
"""An uncertainty has two digits below this mantissa, else one."""


def with_error(value: float, uncertainty: float | None) -> str:
    """A value with its uncertainty, to the digits that the uncertainty leaves; "± ?" if the uncertainty is not finite.

    A value without an uncertainty, or with a negligible one, has three digits.

    Examples
    --------
    >>> with_error(97.77, 13.2), with_error(0.02142, 0.00034), with_error(5.27, math.inf)
    ('98 ± 13', '0.0214 ± 0.0003', '5.27 ± ?')
    """
    if uncertainty is not None and not math.isfinite(uncertainty):
        return f"{value:.{DIGITS}g} ± ?"
    if not uncertainty or not math.isfinite(value) or uncertainty < MIN_UNCERTAINTY * abs(value):
        return f"{value:.{DIGITS}g}"
    mantissa, exponent = f"{uncertainty:.1e}".split("e")
    last = int(exponent) - (float(mantissa) < TWO_DIGIT_MANTISSA)
    size = max(abs(value), uncertainty)
    if not 1 / POWER_LIMIT <= size < POWER_LIMIT:
        power = math.floor(math.log10(size))
        parts = [_rounded(number / 10.0**power, last - power) for number in (value, uncertainty)]
        return f"({' ± '.join(parts)})e{power}"
    return f"{_rounded(value, last)} ± {_rounded(uncertainty, last)}"


def _rounded(value: float, last: int) -> str:
    """A value rounded to 10 to the power of ``last``."""
    return f"{round(value, -last):.{max(-last, 0)}f}"


def digits(value: float) -> str:
    """A value to four digits, without a power of ten below a million."""
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e6 else f"{value:.4g}"


def finite(value: float) -> float | None:
    """The number as JSON can hold it: None where it is infinite or NaN."""
    return float(value) if math.isfinite(value) else None


def percent(fraction: float) -> str:
    """A fraction with its sign ("−" for minus), in per cent."""
    percent = 100 * fraction
    if abs(percent) < 1e-3:
        return "0 %"
    text = f"{percent:+.0f} %" if abs(percent) >= 99.5 else f"{percent:+.2g} %"
    return text.replace("-", "−")


def share(fraction: float) -> str:
    """A fraction without sign, in per cent."""
    percent = 100 * fraction
    return f"{percent:.0f} %" if percent >= 99.5 else f"{percent:.2g} %"


def span(least: float | None, largest: float | None) -> str:
    """The interval between two fractions in per cent; None stands for an unknown end.

    Examples
    --------
    >>> span(0.0042, 0.021), span(0.0123, 0.01231), span(0.0, None)
    ('0.42–2.1 %', '1.2 %', 'unknown')
    """
    if least is None or largest is None:
        return "unknown"
    ends = share(least), share(largest)
    return ends[0] if ends[0] == ends[1] else f"{ends[0].removesuffix(' %')}–{ends[1]}"


def in_unit(quantity: Quantity) -> tuple[str, str]:
    """The number and unit of a quantity for people: lengths in µm."""
    if quantity.unit == "m":
        return f"{quantity.value * 1e6:.4g}", "µm"
    return f"{quantity.value:.4g}", "" if quantity.unit == "1" else quantity.unit
