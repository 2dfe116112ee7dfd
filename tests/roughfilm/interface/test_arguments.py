"""Arguments of wrong types and values: an error in one line that names the argument."""

import numpy as np
import pytest

import roughfilm as rf

SURFACE = rf.Surface(heights=1e-7 * np.random.default_rng(1).normal(size=(64, 64)), spacing=(1e-6, 1e-6))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"count": "4"}, "windows: got '4'; give a whole number"),
        ({"size": "20 um"}, "size: got '20 um'; it must be"),
        ({"gap": "1 um"}, "gap: got '1 um'; it must be"),
        ({"tolerance": "5%"}, "tolerance: got '5%'; it must be above 0 and below 1"),
        ({"processes": 1.5}, "processes: got 1.5; give a whole number"),
        ({"recipe": 5}, "recipe: got int; give the name of a TOML file, or a dictionary"),
        ({"scene": {"kind": "seal"}}, "scene: got dict; give a scene"),
    ],
)
def test_wrong_arguments_of_windows_are_refused(arguments, message):
    with pytest.raises(rf.InputError, match=f"^{message}") as caught:
        rf.windows(SURFACE, **arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"windows": 15}, "windows: got 15; give a whole number from 16 to 10000"),
        ({"seeds": 10**9}, "seeds: got 1000000000; give a whole number from 40 to 10000"),
        ({"area": "10%"}, "area: got '10%'; give a fraction of 0.1 % to 90 %"),
        ({"out": 5}, "out: got int; give the name of a file"),
        ({"recipe": []}, "recipe: got list; give the name of a TOML file"),
    ],
)
def test_wrong_arguments_of_a_fit_are_refused(arguments, message):
    with pytest.raises(rf.InputError, match=f"^{message}"):
        rf.fit_description(SURFACE, **arguments)


@pytest.mark.parametrize("surfaces", [(SURFACE,), (SURFACE, SURFACE)])
def test_a_recipe_that_is_neither_a_file_nor_entries_is_refused(surfaces):
    call = rf.prepare if len(surfaces) == 1 else rf.combine
    with pytest.raises(rf.InputError, match=r"^recipe: got int; give the name of a TOML file"):
        call(*surfaces, recipe=5)
