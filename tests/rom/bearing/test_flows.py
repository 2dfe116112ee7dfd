"""The flows through the edges of a bearing: they add up, and agree with exact and independent solutions."""

import math
from typing import Any

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene

PAD = {"shape": "linear", "length": "20 mm", "width": "30 mm", "film": "10 um", "rise": "20 um"}
SECTOR = {
    "shape": "sector",
    "film": "10 um",
    "rise": "20 um",
    "angle": "30 deg",
    "inner_radius": "20 mm",
    "outer_radius": "40 mm",
}
WASHER = {"shape": "washer", "film": "10 um", "pockets": 12, "inner_radius": "20 mm", "outer_radius": "40 mm"}
JOURNAL = {"shape": "journal", "radius": "10 mm", "clearance": "20 um", "eccentricity": 0.6, "width": "20 mm"}
POCKETS = {"length": "4 mm", "width": "6 mm", "depth": "15 um", "start": "2 mm", "pitch": "6 mm", "columns": 3}
OIL = {
    "viscosity": "0.01 Pa*s",
    "cavitation_pressure": "-0.5 bar",
    "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "0.5 GPa"},
    "piezoviscosity": {"law": "barus", "pressure_coefficient": "15 GPa^-1"},
}
RIDGES = {"kind": "sinusoid", "amplitude": "5 um", "wavelength": "5 mm", "direction": "30 deg"}


def solve(geometry: dict[str, Any], model: str = "reynolds_cavitating", cells: int = 48, **tables: Any) -> Result:
    entries = {
        "name": "bearing",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": "0.01 Pa*s"},
        "motion": {"speed": "1 m/s"},
    }
    return find("bearing", model).solve(read_scene(entries | tables), Request(resolution=cells, tolerance=1e-11))


def values(result: Result) -> dict[str, float]:
    return {name: quantity.value for name, quantity in result.quantities.items()}


SCENES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "pad": (PAD, {}),
    "pad of oil": (PAD, {"lubricant": OIL}),
    "pad with pockets": (PAD | {"texture": POCKETS}, {"lubricant": OIL}),
    "pad starved": (PAD | {"shape": "parabolic"}, {"boundary": {"inlet": {"theta": 0.7}}}),
    "pad starved below ambient": (
        PAD | {"shape": "parabolic"},
        {"lubricant": OIL, "boundary": {"inlet": {"theta": 0.7}}},
    ),
    "pad under pressure": (PAD, {"boundary": {"inlet": {"pressure": "3 bar"}, "sides": {"high": "1 bar"}}}),
    "pad backwards": (PAD | {"shape": "parabolic"}, {"lubricant": OIL, "motion": {"speed": "-1 m/s"}}),
    "journal": (JOURNAL, {}),
    "journal of oil": (JOURNAL, {"lubricant": OIL}),
    "sector": (SECTOR, {"lubricant": OIL}),
    "sector starved": (SECTOR, {"boundary": {"inlet": {"theta": 0.6}}}),
}


def assert_flows_add_up(result: Result) -> None:
    flows = values(result)
    largest = max(abs(flows[name]) for name in ("inlet_flow", "outlet_flow", "side_leakage"))
    assert flows["inlet_flow"] > 0
    assert abs(flows["inlet_flow"] - flows["outlet_flow"] - flows["side_leakage"]) < 1e-9 * largest
    both = flows["side_leakage_low"] + flows["side_leakage_high"]
    assert flows["side_leakage"] == pytest.approx(both, rel=1e-12, abs=1e-12 * largest)
    for name in ("inlet_flow", "outlet_flow"):
        assert flows[f"{name}_per_width"] > 0


@pytest.mark.parametrize("model", ["reynolds", "reynolds_incompressible", "reynolds_cavitating"])
@pytest.mark.parametrize("name", SCENES)
def test_what_enters_a_bearing_leaves_it(name: str, model: str) -> None:
    geometry, tables = SCENES[name]
    try:
        result = solve(geometry, model, **tables)
    except InputError as error:
        assert model == "reynolds", error  # noqa: PT017
        assert "starved" in name
        return
    assert_flows_add_up(result)


@pytest.mark.parametrize("model", ["homogenized", "direct"])
@pytest.mark.parametrize("theta", [None, 0.7])
def test_what_enters_a_rough_bearing_leaves_it(model: str, theta: float | None) -> None:
    boundary = {} if theta is None else {"boundary": {"inlet": {"theta": theta}}}
    assert_flows_add_up(solve(PAD, model, cells=64, roughness=RIDGES, lubricant=OIL, **boundary))


def test_what_enters_a_mixed_film_leaves_it(tips: Any) -> None:
    scene = tips.scene(JOURNAL | {"eccentricity": 0.95})
    assert_flows_add_up(find("bearing", "mixed").solve(scene, Request(resolution=32, tolerance=1e-11)))


def test_the_flow_into_a_line_leaves_it() -> None:
    line = values(solve({name: entry for name, entry in PAD.items() if name != "width"}, cells=500, lubricant=OIL))
    assert line["outlet_flow_per_width"] == pytest.approx(line["inlet_flow_per_width"], rel=1e-9)
    assert not {"inlet_flow", "outlet_flow", "side_leakage"} & set(line)


@pytest.mark.parametrize(
    ("geometry", "inlet", "outlet", "low", "high"),
    [(PAD, 3.12280e-7, 2.04128e-7, 5.40763e-8, 5.40763e-8), (SECTOR, 2.17251e-7, 1.33702e-7, 2.58787e-8, 5.76698e-8)],
)
def test_flows_are_those_of_finite_elements(
    geometry: dict[str, Any], inlet: float, outlet: float, low: float, high: float
) -> None:
    """Quadratic finite elements on up to 160² elements, the flows extrapolated; the errors are of second order."""
    truth = {"inlet_flow": inlet, "outlet_flow": outlet, "side_leakage_low": low, "side_leakage_high": high}
    coarse, fine = solve(geometry, "reynolds", cells=32), solve(geometry, "reynolds", cells=128)
    for name, value in truth.items():
        assert fine[name].value == pytest.approx(value, rel=4e-4)
        assert abs(fine[name].value - value) < abs(coarse[name].value - value) / 8 + 1e-5 * value
        assert abs(coarse[name].value - value) <= coarse[name].uncertainty


def test_a_washer_leaks_as_much_as_a_ring_of_parallel_walls() -> None:
    washer = solve(WASHER, boundary={"sides": {"low": "3 bar", "high": "1 bar"}})
    exact = 2 * math.pi / 12 * 10e-6**3 * 2e5 / (12 * 0.01 * math.log(2))
    assert washer["side_leakage"].value == pytest.approx(exact, rel=1e-4)
    assert washer["side_leakage_high"].value == pytest.approx(exact, rel=1e-4)
    assert washer["side_leakage_low"].value == pytest.approx(-exact, rel=1e-4)
    assert not {"inlet_flow", "outlet_flow", "inlet_flow_per_width"} & set(washer.quantities)


def test_a_groove_under_pressure_beside_an_open_side_has_no_finite_flow() -> None:
    result = solve(PAD, boundary={"inlet": {"pressure": "3 bar"}, "sides": {"high": "3 bar"}})
    unknown = {name for name, quantity in result.quantities.items() if quantity.uncertainty is None}
    at_the_outlet = {"outlet_flow", "outlet_flow_per_width", "side_leakage_high"}
    assert unknown == at_the_outlet | {"inlet_flow", "inlet_flow_per_width", "side_leakage_low", "side_leakage"}
    (warning,) = result.warnings
    assert warning.split(":")[0] == (
        "the pressure jumps between inlet and low side (+3e+05 Pa), outlet and high side (-3e+05 Pa)"
    )
    grown = [solve(PAD, cells=n, boundary={"inlet": {"pressure": "3 bar"}}) for n in (32, 64, 128)]
    flows = [one["side_leakage_low"].value for one in grown]
    per_doubling = 3e5 * 30e-6**3 / (6 * math.pi * 0.01) * math.log(2)
    assert flows[2] - flows[1] == pytest.approx(per_doubling, rel=0.1)


def test_a_starved_inlet_below_ambient_is_reported() -> None:
    starved = {"boundary": {"inlet": {"theta": 0.7}}}
    assert any("5e+04 Pa below ambient" in warning for warning in solve(PAD, lubricant=OIL, **starved).warnings)
    assert solve(PAD, **starved).warnings == ()
