"""Numbers with their errors, as they are written."""

import math

import pytest

from roughfilm.words.numbers import with_error


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
