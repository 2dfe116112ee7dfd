"""Quantities in the units of engineers: one unit for a value and its uncertainty, and digits that mean something."""

import math

import pytest

from roughfilm.contact.foundation.units import Quantity
from roughfilm.words.units import SCALES, in_engineering_unit, in_engineering_units


def shown(value, unit, uncertainty=None):
    return in_engineering_unit(Quantity(value=value, unit=unit, uncertainty=uncertainty))


@pytest.mark.parametrize(
    ("quantity", "expected"),
    [
        ((15.2e-6, "m", 0.03e-6), ("15.20", "0.03", "µm")),
        ((0.025, "m", 0.0), ("25", "exact", "mm")),
        ((2.0272e6, "Pa", 300.0), ("2.0272", "0.0003", "MPa")),
        ((24.857, "W", 0.0123), ("24.857", "0.012", "W")),
        ((1e-3 / 60, "m^3/s", 1e-6 / 60), ("1.0000", "0.0010", "l/min")),
        ((-2.5e-9 / 60, "m^3/s", 0.1e-9 / 60), ("-2.50", "0.10", "µl/min")),
        ((0.31, "N*m", None), ("310", "unknown", "mN·m")),
        ((math.pi / 6, "rad", 0.0), ("30", "exact", "°")),
        ((0.0051, "1", 0.0001), ("0.00510", "0.00010", "")),
        ((2.5e-7, "1", 1e-9), ("250.0", "1.0", "1e-9")),
        ((0.0, "N", 0.0), ("0", "exact", "N")),
        ((0.0, "N", None), ("0", "unknown", "N")),
        ((300.0, "K", 1.0), ("300.0", "1.0", "K")),
    ],
)
def test_a_quantity_in_the_unit_of_an_engineer(quantity, expected):
    assert shown(*quantity) == expected


def test_an_uncertainty_above_the_value_rounds_it():
    assert shown(0.3, "N", 5.0) == ("0", "5000", "mN")


def test_no_more_than_six_digits_are_shown_and_the_uncertainty_is_bounded():
    assert shown(123.456789, "N", 1e-7) == ("123.457", "<0.001", "N")


def test_an_infinite_uncertainty_is_unknown():
    assert shown(1.5, "N", math.inf) == ("1.5", "unknown", "N")


def test_a_number_that_is_not_finite_is_written_as_it_is():
    assert shown(math.nan, "N") == ("nan", "unknown", "N")


@pytest.mark.parametrize("unit", SCALES)
@pytest.mark.parametrize("power", range(-30, 16))
def test_every_number_has_a_unit_and_its_value_back(unit, power):
    value, _, name = shown(3.0 * 10.0**power, unit)
    assert name or unit == "1"
    assert float(value) > 0


def test_a_value_within_an_uncertainty_that_is_round_off_is_zero():
    values = {"load": (1e-11, 6e-11), "corner": (2e-10, 5e-9), "peak": (4.4, 0.2)}
    given = {name: Quantity(value=value, unit="1", uncertainty=size) for name, (value, size) in values.items()}
    shown = in_engineering_units(given)
    assert shown["load"] == shown["corner"] == ("0", "<0.000001", "")
    assert shown["peak"] == ("4.4", "0.2", "")
    resolved = {**given, "load": Quantity(value=1e-4, unit="1", uncertainty=1e-5)}
    assert in_engineering_units(resolved)["load"] == in_engineering_unit(resolved["load"])
