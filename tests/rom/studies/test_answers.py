"""The answers of a sweep: best case and optimum of quantities whose optimum is known in closed form."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.answers import Sense, answer_of, optimum, sense_of, wanted_quantity
from roughfilm.rom.studies.parameters import parameters
from roughfilm.rom.studies.sweep import Sweep
from roughfilm.words.scales import Scale
from roughfilm.words.sweep import best_sentence, unranked_sentence

BEST_RATIO, BEST_STEP = 1.866, 0.718
"""Ratio of the films and place of the step of the Rayleigh step of the greatest load: Rayleigh 1918."""


def load_of_step(ratio, step):
    """Load over 6ηuL²/h² of an infinitely wide step bearing whose inlet film is ``ratio`` times the outlet film h."""
    return (ratio - 1) * step * (1 - step) / (2 * (ratio**3 * (1 - step) + step))


def swept(quantity, values, uncertainty=1e-6):
    """A sweep of bearings by one model with a quantity in every case."""
    values = np.asarray(values, dtype=float)
    unknown = np.full(values.size, np.nan)
    names = ("load_per_width", "friction_per_width", "pressure_max", quantity)
    own = dict.fromkeys(names, unknown) | {quantity: values}
    return Sweep(
        kind="bearing",
        names=tuple(map(str, range(values.size))),
        given={},
        found={"reynolds": own},
        cpu_s={"reynolds": np.ones(values.size)},
        failures=(),
        uncertainty={"reynolds": dict.fromkeys(names, unknown) | {quantity: uncertainty * np.ones(values.size)}},
        expected_error={"reynolds": dict.fromkeys(names, unknown)},
    )


def answered(quantity, values, uncertainty=1e-6):
    return answer_of(swept(quantity, values, uncertainty), "reynolds", quantity)


def test_the_optimum_of_a_rayleigh_step_lies_within_its_uncertainty():
    ratios = [1.4, 1.6, 1.8, 2.0, 2.2]
    varied = parameters({"ratio": ratios})
    answer = answered("load_per_width", [load_of_step(ratio, BEST_STEP) for ratio in ratios])
    assert answer.best == 2
    found = optimum(varied, varied[0], answer)
    assert found is not None
    assert abs(found.place - BEST_RATIO) <= found.place_uncertainty <= 0.1
    assert abs(found.value - load_of_step(BEST_RATIO, BEST_STEP)) <= found.value_uncertainty


def test_the_best_place_of_the_step_is_found_as_well():
    places = [0.5, 0.6, 0.7, 0.8, 0.9]
    varied = parameters({"step": places})
    answer = answered("load_per_width", [load_of_step(BEST_RATIO, place) for place in places])
    found = optimum(varied, varied[0], answer)
    assert found is not None
    assert abs(found.place - BEST_STEP) <= found.place_uncertainty


@pytest.mark.parametrize("ratios", [[1.2, 1.4, 1.6], [2.0, 2.4, 2.8]])
def test_there_is_no_optimum_outside_the_cases(ratios):
    varied = parameters({"ratio": ratios})
    answer = answered("load_per_width", [load_of_step(ratio, BEST_STEP) for ratio in ratios])
    assert optimum(varied, varied[0], answer) is None


def test_there_is_no_optimum_without_an_uncertainty_or_with_one_that_hides_it():
    ratios = [1.4, 1.8, 2.2]
    varied = parameters({"ratio": ratios})
    loads = [load_of_step(ratio, BEST_STEP) for ratio in ratios]
    for uncertainty in (np.nan, 0.1):
        assert optimum(varied, varied[0], answered("load_per_width", loads, uncertainty)) is None


def test_on_a_logarithmic_axis_the_parabola_is_one_of_the_logarithm():
    speeds = [0.1, 1, 10, 100, 1000]
    varied = parameters({"speed": speeds})
    answer = answered("friction_per_width", [1 + (np.log10(speed) - 1.2) ** 2 for speed in speeds])
    found = optimum(varied, varied[0], answer)
    assert found is not None
    assert found.place == pytest.approx(10**1.2)
    assert found.value == pytest.approx(1)


def test_friction_is_best_where_it_is_smallest_and_load_where_it_is_largest():
    values = [3, 1, 2]
    assert answered("load_per_width", values).order == (0, 2, 1)
    assert answered("friction_per_width", values).order == (1, 2, 0)
    assert sense_of("leakage_per_width") is Sense.SMALLEST
    assert sense_of("bearing_load") is Sense.LARGEST
    assert sense_of("mean_gap") is Sense.UNCLEAR


@pytest.mark.parametrize(("uncertainty", "decided"), [(0.1, True), (1.0, False), (np.nan, None)])
def test_the_best_two_cases_are_stated_apart_by_their_uncertainties(uncertainty, decided):
    assert answered("load_per_width", [1, 2, 3], uncertainty).decided is decided


def test_a_question_names_a_quantity_with_or_without_its_ending():
    sweep = swept("load_per_width", [1, 2])
    assert wanted_quantity(sweep, "reynolds") == "load_per_width"
    assert wanted_quantity(sweep, "reynolds", "load") == "load_per_width"
    with pytest.raises(InputError, match=r"got 'lod'; reynolds has load_per_width"):
        wanted_quantity(sweep, "reynolds", "lod")


def test_under_a_load_that_is_the_same_in_all_cases_the_question_is_another_one():
    sweep = swept("film_min", [1e-6, 2e-6])
    sweep.found["reynolds"]["load_per_width"] = np.array([5.0, 5.0])
    assert wanted_quantity(sweep, "reynolds") == "film_min"


def test_a_case_whose_uncertainty_exceeds_its_value_is_not_ranked():
    """The largest load is worthless, so that the best case is the largest of the others, and is said so."""
    answer = answered("load_per_width", [1.0, 9.0, 2.0], np.array([0.1, 20.0, 0.1]))
    assert answer.order == (2, 0)
    assert answer.unranked == (1,)
    assert "case 3 of 3" in best_sentence(answer, "load", Scale(factor=1.0, unit="N/m"), ())
    assert unranked_sentence(answer, "the film ruptures") == (
        "Not ranked, as their error is above 100 %: 1 case (2): the film ruptures."
    )


def test_a_case_that_is_left_out_is_not_ranked_unless_all_are():
    sweep = swept("load_per_width", [1.0, 9.0, 2.0])
    left = answer_of(sweep, "reynolds", "load_per_width", (1,))
    assert (left.order, left.unranked) == ((2, 0), ())
    assert answer_of(sweep, "reynolds", "load_per_width", (0, 1, 2)).order == (1, 2, 0)


def test_where_every_case_is_worthless_all_are_ranked_and_the_error_is_said():
    answer = answered("load_per_width", [1.0, 9.0], np.array([2.0, 20.0]))
    assert answer.order == (1, 0)
    assert answer.unranked == ()
    sentence = best_sentence(answer, "load", Scale(factor=1.0, unit="N/m"), ())
    assert sentence.startswith("Largest load: 9 N/m with an error above 100 % ")
