"""The uncertainty of the quantities of a film against known errors, finer grids and exact solutions."""

import math
from dataclasses import replace
from typing import Any

import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.bearing.quantities import film_ends
from roughfilm.rom.bearing.uncertainty import _positions, beyond_half_a_turn
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.grids import (
    COARSE_SAFETY_FACTOR,
    GRID_SAFETY_FACTOR,
    grid_uncertainty,
    observed_order,
)
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene, read_scene

CELLS = (128, 80, 40, 20)

INLET_WITHOUT_FILM = {
    "lubricant": {"viscosity": "0.01 Pa*s", "cavitation_pressure": "0 Pa"},
    "boundary": {"inlet": {"theta": 0.2}},
}


def solve(cells: int, geometry: dict[str, Any], **tables: Any) -> Result:
    entries = {
        "name": "bearing",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": "0.01 Pa*s"},
        "motion": {"speed": "1 m/s"},
    }
    return find("bearing", "reynolds_cavitating").solve(read_scene(entries | tables), Request(resolution=cells))


@pytest.mark.parametrize("order", [1.0, 1.3, 2.0])
def test_the_uncertainty_of_a_known_order_is_the_safety_factor_times_the_error(order: float) -> None:
    errors = [3e4 * n**-order for n in CELLS]
    assert observed_order(CELLS[:3], [7 + error for error in errors[:3]]) == pytest.approx(order, abs=1e-6)
    found = grid_uncertainty(CELLS, [7 + error for error in errors])
    assert found == pytest.approx(GRID_SAFETY_FACTOR * errors[0], rel=1e-6)
    found = grid_uncertainty([n / 4 for n in CELLS], [7 + error for error in errors])
    assert found == pytest.approx(COARSE_SAFETY_FACTOR * errors[0], rel=1e-6)


def test_values_that_oscillate_or_settle_slowly_have_the_lowest_order() -> None:
    assert observed_order(CELLS[:3], [1.0, 1.2, 1.1]) == 1.0
    assert observed_order(CELLS[:3], [1.0, 1.2, 1.3]) == 1.0
    assert observed_order(CELLS[:3], [1.0, 1.0, 1.3]) == 1.0
    assert observed_order(CELLS[:3], [1.0, 1.01, 1.5]) == 2.0
    assert grid_uncertainty(CELLS, [1.0, 1.0, 1.0, 1.0]) == 0.0
    assert grid_uncertainty(CELLS[:2], [1.0, 1.3]) == pytest.approx(COARSE_SAFETY_FACTOR * 0.3 / 0.6)


@pytest.mark.parametrize("cells", [32, 64, 128, 256, 512])
def test_a_front_at_the_same_place_in_every_cell_does_not_hide_the_error(cells: int) -> None:
    """The film ruptures at x/L = 0.6217, just before a node of all grids with 8, 16, 32, ... cells.

    The truth is the value of 65536 cells; grids of 2048 to 65536 cells agree within a tenth of the smallest error.
    """
    lubricant = {"viscosity": "0.033226339347371514 Pa*s", "cavitation_pressure": "-1430.833121779906 Pa"}
    journal = {"radius": "3.183098861837907 mm", "clearance": "11.342583422651696 um", "eccentricity": 0.4397201866}
    tables: dict[str, Any] = {
        "lubricant": lubricant,
        "motion": {"speed": "0.19777944917828383 m/s"},
        "boundary": {"inlet": {"theta": 0.7664517656534304}},
    }
    result = solve(cells, {"shape": "journal", **journal}, **tables)
    truth = {"load_per_width": 2893.73575, "pressure_max": 606736.15, "inlet_flow_per_width": 7.657204014e-07}
    for name, value in truth.items():
        assert abs(result[name].value - value) <= result[name].uncertainty, name
    assert result["rupture"].value == pytest.approx(0.62168, abs=1e-4), "the film before the outlet does not count"
    assert abs(result["rupture"].value - 0.621686) <= result["rupture"].uncertainty


def test_the_uncertainty_of_a_starved_line_does_not_grow_with_its_cells() -> None:
    scene = load_scene(SCENES / "parabolic_slider.toml", ["boundary.inlet.theta=0.55"])
    model = find("bearing", "reynolds_cavitating")
    loads = [model.solve(scene, Request(resolution=n))["load"] for n in (4096, 20_000, 300_000)]
    bars = [load.uncertainty or math.inf for load in loads]
    assert bars[0] > bars[1] > bars[2]
    assert abs(loads[0].value - loads[2].value) <= bars[0]
    assert abs(loads[1].value - loads[2].value) <= bars[1]
    assert bars[2] < 1e-3


@pytest.mark.parametrize("length", [8.3, 11.7, 14.1])
def test_the_error_of_a_wedge_is_within_its_uncertainty_and_not_far_below(length: float) -> None:
    """W = 6ηuL²/Δ² (ln k - 2 (k - 1)/(k + 1)), with the rise Δ and k = h(0)/h(L)."""
    film, rise = 10e-6, 13e-6
    k = 1 + rise / film
    exact = 6 * 0.01 * (length * 1e-3 / rise) ** 2 * (math.log(k) - 2 * (k - 1) / (k + 1))
    wedge = {"shape": "linear", "length": f"{length} mm", "film": f"{film} m", "rise": f"{rise} m"}
    for cells in (50, 77, 300):
        load = solve(cells, wedge)["load"]
        assert load.uncertainty is not None
        assert 0.1 * load.uncertainty < abs(load.value - exact) <= load.uncertainty


def test_a_film_thinner_than_a_cell_begins_at_an_inlet_above_the_cavitation_pressure() -> None:
    scene = load_scene(SCENES / "parabolic_slider.toml", ["boundary.inlet.pressure=1 bar"])
    found = balance(scene.problem(), (64, 64))
    kind = found.kind.copy()
    kind[1:5] = CAVITY
    assert film_ends(replace(found, kind=kind), 0)[0] == 0.0


def test_positions_without_a_film_are_unknown() -> None:
    starved = solve(64, {"shape": "linear", "length": "10 mm", "film": "10 um", "rise": "10 um"}, **INLET_WITHOUT_FILM)
    assert starved["film_start"].value == starved["rupture"].value == 1.0
    assert starved["film_start"].uncertainty is None
    assert starved["rupture"].uncertainty is None
    assert any("no film forms" in warning for warning in starved.warnings)


def test_grids_that_miss_the_film_do_not_widen_the_uncertainty_of_positions() -> None:
    assert _positions({64: 0.70, 40: 0.71, 20: 0.74, 10: 0.2}, ring=False) == {64: 0.70, 40: 0.71, 20: 0.74}
    assert _positions({16: 0.70, 10: 0.2}, ring=False) == {16: 0.70, 10: 0.2}
    assert _positions({64: 0.02, 40: 0.99}, ring=True) == pytest.approx({64: 0.02, 40: -0.01})


def test_an_angle_that_is_uncertain_by_half_a_turn_is_unknown() -> None:
    assert beyond_half_a_turn({"film_min_angle": 179.0, "attitude_angle": 3.0, "film_min_x": 0.2}) == []
    assert beyond_half_a_turn({"attitude_angle": 180.0, "film_min_x": 0.2}) == ["attitude_angle"]
    assert beyond_half_a_turn({"film_min_angle": 600.0, "film_min_x": 0.5}) == ["film_min_angle", "film_min_x"]


def test_the_least_film_of_tilting_pads_on_few_cells_may_be_anywhere() -> None:
    pads = {"shape": "lobes", "lobes": 4, "arc": "80 deg", "pivot": 0.5, "radius": "50 mm", "width": "50 mm"}
    result = solve(12, pads | {"clearance": "80 um"}, load={"force": "200 N"}, motion={"speed": "10 m/s"})
    for name in ("attitude_angle", "film_min_angle", "film_min_x"):
        assert result[name].uncertainty is None
    assert result["film_min"].uncertainty is not None
    why = "attitude_angle, film_min_angle, film_min_x: unknown uncertainty, as it is more than half a turn; take more"
    assert [warning for warning in result.warnings if warning.startswith(why)]
