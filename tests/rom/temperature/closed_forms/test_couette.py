"""Films between parallel walls: the exact solutions by their differential equations and limits."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.temperature.closed_forms.couette import (
    adiabatic_couette,
    conducting_couette,
    heated_couette,
    speeds_at_stress,
)

FILM, VISCOSITY, COEFFICIENT, CONDUCTIVITY, HEAT = 35e-6, 0.06, 0.032, 0.14, 1.7e6
HEIGHT = np.linspace(0, FILM, 4001)
LIQUID = {
    "film": FILM,
    "viscosity": VISCOSITY,
    "reference": 313.0,
    "temperature_coefficient": COEFFICIENT,
    "conductivity": CONDUCTIVITY,
}


def test_an_adiabatic_film_is_the_integral_of_its_heating():
    given = {"film": FILM, "speed": 8.0, "viscosity": VISCOSITY, "temperature": 313.0, "heat_per_volume": HEAT}

    def slope(_, temperature):
        viscosity = VISCOSITY * np.exp(-COEFFICIENT * (temperature - 313))
        return 2 * viscosity * 8.0 / (HEAT * FILM**2)

    at = np.linspace(0, 0.08, 9)
    integral = solve_ivp(slope, (0, 0.08), [313.0], t_eval=at, rtol=1e-11, atol=1e-11).y[0]
    np.testing.assert_allclose(adiabatic_couette(at, temperature_coefficient=COEFFICIENT, **given), integral, rtol=1e-9)
    nearly = adiabatic_couette(at, temperature_coefficient=1e-9, **given)
    np.testing.assert_allclose(adiabatic_couette(at, temperature_coefficient=0.0, **given), nearly, rtol=1e-8)


@pytest.mark.parametrize(
    ("fixed", "sliding", "resistances"),
    [
        (313.0, 353.0, (0.0, 0.0)),
        (None, 320.0, (0.0, 0.0)),
        (320.0, None, (0.0, 0.0)),
        (313.0, 300.0, (2e-4, 5e-4)),
        (None, 300.0, (0.0, 5e-4)),
        (300.0, None, (5e-4, 0.0)),
    ],
)
def test_a_conducting_film_balances_heat_in_the_film_and_at_its_walls(fixed, sliding, resistances):
    first, last = resistances
    given = {"film": FILM, "speed": 8.0, "viscosity": VISCOSITY, "conductivity": CONDUCTIVITY}
    z = np.array([0.0, FILM / 2, FILM])
    low, middle, high = conducting_couette(
        z, **given, fixed=fixed, sliding=sliding, fixed_resistance=first, sliding_resistance=last
    )
    source = VISCOSITY * (8.0 / FILM) ** 2
    assert CONDUCTIVITY * (low - 2 * middle + high) / (FILM / 2) ** 2 == pytest.approx(-source)  # a parabola
    into_fixed = CONDUCTIVITY * (-3 * low + 4 * middle - high) / FILM
    into_sliding = CONDUCTIVITY * (-low + 4 * middle - 3 * high) / FILM
    for temperature, wall, resistance, flux in ((low, fixed, first, into_fixed), (high, sliding, last, into_sliding)):
        if wall is None:
            assert flux == pytest.approx(0, abs=1e-9 * source * FILM)
        else:
            assert temperature - wall == pytest.approx(resistance * flux, abs=1e-9)


@pytest.mark.parametrize(
    ("fixed", "sliding"), [(313.0, 313.0), (313.0, 353.0), (353.0, 300.0), (None, 318.0), (318.0, None)]
)
@pytest.mark.parametrize("speed", [0.5, 8.0, 80.0])
def test_a_heated_film_satisfies_its_equation_its_walls_and_its_speed(fixed, sliding, speed):
    heated = heated_couette(HEIGHT, speed=speed, fixed=fixed, sliding=sliding, **LIQUID)
    temperature, step = heated.temperature, HEIGHT[1]
    viscosity = VISCOSITY * np.exp(-COEFFICIENT * (temperature - 313))
    assert heated.stress * np.trapezoid(1 / viscosity, HEIGHT) == pytest.approx(speed, rel=1e-6)
    slopes = np.diff(temperature) / step
    sources = heated.stress**2 / viscosity
    # The heat through two sections differs by what is made between them.
    made = np.array([np.trapezoid(sources[:n], HEIGHT[:n]) for n in (1001, 3001)])
    middle = CONDUCTIVITY * (slopes[[999, 2999]] + slopes[[1000, 3000]]) / 2
    assert middle[0] - middle[1] == pytest.approx(made[1] - made[0], rel=1e-5)
    for wall, end, slope in ((fixed, 0, slopes[0]), (sliding, -1, slopes[-1])):
        if wall is None:
            assert abs(CONDUCTIVITY * slope) < 1e-3 * made[1]
        else:
            assert temperature[end] == pytest.approx(wall)
    assert heated.temperature_max == pytest.approx(temperature.max(), abs=1e-4)


def test_a_slightly_heated_film_is_that_of_constant_viscosity():
    given = {"film": FILM, "viscosity": VISCOSITY, "conductivity": CONDUCTIVITY, "speed": 1.0}
    constant = conducting_couette(HEIGHT, **given, fixed=313.0, sliding=313.0) - 313
    coefficients = np.array([1e-3, 1e-4])
    errors = [
        np.abs(
            heated_couette(
                HEIGHT, **given, reference=313.0, temperature_coefficient=beta, fixed=313.0, sliding=313.0
            ).temperature
            - 313
            - constant
        ).max()
        for beta in coefficients
    ]
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.01)


def test_equal_walls_follow_the_formula_of_nahme():
    speed = 8.0
    nahme = COEFFICIENT * VISCOSITY * speed**2 / CONDUCTIVITY
    heated = heated_couette(HEIGHT, speed=speed, fixed=313.0, sliding=313.0, **LIQUID)
    assert heated.temperature_max == pytest.approx(313 + math.log1p(nahme / 8) / COEFFICIENT)
    s = math.sqrt(nahme / 8)
    assert heated.stress == pytest.approx(VISCOSITY * speed / FILM * math.asinh(s) / (s * math.sqrt(1 + s**2)))


@pytest.mark.parametrize("adiabatic_wall", [False, True])
def test_a_stress_belongs_to_two_speeds_that_meet_at_the_greatest_one(adiabatic_wall):
    given = {name: value for name, value in LIQUID.items() if name != "reference"}
    walls = {"fixed": None if adiabatic_wall else 313.0, "sliding": 313.0}
    stress = heated_couette(HEIGHT, speed=5.0, **walls, **LIQUID).stress
    slow, fast = speeds_at_stress(stress, adiabatic_wall=adiabatic_wall, **given)
    assert slow == pytest.approx(5)
    assert heated_couette(HEIGHT, speed=fast, **walls, **LIQUID).stress == pytest.approx(stress)
    speeds = np.linspace(slow, fast, 2001)
    stresses = [heated_couette(HEIGHT[:1], speed=speed, **walls, **LIQUID).stress for speed in speeds]
    largest = max(stresses)
    assert np.diff(speeds_at_stress(largest, adiabatic_wall=adiabatic_wall, **given)) < 0.01 * (fast - slow)
    nahme = COEFFICIENT * VISCOSITY * speeds[np.argmax(stresses)] ** 2 / CONDUCTIVITY
    assert nahme == pytest.approx(4.553 if adiabatic_wall else 18.21, rel=0.01)
    with pytest.raises(InputError, match="stress: got"):
        speeds_at_stress(1.001 * largest, adiabatic_wall=adiabatic_wall, **given)


def test_a_film_that_keeps_its_heat_has_no_steady_temperature():
    with pytest.raises(InputError, match="one wall must have a temperature"):
        heated_couette(HEIGHT, speed=1.0, fixed=None, sliding=None, **LIQUID)
    with pytest.raises(InputError, match=r"speed: got 0\.0; it must be above 0"):
        heated_couette(HEIGHT, speed=0.0, fixed=None, sliding=313.0, **LIQUID)
