"""Quantities with units are read exactly, and anything else is refused without being evaluated."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

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
