"""The definitions are complete, short, and those of the numbers that are computed."""

import numpy as np
import pytest

from roughfilm.contact.parameters.definitions import AREAL, GROUPS, PROFILE
from roughfilm.contact.parameters.roughness_parameters import parameters, profile_parameters
from roughfilm.contact.surfaces.surface import Surface

ALL = {**AREAL, **PROFILE}
MEANING_WIDTH = 38
"""Width that a terminal of 80 columns leaves to the meanings."""


@pytest.mark.parametrize("name", ALL)
def test_a_definition_is_complete_and_short(name):
    one = ALL[name]
    assert one.name == name
    assert one.group in GROUPS
    assert one.unit in ("m", "1", "deg", "1/m", "1/m^2")
    assert one.equation
    assert one.accuracy
    assert one.standard.startswith(("ISO 25178-2:2021, ", "ISO 21920-2:2021", "F. Sahlin"))
    assert 0 < len(one.meaning) <= MEANING_WIDTH


def test_groups_are_not_interrupted():
    for definitions in (AREAL, PROFILE):
        order = [one.group for one in definitions.values()]
        assert order == sorted(order, key=list(GROUPS).index)


def test_each_parameter_is_defined_and_has_its_unit():
    heights = np.random.default_rng(7601).normal(size=(40, 30))
    areal = parameters(Surface(heights=heights, spacing=(1e-6, 1e-6), periodic=True))
    line = profile_parameters(heights[:, 0], 1e-6)
    for found, definitions in ((areal, AREAL), (line, PROFILE)):
        assert {name: quantity.unit for name, quantity in found.items()} == {
            name: one.unit for name, one in definitions.items()
        }
