"""Bearings whose lubricant thins with shear: against films of constant viscosity, a power law, and a given film."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import roughfilm as rf
from roughfilm import rom
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import find, ladder, of_kind
from roughfilm.rom.lubricants.shear_thinning import CarreauYasuda

LAW = {"law": "carreau_yasuda", "index": 0.5, "critical_stress": "2 kPa"}
PAD = {"shape": "linear", "film": "10 um", "rise": "10 um", "length": "20 mm", "width": "20 mm"}
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "30 um", "eccentricity": 0.7, "width": "25 mm"}
PIVOTED = {"shape": "pivoted", "length": "20 mm", "width": "20 mm", "pivot": 0.6}
RIDGES = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "0.2 mm", "direction": "0 deg"}
CELLS = 20


def scene(law: dict[str, Any] | None, geometry: dict[str, Any], **tables: Any) -> rf.Scene:
    lubricant = {"viscosity": "0.05 Pa*s"} | ({} if law is None else {"shear_thinning": law})
    entries = {"name": "thinned", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    return rf.read_scene({**entries, "motion": {"speed": "4 m/s"}, **tables})


@pytest.mark.parametrize(
    ("geometry", "tables", "model"),
    [
        (PAD, {}, "reynolds_cavitating"),
        (
            PAD,
            {"motion": {"speed": "-4 m/s"}, "boundary": {"outlet": {"pressure": "2 kPa"}}},
            "reynolds_cavitating",
        ),
        (JOURNAL, {}, "reynolds_cavitating"),
        (PIVOTED, {"load": {"force": "300 N"}}, "reynolds_cavitating"),
        (PAD, {"roughness": RIDGES, "load": {"force": "300 N"}}, "homogenized"),
    ],
    ids=["pad", "backwards", "journal", "pivoted", "rough under load"],
)
def test_an_index_of_one_gives_the_film_of_constant_viscosity_to_the_last_bit(
    geometry: dict[str, Any], tables: dict[str, Any], model: str
) -> None:
    found = rf.solve(scene({**LAW, "index": 1}, geometry, **tables), model="shear_thinning", resolution=CELLS)
    plain = rf.solve(scene(None, geometry, **tables), model=model, resolution=CELLS)
    assert found.quantities == plain.quantities


def test_a_scene_of_a_newtonian_lubricant_is_refused() -> None:
    with pytest.raises(rf.InputError, match=r"lubricant.shear_thinning is missing"):
        rf.solve(scene(None, PAD), model="shear_thinning", resolution=CELLS)


def test_models_of_newtonian_lubricants_say_what_they_leave_out() -> None:
    for name in ("reynolds_cavitating", "infinitely_wide"):
        model = find(of_kind(ladder(rom, kind="bearing"), "bearing"), "bearing", name)
        assert "leaves out lubricant.shear_thinning" in model.applies(scene(LAW, PAD)).reason
        assert "shear_thinning" not in model.applies(scene(None, PAD)).reason


@pytest.mark.parametrize(
    "calculate",
    [
        lambda one: rf.march(one),
        lambda one: rf.dynamics(one, speeds=[4.0], loads=[1e6]),
        lambda one: rf.stribeck(one, [1.0, 4.0], [1e6]),
    ],
    ids=["march", "dynamics", "stribeck"],
)
def test_calculations_of_newtonian_lubricants_refuse_others(calculate: Callable[[rf.Scene], object]) -> None:
    with pytest.raises(rf.InputError, match=r"lubricant.shear_thinning: got 'carreau_yasuda'; .* takes Newtonian"):
        calculate(scene(LAW, PIVOTED, load={"force": "300 N"}))


def test_an_infinite_shear_viscosity_above_that_at_rest_is_refused() -> None:
    with pytest.raises(rf.InputError, match=r"infinite_shear_viscosity: got 0.06 Pa s; it must be below"):
        scene({**LAW, "infinite_shear_viscosity": "60 mPa*s"}, PAD)


def test_parallel_walls_have_the_friction_of_their_shear_rate() -> None:
    flat = {**PAD, "shape": "parallel"}
    flat.pop("rise")
    found = rf.solve(scene(LAW, flat), model="shear_thinning", resolution=CELLS)
    law = CarreauYasuda.model_validate(LAW)
    viscosity = float(law.viscosity_at(np.array(4.0 / 10e-6), 0.05))
    assert found["friction"].value == pytest.approx(viscosity * 4.0 / 10e-6 * 20e-3 * 20e-3, rel=1e-6)
    np.testing.assert_allclose(found.fields["viscosity"].values, viscosity, rtol=1e-9)


def test_uncertainties_cover_a_finer_grid_and_a_load_leads_back_to_its_film() -> None:
    coarse = rf.solve(scene(LAW, PAD), model="shear_thinning", resolution=24)
    fine = rf.solve(scene(LAW, PAD), model="shear_thinning", resolution=96)
    for name in ("load", "friction", "pressure_max", "inlet_flow"):
        assert abs(coarse[name].value - fine[name].value) <= coarse[name].uncertainty + fine[name].uncertainty, name
    for one in (coarse, fine):
        assert one.numerics.details["viscosity_change"] < 1e-6
        assert one.numerics.details["coupled_residual"] < 1e-5
        assert one.numerics.details["contraction"] < 0.55  # at most 1 - n for steps without acceleration
    load = {"force": coarse["load"].value}
    back = rf.solve(scene(LAW, PAD, load=load), model="shear_thinning", resolution=24)
    assert back["film_min"].value == pytest.approx(10e-6, rel=1e-5)
    assert back["friction"].value == pytest.approx(coarse["friction"].value, rel=1e-5)


def test_a_power_law_pad_scales_with_the_power_of_the_speed() -> None:
    """Far above the critical stress pressures and friction grow with u^n, and the flow with u."""
    law = {**LAW, "critical_stress": "1 Pa"}
    slow = rf.solve(scene(law, PAD), model="shear_thinning", resolution=CELLS)
    fast = rf.solve(scene(law, PAD, motion={"speed": "8 m/s"}), model="shear_thinning", resolution=CELLS)
    for name in ("load", "friction", "pressure_max"):
        assert fast[name].value / slow[name].value == pytest.approx(2**0.5, rel=1e-4), name
    assert fast["inlet_flow"].value / slow["inlet_flow"].value == pytest.approx(2, rel=1e-4)


def test_a_pivoted_pad_has_the_film_of_its_place() -> None:
    found = rf.solve(scene(LAW, PIVOTED, load={"force": "300 N"}), model="shear_thinning", resolution=CELLS)
    place = {"film": found["film_min"].value, "slopes": [found["slope_x"].value, found["slope_y"].value]}
    given = rf.solve(scene(LAW, {**PIVOTED, **place}), model="shear_thinning", resolution=CELLS)
    assert given["load"].value == pytest.approx(300, rel=1e-5)
    assert given["friction"].value == pytest.approx(found["friction"].value, rel=1e-5)


def test_the_heat_balance_has_the_film_of_its_temperature() -> None:
    lubricant = {
        "viscosity": "0.05 Pa*s",
        "temperature": "40 degC",
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.04 1/K"},
        "density": "870 kg/m^3",
        "heat_capacity": "2000 J/(kg*K)",
        "shear_thinning": {"law": "carreau_yasuda", "index": 0.5, "relaxation_time": "25 us"},
    }
    cold = scene(None, {key: one for key, one in PAD.items() if key != "width"}, lubricant=lubricant)
    found = rf.solve(cold, model="heat_balance", resolution=CELLS)
    assert isinstance(cold, Bearing)
    hot = cold.at_temperature(found["effective_temperature"].value + ZERO_CELSIUS)
    film = rf.solve(hot, model="shear_thinning", resolution=CELLS)
    assert found["load_per_width"].value == pytest.approx(film["load_per_width"].value, rel=1e-6)
    newtonian = rf.solve(rf.replace(cold, "lubricant.shear_thinning.index", 1), model="heat_balance", resolution=CELLS)
    assert found["effective_temperature"].value < newtonian["effective_temperature"].value - 3
