"""Bearings whose walls approach each other: against quadrature, by balances and symmetry, and what is refused."""

from typing import Any

import numpy as np
import pytest

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find, models
from roughfilm.rom.bearing.closed_forms.squeeze import squeezed_annulus
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import kind_of, kind_of_scene
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.studies.comparison import to_best

VISCOSITY = 0.01
PAD = {"shape": "linear", "length": "20 mm", "width": "30 mm", "film": "10 um", "rise": "20 um"}
LINE = {name: entry for name, entry in PAD.items() if name != "width"}
PARABOLA = PAD | {"shape": "parabolic"}
JOURNAL = {"shape": "journal", "radius": "10 mm", "clearance": "20 um", "eccentricity": 0.6, "width": "20 mm"}
LOBES = {"shape": "lobes", "lobes": 2, "arc": "150 deg", "width": "20 mm", "eccentricity": [0, 0]}
LOBES |= {"radius": "10 mm", "clearance": "20 um"}
RADII = {"film": "10 um", "inner_radius": "20 mm", "outer_radius": "40 mm"}
SECTOR = RADII | {"shape": "sector", "rise": "20 um", "angle": "30 deg"}
WASHER = RADII | {"shape": "washer", "pockets": 12, "pocket": {"depth": "5 um", "share": 0.5, "extent": "8 mm"}}
RIDGES = {"kind": "sinusoid", "amplitude": "5 um", "wavelength": "5 mm", "direction": "30 deg"}
OIL = {
    "viscosity": "0.01 Pa*s",
    "cavitation_pressure": "-0.5 bar",
    "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "0.5 GPa"},
    "piezoviscosity": {"law": "barus", "pressure_coefficient": "15 GPa^-1"},
}


def entries(geometry: dict[str, Any], speed: float = 0.0, approach: float = 1e-3, **tables: Any) -> dict[str, Any]:
    return {
        "name": "squeezed",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": "0.01 Pa*s"},
        "motion": {"speed": f"{speed} m/s", "approach": f"{approach} m/s"},
        **tables,
    }


def scene_of(*given: Any, **tables: Any) -> Bearing:
    scene = read_scene(entries(*given, **tables))
    assert isinstance(scene, Bearing)
    return scene


def solve(*given: Any, model: str = "reynolds_cavitating", cells: int = 32, **tables: Any) -> Result:
    return find("bearing", model).solve(scene_of(*given, **tables), Request(resolution=cells, tolerance=1e-11))


def test_a_wedge_that_closes_is_the_integral_of_its_own_equation() -> None:
    """In a film without cavities the pressures of sliding and of squeeze add up."""
    film, rise, length, approach, speed = 10e-6, 20e-6, 0.02, 6e-4, 2.0

    def h(x: Array) -> Array:
        return film + rise * (1 - x / length)

    def resistance(x: Array) -> Array:
        return 12 * VISCOSITY / h(x) ** 3

    def flow(x: Array) -> Array:
        return speed * h(x) / 2 - approach * x

    places, weights = np.polynomial.legendre.leggauss(80)
    x, dx = length * (places + 1) / 2, length / 2 * weights
    through = (dx * flow(x) * resistance(x)).sum() / (dx * resistance(x)).sum()
    load = -(dx * x * resistance(x) * (flow(x) - through)).sum()
    result = solve(LINE, speed, approach, cells=256)
    assert result["load_per_width"].value == pytest.approx(load, rel=1e-4)
    assert abs(result["load_per_width"].value - load) <= result["load_per_width"].uncertainty
    assert result["inlet_flow_per_width"].value == pytest.approx(through, rel=1e-4)
    assert result["outlet_flow_per_width"].value == pytest.approx(through + approach * length, rel=1e-4)
    parts = [solve(LINE, *motion, cells=256)["load_per_width"].value for motion in ((speed, 0.0), (0.0, approach))]
    assert sum(parts) == pytest.approx(result["load_per_width"].value, rel=1e-9)


SCENES: dict[str, tuple[dict[str, Any], float, float, dict[str, Any]]] = {
    "pad at rest": (PAD, 0.0, 1e-3, {}),
    "pad at rest of oil": (PAD, 0.0, 1e-4, {"lubricant": OIL}),
    "parabola that slides": (PARABOLA, 1.0, 1e-4, {}),
    "parabola that slides backwards and parts": (PARABOLA, -1.0, -1e-4, {"lubricant": OIL}),
    "parabola starved": (PARABOLA, 1.0, 1e-4, {"boundary": {"inlet": {"theta": 0.7}}}),
    "line": (LINE, 1.0, 1e-4, {}),
    "journal at rest": (JOURNAL, 0.0, 1e-3, {}),
    "journal that turns": (JOURNAL, 1.0, 1e-3, {"lubricant": OIL}),
    "journal that turns and leaves": (JOURNAL, 1.0, -1e-3, {}),
    "sector": (SECTOR, 1.0, 1e-4, {"lubricant": OIL}),
    "washer fed from inside": (WASHER, 1.0, 1e-5, {"boundary": {"sides": {"low": "1 bar"}}}),
    "ridges averaged": (PAD, 1.0, 1e-4, {"model": "homogenized", "roughness": RIDGES}),
    "ridges resolved": (PAD, 1.0, 1e-4, {"model": "direct", "roughness": RIDGES, "cells": 64}),
}


def assert_flows_add_up(result: Result) -> None:
    per = "" if "displaced_flow" in result.quantities else "_per_width"
    names = [f"{name}{per}" for name in ("inlet_flow", "displaced_flow", "outlet_flow")]
    enters, displaced, leaves = (result[name].value if name in result.quantities else 0.0 for name in names)
    sides = [result[f"side_leakage_{side}"].value if not per else 0.0 for side in ("low", "high")]
    largest = max(abs(flow) for flow in (enters, displaced, leaves, *sides))
    assert abs(enters + displaced - leaves - sum(sides)) < 1e-9 * largest


@pytest.mark.parametrize("name", SCENES)
def test_what_enters_and_what_is_displaced_leaves(name: str) -> None:
    geometry, speed, approach, tables = SCENES[name]
    result = solve(geometry, speed, approach, **tables)
    assert_flows_add_up(result)
    assert "motion.approach" in kind_of(result).remarks(result.provenance["scene"], result.quantities)[0]


def test_what_a_recess_gives_and_what_is_displaced_leaves() -> None:
    plates = {"shape": "parallel", "length": "40 mm", "width": "30 mm", "film": "30 um"}
    recess = {
        "kind": "pocket",
        "x": "20 mm",
        "length": "10 mm",
        "extent": "10 mm",
        "depth": "1 mm",
        "pressure": "1 MPa",
    }
    result = solve(plates, 0.0, 1e-4, supply=[recess])
    gains = result["displaced_flow"].value + result["supply_1_flow"].value
    leaves = result["outlet_flow"].value - result["inlet_flow"].value + result["side_leakage"].value
    assert leaves == pytest.approx(gains, rel=1e-9)
    assert result["displaced_flow"].value == pytest.approx(0.04 * 0.03 * 1e-4, rel=1e-9)
    still = solve(plates, 0.0, 0.0, supply=[recess])
    assert still["supply_1_flow"].value > result["supply_1_flow"].value


def test_what_a_mixed_film_displaces_leaves_it(tips: Any) -> None:
    """The mean gap of elastic asperities falls as the separation does."""
    scene = tips.scene(JOURNAL | {"eccentricity": 0.9})
    scene = scene.model_copy(update={"motion": scene.motion.model_copy(update={"approach": 1e-5})})
    assert_flows_add_up(find("bearing", "mixed").solve(scene, Request(resolution=32, tolerance=1e-11)))
    film, asperities = scene.problem(), asperities_of(scene)
    x, y = np.linspace(0, film.shape.length, 9), np.zeros(9)
    opening = mixed_problem(scene, asperities).opening
    assert opening is not None
    assert film.opening is not None
    assert np.allclose(opening(x, y), film.opening(x, y), rtol=1e-6)

    class Flattened:
        """Asperities of the same wall whose mean gap falls half as fast as the separation."""

        touching, closest = asperities.touching, asperities.closest

        def mean_gap(self, separation: Any) -> Any:
            return separation / 2

    halved = mixed_problem(scene, Flattened()).opening  # type: ignore[arg-type]
    assert halved is not None
    assert np.allclose(halved(x, y), film.opening(x, y) / 2, rtol=1e-6)


def test_a_film_at_rest_is_linear_in_velocity_and_viscosity() -> None:
    plain, fast = solve(JOURNAL), solve(JOURNAL, 0.0, 2e-3, lubricant={"viscosity": "0.03 Pa*s"})
    assert fast["load"].value == pytest.approx(6 * plain["load"].value, rel=1e-9)
    assert fast["side_leakage"].value == pytest.approx(2 * plain["side_leakage"].value, rel=1e-9)
    assert fast["cavitated_fraction"].value == plain["cavitated_fraction"].value


def test_sliding_backwards_mirrors_a_symmetric_film_that_closes() -> None:
    ahead, back = (solve(PARABOLA, speed, 3e-4) for speed in (1.0, -1.0))
    for name in ("load", "friction", "side_leakage", "cavitated_fraction", "pressure_max"):
        assert back[name].value == pytest.approx(ahead[name].value, rel=1e-8)
    assert back["power_loss"].value > 0


def test_a_fine_grid_lies_within_the_uncertainty_of_a_coarse_one() -> None:
    for motion in ((0.0, 1e-3), (1.0, 1e-3), (1.0, -1e-3)):
        coarse, fine = (solve(JOURNAL, *motion, cells=cells) for cells in (48, 160))
        for name in ("load", "side_leakage", "pressure_max", "friction", "displaced_flow"):
            assert abs(coarse[name].value - fine[name].value) <= coarse[name].uncertainty, (motion, name)


def test_without_an_approach_nothing_is_displaced() -> None:
    scene = scene_of(PAD, 1.0, 0.0)
    assert scene.problem().opening is None
    assert "squeeze_number" not in bearing_numbers(scene)
    assert "displaced_flow" not in find("bearing", "reynolds").solve(scene, Request(resolution=16)).quantities
    assert kind_of_scene(scene).lawful
    assert scene.equivalent_speed == 1.0


def test_scales_and_numbers_of_squeeze() -> None:
    scene = scene_of(LINE, 1.0, 1e-3, lubricant={"viscosity": "0.01 Pa*s", "density": "900 kg/m^3"})
    numbers = bearing_numbers(scene)
    assert numbers["squeeze_number"] == pytest.approx(2 * 1e-3 * 0.02 / 10e-6)
    assert scene.pressure_unit == pytest.approx(6 * 0.01 * 0.02 / 10e-6**2 + 12 * 0.01 * 1e-3 * 0.02**2 / 10e-6**3)
    assert numbers["reynolds_number"] == pytest.approx(900 * 10e-6 / 0.01 * (1 + 4))
    assert bearing_numbers(scene_of(LINE))["squeeze_number"] == np.inf
    assert not kind_of_scene(scene).lawful


def test_a_journal_under_a_load_at_rest_has_the_film_of_its_velocity() -> None:
    given = solve(JOURNAL, cells=48)
    loaded = {name: entry for name, entry in JOURNAL.items() if name != "eccentricity"}
    result = solve(loaded, cells=48, load={"force": f"{given['load'].value!r} N"})
    assert result["eccentricity"].value == pytest.approx(0.6, rel=1e-5)


def test_models_without_a_time_dependent_film_refuse() -> None:
    scene = scene_of(LINE, 1.0, 1e-3, lubricant={"viscosity": "0.01 Pa*s", "density": "900 kg/m^3"})
    refused = {
        model.name: model.applies(scene).reason
        for model in models()
        if model.kind == "bearing" and not model.applies(scene).applies
    }
    assert {"film", "film_slope", "stokes", "navier_stokes"} <= set(refused)
    assert all("approach" in refused[name] for name in ("film", "film_slope", "stokes", "navier_stokes"))
    assert find("bearing", "infinitely_wide").applies(scene_of(PAD)).applies


@pytest.mark.parametrize(
    ("given", "match"),
    [
        (
            (LOBES,),
            "march",
        ),
        ((PAD, 0.0, 0.0), "motion.speed: got 0 m/s under a load"),
        ((PAD, 0.0, -1e-3), "between walls that part"),
    ],
)
def test_what_carries_nothing_or_moves_otherwise_is_refused(given: Any, match: str) -> None:
    tables = {} if match == "march" else {"load": {"force": "10 N"}}
    with pytest.raises(InputError, match=match):
        scene_of(*given, **tables)


def test_a_liquid_that_is_compressed_faster_than_it_flows_out_is_refused() -> None:
    """With a constant bulk modulus K the pressure has an eigenvalue: no film at rest beyond 12ηVB²/(π²Kh³) = 1."""
    soft = {"viscosity": "0.01 Pa*s", "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "1 MPa"}}
    line = {"shape": "parallel", "length": "20 mm", "film": "20 um"}
    limit = np.pi**2 * 1e6 * 20e-6**3 / (12 * VISCOSITY * 0.02**2)
    peak = 1e6 * np.log(1 / np.cos(np.pi / 2 * np.sqrt(0.5)))
    assert solve(line, 0.0, 0.5 * limit, lubricant=soft)["pressure_max"].value == pytest.approx(peak, rel=2e-3)
    with pytest.raises(ConvergenceError, match=r"lower motion\.approach"):
        solve(line, 0.0, 1.2 * limit, lubricant=soft)


def test_a_flat_ring_that_is_squeezed_carries_the_load_of_annular_plates() -> None:
    ring = RADII | {"shape": "sector", "rise": "0 m", "angle": "360 deg", "joined": True}
    known = squeezed_annulus(film=10e-6, inner_radius=0.02, outer_radius=0.04, approach=1e-3, viscosity=VISCOSITY)
    result = solve(ring)
    load = result["load"]
    assert load.uncertainty is not None
    assert abs(load.value - known.load) < load.uncertainty < 0.03 * known.load


def test_models_of_a_wall_at_rest_are_not_compared_by_its_friction_which_is_zero() -> None:
    scene = scene_of({"shape": "parallel", "length": "20 mm", "width": "30 mm", "film": "10 um"})
    ladder = [find("bearing", name) for name in ("reynolds", "reynolds_cavitating")]
    results = {one.name: one.solve(scene, Request(resolution=32)) for one in ladder}
    assert {one.quantity for one in to_best(scene, ladder, results)} == {"load_per_width"}
