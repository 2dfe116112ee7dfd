"""Marches between rough walls: averaged roughness, and asperities that carry what the film does not."""

import numpy as np
import pytest
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.film import averaged_films
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.ladder.scene import read_scene

BORE = {"shape": "lobes", "radius": "10 mm", "width": "10 mm", "clearance": "10 um"}
PAD = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.6}
PLATES = {"shape": "parallel", "length": "20 mm"}
FED = {"sides": {"low": "1 bar", "high": "1 bar"}}
CELLS = (16, 8)


def heavy(tips, speed, **more):
    load = {"force": "1 kN"}
    return tips.scene(BORE, motion={"speed": speed}, boundary=FED, load=load, **more)


def test_a_heavy_shaft_comes_to_rest_on_its_asperities(tips):
    """∫ P₀ (1 - h/T)^1.5 cos φ dA over h = c (1 - ε cos φ) is the load, by quadrature."""
    bearing = heavy(tips, "0 m/s", body={"start": {"eccentricity": [0.0, -0.5]}})
    march = march_bearing(bearing, end=20.0, cells=(24, 8), uncertain=False)
    angle = np.linspace(-np.pi, np.pi, 20_001)

    def excess(ratio):
        pressure = tips.pressure(10e-6 * (1 - ratio * np.cos(angle)))
        return float(np.trapezoid(pressure * np.cos(angle), angle)) * 10e-3 * 10e-3 - 1000

    assert march["contact_load"][0] == 0
    assert march["contact_load"][-1] == pytest.approx(1000, rel=1e-6)
    assert -march["eccentricity_y"][-1] == pytest.approx(brentq(excess, 0.8, 0.97), rel=5e-4)
    assert march["friction"][-1] > tips.friction * march["contact_load"][-1]
    assert np.abs(march["residual"]).max() < 1e-8


def test_a_slow_shaft_ends_in_the_equilibrium_of_film_and_asperities(tips):
    bearing = heavy(tips, "0.05 m/s", body={"start": {"eccentricity": [0.15, -0.85]}})
    march = march_bearing(bearing, end=2.0, steps=14, cells=CELLS)
    law = tips.table()
    film = free_film(bearing, CELLS, film=lambda one: mixed_problem(one, law), contact=law)
    place = equilibrium(film, None, tolerance=1e-10).place / film.wall.unit
    assert [march["eccentricity_x"][-1], march["eccentricity_y"][-1]] == pytest.approx(place, abs=1e-5)
    for part in ("force_x", "force_y"):
        carried = march[f"film_{part}"] + march[f"contact_{part}"]
        assert np.abs(carried + march[f"load_{part}"])[1:].max() < 1e-5
    assert 0.3 < march["contact_load"][-1] / 1000 < 0.9
    assert np.abs(march["flow_imbalance"]).max() < 1e-9
    load, film_min = march.quantities["contact_load_mean"], march.quantities["film_min"]
    assert 0 < load.uncertainty < load.value
    assert 0 < film_min.uncertainty < film_min.value


def test_plates_that_close_squeeze_until_their_tips_carry_the_load(tips):
    """Smooth while apart, dh/dt = -(W - L p_c) h³/(η L³) per width, and p_c = W/L at the end."""
    force = 2e5
    bearing = tips.scene(
        PLATES,
        motion={"speed": "0 m/s"},
        load={"force_per_width": f"{force} N/m"},
        body={"start": {"film": "5 um"}},
    )
    march = march_bearing(bearing, end=10, cells=(32, 8), uncertain=False)
    speed = -(force - 0.02 * tips.pressure(march["film"])) * march["film"] ** 3 / (0.1 * 0.02**3)
    assert march["film_velocity"][1:] == pytest.approx(speed[1:], rel=5e-3, abs=1e-5 * np.abs(speed).max())
    assert march["contact_load"][-1] == pytest.approx(force, rel=1e-3)
    assert tips.pressure(march["film"][-1]) == pytest.approx(force / 0.02, rel=1e-3)


def test_the_pad_of_averaged_ridges_ends_in_its_equilibrium():
    bearing = ridged(load={"pressure": "2 MPa"})
    march = march_bearing(bearing, end=0.05, steps=40, cells=(12, 8), uncertain=False)
    film = free_film(bearing, (12, 8), film=averaged_films(bearing).film)
    place = equilibrium(film, None, tolerance=1e-10).place
    assert [march["pivot_film"][-1], march["slope_x"][-1]] == pytest.approx(place, rel=1e-3)
    smooth = free_film(bearing, (12, 8))
    assert march["pivot_film"][-1] > 1.001 * equilibrium(smooth, None, tolerance=1e-10).place[0]


def ridged(direction="0 deg", **tables):
    ridges = {"kind": "sinusoid", "amplitude": "6 um", "wavelength": "400 um", "direction": direction}
    lubricant, motion = {"viscosity": "30 mPa*s"}, {"speed": "10 m/s"}
    entries = {"lubricant": lubricant, "motion": motion, "roughness": ridges, "geometry": PAD} | tables
    return read_scene({"name": "ridges", "kind": "bearing", **entries})


def test_ridges_that_touch_without_asperities_are_one_line():
    apart = {"load": {"force_per_width": "2e4 N/m"}, "motion": {"speed": "0 m/s"}, "geometry": PLATES}
    with pytest.raises(InputError, match=r"body\.start\.film: the walls are .* closer than flow factors"):
        march_bearing(ridged(**apart, body={"start": {"film": "5 um"}}), end=1.0, cells=(16, 8))
    with pytest.raises(ConvergenceError, match="the walls touch"):
        march_bearing(ridged("90 deg", **apart, body={"start": {"film": "8 um"}}), end=1.0, cells=(16, 8))
