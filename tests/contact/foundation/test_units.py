"""Quantities with units are read exactly, and anything else is refused without being evaluated."""

import contextlib
import itertools
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roughfilm.contact.foundation import units
from roughfilm.contact.foundation.units import to_si, with_unit


@pytest.mark.parametrize(
    ("text", "base", "value"),
    [
        ("30 um", "m", 3e-5),
        ("30um", "m", 3e-5),
        ("30 µm", "m", 3e-5),
        ("1 mm", "m", 1e-3),
        ("7.5e0 um", "m", 7.5e-6),
        ("10 cP", "Pa*s", 0.01),
        ("10 mPa·s", "Pa*s", 0.01),
        ("10 mPa s", "Pa*s", 0.01),
        ("0.875 g/cm^3", "kg/m^3", 875.0),
        ("875 kg/m**3", "kg/m^3", 875.0),
        ("36 km/h", "m/s", 10.0),
        ("1 inch", "m", 0.0254),
    ],
)
def test_units(text, base, value):
    assert to_si(text, base) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("30", "without a unit"),
        (30, "without a unit"),
        (True, "write a number and a unit"),
        (None, "write a number and a unit"),
        (["1 m"], "write a number and a unit"),
        ("30 s", "wrong dimension"),
        ("30 furlongz", "not known"),
        ("um 30", "write a number and a unit"),
        ("1e400 m", "write a number and a unit|not finite"),
        ("1e308 km", "not finite"),
        ("nan m", "write a number"),
        ("inf m", "write a number"),
        ("9**9**9**9 m", "not known"),
        ("1 m^99999999999", "not known"),
        ("1 m**9**9", "not known|dimension"),
        ("1 __import__('os')", "not known"),
        ("1 degC", "dimension|not known"),
        ("1 ()", "not known"),
        ("", "write a number"),
        ("1 " + "m" * 500, "write a number|not known"),
    ],
)
def test_refusals_name_what_was_got(text, words):
    with pytest.raises(ValueError, match=words) as caught:
        to_si(text, "m")
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 250


@given(st.text(max_size=60) | st.from_regex(r"-?[0-9.e+-]{1,6} ?[a-zµ*/^()0-9 -]{0,20}", fullmatch=True))
def test_no_text_raises_anything_but_value_error(text):
    with contextlib.suppress(ValueError):
        assert isinstance(to_si(text, "m"), float)


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_written_numbers_are_read_back_to_the_last_bit(value):
    assert to_si(with_unit(value, "kg/m^3"), "kg/m^3") == value


PREFIXES = ("", *units._PREFIXES)
PRODUCTS = {
    "m": ("{}m", "{}inch", "{}m^2/{}m", "{}l / {}m**2"),
    "Pa": ("{}Pa", "{}bar", "{}psi", "{}N/{}m^2", "{}J {}m^-3", "{}lbf/inch^2"),
    "Pa*s": ("{}Pa*{}s", "{}Pa {}s", "{}P", "{}N*{}s/{}m^2", "{}g/{}m/{}s", "{}psi*{}min"),
    "Pa^-1": ("{}Pa^-1", "{}m**2/{}N", "{}bar^-1"),
    "Pa/m": ("{}Pa/{}m", "{}N {}m^-3"),
    "kg/m^3": ("{}g/{}m^3", "{}g/{}l", "lb/{}m^3"),
    "m/s": ("{}m/{}s", "{}m/h", "{}m / min", "{}m*{}Hz"),
    "m^2/s": ("{}St", "{}m^2/{}s", "{}l/{}m/{}s"),
    "rad": ("{}rad", "{}deg", "turn"),
    "rad/s": ("{}rad/{}s", "rpm", "{}Hz", "deg/{}s"),
    "N/m": ("{}N/{}m", "{}J/{}m^2", "{}W {}s/{}m**2", "{}lbf/yd"),
    "K": ("{}K", "{}m"),
}


@pytest.mark.parametrize("base", PRODUCTS)
def test_the_table_of_units_agrees_with_pint_to_the_bit(base):
    choose = random.Random(5)
    for product in PRODUCTS[base]:
        ways = [*itertools.product(PREFIXES, repeat=product.count("{}"))]
        for prefixes in choose.sample(ways, min(len(ways), 150)):
            unit = product.format(*prefixes)
            powers = units._powers(unit)
            assert powers is not None, unit
            assert units._by_table(powers, units._powers(base)) == units._by_pint(unit, base), unit


def test_units_beyond_the_table_are_those_of_pint():
    assert units._powers("hbar") is None
    assert to_si("1 atm", "Pa") == 101325.0
    assert to_si("2 N/(m*s)", "Pa*m/s") == 2.0
