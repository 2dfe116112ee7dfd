"""The search for the temperature at which the heat of a film is balanced."""

import math

import pytest
from scipy.special import lambertw

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.thermal.balanced import HOTTEST, balanced

COLD = 300.0


@pytest.mark.parametrize("rise", [1e-3, 1.0, 30.0, 1000.0, 1e6])
@pytest.mark.parametrize("coefficient", [0.0, 0.01, 0.05])
def test_a_viscosity_that_falls_exponentially(rise, coefficient):
    """T - T0 = a exp(-β (T - T0)), whose root is W(aβ)/β with Lambert's function."""
    exact = COLD + (lambertw(rise * coefficient).real / coefficient if coefficient else rise)
    tried = []

    def equilibrium(at):
        tried.append(at)
        return COLD + rise * math.exp(-coefficient * (at - COLD))

    if exact > HOTTEST:
        with pytest.raises(InputError, match="thermal runaway"):
            balanced(equilibrium, COLD, tolerance=1e-9)
        return
    found = balanced(equilibrium, COLD, tolerance=1e-9)
    assert found.temperature == pytest.approx(exact, abs=2e-9)
    assert tried[-1] == found.temperature
    assert len(tried) < 45
    again = balanced(equilibrium, found.temperature + 0.01, slope=found.slope, tolerance=1e-6)
    assert again.temperature == pytest.approx(exact, abs=2e-6)


def test_of_several_balances_the_first_stable_one_is_taken():
    """T_eq crosses T from above at 310 K and 350 K, and from below, which is unstable, at 330 K."""

    def equilibrium(at):
        return at - 1e-3 * (at - 310) * (at - 330) * (at - 350) / 4

    assert balanced(equilibrium, 300.0, tolerance=1e-9).temperature == pytest.approx(310)
    assert balanced(equilibrium, 325.0, tolerance=1e-9).temperature == pytest.approx(310)
    assert balanced(equilibrium, 335.0, tolerance=1e-9).temperature == pytest.approx(350)


def test_it_cools_down_to_the_coldest_temperature():
    found = balanced(lambda at: 280 + 0.1 * (300 - at), 300.0, coldest=280.0, tolerance=1e-9)
    assert found.temperature == pytest.approx(280 + 20 / 11)
    with pytest.raises(InputError, match="the film cools"):
        balanced(lambda at: at - 1, 300.0, coldest=290.0, tolerance=1e-9)


def test_a_film_that_ends_before_its_balance_is_a_runaway():
    def equilibrium(at):
        if at > 345:
            raise InputError("load: is too large")
        return 400.0

    with pytest.raises(InputError, match=r"at every temperature, from 7\d.* to 126.9 °C.*load: is too"):
        balanced(equilibrium, 300.0, tolerance=1e-6)
