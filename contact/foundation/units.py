"""Conversion between text with units ("30 um", "0.01 Pa*s") and SI numbers, and quantities of results."""

import difflib
import math
import re
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.rounding import with_error

if TYPE_CHECKING:
    import pint

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?)\s*(.*?)\s*")
_NONZERO = re.compile(r"[-+0.]*[1-9]")
_COMMA = re.compile(r"\s*([-+]?\d[\d.]*,[\d.,]*\d(?:[eE][-+]?\d{1,3})?)\s*(.*?)\s*")
_POWER_OF_TEN = re.compile(r"([x×*·]\s*10)?\s*(?:\^|\*\*)\s*([-+]?\d{1,3}+)(?!\s*[*^])\s*(.*)")
_UNIT = re.compile(r"(?:[A-Za-z%*/ ()]|\^-?\d(?!\d)){1,40}")


_TERM = re.compile(r"( *[*/] *| +|^)([A-Za-zµμ%]+)(?:(?:\^|\*\*)(-?\d))?")

_SPELLINGS = (
    (re.compile("[µμ]"), "u"),
    (re.compile(r"\*\*"), "^"),
    (re.compile("·"), "*"),
    (re.compile("°([CF])"), r"deg\1"),
    (re.compile("°"), "deg"),
    (re.compile("⁻"), "-"),
    (re.compile("¹"), "1"),
    (re.compile("²"), "2"),
    (re.compile("³"), "3"),
    (re.compile("^U/min$"), "rpm"),
    (re.compile(r"(?<=[A-Za-z])(-?\d)(?!\d)"), r"^\1"),
    (re.compile(r"(?<=[A-Za-z\d])\.(?=[A-Za-z])"), "*"),
    (re.compile(r"^1 ?/"), "/"),
)
"""Other ways to write a unit, in the order in which they are replaced: "mm²" and "mm2" are "mm^2"."""

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
    "rev": (1.0, {"turn": 1}),
    "rpm": (1.0, {"turn": 1, "min": -1}),
    "bar": (1e5, {"Pa": 1}),
    "Pas": (1.0, {"Pa": 1, "s": 1}),
    "P": (0.1, {"Pa": 1, "s": 1}),
    "St": (1.0, {"cm": 2, "s": -1}),
    "grain": (64.79891, {"mg": 1}),
    "lb": (7000.0, {"grain": 1}),
    "lbf": (9.80665, {"m": 1, "s": -2, "lb": 1}),
    "yd": (0.9144, {"m": 1}),
    "inch": (1 / 36, {"yd": 1}),
    "in": (1.0, {"inch": 1}),
    "mil": (1e-3, {"inch": 1}),
    "psi": (1.0, {"lbf": 1, "inch": -2}),
    "ksi": (1e3, {"psi": 1}),
}
"""Each unit as a factor times a product of powers of other units, which is empty for a base unit.

The factors agree with those of the library pint to the last bit. Two names differ: for pint "mil" is an angle, and
"Pas" the plural of pascal.
"""

_ANGLES = frozenset({"rad", "deg", "turn", "rev", "rpm", "π"})
"""Units whose presence makes a rotational speed one in angles per time; without them it counts revolutions."""

_CELSIUS, ZERO_CELSIUS = "degC", 273.15
_OTHER_CELSIUS = ("c", "deg", "deg c", "celsius", "centigrade")
_FAHRENHEIT = ("f", "degf", "deg f", "fahrenheit")
"""Units of a temperature that are not taken, in small letters."""

_MEANINGS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "m": ("a length", ("um", "mm", "m", "nm", "cm", "km", "in", "mil")),
    "Pa": ("a pressure", ("MPa", "kPa", "Pa", "GPa", "bar", "psi", "ksi", "N/mm^2")),
    "Pa*s": ("a viscosity", ("mPa*s", "Pa*s", "cP", "mPas", "cSt")),
    "kg/m^3": ("a density", ("kg/m^3", "g/cm^3")),
    "m/s": ("a speed", ("m/s", "mm/s", "km/h", "rpm")),
    "rad": ("an angle", ("deg", "rad")),
    "rad/s": ("a rotational speed", ("rpm", "rad/s", "Hz", "1/min")),
    "m^2/s": ("a kinematic viscosity", ("cSt", "mm^2/s")),
    "Pa^-1": ("a pressure coefficient", ("1/GPa", "1/Pa")),
    "Pa/m": ("a pressure gradient", ("MPa/mm", "Pa/m", "bar/mm")),
    "N": ("a force", ("N", "kN", "lbf")),
    "N/m": ("a force per width", ("N/m", "N/mm", "kN/m")),
    "m^3/s": ("a flow", ("l/min", "ml/min", "m^3/s")),
    "s": ("a time", ("s", "min", "h")),
    "kg": ("a mass", ("kg", "g")),
    "kg*m": ("an unbalance", ("g*mm", "kg*m")),
    "kg*m^2": ("a moment of inertia", ("kg*mm^2", "kg*m^2")),
    "K": ("a temperature", ("degC", "K")),
    "K^-1": ("a rate over temperature", ("1/K",)),
    "W/(m*K)": ("a thermal conductivity", ("W/(m*K)",)),
    "W/(m^2*K)": ("a heat transfer coefficient", ("W/(m^2*K)",)),
    "J/(kg*K)": ("a heat capacity", ("J/(kg*K)", "kJ/(kg*K)")),
    "m^2": ("an area", ("mm^2", "m^2")),
    "W": ("a power", ("W", "kW")),
    "%": ("a percentage", ("%",)),
}
"""The quantity that each SI unit measures, and common units of it, for messages."""

_REMEDIES = {
    ("Pa*s", "m^2/s"): "add the key density beside it, or write mPa*s",
    ("m/s", "rad/s"): "no wall rotates here, write the sliding speed, in m/s",
    ("Pa*s", "K"): "write the viscosity at that temperature, in mPa*s",
    ("Pa", "N"): "divide the force by the area, and write MPa or Pa",
}
"""The remedy for a unit of one quantity (second) where another is wanted (first)."""

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
    asked, wanted = _powers(unit), _powers(base)
    return _by_pint(unit, base) if asked is None or wanted is None else _by_table(asked, wanted)


def _spelled(unit: str) -> str:
    """A unit in the spelling of the table: "mm^2/s" for "mm²/s", and "/Pa" for "1/Pa"."""
    for found, written in _SPELLINGS:
        unit = found.sub(written, unit)
    return unit


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
        parsed = _registry().parse_units(unit if unit[0] not in "*/" else f"1{unit}")
        zero, one = (float(_registry().Quantity(value, parsed).to(base).magnitude) for value in (0.0, 1.0))
    except DimensionalityError:
        return None
    except Exception as error:  # pint raises tokenizer, attribute and type errors alike for text that is no unit
        raise ValueError(f"got unit {unit!r}, which is not known") from error
    if zero != 0:
        raise ValueError(f"got unit {unit!r}, whose zero is not that of {base}")
    return one


class SiNumber(float):
    """A number in SI units, which stands where a text with a unit is asked."""


class SiInteger(int):
    """A whole number in SI units, which stands where a text with a unit is asked."""


def in_si(entry: Any) -> Any:
    """The entry with every number in it, also in tables and lists, marked as one in SI units.

    Tables, lists and arrays become dicts and lists. All else is left as it is.

    Examples
    --------
    >>> to_si(in_si(7.5e-6), "m")
    7.5e-06
    >>> in_si({"size": (1, 2.5), "kind": "sinusoid"})
    {'size': [1, 2.5], 'kind': 'sinusoid'}
    """
    if isinstance(entry, Mapping):
        return {key: in_si(value) for key, value in entry.items()}
    if isinstance(entry, list | tuple):
        return [in_si(value) for value in entry]
    if isinstance(entry, bool | str):
        return entry
    if isinstance(entry, Integral):
        return SiInteger(entry)
    if isinstance(entry, Real):
        return SiNumber(entry)
    return in_si(entry.tolist()) if hasattr(entry, "tolist") else entry


def to_si(text: object, base: str) -> float:
    """Convert a text such as "10 mPa*s" to a number in the SI unit ``base``, for example "Pa*s".

    The text must be a decimal number followed by a unit; expressions are not evaluated. A number that :func:`in_si`
    marks is one in ``base`` already.

    Raises
    ------
    ValueError
        If the text has another form, the unit is unknown or has another dimension, or the number is not in the range of
        :data:`roughfilm.contact.foundation.ranges.RANGES`. The message gives the input and the remedy.

    Examples
    --------
    >>> to_si("30 um", "m")
    3e-05
    >>> to_si("36 km/h", "m/s")
    10.0
    >>> to_si("0.875 g/cm3", "kg/m^3")
    875.0
    >>> to_si(0.03, "m")
    Traceback (most recent call last):
    ...
    ValueError: got 0.03, a number without a unit; write for example '0.03 m' or '0.03 um'
    >>> to_si("7,5 um", "m")
    Traceback (most recent call last):
    ...
    ValueError: got '7,5 um', with a comma; write '7.5 um'
    """
    return _in_range(converted(text, base), text, base)


def converted(text: object, base: str) -> float:
    """The number that :func:`to_si` gives, which may be out of range; ValueError for a text of another form."""
    if isinstance(text, SiNumber | SiInteger):
        return _as_float(text)
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise ValueError(f"got {_brief(text)}; write a number and a unit, {_example(base)}")
    if isinstance(text, float) and not math.isfinite(text):
        raise ValueError(f"got {_brief(text)}; write a finite number and a unit, {_example(base)}")
    if isinstance(text, int | float):
        raise ValueError(f"got {_brief(text)}, a number without a unit; {_with_units(_brief(text), base)}")
    number, unit = _number_and_unit(text, base)
    if base == "K":
        _check_degrees(text, float(number), unit)
    factor = _scale(text, number, unit, base)
    if factor is None:
        raise ValueError(_wrong_dimension(text, unit, base))
    # Dividing by an exact power of ten keeps "30 um" at 3e-05, where multiplying by 1e-06 would not.
    times = factor >= 1
    whole = round(factor if times else 1 / factor)
    if not math.isclose(factor if times else 1 / factor, whole, rel_tol=1e-12):
        value = float(number) * factor
    else:
        value = float(number) * whole if times else float(number) / whole
    value += ZERO_CELSIUS if unit == _CELSIUS else 0.0
    # A number that rounds to zero is as small as one can be, and not the zero that a key may allow.
    return value if value or not _NONZERO.match(number) else sys.float_info.min


def rotational_speed(text: object) -> float | None:
    """The rotational speed of a text such as "3000 rpm", rad/s; None if it is not one.

    "50 Hz", "50 1/s" and "3000 1/min" count revolutions, "5 rad/s" and "300 deg/s" angles.

    Examples
    --------
    >>> [round(rotational_speed(text), 3) for text in ("3000 rpm", "50 Hz", "5 rad/s")]
    [314.159, 314.159, 5.0]
    >>> rotational_speed("5 m/s") is None
    True
    """
    try:
        value = converted(text, "rad/s") if isinstance(text, str) else None
    except ValueError:
        return None
    if value is None:
        return None
    names = _powers(_number_and_unit(str(text), "rad/s")[1])
    counts = names is not None and not any(name in _ANGLES or name[1:] in _ANGLES for name in names)
    return 2 * math.pi * value if counts else value


def dynamic_viscosity(viscosity: object, density: object) -> object:
    """The viscosity in Pa s, as a text, of a kinematic one such as "46 cSt"; the given viscosity if it is none.

    Parameters
    ----------
    viscosity : an entry of a scene.
    density : the density of the liquid, as an entry of a scene; without a valid one nothing is converted.

    Examples
    --------
    >>> dynamic_viscosity("46 cSt", "870 kg/m^3"), dynamic_viscosity("10 mPa*s", None)
    ('0.04002 Pa*s', '10 mPa*s')
    """
    try:
        kinematic = converted(viscosity, "m^2/s") if isinstance(viscosity, str) else None
        return viscosity if kinematic is None else with_unit(kinematic * to_si(density, "kg/m^3"), "Pa*s")
    except ValueError:
        return viscosity


def _number_and_unit(text: str, base: str) -> tuple[str, str]:
    """The number of a text and its unit in the spelling of the table; ValueError for a text of another form."""
    if len(text) > 80:
        raise ValueError(f"got {_brief(text)}; write a number and a unit, {_example(base)}")
    if comma := _COMMA.fullmatch(text):
        raise ValueError(f"got {text!r}, with a comma; {_without_comma(comma[1], comma[2], base)}")
    match = _NUMBER.fullmatch(text)
    if match is None:
        raise ValueError(f"got {_brief(text)}; write a number and a unit, {_example(base)}")
    number, unit = match.groups()
    if not unit:
        raise ValueError(f"got {text!r}, a number without a unit; {_with_units(number, base)}")
    if (power := _POWER_OF_TEN.fullmatch(unit)) and (power[1] or number == "10"):
        times = number if power[1] else "1"
        raise ValueError(f"got {text!r}; write a power of ten as '{times}e{int(power[2])} {power[3] or base}'")
    if groups := re.match(r"(\d{3} ?)+(?!\d)", unit):
        whole = number + groups[0].replace(" ", "")
        raise ValueError(f"got {text!r}, with a space in the number; write '{whole} {unit[groups.end() :] or base}'")
    return number, _spelled(unit)


def _scale(text: str, number: str, unit: str, base: str) -> float | None:
    """The number of ``base`` units in one ``unit``; None if the dimensions differ; ValueError for an unknown unit."""
    if unit in (_CELSIUS, "%"):
        return 1.0 if (unit, base) in ((_CELSIUS, "K"), ("%", "%")) else None
    try:
        if _UNIT.fullmatch(unit) is not None and unit != "u":
            return _factor(unit, base)
    except ValueError:
        pass
    quantity, usual = _MEANINGS.get(base, ("a number", (base,)))
    near = _spelled_otherwise(unit, usual) or [
        one for one in usual if one.lower() in difflib.get_close_matches(unit.lower(), [one.lower() for one in usual])
    ]
    remedy = f"did you mean '{number} {near[0]}'?" if near else f"write {quantity}, in {_either(usual)}"
    raise ValueError(f"got {_brief(text)}, whose unit is not known; {remedy}")


def _check_degrees(text: str, number: float, unit: str) -> None:
    """Raise ValueError for a temperature in Fahrenheit, and for degrees Celsius with another name."""
    if unit.lower() in _FAHRENHEIT:
        raise ValueError(f"got {text!r}, a temperature in Fahrenheit; write '{(number - 32) / 1.8:.6g} degC'")
    if unit.lower() in _OTHER_CELSIUS:
        raise ValueError(f"got {text!r}, which is not a temperature; did you mean '{number:g} degC'?")


def _spelled_otherwise(unit: str, usual: Sequence[str]) -> list[str]:
    """The usual units that differ from a unit by capital letters, or by parentheses and signs of products, alone."""
    bare = {one: re.sub(r"[*^() ]", "", _spelled(one)) for one in (unit, *usual)}
    alike = [one for one in usual if bare[one].lower() == bare[unit].lower() and _spelled(one) != unit]
    return sorted(alike, key=lambda one: bare[one] != bare[unit])


def _wrong_dimension(text: str, unit: str, base: str) -> str:
    """The message on a unit of another quantity than that of ``base``."""
    quantity, usual = _MEANINGS.get(base, ("a number", (base,)))
    if near := _spelled_otherwise(unit, usual):
        return (
            f"got {text!r}, which has the wrong dimension; did you mean '{_number_and_unit(text, base)[0]} {near[0]}'?"
        )
    other = next((one for one in _MEANINGS if _scale(text, "1", unit, one) is not None), None)
    meaning = f" ({_MEANINGS[other][0]})" if other else ""
    remedy = _REMEDIES.get((base, other or ""), f"write {quantity}, in {_either(usual)}")
    return f"got {text!r}, which has the wrong dimension{meaning}; {remedy}"


def _without_comma(number: str, unit: str, base: str) -> str:
    """The remedy for a number with commas; where a comma may separate thousands too, both ways to write it."""
    whole, _, decimals = number.rpartition(",")
    if "." in decimals or "," in whole:
        ways = [number.replace(",", "")]
    elif len(decimals) == 3 and "." not in whole:
        ways = [f"{whole}.{decimals}", whole + decimals]
    else:
        ways = [f"{whole.replace('.', '')}.{decimals}"]
    return "write " + " or ".join(f"'{way} {unit or base}'" for way in ways)


def _with_units(number: str, base: str) -> str:
    """The remedy for a number without a unit."""
    usual = _MEANINGS.get(base, ("", ()))[1][:1]
    return "write for example " + " or ".join(dict.fromkeys(f"'{number} {unit}'" for unit in (base, *usual)))


def _example(base: str) -> str:
    return f"for example '1 {_MEANINGS.get(base, ('', (base,)))[1][0]}'"


def _either(units: Sequence[str]) -> str:
    """The first three units, in a sentence."""
    *others, last = units[:3]
    return f"{', '.join(others)} or {last}" if others else last


def _as_float(number: float) -> float:
    """The nearest float; infinite for a whole number beyond all floats."""
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


def _in_range(value: float, text: object, base: str) -> float:
    """The number if it is in the range of its unit; ValueError otherwise."""
    allowed = RANGES.get(base)
    if math.isfinite(value) and (allowed is None or value in allowed):
        return value
    if allowed is None or math.isnan(value):
        raise ValueError(f"got {_brief(text)}, which is not finite; write a finite number")
    quantity = _MEANINGS[base][0]
    raise ValueError(f"got {_brief(text)}; {quantity} must be {allowed} {base}, check the unit")


def is_unit(word: str) -> bool:
    """Whether a word is a known unit of any dimension.

    Examples
    --------
    >>> is_unit("um"), is_unit("width")
    (True, False)
    """
    try:
        _factor(_spelled(word), "m")
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
