"""The inputs of a computation: the words on the first difference from those of a file."""

import numpy as np
import pytest

from roughfilm.contact.foundation.inputs import Inputs


@pytest.mark.parametrize(
    ("stored", "words"),
    [
        ({"cells": 8}, "with cells 8, not 16"),
        ({"scene": {"load": {"force": "1 N", "angle": "0 rad"}}}, "with scene.load.angle 0 rad, not 1 rad"),
        ({"scene": {"load": {"force": "1 N"}}}, "with scene.load.angle None, not 1 rad"),
        ({"code": "x"}, "of another version of roughfilm"),
        ({}, "of another surface"),
    ],
)
def test_a_difference_names_its_key_also_in_nested_tables(stored, words):
    own = {"cells": 16, "scene": {"load": {"force": "1 N", "angle": "1 rad"}}, "code": "y"}
    inputs = Inputs(heights=np.zeros((1, 1)), spacing=(1.0, 1.0), settings=own)
    assert inputs.difference({**own, **stored}) == words


def test_long_entries_are_shortened():
    inputs = Inputs(heights=np.zeros((1, 1)), spacing=(1.0, 1.0), settings={"times": list(range(1000))})
    assert len(inputs.difference({"times": list(range(1, 1000))})) < 150
