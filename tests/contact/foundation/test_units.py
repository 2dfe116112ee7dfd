"""Quantities with units are read exactly, and anything else is refused without being evaluated."""

import contextlib
import itertools
import math
import random
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from roughfilm.contact.foundation import units
from roughfilm.contact.foundation.entries import LengthPair
from roughfilm.contact.foundation.units import dynamic_viscosity, in_si, rotational_speed, to_si, with_unit


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
        ("1 in", "m", 0.0254),
        ("1 mil", "m", 25.4e-6),
        ("30 μm", "m", 3e-5),
        ("10 mPas", "Pa*s", 0.01),
        ("10 mPa.s", "Pa*s", 0.01),
        ("0.01 N s/m2", "Pa*s", 0.01),
        ("0.875 g/cm3", "kg/m^3", 875.0),
        ("875 kg/m3", "kg/m^3", 875.0),
        ("875 kg·m⁻³", "kg/m^3", 875.0),
        ("20 1/GPa", "Pa^-1", 2e-8),
        ("20 GPa⁻¹", "Pa^-1", 2e-8),
        ("20e-9 1/Pa", "Pa^-1", 2e-8),
        ("1 N/mm2", "Pa", 1e6),
        ("1 ksi", "Pa", 6894757.293168361),
        ("46 cSt", "m^2/s", 4.6e-5),
        ("46 mm²/s", "m^2/s", 4.6e-5),
        ("6 l/min", "m^3/s", 1e-4),
        ("6 ml/min", "m^3/s", 1e-7),
        ("180°", "rad", math.pi),
        ("180 deg", "rad", math.pi),
        ("20 °C", "K", 293.15),
        ("5 %", "%", 5.0),
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
        ("1e400 m", "a length must be 1e-22 to 1e\\+13 m"),
        ("1e308 km", "a length must be 1e-22 to 1e\\+13 m"),
        ("-1e14 m", "got .* a length must be"),
        ("1e-23 m", "a length must be"),
        ("1e-999 m", "a length must be"),
        ("0.0001e-320 m", "a length must be"),
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
        ("7,5 um", r"write '7\.5 um'$"),
        ("1.234,5 um", r"write '1234\.5 um'$"),
        ("1,000 um", r"write '1\.000 um' or '1000 um'$"),
        ("1 000 um", r"write '1000 um'$"),
        ("2 x 10^-3 m", r"write a power of ten as '2e-3 m'$"),
        ("7.5", r"'7\.5 m' or '7\.5 um'$"),
        ("7.5 UM", r"did you mean '7\.5 um'\?$"),
        ("7.5 µ", r"did you mean '7\.5 um'\?$"),
        ("3000 rpm", "a rotational speed"),
        ("5 %", "a percentage"),
        ("5 kN", "a force"),
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


@given(st.floats(min_value=1e-12, max_value=1e14))
def test_written_numbers_are_read_back_to_the_last_bit(value):
    assert to_si(with_unit(value, "kg/m^3"), "kg/m^3") == value


PREFIXES = ("", *units._PREFIXES)
PRODUCTS = {
    "m": ("{}m", "{}inch", "{}in", "{}m^2/{}m", "{}l / {}m**2"),
    "Pa": ("{}Pa", "{}bar", "{}psi", "{}N/{}m^2", "{}J {}m^-3", "{}lbf/inch^2"),
    "Pa*s": ("{}Pa*{}s", "{}Pa {}s", "{}P", "{}N*{}s/{}m^2", "{}g/{}m/{}s", "{}psi*{}min"),
    "Pa^-1": ("{}Pa^-1", "{}m**2/{}N", "{}bar^-1"),
    "Pa/m": ("{}Pa/{}m", "{}N {}m^-3"),
    "kg/m^3": ("{}g/{}m^3", "{}g/{}l", "lb/{}m^3"),
    "m/s": ("{}m/{}s", "{}m/h", "{}m / min", "{}m*{}Hz"),
    "m^2/s": ("{}St", "{}m^2/{}s", "{}l/{}m/{}s"),
    "rad": ("{}rad", "{}deg", "turn"),
    "rad/s": ("{}rad/{}s", "rpm", "{}Hz", "deg/{}s", "{}min^-1"),
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


def test_a_suggested_text_has_the_value_that_was_written():
    for text, base in [
        ("30 mpas", "Pa*s"),
        ("7,5 um", "m"),
        ("12 mpa", "Pa"),
        ("3 RPM", "rad/s"),
        ("2 Kg/m3", "kg/m^3"),
    ]:
        with pytest.raises(ValueError, match="'") as caught:
            to_si(text, base)
        suggested = str(caught.value).rpartition("; ")[2].split("'")[1]
        assert float(suggested.split()[0]) == float(text.split()[0].replace(",", "."))
        assert to_si(suggested, base) > 0


@pytest.mark.parametrize("text", ["3000 rpm", "50 Hz", "50 1/s", "3000 1/min", "3000/min", "50 rev/s", "18000 deg/s"])
def test_a_rotational_speed_counts_revolutions_unless_it_names_an_angle(text):
    assert rotational_speed(text) == pytest.approx(100 * math.pi, rel=1e-12)


@pytest.mark.parametrize("text", ["5 m/s", "5", 5, None, "rpm", "5 rad"])
def test_other_texts_are_no_rotational_speed(text):
    assert rotational_speed(text) is None


def test_a_kinematic_viscosity_times_the_density_is_the_dynamic_one():
    assert to_si(dynamic_viscosity("46 cSt", "0.87 g/cm3"), "Pa*s") == pytest.approx(46e-6 * 870, rel=1e-14)
    assert dynamic_viscosity("46 cSt", None) == "46 cSt"
    assert dynamic_viscosity(7, "870 kg/m3") == 7


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("113 degF", "a temperature in Fahrenheit; write '45 degC'"),
        ("113 °F", "a temperature in Fahrenheit; write '45 degC'"),
        ("32.9 F", "a temperature in Fahrenheit; write '0.5 degC'"),
        ("45 celsius", "which is not a temperature; did you mean '45 degC'?"),
        ("45 C", "which is not a temperature; did you mean '45 degC'?"),
        ("45°", "which is not a temperature; did you mean '45 degC'?"),
        ("45 degree_Celsius", "whose unit is not known; write a temperature, in degC or K"),
        ("36 degRe", "whose unit is not known; did you mean '36 degC'?"),
    ],
)
def test_other_scales_of_temperature_are_refused_with_the_remedy(text, words):
    with pytest.raises(ValueError, match=re.escape(f"got {text!r}, {words}")):
        to_si(text, "K")


@pytest.mark.parametrize(
    ("text", "base", "meant"),
    [
        ("2 kJ/kgK", "J/(kg*K)", "2 kJ/(kg*K)"),
        ("2000 J/kgK", "J/(kg*K)", "2000 J/(kg*K)"),
        ("0.13 W/mK", "W/(m*K)", "0.13 W/(m*K)"),
        ("20 W/m2K", "W/(m^2*K)", "20 W/(m^2*K)"),
    ],
)
def test_units_without_parentheses_are_recognised(text, base, meant):
    with pytest.raises(ValueError, match=re.escape(f"did you mean '{meant}'?")):
        to_si(text, base)


def test_numbers_that_python_marks_are_in_si_units():
    marked = in_si({"film": np.float64(3e-5), "size": (np.int32(2), 0.5), "kind": "pad", "joined": True})
    assert to_si(marked["film"], "m") == 3e-5
    assert [to_si(one, "m") for one in marked["size"]] == [2.0, 0.5]
    assert (marked["kind"], marked["joined"]) == ("pad", True)
    with pytest.raises(ValueError, match="not finite"):
        to_si(in_si(float("nan")), "m")
    with pytest.raises(ValueError, match="without a unit"):
        to_si(3e-5, "m")


def test_units_beyond_the_table_are_those_of_pint():
    assert units._powers("hbar") is None
    assert to_si("1 atm", "Pa") == 101325.0
    assert to_si("2 N/(m*s)", "Pa*m/s") == 2.0


def test_a_pair_separates_a_decimal_comma_from_two_lengths():
    pair = TypeAdapter(LengthPair)
    assert pair.validate_python("1 um, 2.5 um") == (1e-6, 2.5e-6)
    with pytest.raises(ValueError, match=r"write '7\.5 um' or '7 um, 5 um'"):
        pair.validate_python("7,5 um")
