"""The unit of each quantity of a page, chosen once from its size, and numbers in it with their uncertainty."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.rounding import with_error
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import Result
from roughfilm.words.units import scale_of

DIGITS = 5
"""Digits of a value whose uncertainty is below the last of them."""

NEGLIGIBLE, NEGLIGIBLE_PLAIN = 1e-6, 1e-9
"""Magnitude over the largest one of its unit, and magnitude of a plain number, below which a number is written as 0."""

PERCENT = (
    "area_fraction",
    "area_fraction_pixel",
    "cavitated_fraction",
    "contact_area",
    "contact_share",
    "plastic_fraction",
)
"""Plain numbers that are shown in per cent."""

MICROMETRES = (1e-8, 1e-3)
"""Lengths that are shown in µm, m."""

PLACES = ("x", "y", "position", "film_min_x", "film_min_y", "temperature_max_x", "temperature_max_y")
"""Lengths that are positions; each has a unit of its own."""


@dataclass(frozen=True, kw_only=True)
class Scale:
    """The unit in which a quantity is shown.

    Attributes
    ----------
    factor : size of the unit in the SI unit.
    unit : name of the unit; empty for a plain number, and a power of ten such as "10⁻⁶" for a small one.
    negligible : magnitude in the SI unit below which a number is written as 0.
    """

    factor: float
    unit: str
    negligible: float = 0.0

    def number(self, value: float, uncertainty: float | None = None) -> str:
        """A value in the SI unit as a number in this one, with its uncertainty, rounded to it.

        An uncertainty that is infinite or NaN is unknown, "± ?". Without an uncertainty, or with one below the last of
        ``DIGITS`` digits, the value has three or ``DIGITS`` digits and stands alone.

        Examples
        --------
        >>> micrometre = Scale(factor=1e-6, unit="µm")
        >>> micrometre.number(4.5819e-6, 1.3e-8), micrometre.number(2e-5, 1e-13), micrometre.number(-3e-6)
        ('4.582 ± 0.013', '20', '−3')
        """
        if not math.isfinite(value):
            return "–"
        value = 0.0 if abs(value) <= self.negligible else value / self.factor
        bar = None if uncertainty is None else uncertainty / self.factor
        if bar is not None and bar < 10.0**-DIGITS * abs(value):
            text = f"{value:.{DIGITS}g}"
        elif value == 0.0 and bar is not None and bar <= self.negligible / self.factor:
            text = "0"
        else:
            text = with_error(value, math.inf if bar is not None and math.isnan(bar) else bar)
        return text.replace("-", "−")

    def text(self, value: float, uncertainty: float | None = None) -> str:
        """A value in the SI unit with its uncertainty and the unit."""
        number = self.number(value, uncertainty)
        times = "× " if self.unit.startswith("10") else ""
        return f"{f'({number})' if times and '±' in number else number} {times}{self.unit}".strip()

    def values(self, values: Array) -> Array:
        """Values in the SI unit as numbers in this one; those near 0 are 0."""
        return np.where(np.abs(values) <= self.negligible, 0.0, values) / self.factor

    def of(self, quantity: Quantity) -> str:
        """A quantity with its uncertainty, which is unknown if it is None, without the unit."""
        return self.number(quantity.value, math.inf if quantity.uncertainty is None else quantity.uncertainty)

    def label(self, title: str) -> str:
        """The label of an axis, a column or a row: the title and the unit."""
        return f"{title}, {self.unit}" if self.unit else title


def scale_for(unit: str, largest: float) -> Scale:
    """The largest unit that is not larger than a magnitude in an SI unit; plain numbers near 0 have none."""
    negligible = max(NEGLIGIBLE * largest, NEGLIGIBLE_PLAIN if unit == "1" else 0.0)
    size = largest if largest > negligible else 0.0
    factor, name = (1e-6, "µm") if unit == "m" and MICROMETRES[0] <= size < MICROMETRES[1] else scale_of(unit, size)
    return Scale(factor=factor, unit=POWERS.get(name, name), negligible=negligible)


POWERS = {"1e-12": "10⁻¹²", "1e-9": "10⁻⁹", "1e-6": "10⁻⁶", "1e6": "10⁶", "1e9": "10⁹"}
"""Units of plain numbers, as they are written."""


def common_scale(unit: str, values: Array) -> Scale:
    """The largest unit in which the largest magnitude of values is at least 1."""
    return scale_for(unit, max((abs(float(one)) for one in values if math.isfinite(one)), default=0.0))


@dataclass(frozen=True, kw_only=True)
class Scales:
    """The scales of a page: one for each quantity, which headline, tables and figures share."""

    by_family: Mapping[str, Scale]

    def __call__(self, name: str, unit: str) -> Scale:
        """The scale of a quantity or field of a name and SI unit."""
        if name in PERCENT:
            return Scale(factor=0.01, unit="%", negligible=NEGLIGIBLE_PLAIN)
        return self.by_family.get(family(name, unit)) or scale_for(unit, 0.0)

    def text(self, name: str, quantity: Quantity) -> str:
        """A quantity with its uncertainty and the unit of the page."""
        bar = math.inf if quantity.uncertainty is None else quantity.uncertainty
        return self(name, quantity.unit).text(quantity.value, bar)


def family(name: str, unit: str) -> str:
    """The name of the quantities that share a unit: all pressures, all gaps, all flows; not friction, numbers, angles.

    Examples
    --------
    >>> family("side_leakage", "m^3/s") == family("inlet_flow", "m^3/s"), family("film_min_x", "m")
    (True, 'film_min_x')
    >>> family("friction", "N") == family("load", "N")
    False
    """
    if unit in ("1", "rad") or name in PLACES:
        return name
    return f"{unit} of friction" if "friction" in name else unit


def scales_of(results: Iterable[Result]) -> Scales:
    """The scales of a page from the quantities of the results that decide them, such as that of the best model.

    The pressure in the film counts as a quantity.
    """
    largest: dict[tuple[str, str], float] = {}
    for result in results:
        sizes = [(name, one.unit, abs(one.value)) for name, one in result.quantities.items()]
        if "pressure" in result.fields:
            field = result.fields["pressure"]
            sizes.append(("pressure", field.unit, float(np.abs(field.values).max())))
        for name, unit, size in sizes:
            key = family(name, unit), unit
            largest[key] = max(largest.get(key, 0.0), size)
    return Scales(by_family={name: scale_for(unit, size) for (name, unit), size in largest.items()})
