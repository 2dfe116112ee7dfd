"""Numbers as text: with an uncertainty, such as 98 ± 13 and 0.0214 ± 0.0003, in per cent, or in a unit."""

import math
from collections.abc import Mapping
from typing import Any

from roughfilm.contact.foundation.rounding import MIN_UNCERTAINTY as MIN_UNCERTAINTY
from roughfilm.contact.foundation.rounding import share as share
from roughfilm.contact.foundation.rounding import with_error as with_error
from roughfilm.contact.foundation.units import Quantity

SURFACE_UNITS: Mapping[str, tuple[float, str]] = {
    "m": (1e-6, "µm"),
    "1/m": (1e3, "1/mm"),
    "1/m^2": (1e6, "1/mm²"),
    "1": (1.0, ""),
}
"""The unit in which roughness parameters of each SI unit are shown, and its size."""


def digits(value: float) -> str:
    """A value to four digits, without a power of ten below a million."""
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e6 else f"{value:.4g}"


def finite(value: float) -> float | None:
    """The number as JSON can hold it: None where it is infinite or NaN."""
    return float(value) if math.isfinite(value) else None


def finite_entries(entry: Any) -> Any:
    """The entries as JSON can hold them: None in place of each number that is infinite or NaN, at any depth."""
    if isinstance(entry, Mapping):
        return {name: finite_entries(one) for name, one in entry.items()}
    if isinstance(entry, list | tuple):
        return [finite_entries(one) for one in entry]
    return finite(entry) if isinstance(entry, float) else entry


def percent(fraction: float) -> str:
    """A fraction with its sign ("−" for minus), in per cent."""
    percent = 100 * fraction
    if abs(percent) < 1e-3:
        return "0 %"
    text = f"{percent:+.0f} %" if abs(percent) >= 99.5 else f"{percent:+.2g} %"
    return text.replace("-", "−")


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
    """The number and unit of a quantity for people: lengths in µm, curvatures and densities per mm and mm²."""
    scale, unit = SURFACE_UNITS.get(quantity.unit, (1.0, quantity.unit))
    return f"{quantity.value / scale:.4g}", unit
