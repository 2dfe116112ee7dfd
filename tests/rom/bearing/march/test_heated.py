"""Marches of films whose temperature follows the balance of their heat."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.special import lambertw

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

COLD, BETA, TAU, CELLS = 40.0, 0.035, 0.01, (16, 8)
OIL = {
    "viscosity": "0.03 Pa*s",
    "density": "870 kg/m^3",
    "heat_capacity": "2000 J/(kg*K)",
    "temperature": f"{COLD} degC",
    "cavitation_pressure": "-0.1 MPa",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{BETA} 1/K"},
}
STIFF = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
BORE = {"shape": "lobes", "radius": "25 mm", "clearance": "30 um", "width": "40 mm"}
PLACED = BORE | {"eccentricity": [0.1, -0.1]}
THROUGH = {"sides": {"low": "1 MPa"}}
LOADED = {
    "geometry": BORE,
    "load": {"force": "2 kN"},
    "boundary": {"sides": {"low": "0.5 MPa", "high": "0.5 MPa"}},
}
SLOW = {"time_constant": f"{TAU} s"}


def scene_of(geometry, *, oil=(), speed="5 m/s", **tables):
    tables = {"lubricant": dict(oil) if "oil" in dict(oil) else OIL | dict(oil), "motion": {"speed": speed}} | tables
    return read_scene({"name": "heated", "kind": "bearing", "geometry": geometry, **tables})


def marched(geometry, *, end, steps=None, uncertain=False, **options):
    return march_bearing(scene_of(geometry, **options), end=end, steps=steps, cells=CELLS, uncertain=uncertain)


def test_a_start_from_cold_with_constant_friction_is_an_exponential():
    """With a viscosity that does not change T = T_eq - (T_eq - T0) exp(-t/τ); steps are of second order."""
    errors = []
    for steps in (20, 40, 80):
        march = marched(PLACED, end=2 * TAU, steps=steps, oil=STIFF, heat=SLOW, boundary=THROUGH)
        final = march["balanced_temperature"]
        assert np.ptp(final) < 1e-6 * (final[0] - COLD)
        exact = final[0] - (final[0] - COLD) * np.exp(-march.time / TAU)
        assert final[0] > COLD + 5
        errors.append(np.abs(march["temperature"] - exact).max() / (final[0] - COLD))
    assert errors[-1] < 1e-3
    assert math.log2(errors[0] / errors[1]) > 1.7
    assert math.log2(errors[1] / errors[2]) > 1.7


def test_every_quantity_contains_a_factor_of_two_of_a_heat_transfer_that_is_estimated():
    """Petroff's friction goes to the surroundings by 300 W/(m² K) over diameter times width: a Lambert function."""
    speed, area = 1.0, 50e-3 * 40e-3
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    place = BORE | {"eccentricity": [0.0, 0.0]}
    options = {"speed": f"{speed} m/s", "boundary": still}
    march = marched(place, end=TAU, steps=4, uncertain=True, **options)

    def temperature(transfer):
        rise = 2 * math.pi * 0.03 * speed**2 * 25e-3 * 40e-3 / 30e-6 / (transfer * area)
        return COLD + lambertw(BETA * rise).real / BETA

    colder, own, hotter = (temperature(part * 300.0) for part in (2.0, 1.0, 0.5))
    found = march.quantities
    assert found["temperature_mean"].value == pytest.approx(own, rel=1e-3)
    assert found["temperature_mean"].uncertainty == pytest.approx(hotter - own, rel=0.05)
    change = max(abs(math.exp(-BETA * (one - own)) - 1) for one in (colder, hotter))
    power = found["power_loss_mean"]
    (warning,) = [one for one in march.warnings if "heat.heat_transfer and heat.area" in one]
    assert warning.endswith("; the uncertainty contains a factor of two of it")
    known = marched(
        place, end=TAU, steps=4, uncertain=True, heat={"heat_transfer": "300 W/(m^2*K)", "area": "20 cm^2"}, **options
    )
    assert known.quantities["temperature_mean"].uncertainty < 0.01 * (own - COLD)
    of_grid = known.quantities["power_loss_mean"].uncertainty
    assert power.uncertainty - of_grid == pytest.approx(change * power.value, rel=1e-3)


def test_steps_whose_heat_transfer_is_estimated_are_said_once():
    """Petroff's friction of cold oil goes to the surroundings by 300 W/(m² K) over diameter times width."""
    speed, area = 1.0, 50e-3 * 40e-3
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    place = BORE | {"eccentricity": [0.0, 0.0]}
    march = marched(place, end=TAU, steps=4, speed=f"{speed} m/s", heat=SLOW, boundary=still)
    rise = 2 * math.pi * 0.03 * speed**2 * 25e-3 * 40e-3 / 30e-6 / (300 * area)
    assert march["balanced_temperature"][0] == pytest.approx(COLD + rise, rel=1e-6)
    assert march["estimated_heat_transfer"] == pytest.approx(300 * area, rel=1e-6)
    (warning,) = [one for one in march.warnings if "heat.heat_transfer and heat.area" in one]
    held = np.count_nonzero(march.time >= march.first)
    assert warning.startswith(f"temperature: at {held} of {held} steps in that time ")
    cooled = SLOW | {"heat_transfer": "300 W/(m^2*K)", "area": "20 cm^2"}
    given = marched(place, end=TAU, steps=4, speed=f"{speed} m/s", heat=cooled, boundary=still)
    assert not any("heat.area" in one for one in given.warnings)
    assert given["temperature"] == pytest.approx(march["temperature"], rel=1e-9)


def test_a_given_film_warms_as_its_equation_says():
    """A concentric shaft gives Petroff's friction P to the surroundings: τ dT/dt = T0 + P(T)/(α A) - T."""
    heat = SLOW | {"heat_transfer": "20 W/(m^2*K)", "area": "0.1 m^2", "surroundings": f"{COLD} degC"}
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    rise = 2 * math.pi * 0.03 * 5.0**2 * 25e-3 * 40e-3 / 30e-6 / 2.0

    def rate(warmed):
        return (rise * math.exp(-BETA * warmed) - warmed) / TAU

    count = 4000
    size, warmed, exact = 2 * TAU / count, 0.0, [0.0]
    for _ in range(count):
        k1 = rate(warmed)
        k2 = rate(warmed + size / 2 * k1)
        k3 = rate(warmed + size / 2 * k2)
        warmed += size / 6 * (k1 + 2 * k2 + 2 * k3 + rate(warmed + size * k3))
        exact.append(warmed)
    times = np.linspace(0, 2 * TAU, count + 1)
    errors = [
        np.abs(march["temperature"] - COLD - np.interp(march.time, times, exact)).max()
        for march in (
            marched(BORE | {"eccentricity": [0.0, 0.0]}, end=2 * TAU, steps=steps, heat=heat, boundary=still)
            for steps in (20, 80)
        )
    ]
    assert errors[-1] < 2e-3 * warmed
    assert math.log(errors[0] / errors[1], 4) > 1.7


def test_a_film_that_cools_in_one_step_is_not_expected_below_what_cools_it():
    """The loaded film at rest is 280 K above the supply, the moving one 60 K: a line through both falls below 0 K."""
    march = marched(
        BORE | {"radius": "15 mm", "width": "30 mm"},
        end=None,
        steps=4,
        oil={"oil": "ISO VG 460", "temperature": "60 degC", "cavitation_pressure": "-0.1 MPa"},
        speed="30 m/s",
        load={"pressure": "40 MPa"},
    )
    assert march["temperature"][0] > 2 * march["temperature"][1]
    assert march["temperature"].min() > 60


@pytest.mark.parametrize("heat", [SLOW, {"carried_over": 0.7}], ids=["walls", "at once"])
def test_a_march_ends_at_the_film_of_heat_balance(heat):
    near = {"eccentricity": [0.34, -0.07]} | ({"temperature": "60 degC"} if heat is SLOW else {})
    options = LOADED | {"heat": heat, "body": {"start": near}}
    march = marched(**options, end=0.12)
    steady = find("bearing", "heat_balance").solve(scene_of(**options), Request(resolution=CELLS[0]))
    rise = steady["effective_temperature"].value - COLD
    assert march["temperature"][-1] - COLD == pytest.approx(rise, rel=2e-3)
    assert march["balanced_temperature"][-1] == pytest.approx(march["temperature"][-1], abs=1e-2 * rise)
    assert march["film_min"][-1] == pytest.approx(steady["film_min"].value, rel=2e-3)
    assert march["power_loss"][-1] == pytest.approx(steady["power_loss"].value, rel=2e-3)
    assert march.quantities["temperature_max"].value >= march.quantities["temperature_mean"].value


def test_a_pad_with_an_inlet_ends_at_the_temperature_of_heat_balance():
    pad = {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "20 um"}
    march = marched(pad, end=8 * TAU, steps=40, heat=SLOW)
    steady = find("bearing", "heat_balance").solve(scene_of(pad), Request(resolution=CELLS[0]))
    quantity = steady["effective_temperature"]
    assert quantity.value > COLD + 1
    assert march["temperature"][-1] == pytest.approx(quantity.value, abs=quantity.uncertainty)


def test_a_viscosity_that_does_not_change_leaves_the_path():
    """The path and all other numbers are those of the isothermal march to the last bit."""
    options = LOADED | {"oil": STIFF, "body": {"start": {"eccentricity": [0.1, 0]}}}
    hot = marched(**options, end=0.02, steps=30, heat=SLOW)
    cold = march_bearing(scene_of(**options).isothermal(), end=0.02, steps=30, cells=CELLS, uncertain=False)
    for name in cold.series.units.keys() - {"error"}:
        assert (hot[name] == cold[name]).all(), name


def test_it_begins_at_a_given_temperature_and_goes_on_from_its_file(tmp_path: Path):
    warm = {"start": {"eccentricity": [0.2, -0.3], "temperature": "70 degC"}}
    scene = scene_of(**LOADED, heat=SLOW, body=warm)
    whole = march_bearing(scene, end=0.01, cells=CELLS, path=tmp_path / "series.h5")
    again = march_bearing(scene, end=0.01, cells=CELLS, path=tmp_path / "series.h5")
    assert whole["temperature"][0] == pytest.approx(70)
    assert (again["temperature"] == whole["temperature"]).all()
    assert again.series.known == len(again.time)
    assert whole.quantities["temperature_mean"].uncertainty > 0


def test_a_first_temperature_needs_a_time_constant():
    with pytest.raises(InputError, match=r"body.start.temperature: .*heat.time_constant"):
        marched(**LOADED, body={"start": {"temperature": "70 degC"}}, end=0.01)


@pytest.mark.parametrize("cells", [(8, 8), (16, 8)])
def test_a_squeezed_film_heats_by_the_mean_pressure_over_the_heat_of_its_volume(cells):
    """The walls displace V A on any grid, whose heat is their power ∫ p V dA: ρ c (T_out - T0) = p_mean.

    The temperature of the film is the mean of T0 and T_out.
    """
    pad = {"shape": "parallel", "length": "20 mm", "width": "20 mm", "film": "20 um"}
    scene = scene_of(pad, oil=STIFF, heat=SLOW, motion={"speed": "0 m/s", "approach": "20 mm/s"})
    march = march_bearing(scene, end=1e-4, steps=4, cells=cells, uncertain=False)
    mean = march["film_force"] / (20e-3 * 20e-3)
    assert mean.min() > 10e6
    np.testing.assert_allclose(march["balanced_temperature"] - COLD, mean / (2 * 870 * 2000), rtol=1e-6)
