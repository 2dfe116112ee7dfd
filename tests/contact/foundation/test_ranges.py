"""Ranges of quantities: wide enough for engineering, narrow enough that no product of a few overflows."""

import math

import pytest
from places import ROOT

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES, in_range
from roughfilm.contact.foundation.units import to_si

ENGINEERING = {
    "m": ("1 nm", "100 m"),
    "Pa": ("1 Pa", "1 TPa"),
    "Pa*s": ("10 uPa*s", "1 MPa*s"),
    "kg/m^3": ("0.1 kg/m^3", "20 g/cm^3"),
    "m/s": ("1 nm/s", "10 km/s"),
    "N": ("1 nN", "100 MN"),
    "N/m": ("1 uN/m", "100 MN/m"),
    "Pa^-1": ("0.1 1/GPa", "1 1/MPa"),
    "Pa/m": ("1 Pa/m", "1 GPa/um"),
    "rad/s": ("1 rad/h", "100000 rpm"),
}


@pytest.mark.parametrize("unit", ENGINEERING)
def test_engineering_lies_ten_decades_inside_of_each_range(unit):
    smallest, largest = (to_si(text, unit) for text in ENGINEERING[unit])
    assert RANGES[unit].least <= smallest * 1e-10
    assert RANGES[unit].most >= largest * 1e10


@pytest.mark.parametrize("unit", RANGES)
def test_the_ends_are_allowed_and_what_lies_beyond_is_not(unit):
    allowed = RANGES[unit]
    for inside in (allowed.least, allowed.most, -allowed.least, -allowed.most, 0.0):
        assert inside in allowed
    for beyond in (allowed.least / 2, allowed.most * 2, math.inf, -math.inf, math.nan, 5e-324):
        assert beyond not in allowed


def test_the_pressure_of_a_film_stays_a_float_at_the_ends_of_the_ranges():
    length, film, speed, viscosity = RANGES["m"].most, RANGES["m"].least, RANGES["m/s"].most, RANGES["Pa*s"].most
    assert math.isfinite((6 * viscosity * speed * length / film**2) ** 2)
    assert (viscosity * film**3 / length) ** 2 > 0


@pytest.mark.parametrize("value", [0, -1.0, 1e300, 10**400, math.nan, math.inf, "1 MPa", None, True, 1e-300])
def test_numbers_from_python_are_refused_in_one_line(value):
    with pytest.raises(InputError, match=r"^load: got .*; it must be 1e-13 to 1e\+22 Pa, check the unit$"):
        in_range("load", value, "Pa")


def test_zero_is_a_number_where_it_has_a_meaning():
    assert in_range("speed", 0, "m/s", zero=True) == 0.0


def test_the_manual_lists_every_range():
    page = (ROOT / "docs" / "reference" / "scenes.md").read_text(encoding="utf-8")
    section = page.partition("## Ranges")[2].partition("\n## ")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in section.splitlines() if line[:2] == "| "]
    listed = {unit: (float(least), float(most)) for _, unit, least, most in rows[1:]}
    assert listed == {unit: (allowed.least, allowed.most) for unit, allowed in RANGES.items()}
