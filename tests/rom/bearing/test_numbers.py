"""Dimensionless numbers of bearings, against those that a page of paper gives."""

import math
from typing import Any

import numpy as np
import pytest

from roughfilm.rom.bearing.kind import columns, composed
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.temperature.closed_forms.couette import adiabatic_couette
from roughfilm.rom.temperature.closed_forms.slider import adiabatic_slider

PAD: dict[str, Any] = {
    "name": "pad",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": "20 mm", "width": "30 mm", "film": "5 um", "rise": "10 um"},
    "lubricant": {"viscosity": "0.01 Pa*s", "cavitation_pressure": "-0.1 MPa"},
    "motion": {"speed": "-2 m/s"},
}
POCKETS = {
    "length": "1 mm",
    "width": "2 mm",
    "depth": "4 um",
    "start": "2 mm",
    "pitch": "4 mm",
    "columns": 3,
    "pitch_across": "5 mm",
    "rows": 2,
}
RIDGES = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "0.5 mm"}
MADE = 6 * 0.01 * 2 * 20e-3 / 5e-6**2


def scene(**tables: Any) -> Bearing:
    """The pad, with more in its tables."""
    entries = {name: dict(table) if isinstance(table, dict) else table for name, table in PAD.items()}
    for name, table in tables.items():
        entries[name] = {**entries.get(name, {}), **table}
    result = read_scene(entries)
    assert isinstance(result, Bearing)
    return result


def test_a_smooth_pad_has_the_numbers_of_its_film_and_no_others() -> None:
    assert bearing_numbers(scene()) == pytest.approx(
        {
            "convergence": 2.0,
            "thickness_ratio": 3.0,
            "divergence": 2.0,
            "finest": 1.0,
            "slenderness": 1.5,
            "starvation": 1.0,
            "cavitation_number": 1e5 / MADE,
            "compression": 0.0,
            "piezoviscous": 0.0,
            "pressure_dependence": 0.0,
        }
    )


def test_a_wedge_that_slides_towards_its_thin_end_widens_nowhere() -> None:
    assert bearing_numbers(scene(motion={"speed": "2 m/s"}))["divergence"] == pytest.approx(0.0)


def test_each_table_adds_its_own_numbers() -> None:
    law = {"law": "barus", "pressure_coefficient": "20 GPa^-1"}
    stiff = {"law": "constant_bulk_modulus", "bulk_modulus": "1e6 GPa"}
    numbers = bearing_numbers(
        scene(
            geometry={"texture": POCKETS},
            lubricant={"density": "900 kg/m^3", "piezoviscosity": law, "compressibility": stiff},
            boundary={"inlet": {"theta": 0.7}, "sides": {"low": "1 bar"}},
            roughness=RIDGES,
        )
    )
    expected = {
        "convergence": 2.0,
        "finest": 0.05,
        "starvation": 0.7,
        "compression": MADE / 1e15,
        "piezoviscous": 20e-9 * MADE,
        "pressure_dependence": (1 / 1e15 + 20e-9) * (MADE / (1 + (20 / 30) ** 2) + 1e5),
        "roughness_ratio": 2 / math.sqrt(2) / 5,
        "peak_ratio": 0.4,
        "roughness_period": 0.025,
        "texture_density": 6 * 1 * 2 / (20 * 30),
        "pocket_depth_ratio": 0.8,
        "pocket_length_ratio": 0.05,
        "reynolds_number": 900 * 2 * 5e-6 / 0.01,
        "reduced_reynolds_number": 900 * 2 * 5e-6 / 0.01 * 5e-6 / 1e-3,
    }
    assert {name: numbers[name] for name in expected} == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("pressure", "number"), [("-1 bar", math.inf), ("0 Pa", 0.0)])
def test_at_rest_sliding_makes_no_pressure(pressure: str, number: float) -> None:
    at_rest = scene(motion={"speed": "0 m/s"}, lubricant={"cavitation_pressure": pressure})
    assert bearing_numbers(at_rest)["cavitation_number"] == number


def test_a_ring_counts_along_its_mean_radius_and_joined_pads_have_no_inlet() -> None:
    washer = {
        "shape": "washer",
        "inner_radius": "30 mm",
        "outer_radius": "50 mm",
        "pockets": 12,
        "film": "10 um",
        "pocket": {"depth": "0.1 mm", "share": 0.25, "extent": "20 mm"},
    }
    entries = {**PAD, "geometry": washer, "boundary": {"sides": {"low": "0.2 MPa"}}}
    entries["lubricant"] = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
    result = read_scene(entries)
    assert isinstance(result, Bearing)
    numbers = bearing_numbers(result)
    pocket = 0.25 * 2 * math.pi / 12 * 40e-3
    assert numbers["convergence"] == pytest.approx(0.0)
    assert numbers["texture_density"] == pytest.approx(0.25)
    assert numbers["reduced_reynolds_number"] == pytest.approx(1000 * 2 * 10e-6 / 0.01 * 10e-6 / pocket)
    assert "starvation" not in numbers


def test_the_table_of_cases_has_the_same_numbers() -> None:
    rough = scene(roughness=RIDGES)
    numbers, entries = bearing_numbers(rough), columns(rough)
    assert not isinstance(entries["width_ratio"], str)
    assert not isinstance(entries["roughness_ratio"], str)
    assert entries["width_ratio"].value == pytest.approx(numbers["slenderness"])
    assert entries["roughness_ratio"].value == pytest.approx(numbers["roughness_ratio"])


HOT: dict[str, Any] = {
    "viscosity": "0.05 Pa*s",
    "temperature": "40 degC",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.03 1/K"},
    "density": "850 kg/m^3",
    "heat_capacity": "2000 J/(kg*K)",
    "conductivity": "0.14 W/(m*K)",
}
THERMAL = {"heating_number", "thermal_peclet_number", "nahme_number", "brinkman_number"}


def test_a_film_with_temperature_has_the_numbers_of_its_heat() -> None:
    walls = {"fixed_wall": {"kind": "temperature", "temperature": "60 degC"}, "sliding_wall": "adiabatic"}
    numbers = bearing_numbers(scene(lubricant=HOT, heat=walls))
    assert numbers["thermal_peclet_number"] == pytest.approx(850 * 2000 * 2 * 5e-6**2 / (0.14 * 20e-3))
    assert numbers["nahme_number"] == pytest.approx(0.03 * 0.05 * 2**2 / 0.14)
    assert numbers["brinkman_number"] == pytest.approx(0.05 * 2**2 / (0.14 * 20))
    rise = 0.05 * 2 * 20e-3 / (850 * 2000 * 5e-6**2)
    friction, flow = (4 * math.log(3) - 6 * 2 / 4) / 2, 3 / 4  # over ηuL/h and uh
    assert numbers["heating_number"] == pytest.approx(0.03 * rise * friction / flow)


def test_the_heating_number_predicts_the_adiabatic_wedge() -> None:
    for rise in (0.0, 1e-6, 20e-6):
        shape = scene(lubricant=HOT, geometry={"rise": f"{rise or 1e-12} m"})
        number = bearing_numbers(shape)["heating_number"]
        liquid = {"film": 5e-6, "speed": 2.0, "viscosity": 0.05, "temperature": 0.0, "temperature_coefficient": 0.03}
        if rise:
            exact = adiabatic_slider(rise=rise, length=20e-3, heat_per_volume=1.7e6, **liquid).outlet_temperature
        else:
            exact = float(adiabatic_couette(np.array(20e-3), heat_per_volume=1.7e6, **liquid))
        assert math.log1p(number) / 0.03 == pytest.approx(exact, rel=0.04)


@pytest.mark.parametrize("missing", ["thermoviscosity", "density", "heat_capacity"])
def test_a_film_without_a_temperature_has_none_of_them(missing: str) -> None:
    lubricant = {key: value for key, value in HOT.items() if key != missing}
    assert not THERMAL & bearing_numbers(scene(lubricant=lubricant)).keys()


def test_without_a_conductivity_only_the_heating_is_known() -> None:
    lubricant = {key: value for key, value in HOT.items() if key != "conductivity"}
    assert THERMAL & bearing_numbers(scene(lubricant=lubricant)).keys() == {"heating_number"}


def test_the_words_say_how_hot_the_film_becomes_and_how_far_conduction_reaches() -> None:
    (thin,) = (line for line in composed(scene(lubricant=HOT)) if line.startswith("heating"))
    assert "conduction reaches across it (Péclet number 0.03)" in thin
    thick = scene(lubricant=HOT, geometry={"film": "100 um"}, motion={"speed": "10 m/s"})
    (line,) = (line for line in composed(thick) if line.startswith("heating"))
    numbers = bearing_numbers(thick)
    rise = math.log1p(numbers["heating_number"]) / 0.03
    assert f"friction heats the film by about {rise:.2g} K while it passes" in line
    assert "conduction hardly reaches into it (Péclet number 61)" in line
    assert not any(line.startswith("heating") for line in composed(scene()))
