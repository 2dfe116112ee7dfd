"""Forces and flows that cancel are 0 within the round-off of their parts, and no number is a ratio to such a load."""

from typing import Any

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.rounding import round_off
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.totals.rounding import NO_LOAD
from roughfilm.rom.ladder.result import beyond_round_off

FILM, LENGTH, VISCOSITY, SPEED = 20e-6, 50e-3, 0.03, 8.0
BEARING = {
    "name": "a film without a load",
    "kind": "bearing",
    "lubricant": {"viscosity": "0.03 Pa*s", "density": "860 kg/m^3", "cavitation_pressure": "-0.1 MPa"},
    "motion": {"speed": "8 m/s"},
}
WIDE = {"shape": "parallel", "length": "50 mm", "film": "20 um"}
SHAFT = {"radius": "25 mm", "width": "25 mm", "clearance": "50 um"}
UNLOADED = {
    "wide": WIDE,
    "square": WIDE | {"width": "50 mm"},
    "journal": SHAFT | {"shape": "journal", "eccentricity": 0.0},
    "lobes": SHAFT | {"shape": "lobes", "arc": "170 deg", "lobes": 2, "eccentricity": [0.0, 0.0]},
}
RATIOS = {"friction_coefficient", "hersey_number", "sommerfeld_number", "attitude_angle"}
MODELS = ("reynolds", "reynolds_incompressible", "reynolds_cavitating", "infinitely_wide", "film", "film_slope")


def results(entries: dict[str, Any], resolution: int) -> list[Any]:
    scene = rf.read_scene(entries)
    models = [one for one in rf.models(scene.kind) if one.name in MODELS and one.applies(scene).applies]
    return [rf.solve(scene, model=model.name, resolution=resolution) for model in models]


@pytest.mark.parametrize("name", UNLOADED)
def test_a_film_that_carries_nothing(name: str) -> None:
    found = results({**BEARING, "geometry": UNLOADED[name]}, 24)
    assert len(found) >= 3
    for result in found:
        load = result.quantities["load_per_width"]
        assert load.value == 0.0
        assert 0.0 < load.uncertainty < 1e-6 * 6 * VISCOSITY * SPEED * LENGTH**2 / FILM**2
        assert not RATIOS & result.quantities.keys()
        assert NO_LOAD in result.warnings
        friction = result.quantities["friction_per_width"]
        assert friction.value > 1.0, "which is shear alone"
        assert friction.uncertainty < 1e-6 * friction.value


def test_walls_at_rest_have_no_flow_and_no_friction() -> None:
    still = {"motion": {"speed": "0 m/s"}, "geometry": WIDE | {"width": "50 mm", "shape": "linear", "rise": "20 um"}}
    for result in results({**BEARING, **still}, 24):
        names = {"load", "friction", "power_loss", "inlet_flow", "outlet_flow", "side_leakage", "pressure_max"}
        assert {result.quantities[name].value for name in names & result.quantities.keys()} == {0.0}
        assert result.quantities["load_per_width"].value == 0.0


@pytest.mark.parametrize("ratio", [1e-3, 1e-5, 1e-6])
def test_a_small_load_is_no_round_off(ratio: float) -> None:
    """W = 6 η u (L/h)² (ln(1 + K) - 2 K/(2 + K))/K², of a wedge that rises by K h: K/12 to first order."""
    wedge = {**WIDE, "shape": "linear", "rise": f"{ratio * FILM!r} m"}
    exact = 6 * VISCOSITY * SPEED * (LENGTH / FILM) ** 2 * ratio / 12 * (1 - 1.5 * ratio + 9 / 5 * ratio**2)
    for result in results({**BEARING, "geometry": wedge}, 200):
        if result.model in ("reynolds_incompressible", "reynolds_cavitating", "infinitely_wide"):
            assert result.quantities["load_per_width"].value == pytest.approx(exact, rel=1e-3)
            assert "friction_coefficient" in result.quantities


def test_a_symmetric_groove_in_creeping_flow_has_no_load() -> None:
    groove = {"length": "1 mm", "film": "30 um", "width": "0.3 mm", "depth": "7.5 um"}
    liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
    entries = {"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid}
    scene = rf.read_scene(entries | {"motion": {"reynolds_number": 1e-9}})
    for name in ("load_plus", "load_per_area"):
        load = rf.solve(scene, model="reynolds").quantities[name]
        assert load.value == 0.0
        assert load.uncertainty > 0.0
    inertial = [
        rf.solve(rf.replace(scene, "motion.reynolds_number", number), model="inertial_reynolds")
        for number in (1e-7, 1.0)
    ]
    loads = [result.quantities["load_plus"].value for result in inertial]
    assert loads[0] / 1e-7 == pytest.approx(loads[1], rel=1e-4), "proportional to the Reynolds number, and not cut"


def test_the_round_off_of_random_sums() -> None:
    random = np.random.default_rng(1)
    for count in (10, 1000, 100_000):
        parts = random.standard_normal(count)
        both = np.concatenate([parts, -random.permutation(parts)])
        assert abs(both.cumsum()[-1]) <= round_off(float(np.abs(both).sum()), both.size)


def test_a_number_above_its_round_off_stays() -> None:
    one = Quantity(value=-2.0, unit="N", uncertainty=0.1)
    assert beyond_round_off(one, 1.9) is one
    assert beyond_round_off(one, 2.0) == Quantity(value=0.0, unit="N", uncertainty=2.0)
