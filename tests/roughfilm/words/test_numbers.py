"""Numbers with their errors, as they are written."""

import math

import pytest

from roughfilm.words.numbers import finite_entries, with_error


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (97.77, 13.2, "98 ± 13"),
        (22.0, 2.9, "22 ± 3"),
        (19840.0, 2100.0, "20000 ± 2000"),
        (0.02142, 0.00034, "0.0214 ± 0.0003"),
        (99.97, 0.96, "100.0 ± 1.0"),
        (0.0, 0.25, "0.0 ± 0.2"),
        (-3.21, 0.4, "-3.2 ± 0.4"),
        (0.5, 30.0, "0 ± 30"),
        (-0.01, 0.25, "0.0 ± 0.2"),
        (-1e-9, 1.3e-7, "0 ± 1.3e-7"),
        (0.0, 6e-13, "0 ± 6e-13"),
        (3.0e8, 2.1e6, "(3.00 ± 0.02)e8"),
        (1.234e-9, 3e-11, "(1.23 ± 0.03)e-9"),
        (2.0, 1e-9, "2"),
        (1.2345, None, "1.23"),
        (0.0, 0.0, "0"),
        (5.27, math.inf, "5.27 ± ?"),
    ],
)
def test_no_digits_that_the_error_does_not_leave(value, error, text):
    assert with_error(value, error) == text


def test_json_has_no_number_that_is_not_finite():
    unknown = {"value": 1.5, "uncertainty": math.inf}
    entries = {"load": unknown, "of two": [(unknown, math.nan)], "cells": 16, "unit": "Pa", "left out": None}
    known = {"value": 1.5, "uncertainty": None}
    assert finite_entries(entries) == {
        "load": known,
        "of two": [[known, None]],
        "cells": 16,
        "unit": "Pa",
        "left out": None,
    }
