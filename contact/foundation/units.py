"""Conversion between text with units ("30 um", "0.01 Pa*s") and SI numbers, and quantities of results."""

import math
import re
from dataclasses import dataclass
from functools import cache

import pint

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?)\s*(.*?)\s*")
_UNIT = re.compile(r"(?:[A-Za-zµμ°·/* ()]|(?:\^|\*\*)-?\d(?!\d)){1,40}")


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its unit ("1" for none).

    ``uncertainty`` is the half width of the interval that covers the truth in 95 of 100 cases, in the same unit; None
    where it is unknown.

    Examples
    --------
    >>> load = Quantity(value=120.0, unit="N", uncertainty=3.0)
    >>> f"{load.value:.0f} ± {load.uncertainty:.0f} {load.unit}"
    '120 ± 3 N'
    """

    value: float
    unit: str
    uncertainty: float | None = None


@cache
def _registry() -> "pint.UnitRegistry[float]":
    return pint.UnitRegistry()


@cache
def _factor(unit: str, base: str) -> float | None:
    """How many ``base`` make one ``unit``; None if the dimensions differ; ValueError if it is no unit."""
    try:
        parsed = _registry().parse_units(unit.replace("·", "*"))
        return float(_registry().Quantity(1.0, parsed).to(base).magnitude)
    except pint.DimensionalityError:
        return None
    except Exception as error:  # pint raises tokenizer, attribute and type errors alike for text that is no unit
        raise ValueError(f"got unit {unit!r}, which is not known; write for example '1 {base}'") from error


def to_si(text: object, base: str) -> float:
    """The number of ``base`` units (SI, for example "Pa*s") in a text such as "10 mPa*s".

    Only a decimal number followed by a unit is read; nothing is evaluated.

    Raises
    ------
    ValueError
        For anything else, with what was got and what to write instead.

    Examples
    --------
    >>> to_si("30 um", "m")
    3e-05
    >>> to_si("36 km/h", "m/s")
    10.0
    >>> to_si(0.03, "m")
    Traceback (most recent call last):
    ...
    ValueError: got 0.03, a number without a unit; write for example '0.03 m'
    """
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise ValueError(f"got {_brief(text)}; write a number and a unit, for example '1 {base}'")
    if isinstance(text, int | float):
        raise ValueError(f"got {_brief(text)}, a number without a unit; write for example '{_brief(text)} {base}'")
    match = _NUMBER.fullmatch(text)
    if match is None or len(text) > 80:
        raise ValueError(f"got {_brief(text)}; write a number and a unit, for example '1 {base}'")
    number, unit = match.groups()
    if not unit:
        raise ValueError(f"got {text!r}, a number without a unit; write for example '{number} {base}'")
    if _UNIT.fullmatch(unit) is None:
        raise ValueError(f"got unit {_brief(unit)}, which is not known; write for example '1 {base}'")
    factor = _factor(unit, base)
    if factor is None:
        raise ValueError(f"got {text!r}, which has the wrong dimension; write for example '{number} {base}'")
    # Dividing by an exact power of ten keeps "30 um" at 3e-05, where multiplying by 1e-06 would not.
    inverse = round(1 / factor) if 0 < factor < 1 else 0
    value = (
        float(number) / inverse
        if inverse and math.isclose(1 / factor, inverse, rel_tol=1e-12)
        else float(number) * factor
    )
    if not math.isfinite(value):
        raise ValueError(f"got {text!r}, which is not finite; write a finite number")
    return value


def is_unit(word: str) -> bool:
    """Whether a word is a unit of anything.

    >>> is_unit("um"), is_unit("width")
    (True, False)
    """
    try:
        _factor(word, "m")
    except ValueError:
        return False
    return True


def with_unit(value: float, base: str) -> str:
    """Text that ``to_si`` reads back to the same bits.

    >>> with_unit(3e-05, "m")
    '3e-05 m'
    """
    return f"{value!r} {base}"


def _brief(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
