"""The temperatures that a heat and its flows bring about, against an integration along the film and the second law."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from roughfilm.rom.bearing.thermal.exchange import IN_A_MACHINE, Exchange, temperatures
from roughfilm.rom.lubricants.liquid import Liquid

COLD, CAPACITY = 313.15, 1.7e6


def liquid_of(growth=0.0):
    """A liquid whose volume takes the heat C (1 + g (T - T0)) dT."""

    def heat(temperature):
        above = temperature - COLD
        return CAPACITY * (above + growth * above**2 / 2), CAPACITY * (1 + growth * above)

    def viscosity(temperature):
        return np.full_like(temperature, 0.03), np.zeros_like(temperature)

    return Liquid(temperature=COLD, viscosity=viscosity, heat=heat, conductivity=0.13)


def exchange(power, flow, *, carried=0.0, conductance=2.0, surroundings=COLD - 20, entering=COLD, area=0.0):
    new = ((flow, entering),) if flow else ()
    return Exchange(
        power=power, new=new, carried=carried, conductance=conductance, surroundings=surroundings, area=area
    )


def integrated(given, liquid):
    """Inlet, outlet and mean of Q de/ds = P - G (T - T_a) with what recirculates, by a Runge–Kutta method."""
    flow, entering = given.new[0]
    whole, again = flow + given.carried, given.carried / (flow + given.carried)

    def along(inlet):
        def slope(_, state):
            capacity = liquid.heat(state[:1])[1][0] * whole
            return [(given.power - given.conductance * (state[0] - given.surroundings)) / capacity, state[0]]

        return solve_ivp(slope, (0, 1), [inlet, 0.0], method="LSODA", rtol=1e-11, atol=1e-9).y[:, -1]

    def mixing(inlet):
        heat_in, heat_out, heat_new = (liquid.heat(np.array([t]))[0][0] for t in (inlet, along(inlet)[0], entering))
        return heat_in - (1 - again) * heat_new - again * heat_out

    inlet = brentq(mixing, 200, 900, xtol=1e-9)
    return inlet, *along(inlet)


@pytest.mark.parametrize("carried", [0.0, 3e-6])
@pytest.mark.parametrize("units", [1e-9, 0.1, 1.0, 30.0])
@pytest.mark.parametrize("power", [0.0, 40.0])
def test_the_profile_along_the_film_is_that_of_its_differential_equation(units, carried, power):
    """Temperatures and their mean agree to rounding for a constant heat capacity, with transfer units from 0 to 30."""
    flow = 2e-6
    given = exchange(power, flow, carried=carried, conductance=units * CAPACITY * (flow + carried))
    found, exact = temperatures(given, liquid_of()), integrated(given, liquid_of())
    assert (found.inlet, found.outlet, found.effective) == pytest.approx(exact, abs=1e-6)
    off = given.conductance * (found.effective - given.surroundings)
    assert found.to_surroundings == pytest.approx(off, rel=1e-12)
    taken = CAPACITY * flow * (found.outlet - COLD)
    rounding = 1e-12 * CAPACITY * flow * COLD
    assert taken + off == pytest.approx(power, abs=1e-9 * (abs(off) + power) + rounding)


@pytest.mark.parametrize("growth", [2e-3, -1e-3])
def test_a_heat_capacity_that_varies_keeps_the_energy_and_nearly_the_profile(growth):
    liquid, flow = liquid_of(growth), 2e-6
    given = exchange(200.0, flow, carried=1e-6, conductance=3.0)
    found, exact = temperatures(given, liquid), integrated(given, liquid)
    rise = exact[1] - exact[0]
    assert rise > 5
    assert (found.inlet, found.outlet, found.effective) == pytest.approx(exact, abs=0.01 * rise)
    taken = flow * float(liquid.heat(np.array([found.outlet]))[0][0])
    assert taken + found.to_surroundings == pytest.approx(200.0, rel=1e-10)


def test_without_heat_transfer_the_film_has_the_mean_of_inlet_and_outlet():
    found = temperatures(exchange(50.0, 2e-6, carried=1e-6, conductance=None), liquid_of())
    assert found.outlet - COLD == pytest.approx(50.0 / (CAPACITY * 2e-6), rel=1e-12)
    assert found.inlet - COLD == pytest.approx((found.outlet - COLD) / 3, rel=1e-12)
    assert found.effective == pytest.approx((found.inlet + found.outlet) / 2, rel=1e-14)
    assert found.to_surroundings == 0


def test_nothing_leaves_colder_than_what_cools_it():
    """Random films: what leaves is between what enters and the temperature T_a + P/G of a film without flow."""
    random = np.random.default_rng(5)
    for _ in range(300):
        power = random.choice([0.0, 10 ** random.uniform(-3, 3)])
        flow, carried, conductance = 10.0 ** random.uniform([-16, -12, -4], [-4, -5, 2])
        entering, around = random.uniform(COLD - 40, COLD + 40, 2)
        given = exchange(power, flow, carried=carried, conductance=conductance, surroundings=around, entering=entering)
        found = temperatures(given, liquid_of())
        ends = sorted((entering, around + power / conductance))
        slack = 1e-9 * max(ends)
        assert ends[0] - slack <= found.outlet <= ends[1] + slack
        assert ends[0] - slack <= found.effective <= ends[1] + slack
        assert found.outlet >= min(entering, around) - slack
        # The entropy of the lubricant and of the surroundings does not fall.
        gained = CAPACITY * flow * math.log(found.outlet / entering) + found.to_surroundings / around
        assert gained >= -1e-9 * (abs(found.to_surroundings) + power) / around


def test_the_smaller_the_flow_the_nearer_is_the_film_to_the_convection_of_the_standard():
    """T_e = T_a + P/(α A) is the limit of no flow, which is reached in proportion to the flow."""
    limit = COLD - 20 + 30.0 / 2.0
    errors = [
        abs(temperatures(exchange(30.0, flow, carried=1e-7), liquid_of()).effective - limit)
        for flow in (1e-9, 1e-10, 1e-11, 0.0)
    ]
    assert errors[1] < 0.11 * errors[0]
    assert errors[2] < 0.11 * errors[1]
    assert errors[3] < 1e-9


def test_a_flow_that_cannot_carry_the_heat_leaves_the_rest_to_the_bearing():
    """The flow and the bearing take away at least what the standard's bearing in still air does, and no more."""
    area, rises = 1e-3, []
    still = IN_A_MACHINE * area
    for flow in (2 * still / CAPACITY, still / CAPACITY, 0.5 * still / CAPACITY, 0.0):
        given = exchange(1.0, flow, conductance=None, surroundings=COLD, area=area)
        found = temperatures(given, liquid_of())
        assert found.estimated == pytest.approx(max(still - flow * CAPACITY, 0.0))
        assert found.to_surroundings == pytest.approx(found.estimated * (found.effective - COLD))
        rises.append(found.effective - COLD)
    assert rises[:2] == pytest.approx([1 / (4 * still), 1 / (2 * still)])
    assert rises[-1] == pytest.approx(1 / still)
    assert rises == sorted(rises)
    assert not math.isnan(rises[2])
