"""Verdicts, tables and summaries of published numbers."""

from dataclasses import replace

import pytest

from roughfilm.validation.listing import names, source
from roughfilm.validation.published import Row, Verdict
from roughfilm.validation.reading import TABLES, half_digit, not_yet, published
from roughfilm.validation.sources.butenschoen import interpolated
from roughfilm.validation.sources.patir_cheng import pressure_factor, shear_factor

ROW = Row(case="a", series="b", at=0.0, quantity="load", unit="N", published=10.0, ours=10.4, bar=0.3, uncertainty=0.4)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ({}, Verdict.WITHIN),  # 0.4 <= √(0.3² + 0.4²)
        ({"ours": 10.51}, Verdict.OUTSIDE),
        ({"ours": 9.49}, Verdict.OUTSIDE),
        ({"ours": 10.51, "evidence": "another table gives 10.5"}, Verdict.SUSPECT),
        ({"evidence": "another table gives 10.5"}, Verdict.WITHIN),
        ({"uncertainty": None}, Verdict.OUTSIDE),
    ],
)
def test_a_number_is_within_if_it_differs_by_less_than_bar_and_uncertainty_in_squares(changes, verdict):
    assert replace(ROW, **changes).verdict is verdict


def test_a_value_below_its_bar_has_no_relative_difference():
    assert ROW.relative == pytest.approx(0.04)
    assert replace(ROW, published=0.1).relative is None


@pytest.mark.parametrize("name", names())
def test_a_source_has_the_name_of_its_module_and_says_how_its_numbers_were_had(name):
    one = source(name)
    assert one.name == name
    assert all((one.title, one.citation, one.obtained, *one.methods, one.bar))
    assert 0 < one.cost[False] <= one.cost[True]


def test_the_default_takes_about_a_minute():
    assert sum(source(name).cost[False] for name in names()) < 80


@pytest.mark.parametrize("path", sorted(TABLES.glob("*.csv")), ids=lambda path: path.stem)
def test_every_column_of_numbers_names_its_unit(path):
    for row in published(path.stem):
        for column, text in row.items():
            if column.endswith("]"):
                float(text)
            else:
                assert column in {"case", "bore", "suspect", "likely", "quantity", "published", "uncertainty"}


def test_tables_that_wait_name_the_missing_physics():
    assert all(set(one) == {"title", "citation", "missing"} for one in not_yet())


def test_printed_digits_are_counted():
    assert half_digit("12.299") == pytest.approx(5e-4)
    assert half_digit("42") == 0.5


def test_the_other_entries_of_a_table_predict_an_entry_but_not_a_misprint():
    table = {
        (float(one["eccentricity_ratio [1]"]), float(one["width_over_diameter [1]"])): one
        for one in published("butenschoen")
    }
    assert interpolated(table, 0.97, 0.25, "attitude [deg]") == pytest.approx(12.397, rel=1e-3)  # printed: 12.299
    assert interpolated(table, 0.96, 0.25, "attitude [deg]") == pytest.approx(
        float(table[0.96, 0.25]["attitude [deg]"]), rel=1e-3
    )
    assert interpolated(table, 0.1, 1.0, "Q [1]") is None


def test_the_fits_of_patir_and_cheng():
    fit = {
        name.partition(" [")[0]: float(text)
        for name, text in next(one for one in published("patir_cheng") if one["gamma [1]"] == "1").items()
    }
    assert pressure_factor(fit, 3.0) == pytest.approx(0.8323, abs=5e-5)  # 1 - 0.9 exp(-1.68)
    assert shear_factor(fit, 6.0) == pytest.approx(0.2512, abs=5e-5)  # 1.126 exp(-1.5)
