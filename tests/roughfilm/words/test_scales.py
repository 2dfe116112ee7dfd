"""One unit for each quantity of a page, and numbers near zero."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.units import Quantity
from roughfilm.words.scales import Scale, Scales, common_scale, family, scale_for


@pytest.mark.parametrize(
    ("unit", "largest", "shown"),
    [
        ("m", 1.06e-7, "µm"),
        ("m", 2e-9, "nm"),
        ("m", 0.02, "mm"),
        ("N", 4150.0, "kN"),
        ("N/m", 48890.0, "kN/m"),
        ("m^3/s", 47.4e-6 / 60, "ml/min"),
        ("kg/(m*s)", 3.16e-8, "mg/(h·m)"),
        ("1", 0.7, ""),
        ("1", 2.5e-7, "10⁻⁹"),
        ("1", 1e-12, ""),
    ],
)
def test_the_unit_of_a_page_is_one_that_engineers_use(unit, largest, shown):
    assert scale_for(unit, largest).unit == shown


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (2444.6, 0.28, "2.4446 ± 0.0003"),
        (82.0, 4.1, "0.082 ± 0.004"),
        (800.0, 1e-7, "0.8"),
        (-50.0, math.inf, "−0.05 ± ?"),
        (1e-12, 0.0, "0"),
        (1e-12, 1e-6, "0"),
        (0.05, 2e-6, "0.000050000 ± 0.000000002"),
        (1e-12, 2.0, "0.000 ± 0.002"),
        (math.nan, 1.0, "–"),
    ],
)
def test_numbers_in_one_unit_are_rounded_to_their_uncertainty_and_near_zero_are_zero(value, uncertainty, text):
    assert scale_for("N", 4150.0).number(value, uncertainty) == text


def test_values_that_are_rounding_errors_have_no_power_of_ten_for_a_unit():
    rounding = np.array([3e-14, -1e-12, 0.0, np.nan])
    scale = common_scale("1", rounding)
    assert scale.unit == ""
    assert np.array_equal(scale.values(rounding), [0.0, 0.0, 0.0, np.nan], equal_nan=True)


def test_all_pressures_of_a_page_share_a_unit_and_friction_has_its_own():
    scales = Scales(by_family={"Pa": scale_for("Pa", 5e6), "N": scale_for("N", 5e3)})
    assert scales.text("specific_load", Quantity(value=2e5, unit="Pa", uncertainty=0.0)) == "0.2 MPa"
    assert scales("bearing_load", "N").unit == scales("contact_load", "N").unit == "kN"
    assert scales("friction", "N") == Scale(factor=1.0, unit="N")
    assert scales.text("contact_share", Quantity(value=0.256, unit="1", uncertainty=0.006)) == "25.6 ± 0.6 %"


def test_the_place_of_the_highest_temperature_has_a_unit_of_its_own():
    places = ("film_min_x", "temperature_max_x", "temperature_max_y")
    assert [family(name, "m") for name in places] == [*places]
