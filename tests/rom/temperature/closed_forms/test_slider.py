"""An adiabatic wedge: by its differential equations, by its energy, and its first-order changes."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.temperature.closed_forms.slider import adiabatic_slider, slightly_heated_slider

PAD = {"film": 40e-6, "rise": 60e-6, "length": 0.08, "speed": 12.0}
LIQUID = {"viscosity": 0.05, "heat_per_volume": 1.7e6}


def test_the_wedge_solves_reynolds_and_the_energy_equation():
    """Pressure, temperature and flow by collocation of p' and T' over x, in the units 6ηuL/h², 1/β and u h."""
    beta, (film, rise, length, speed) = 0.03, PAD.values()
    unit = 6 * 0.05 * speed * length / film**2
    heating = beta * 0.05 * speed * length / (1.7e6 * film**2)

    def equations(x, fields, parameter):
        _, temperature, _ = fields
        h, q, eta = 1 + rise / film * (1 - x), parameter[0], np.exp(-temperature)
        slope = 2 * eta * (h / 2 - q) / h**3
        return np.array([slope, heating * eta * (1 / h + 12 * (h / 2 - q) ** 2 / h**3) / q, -x * slope])

    def edges(first, last, _):
        return np.array([first[0], last[0], first[1], first[2]])

    x = np.linspace(0, 1, 21)
    start = np.array([x * (1 - x) / 4, x / 2, x / 10])
    solved = solve_bvp(equations, edges, x, start, p=[0.7], tol=1e-10, max_nodes=20000)
    assert solved.success
    heated = adiabatic_slider(**PAD, **LIQUID, temperature=313.0, temperature_coefficient=beta)
    assert heated.flow == pytest.approx(solved.p[0] * speed * film, rel=1e-8)
    assert heated.load == pytest.approx(solved.y[2, -1] * unit * length, rel=1e-8)
    assert heated.outlet_temperature - 313 == pytest.approx(solved.y[1, -1] / beta, rel=1e-8)


@pytest.mark.parametrize("ratio", [1.001, 2.0, 5.0, 40.0])
def test_energy_leaves_as_it_comes_in(ratio):
    pad = PAD | {"rise": (ratio - 1) * PAD["film"]}
    heated = adiabatic_slider(**pad, **LIQUID, temperature=313.0, temperature_coefficient=0.03)
    out = 1.7e6 * heated.flow * (heated.outlet_temperature - 313)
    assert out == pytest.approx(heated.friction * PAD["speed"], rel=1e-10)


def test_a_constant_viscosity_gives_the_isothermal_slider():
    heated = adiabatic_slider(**PAD, **LIQUID, temperature=313.0, temperature_coefficient=0.0)
    solution = linear_slider(**PAD, viscosity=0.05)
    assert (heated.load, heated.friction) == pytest.approx((solution.load, solution.friction), rel=1e-11)


def test_small_heating_changes_the_slider_by_its_first_order_to_second_order():
    constant = adiabatic_slider(**PAD, **LIQUID, temperature=313.0, temperature_coefficient=0.0)
    errors, numbers = [], []
    for beta in (4e-4, 2e-4, 1e-4):
        first = slightly_heated_slider(**PAD, **LIQUID, temperature_coefficient=beta)
        heated = adiabatic_slider(**PAD, **LIQUID, temperature=313.0, temperature_coefficient=beta)
        numbers.append(first.number)
        errors.append(
            [
                heated.load / constant.load - 1 - first.load_change,
                heated.friction / constant.friction - 1 - first.friction_change,
                heated.flow / constant.flow - 1 - first.flow_change,
            ]
        )
        assert first.outlet_rise == pytest.approx(constant.outlet_temperature - 313)
    orders = np.polyfit(np.log(numbers), np.log(np.abs(errors)), 1)[0]
    np.testing.assert_allclose(orders, 2, atol=0.03)


def test_a_film_that_does_not_narrow_is_refused():
    with pytest.raises(InputError, match=r"rise: got 0\.0 m"):
        adiabatic_slider(**PAD | {"rise": 0.0}, **LIQUID, temperature=313.0, temperature_coefficient=0.0)
