"""The slope of area against load, of the two theories that know it."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.exact.light_load import BUSH_GIBSON_THOMAS, PERSSON, light_load_area_fraction


def test_slopes_are_those_the_literature_gives_and_bound_solved_contacts():
    """Hyun et al. (2004) quote 1.6 and 2.5; what they and others since have solved lies between 2.0 and 2.2."""
    lower, upper = PERSSON, BUSH_GIBSON_THOMAS
    assert lower == pytest.approx(1.6, abs=0.005)
    assert upper == pytest.approx(2.5, abs=0.01)
    assert upper / lower == pytest.approx(np.pi / 2)


def test_area_grows_with_load_and_falls_with_stiffness_and_slope():
    load = np.array([1e5, 2e5, 7e6])
    area = light_load_area_fraction(load, composite_modulus=2e11, rms_slope=0.02, kappa=2.0)
    np.testing.assert_allclose(area, [5e-5, 1e-4, 3.5e-3])


@pytest.mark.parametrize("name", ["load", "composite_modulus", "rms_slope", "kappa"])
def test_what_makes_no_sense_is_refused(name):
    given = {"load": 1e6, "composite_modulus": 2e11, "rms_slope": 0.02, "kappa": PERSSON} | {name: float("nan")}
    with pytest.raises(InputError, match=name):
        light_load_area_fraction(given.pop("load"), **given)
