"""The limits of laminar flow in bearings: right values, every model, and every series."""

import math

import numpy as np
import pytest
from forging import forge
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.bearing.models import navier_stokes, stokes
from roughfilm.interface.motion import march
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.bearing.dynamics.store import write_ross
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.effects.ablation import Variant
from roughfilm.rom.bearing.effects.analysis import analyse_effects
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.mixed import store
from roughfilm.rom.bearing.mixed.curves import curve_inputs
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.bearing.outside import channel_outside, reynolds_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.parts.laminar import PRESSURE_LIMIT, SHEAR_LIMIT, TAYLOR
from roughfilm.words.summary import summary

WATER = {"viscosity": "0.5 mPa*s", "density": "1000 kg/m^3"}
PAD = {"shape": "linear", "length": "40 mm", "film": "50 um", "rise": "50 um"}
THICK = {"viscosity": "5 mPa*s", "density": "1000 kg/m^3"}
LOBES = {"shape": "lobes", "radius": "50 mm", "width": "60 mm", "clearance": "100 um", "lobes": 2, "arc": "160 deg"}


def scene(geometry, lubricant=WATER, speed="1 m/s", **tables) -> Bearing:
    entries = {"name": "film", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    return Bearing.model_validate({**entries, "motion": {"speed": speed}, **tables})


def numbers(bearing, cells=32):
    return reynolds_numbers(bearing, solve(bearing.problem(), (cells, cells)))


def test_the_shear_flow_counts_where_the_film_is_thickest():
    assert numbers(scene(PAD, speed="3 m/s")).shear == pytest.approx(1000 * 3 * 100e-6 / 5e-4)
    sector = {"shape": "sector", "inner_radius": "150 mm", "outer_radius": "300 mm", "angle": "40 deg"}
    found = numbers(scene({**sector, "film": "60 um", "rise": "60 um"}, speed="3000 rpm"))
    assert found.shear == pytest.approx(1000 * 2 * math.pi * 50 * 0.3 * 120e-6 / 5e-4)


def test_the_flow_by_pressure_is_that_between_plates():
    flat = {"shape": "parallel", "length": "40 mm", "film": "50 um"}
    fed = scene(flat, speed="0 m/s", boundary={"inlet": {"pressure": "5 MPa"}})
    flow = 50e-6**3 * 5e6 / (12 * 5e-4 * 40e-3)
    assert numbers(fed).pressure == pytest.approx(1000 * flow / 5e-4, rel=1e-9)
    assert numbers(fed).shear == 0
    bore = {"shape": "lobes", "lobes": 1, "radius": "50 mm", "width": "60 mm", "clearance": "100 um"}
    seal = scene({**bore, "eccentricity": [0.0, 0.0]}, speed="0.01 m/s", boundary={"sides": {"low": "1 MPa"}})
    flow = 100e-6**3 * 1e6 / (12 * 5e-4 * 60e-3)
    assert numbers(seal).pressure == pytest.approx(1000 * flow / 5e-4, rel=1e-6)


def test_the_flow_by_pressure_of_a_tapered_pad_is_what_sliding_does_not_carry():
    bearing = scene(PAD, speed="3 m/s")
    flow = 3 * 50e-6 * 100e-6 / 150e-6  # h1 h2/(h1 + h2) u of the linear pad
    largest = 1000 * (3 * 100e-6 / 2 - flow) / 5e-4
    assert 0.98 * largest < numbers(bearing, 256).pressure <= largest, "of 99 % of the area"


def test_the_density_is_that_at_the_pressure_of_the_film():
    law = {"law": "tabulated", "table": [[0, 1], [1e7, 2], [1e9, 101]]}
    thick = {**WATER, "compressibility": law}
    fed = {"inlet": {"pressure": "10 MPa"}, "outlet": {"pressure": "10 MPa"}}
    flat = {"shape": "parallel", "length": "40 mm", "film": "50 um"}
    plain, dense = (numbers(scene(flat, lubricant, boundary=fed)).shear for lubricant in (WATER, thick))
    assert dense == pytest.approx(2 * plain, rel=1e-6)


def test_cylinders_are_judged_by_the_limit_of_taylor():
    concentric = {"shape": "journal", "radius": "200 mm", "clearance": "0.3 mm", "eccentricity": 0.0, "width": "300 mm"}
    limit = TAYLOR * math.sqrt(200 / 0.3)
    speed = limit * 0.012 / (860 * 0.3e-3)
    for factor, beyond in ((0.99, False), (1.01, True)):
        bearing = scene(concentric, {"viscosity": "12 mPa*s", "density": "860 kg/m^3"}, speed=f"{factor * speed} m/s")
        found = models("bearing")[0].solve(bearing, Request(resolution=16)).outside
        assert any("Taylor" in one for one in found) == beyond
    assert limit == pytest.approx(1063.8, rel=1e-4)


def test_a_film_of_unknown_density_is_judged_with_that_of_water_and_says_so():
    thin = {"viscosity": "0.5 mPa*s"}
    (found,) = models("bearing")[0].solve(scene(PAD, thin, speed="10 m/s"), Request(resolution=16)).outside
    assert "Re = ρuh/η = 2000 exceeds 1440" in found
    assert "with a density of 1000 kg/m³, as lubricant.density is missing" in found
    oil = {"viscosity": "30 mPa*s"}
    assert models("bearing")[0].solve(scene(PAD, oil, speed="10 m/s"), Request(resolution=16)).outside == ()


ROUGH = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "2 mm"}
THINNED = {"law": "carreau_yasuda", "index": 0.9, "critical_stress": "1 MPa"}
HOT = {"oil": "water", "temperature": "30 degC"}
GENTLE = {"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "20 um"}
SCENES = {
    **{name: {} for name in ("reynolds", "reynolds_incompressible", "reynolds_cavitating", "film", "film_slope")},
    "infinitely_wide": {"geometry": {**PAD, "width": "80 mm"}},
    **{name: {"roughness": ROUGH} for name in ("homogenized", "direct")},
    "shear_thinning": {"lubricant": {**WATER, "shear_thinning": THINNED}},
    **{name: {"lubricant": HOT, "heat": {}} for name in ("heat_balance", "adiabatic", "across")},
    "mixed": {"geometry": GENTLE, "lubricant": WATER},
}
"""What the scene of each model that runs in this process has in place of the water pad's."""


def scene_of(name, speed, tips):
    if name == "mixed":
        return tips.scene(**SCENES[name], motion={"speed": speed})
    own = {key: entry for key, entry in SCENES[name].items() if entry or key != "heat"}
    return scene(**{"geometry": PAD, "lubricant": WATER, "speed": speed, **own})


def test_every_model_that_runs_here_has_a_scene():
    assert {model.name for model in models("bearing") if not model.outside} == SCENES.keys()


@pytest.mark.parametrize("name", SCENES)
def test_no_model_promises_anything_beyond_the_laminar_limit(name, tips):
    (model,) = [one for one in models("bearing") if one.name == name]
    resolution = Request(resolution=64 if name in ("film", "film_slope", "direct") else 16)
    slow, fast = scene_of(name, "0.5 m/s", tips), scene_of(name, "60 m/s", tips)
    assert model.solve(slow, resolution).outside == ()
    found = with_errors(model.solve(fast, resolution), fast, model, models("bearing"))
    assert any("Re = ρuh/η" in one and f"exceeds {SHEAR_LIMIT:g}" in one for one in found.outside)
    assert found.expected_error == {}
    assert summary(found, "load_per_width", 0.05).startswith("outside the range of the model: Re = ")
    advice = advise(fast, models("bearing"), quantity="load_per_width", within=0.5)
    assert (advice.chosen, advice.nearest) == (None, None)


@pytest.mark.parametrize("model", [navier_stokes.MODEL, stokes.MODEL])
def test_the_models_of_openfoam_are_judged_before_their_run(model):
    if not model.available().available:
        pytest.skip(f"no OpenFOAM here: {model.available().detail}")
    fast = scene(PAD, speed="60 m/s")
    verdicts = {one.model: one for one in advise(fast, [model], quantity="load_per_width", within=0.5).considered}
    assert "exceeds 1440" in verdicts[model.name].reason


def test_the_flow_of_openfoam_is_judged_after_its_run():
    slow = scene(PAD, speed="0.5 m/s")
    thickness, pressure = np.linspace(100e-6, 50e-6, 20), np.zeros(2)
    assert channel_outside(slow, thickness, 0.5 * 100e-6 / 3, pressure) == ()
    (found,) = channel_outside(scene(PAD, speed="10 m/s"), thickness, 10 * 100e-6 / 3, pressure)
    assert "Re = ρuh/η = 2000 exceeds 1440" in found
    (found,) = channel_outside(slow, thickness, 1.0e-3, pressure)
    assert f"exceeds {PRESSURE_LIMIT:g}" in found


def test_a_flow_against_the_sliding_is_driven_by_the_pressure_all_the_more():
    water = {"viscosity": "1 mPa*s", "density": "1000 kg/m^3"}
    bearing, thickness = scene({**PAD, "film": "20 um"}, water, speed="10 m/s"), np.full(2, 20e-6)
    (found,) = channel_outside(bearing, thickness, -1.25e-3, np.zeros(2))
    assert "1350" in found, "1.25e-3 m2/s back and uh/2 = 1e-4 m2/s carried along, over 1e-6 m2/s"
    assert channel_outside(bearing, thickness, 1.25e-3, np.zeros(2)) == ()


SLOW, FAST = 0.5, 60.0
"""Sliding speeds, m/s, of laminar and turbulent films of water."""


def test_a_stribeck_curve_says_which_points_are_beyond_the_limit():
    bearing = scene({**PAD, "width": "80 mm"})
    (curve,) = stribeck(bearing, [2.0, FAST], [5e4], resolution=16)
    slow, fast = curve.points
    assert slow.outside == ()
    assert any("exceeds 1440" in one for one in fast.outside)


def test_stiffness_and_damping_say_which_points_are_beyond_the_limit():
    bearing = scene(LOBES, THICK, load={"force": "500 N"})
    (curve,) = dynamics(bearing, [5.0, 200.0], [bearing.load_pressure], resolution=32)
    slow, fast = curve.points
    assert slow.outside == ()
    assert any("Taylor" in one for one in fast.outside)
    assert any("exceeds 1440" in one for one in fast.outside)


def test_a_march_says_at_which_steps_it_is_beyond_the_limit():
    over_time = {"time": ["0 s", "1 ms", "2 ms"], "speed": ["5 m/s", "5 m/s", "200 m/s"]}
    lobes = {**LOBES, "eccentricity": [0.3, 0.0]}
    bearing = scene(lobes, THICK, motion={"speed": "5 m/s", "over_time": over_time})
    found = march(bearing, steps=10, cells=(16, 8), uncertainty=False)
    assert found["reynolds_number_of_clearance"] == pytest.approx(1000 * found["speed"] * 100e-6 / 5e-3)
    (taylor,) = [one for one in found.outside if "Taylor" in one]
    beyond = found["reynolds_number_of_clearance"] > TAYLOR * math.sqrt(500)
    assert f"at {beyond.sum()} of {beyond.size} steps" in taylor
    assert 0 < beyond.sum() < beyond.size


def test_the_effects_of_a_bearing_say_that_it_is_beyond_the_limit():
    for speed, beyond in (("0.5 m/s", False), ("60 m/s", True)):
        study = analyse_effects(scene({**PAD, "width": "80 mm"}, speed=speed), 16, models("bearing")).at_film
        assert bool(study.outside) == beyond


@pytest.mark.parametrize(("speed", "pressure", "beyond"), [("0.5 m/s", 500.0, False), ("60 m/s", 5e4, True)])
def test_the_effects_under_a_load_say_that_the_film_is_beyond_the_limit(speed, pressure, beyond):
    bearing = scene({**PAD, "width": "80 mm"}, speed=speed)
    found = under_load(Variant(scene=bearing), pressure, 16).outside
    assert any("Re = ρuh/η" in one for one in found) == beyond


GAS = {"viscosity": "18.5 uPa*s", "cavitation_pressure": "-91192.5 Pa"}
SLIDER = {"shape": "linear", "length": "10 mm", "film": "10 um", "rise": "10 um"}
TABLE = [[0, 1], [91192.5, 10], [192517.5, 20], [1104442.5, 110]]


def ideal_gas_slider() -> dict[str, float]:
    """Load, N/m, and peak pressure, Pa, of the air slider by P H³ P' = Λ (P H - C) of an isothermal ideal gas."""
    ambient, length = 101325.0, 0.01
    number = 6 * 18.5e-6 * 50 * length / (ambient * 1e-10)

    def film(flow):
        slope = lambda x, p: number * (p * (2 - x) - flow) / (p * (2 - x) ** 3)  # noqa: E731
        return solve_ivp(slope, (0, 1), [1.0], method="DOP853", rtol=1e-12, atol=1e-13, dense_output=True)

    flow = brentq(lambda flow: film(flow).y[0, -1] - 1, 1.0, 1.9)
    x = np.linspace(0, 1, 100_001)
    over = (film(flow).sol(x)[0] - 1) * ambient
    return {"load_per_width": float(np.trapezoid(over, x)) * length, "pressure_max": float(over.max())}


def test_a_gas_without_a_law_is_not_taken_as_a_liquid_in_silence():
    air = scene(SLIDER, {**GAS, "density": "1.2 kg/m^3"}, speed="50 m/s")
    assert any("gas" in one for one in models("bearing")[0].solve(scene(SLIDER, GAS, speed="50 m/s")).outside)
    for model in models("bearing"):
        if model.name in ("reynolds_cavitating", "reynolds_incompressible", "reynolds", "film", "film_slope"):
            found = model.solve(air, Request(resolution=64))
            (reason,) = found.outside
            assert "taken as incompressible: Λ = 6ηuL/(p_a h²) = 5.48" in reason
    assert advise(air, models("bearing"), quantity="load_per_width", within=0.5).chosen is None


def test_a_gas_with_its_law_is_that_of_the_equation_of_ideal_gases():
    air = scene(SLIDER, {**GAS, "compressibility": {"law": "tabulated", "table": TABLE}}, speed="50 m/s")
    by = {model.name: model for model in models("bearing")}
    found = by["reynolds_cavitating"].solve(air)
    assert found.outside == ()
    true = ideal_gas_slider()
    assert true["load_per_width"] == pytest.approx(134.525193, rel=1e-8)
    for name, value in true.items():
        assert abs(found[name].value - value) <= found[name].uncertainty <= 1e-5 * value
    (reason,) = by["reynolds_incompressible"].solve(air, Request(resolution=64)).outside
    assert "gas" in reason


def test_pressures_that_hardly_differ_from_ambient_do_not_compress_a_gas():
    slow = scene(SLIDER, GAS, speed="0.01 m/s")
    assert models("bearing")[0].solve(slow, Request(resolution=64)).outside == ()


def test_the_table_for_ross_says_where_it_is_outside_the_range(tmp_path):
    bearing = scene(LOBES, THICK, load={"force": "500 N"})
    curves = dynamics(bearing, [5.0, 200.0], [bearing.load_pressure], resolution=32)
    write_ross(tmp_path / "ross.toml", bearing, curves[0])
    said = [line for line in (tmp_path / "ross.toml").read_text().splitlines() if "outside the range" in line]
    assert len(said) == 1
    assert said[0].startswith("# at 4000 rad/s ")


def test_stiffness_of_a_bearing_without_a_load_is_that_under_the_given_one():
    with_load = scene(LOBES, THICK, load={"force": "500 N"})
    without = scene({**LOBES, "eccentricity": [0.0, 0.0]}, THICK)
    one, other = (
        dynamics(bearing, [5.0], [500 / (0.1 * 0.06)], resolution=32)[0].points[0] for bearing in (with_load, without)
    )
    assert one.numbers == other.numbers


def test_a_file_whose_sentences_are_not_those_of_its_points_is_refused(tmp_path):
    bearing = scene({**PAD, "width": "80 mm"})
    (curve,) = stribeck(bearing, [2.0, FAST], [5e4], resolution=16)
    path, inputs = tmp_path / "stribeck.h5", curve_inputs(bearing, None, 16)
    store.save_points(path, inputs, curve.points)
    assert [one.outside for one in store.known_points(path, inputs)] == [one.outside for one in curve.points]
    forge(path, lambda file: file.attrs.update(outside="[]"))
    with pytest.raises(InputError, match="another number of points"):
        store.known_points(path, inputs)
