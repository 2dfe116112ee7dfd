"""Conversion between text with units ("30 um", "0.01 Pa*s") and SI numbers, and quantities of results."""

import math
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from roughfilm.contact.foundation.rounding import with_error

if TYPE_CHECKING:
    import pint

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?)\s*(.*?)\s*")
_UNIT = re.compile(r"(?:[A-Za-zµμ°·/* ()]|(?:\^|\*\*)-?\d(?!\d)){1,40}")


_TERM = re.compile(r"( *[*/] *| +|^)([A-Za-zµμ]+)(?:(?:\^|\*\*)(-?\d))?")

_UNITS: Mapping[str, tuple[float, Mapping[str, int]]] = {
    **{base: (1.0, {}) for base in ("m", "s", "g", "K", "rad")},
    "N": (1.0, {"kg": 1, "m": 1, "s": -2}),
    "Pa": (1.0, {"N": 1, "m": -2}),
    "J": (1.0, {"N": 1, "m": 1}),
    "W": (1.0, {"J": 1, "s": -1}),
    "Hz": (1.0, {"s": -1}),
    "min": (60.0, {"s": 1}),
    "h": (60.0, {"min": 1}),
    "l": (1.0, {"dm": 3}),
    "π": (math.pi, {"rad": 1}),
    "deg": (1 / 180, {"π": 1}),
    "turn": (2.0, {"π": 1}),
    "rpm": (1.0, {"turn": 1, "min": -1}),
    "bar": (1e5, {"Pa": 1}),
    "P": (0.1, {"Pa": 1, "s": 1}),
    "St": (1.0, {"cm": 2, "s": -1}),
    "grain": (64.79891, {"mg": 1}),
    "lb": (7000.0, {"grain": 1}),
    "lbf": (9.80665, {"m": 1, "s": -2, "lb": 1}),
    "yd": (0.9144, {"m": 1}),
    "inch": (1 / 36, {"yd": 1}),
    "psi": (1.0, {"lbf": 1, "inch": -2}),
}
"""Each unit as a factor times a product of powers of other units, which is empty for a base unit.

The factors agree with those of the library pint to the last bit.
"""

_PREFIXES = {
    "f": 1e-15,
    "p": 1e-12,
    "n": 1e-9,
    "u": 1e-6,
    "m": 1e-3,
    "c": 1e-2,
    "d": 1e-1,
    "k": 1e3,
    "M": 1e6,
    "G": 1e9,
    "T": 1e12,
}


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its unit.

    Attributes
    ----------
    value : number, in the unit.
    unit : text such as "Pa*s"; "1" for a dimensionless number.
    uncertainty : half width of the interval that covers the true value in 95 of 100 cases, in the same unit; None if
        it is unknown.

    Examples
    --------
    >>> load = Quantity(value=120.0, unit="N", uncertainty=3.0)
    >>> print(load)
    120 ± 3 N
    """

    value: float
    unit: str
    uncertainty: float | None = None

    def __str__(self) -> str:
        """The value with its uncertainty, to the digits that this leaves, and the unit."""
        return with_error(self.value, self.uncertainty) + (f" {self.unit}" if self.unit != "1" else "")


@cache
def _registry() -> "pint.UnitRegistry[float]":
    import pint

    return pint.UnitRegistry()


@cache
def _factor(unit: str, base: str) -> float | None:
    """The number of ``base`` units in one ``unit``; None if the dimensions differ; ValueError for an unknown unit."""
    unit = unit.replace("·", "*")
    asked, wanted = _powers(unit), _powers(base)
    return _by_pint(unit, base) if asked is None or wanted is None else _by_table(asked, wanted)


def _powers(text: str) -> dict[str, int] | None:
    """The power of each unit in a product such as "N*s/m^2"; None if a unit is not in the table."""
    powers: dict[str, int] = {}
    end = 0
    while end < len(text):
        term = _TERM.match(text, end)
        if term is None:
            return None
        sign, name, power = term.groups()
        name = name.replace("µ", "u").replace("μ", "u")
        if name not in _UNITS and (name[0] not in _PREFIXES or name[1:] not in _UNITS):
            return None
        powers[name] = powers.get(name, 0) + (-1 if "/" in sign else 1) * int(power or 1)
        if not powers[name]:
            del powers[name]
        end = term.end()
    return powers


def _by_table(asked: Mapping[str, int], wanted: Mapping[str, int]) -> float | None:
    """The factor as pint computes it: the powers of all scales, those of the numerator first."""
    above, below, dimensions = Counter[float](), Counter[float](), Counter[str]()

    def add(units: Mapping[str, int], times: int) -> None:
        for name, power in units.items():
            scale, others = _UNITS.get(name) or (_PREFIXES[name[0]], {name[1:]: 1})
            if not others:
                dimensions[name] += times * power
            elif times * power > 0:
                above[scale] += times * power
            else:
                below[scale] -= times * power
            add(others, times * power)

    ratio = dict(asked)
    for name, power in wanted.items():
        ratio[name] = ratio.get(name, 0) - power
        if not ratio[name]:
            del ratio[name]
    add(ratio, 1)
    if any(power for name, power in dimensions.items() if name != "rad"):
        return None
    factor = 1.0
    for scale, power in above.items():
        factor *= scale ** max(power - below[scale], 0)
    for scale, power in below.items():
        factor *= scale ** -max(power - above[scale], 0)
    return factor


def _by_pint(unit: str, base: str) -> float | None:
    from pint import DimensionalityError  # slow to import, and few units need it

    try:
        parsed = _registry().parse_units(unit)
        return float(_registry().Quantity(1.0, parsed).to(base).magnitude)
    except DimensionalityError:
        return None
    except Exception as error:  # pint raises tokenizer, attribute and type errors alike for text that is no unit
        raise ValueError(f"got unit {unit!r}, which is not known; write for example '1 {base}'") from error


def to_si(text: object, base: str) -> float:
    """Convert a text such as "10 mPa*s" to a number in the SI unit ``base``, for example "Pa*s".

    The text must be a decimal number followed by a unit; expressions are not evaluated.

    Raises
    ------
    ValueError
        If the text has another form, the unit is unknown or has another dimension, or the number is not finite. The
        message gives the input and a correct example.

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
    """Whether a word is a known unit of any dimension.

    Examples
    --------
    >>> is_unit("um"), is_unit("width")
    (True, False)
    """
    try:
        _factor(word, "m")
    except ValueError:
        return False
    return True


def with_unit(value: float, base: str) -> str:
    """The text of a number in the SI unit ``base``, which ``to_si`` reads back without rounding.

    Examples
    --------
    >>> with_unit(3e-05, "m")
    '3e-05 m'
    """
    return f"{value!r} {base}"


def _brief(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
