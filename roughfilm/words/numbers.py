"""Numbers as people write them: with an error, such as 98 ± 13 and 0.0214 ± 0.0003, in per cent, in a unit."""

import math

from roughfilm.contact.foundation.units import Quantity

PLAIN, FINEST = 3, 1e-6
"""Digits of a value without an error; errors below this part of the value are left out."""

GREATEST = 1e6
"""From this number on, and below its inverse, powers of ten are written."""

LEADING = 2.0
"""Below this mantissa an error has two digits, else one."""


def with_error(value: float, error: float | None) -> str:
    """The value to the digits that its error leaves; "± ?" where the error is not known, as it is not finite.

    Without an error, or with one that does not count, the value to three digits.

    Examples
    --------
    >>> with_error(97.77, 13.2), with_error(0.02142, 0.00034), with_error(5.27, math.inf)
    ('98 ± 13', '0.0214 ± 0.0003', '5.27 ± ?')
    """
    if error is not None and not math.isfinite(error):
        return f"{value:.{PLAIN}g} ± ?"
    if not error or not math.isfinite(value) or error < FINEST * abs(value):
        return f"{value:.{PLAIN}g}"
    mantissa, power = f"{error:.1e}".split("e")
    last = int(power) - (float(mantissa) < LEADING)
    size = max(abs(value), error)
    if not 1 / GREATEST <= size < GREATEST:
        shift = math.floor(math.log10(size))
        return (
            f"({_rounded(value / 10.0**shift, last - shift)} ± {_rounded(error / 10.0**shift, last - shift)})e{shift}"
        )
    return f"{_rounded(value, last)} ± {_rounded(error, last)}"


def _rounded(value: float, last: int) -> str:
    """To the digit of 10 to the ``last``."""
    return f"{round(value, -last):.{max(-last, 0)}f}"


def digits(value: float) -> str:
    """Four digits, and no power of ten below a million."""
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e6 else f"{value:.4g}"


def finite(value: float) -> float | None:
    """The number as JSON can hold it: None where it is infinite or NaN."""
    return float(value) if math.isfinite(value) else None


def percent(part: float) -> str:
    """A part with its sign ("−" for minus), in per cent."""
    percent = 100 * part
    if abs(percent) < 1e-3:
        return "0 %"
    text = f"{percent:+.0f} %" if abs(percent) >= 99.5 else f"{percent:+.2g} %"
    return text.replace("-", "−")


def in_unit(quantity: Quantity) -> tuple[str, str]:
    """A quantity as people read it: its number, and its unit."""
    if quantity.unit == "m":
        return f"{quantity.value * 1e6:.4g}", "µm"
    return f"{quantity.value:.4g}", "" if quantity.unit == "1" else quantity.unit
