"""What varies in a study, in the units of its author."""

import numpy as np
import pytest

from roughfilm.rom.studies.parameters import parameters
from roughfilm.rom.studies.table import Column


def test_a_length_keeps_the_unit_of_its_author():
    (depth,) = parameters({"depth": ["2.5 um", "7.5 um", "10 um"]})
    assert depth.values == pytest.approx([2.5, 7.5, 10])
    assert (depth.label, depth.text(1)) == ("depth, µm", "7.5 µm")


def test_a_multiple_of_another_length_says_so():
    (depth,) = parameters({"depth": ["0.25 film", "0.75 film"]})
    assert depth.label == "depth, × film"


def test_values_in_several_units_are_given_in_the_first_one():
    table = {"depth": Column(values=[5e-6, 1e-5], unit="m")}
    (depth,) = parameters({"depth": ["5 um", "0.01 mm"]}, table, [0, 1])
    assert depth.unit == "µm"
    assert depth.values == pytest.approx([5, 10])


def test_texts_keep_the_order_of_the_study():
    (shape,) = parameters({"shape": ["wedge", "step", "wedge"]})
    assert not shape.numeric
    assert shape.distinct == ["wedge", "step"]
    assert shape.codes().tolist() == [0, 1, 0]


def test_entries_that_vary_together_are_one_parameter():
    (one,) = parameters({"profile": ["a", "b"], "depth": ["1 um", "2 um"], "width": [3, 3]})
    assert one.name == "depth"
    assert one.along == ("profile",)


def test_an_entry_that_some_cases_lack_is_a_number_all_the_same():
    (shift,) = parameters({"shift": [None, "0.1 mm", "0.2 mm"]})
    assert shift.distinct == pytest.approx([0.1, 0.2])
    assert np.isnan(shift.values[0])


@pytest.mark.parametrize(
    ("values", "logarithmic"),
    [([1, 10, 100], True), ([1, 2, 3], False), ([1, 50, 51], False), ([-1, 10, 100], False), ([0.1, 1, 4, 10], True)],
)
def test_an_axis_is_logarithmic_for_values_that_are_even_in_the_logarithm(values, logarithmic):
    (one,) = parameters({"speed": values})
    assert one.logarithmic is logarithmic
