"""The public interface: light to import, documented, strict about its input, and the same as the library beneath."""

import ast
import inspect
import json
import os
import subprocess
import sys
import tomllib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from places import ROOT, SCENES, STUDIES

import roughfilm as rf

HEAVY = ("matplotlib", "numba", "pandas", "pint", "pyvista", "scipy.interpolate", "typer", "xarray")
KINDS = {model.kind for model in rf.models()}
NAMES = [name for name in rf.__all__ if name != "__version__"]


def run(*arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, *map(str, arguments)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "MPLBACKEND": "agg"}
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def pocket() -> rf.Scene:
    return rf.load_scene(SCENES / "pocket.toml")


@pytest.fixture
def ridges() -> np.ndarray:
    """Ridges along y, 1 µm high, of one period in 64 points."""
    return np.outer(1e-6 * np.cos(2 * np.pi * np.arange(64) / 64), np.ones(64))


def test_importing_the_package_loads_nothing_heavy(tmp_path):
    code = f"import roughfilm, sys; print([name for name in {HEAVY} if name in sys.modules])"
    assert run("-c", code, cwd=tmp_path).stdout.strip() == "[]"


def test_type_checkers_see_the_names_that_the_package_has():
    tree = ast.parse(Path(rf.__file__).read_text(encoding="utf-8"))
    (typed,) = (node for node in tree.body if isinstance(node, ast.If))
    imported = {alias.asname for node in typed.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert imported == set(NAMES)
    assert set(rf.__all__) <= set(dir(rf))


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'sovle'"):
        rf.sovle  # noqa: B018


@pytest.mark.parametrize("name", NAMES)
def test_every_public_name_is_documented_with_an_example(name):
    public = getattr(rf, name)
    doc = inspect.getdoc(public)
    assert doc
    assert ">>>" in doc
    if inspect.isfunction(public):
        for parameter in inspect.signature(public).parameters:
            assert parameter in doc.partition("Parameters")[2], f"{name}: {parameter}"
        assert "Returns" in doc or inspect.signature(public).return_annotation is None
        assert "Raises" in doc


BAD = {
    "a path that is none": (lambda scene, z: rf.load_scene(3), "path: got int"),
    "a key that is unknown": (
        lambda scene, z: rf.load_scene(SCENES / "pocket.toml", set={"geometry.depht": "1 um"}),
        "did you mean 'depth'",
    ),
    "a value that is none": (
        lambda scene, z: rf.load_scene(SCENES / "pocket.toml", set={"geometry.depth": object()}),
        "set: got <object",
    ),
    "values that are no dict": (lambda scene, z: rf.load_scene(SCENES / "pocket.toml", set="x"), "set: got 'x'"),
    "entries that are none": (lambda scene, z: rf.read_scene([1]), "scene: got list"),
    "a kind that is unknown": (lambda scene, z: rf.models("pockets"), "it must be one of"),
    "a scene that is none": (lambda scene, z: rf.solve("pocket.toml", model="film"), "scene: got str"),
    "a resolution without model": (lambda scene, z: rf.solve(scene, resolution=50), "resolution: got 50 without"),
    "both model and tolerance": (lambda scene, z: rf.solve(scene, model="film", within=0.1), "leave one of them out"),
    "both model and quantity": (lambda scene, z: rf.solve(scene, model="film", quantity="load"), "leave one of them"),
    "a model that is unknown": (lambda scene, z: rf.solve(scene, model="flim"), "model: got 'flim'; it must"),
    "a scheme that is not offered": (lambda scene, z: rf.solve(scene, model="reynolds", scheme="upwind"), "no choice"),
    "a resolution out of range": (lambda scene, z: rf.solve(scene, model="film", resolution=-3), "resolution: got -3"),
    "a resolution as text": (lambda scene, z: rf.solve(scene, model="film", resolution="x"), "resolution: got 'x'"),
    "a tolerance as text": (lambda scene, z: rf.advise(scene, within="5%"), "within: got '5%'"),
    "a tolerance out of range": (lambda scene, z: rf.advise(scene, within=2.0), "above 0 and below 1"),
    "a quantity that is unknown": (lambda scene, z: rf.advise(scene, within=0.1, quantity="lift"), "quantity: got"),
    "models as text": (lambda scene, z: rf.compare(scene, models="film"), "give a list of names"),
    "a key to replace that is unknown": (
        lambda scene, z: rf.replace(scene, "geometry.depht", "1 um"),
        "scene.geometry.depht: unknown key; did you mean 'depth'",
    ),
    "a table to replace that is unknown": (
        lambda scene, z: rf.replace(scene, "geometri.depth", "1 um"),
        "did you mean 'geometry'",
    ),
    "a key to replace below a number": (
        lambda scene, z: rf.replace(scene, "geometry.depth.more", "1 um"),
        "'depth' is not a table",
    ),
    "a key to replace that is none": (lambda scene, z: rf.replace(scene, 3, "1 um"), "key: got 3"),
    "a key to replace with a value in it": (lambda scene, z: rf.replace(scene, "a=b", "1 um"), "key: got 'a=b'"),
    "a value to replace that is missing": (lambda scene, z: rf.replace(scene, "geometry.depth"), "value: missing"),
    "a value to replace beside a dict": (lambda scene, z: rf.replace(scene, {"name": "a"}, "b"), "leave it out"),
    "a value to replace that is none": (
        lambda scene, z: rf.replace(scene, "geometry.depth", object()),
        "geometry.depth: got <object",
    ),
    "a value to replace out of range": (
        lambda scene, z: rf.replace(scene, "geometry.depth", "-1 um"),
        "depth: got '-1 um'; it must be above zero",
    ),
    "a value to replace that excludes another": (
        lambda scene, z: rf.replace(scene, {"motion.speed": "1 m/s", "motion.reynolds_number": 3}),
        "takes the place of",
    ),
    "a required entry removed": (lambda scene, z: rf.replace(scene, "geometry.film", None), "film: missing"),
    "a scene to replace that is none": (lambda scene, z: rf.replace("pocket.toml", "name", "b"), "scene: got str"),
    "a dotted key of a copy": (
        lambda scene, z: scene.model_copy(update={"geometry.depth": 7.5e-6}),
        "geometry.depth: is no key of Pocket; make a changed scene with rf.replace",
    ),
    "an attribute that is set": (lambda scene, z: setattr(scene.geometry, "film", 1e-6), "rf.replace(scene, "),
    "a sweep over one value": (lambda scene, z: rf.sweep(scene, {"geometry.depth": "5 um"}), "give a list"),
    "a sweep over a list": (lambda scene, z: rf.sweep(scene, ["geometry.depth"]), "values: got"),
    "a sweep over no key": (lambda scene, z: rf.sweep(scene, {"geometry.dep": ["5 um"]}), "geometry.dep"),
    "heights in a row": (lambda scene, z: rf.press(z[0], spacing=1e-6, modulus=1e9, load=1e5), "shape (64,)"),
    "heights of ragged rows": (lambda scene, z: rf.parameters([[1.0], [1.0, 2.0]], spacing=1e-6), "heights: got"),
    "heights as text": (lambda scene, z: rf.parameters([["a", "b"]], spacing=1e-6), "give real numbers"),
    "a profile of two lines": (lambda scene, z: rf.profile_parameters(z, spacing=1e-6), "give one line"),
    "a profile of ragged rows": (
        lambda scene, z: rf.profile_parameters([[1.0], [1.0, 2.0]], spacing=1e-6),
        "give one line",
    ),
    "a profile as text": (lambda scene, z: rf.profile_parameters(["a", "b"], spacing=1e-6), "give real numbers"),
    "a profile without spacing": (lambda scene, z: rf.profile_parameters(z[:, 0], spacing=0.0), "spacing"),
    "a profile of no sections": (
        lambda scene, z: rf.profile_parameters(z[:, 0], spacing=1e-6, sections=0),
        "give 1 to 64",
    ),
    "a profile of no letter": (lambda scene, z: rf.profile_parameters(z[:, 0], spacing=1e-6, profile="Q"), "'R'"),
    "heights not finite": (lambda scene, z: rf.press(z * np.nan, spacing=1, modulus=1, load=1), "are not finite"),
    "masked heights": (
        lambda scene, z: rf.flow_factors(np.ma.masked_less(z, z.mean()), spacing=1e-6, gap=3e-6),
        "masked",
    ),
    "no spacing": (lambda scene, z: rf.flow_factors(z, gap=3e-6), "spacing: missing"),
    "a negative spacing": (lambda scene, z: rf.flow_factors(z, spacing=-1e-6, gap=3e-6), "spacing"),
    "three spacings": (lambda scene, z: rf.flow_factors(z, spacing=(1, 2, 3), gap=3e-6), "a pair (dx, dy)"),
    "a gap of nothing": (lambda scene, z: rf.flow_factors(z, spacing=1e-6, gap=0.0), "gap: got 0.0"),
    "a negative load": (lambda scene, z: rf.press(z, spacing=1e-6, modulus=1e9, load=-1e5), "load: got"),
    "a load above the hardness": (
        lambda scene, z: rf.press(z, spacing=1e-6, modulus=1e9, load=1e6, hardness=1e5),
        "hardness",
    ),
    "a boundary that is unknown": (
        lambda scene, z: rf.press(z, spacing=1e-6, modulus=1e9, load=1e6, boundary="open"),
        "periodic or free",
    ),
    "an array to read": (lambda scene, z: rf.read_surface(z), "path: got ndarray"),
    "an array to prepare": (lambda scene, z: rf.prepare(z), "surface: got ndarray"),
    "an array to combine": (lambda scene, z: rf.combine(z, z), "first: got ndarray"),
    "a shift of one length": (
        lambda scene, z: rf.combine(*[rf.Surface(heights=z, spacing=(1e-6, 1e-6))] * 2, "sum", shift=1e-6),
        "shift: got 1e-06; give a pair",
    ),
    "a shift beyond the surface": (
        lambda scene, z: rf.combine(*[rf.Surface(heights=z, spacing=(1e-6, 1e-6))] * 2, shift=(1.0, 0.0)),
        "registration: the surfaces overlap by 0 pixels along x",
    ),
    "an unknown operation": (
        lambda scene, z: rf.combine(*[rf.Surface(heights=z, spacing=(1e-6, 1e-6))] * 2, "product"),
        "operation: got 'product'",
    ),
    "an unknown axis": (
        lambda scene, z: rf.combine(*[rf.Surface(heights=z, spacing=(1e-6, 1e-6))] * 2, mirror="z"),
        "mirror: got 'z'; it must be 'x', 'y' or 'none'",
    ),
    "a model without cases": (lambda scene, z: rf.write_case(scene, "case", model="film"), "navier_stokes"),
    "a pocket for a bearing": (lambda scene, z: rf.stribeck(scene, [1.0], [1e6]), "kind 'pocket'"),
    "a pocket for a seal": (lambda scene, z: rf.leakage_curve(scene, [1e6]), "kind 'pocket'"),
    "a pocket for effects": (lambda scene, z: rf.effects(scene), "kind 'pocket'"),
    "no processes": (lambda scene, z: rf.run_study(STUDIES / "pocket.toml", "out", processes=0), "processes: got 0"),
    "a result that is not there": (lambda scene, z: rf.load_result("nowhere.h5"), "nowhere.h5"),
    "a result that is none": (lambda scene, z: rf.save({}, "nowhere.h5"), "result: got dict"),
}


@pytest.mark.parametrize("fault", BAD)
def test_bad_input_is_refused_in_one_line(fault, pocket, ridges, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, words = BAD[fault]
    with pytest.raises(rf.InputError) as refused:
        call(pocket, ridges)
    message = str(refused.value)
    assert words in message
    assert "\n" not in message
    assert len(message) < 300
    assert not list(tmp_path.iterdir())


def test_a_scene_may_be_changed_while_it_is_read(pocket):
    deep = rf.load_scene(SCENES / "pocket.toml", set={"geometry.depth": "22.5 um", "motion.reynolds_number": 40})
    assert deep.reynolds_number == 40
    assert deep.depth == pytest.approx(3 * pocket.depth)


def test_a_replaced_value_changes_that_entry_alone(pocket):
    before = pocket.model_dump()
    deep = rf.replace(pocket, "geometry.depth", "15 um")
    assert deep == rf.load_scene(SCENES / "pocket.toml", set={"geometry.depth": "15 um"})
    assert deep.depth == pytest.approx(2 * pocket.depth)
    assert pocket.model_dump() == before
    assert rf.replace(deep, "geometry.depth", "7.5 um") == pocket


def test_a_key_replaces_the_one_that_it_excludes(pocket):
    slow = rf.replace(pocket, "motion.reynolds_number", 40)
    assert slow.reynolds_number == 40
    assert slow.speed == pytest.approx(pocket.speed / 4, rel=1e-4)
    assert rf.replace(slow, "motion.speed", "1 m/s").speed == 1


def test_values_of_every_kind_replace_entries(pocket):
    renamed = rf.replace(pocket, {"name": "3", "motion.reynolds_number": np.float32(40)})
    assert (renamed.name, renamed.reynolds_number) == ("3", 40)
    washer = rf.load_scene(SCENES / "rough_washer.toml")
    fine = rf.replace(washer, "roughness.surface.points", np.array([256, 512]))
    assert fine.roughness.surface["points"] == [256, 512]
    table = {"law": "barus", "pressure_coefficient": "15 GPa^-1"}
    thick = rf.replace(washer, "lubricant.piezoviscosity", table)
    assert thick.lubricant.piezoviscosity.pressure_coefficient == pytest.approx(15e-9)
    assert rf.replace(thick, "lubricant.piezoviscosity", None) == washer
    two = rf.load_scene(SCENES / "two_grooves.toml")
    (left, right) = rf.replace(two, "geometry.grooves.1.depth", "5 um").grooves
    assert (left, right.depth) == (two.grooves[0], pytest.approx(5e-6))


def test_numbers_are_in_si_units(pocket):
    assert rf.replace(pocket, "geometry.depth", 15e-6) == rf.replace(pocket, "geometry.depth", "15 um")
    assert rf.replace(pocket, "geometry.depth", np.float64(15e-6)) == rf.replace(pocket, "geometry.depth", 15e-6)
    assert rf.replace(pocket, "motion.speed", 10) == rf.replace(pocket, "motion.speed", "10 m/s")
    groove = {"length": 1e-3, "film": 30e-6, "profile": "cylindrical", "width": 0.3e-3, "depth": 9e-6}
    assert rf.replace(pocket, "geometry", groove) == rf.replace(pocket, "geometry.depth", "9 um")
    washer = rf.load_scene(SCENES / "rough_washer.toml")
    shorter = rf.replace(washer, "roughness.surface.correlation_length", 50e-6)
    assert shorter == rf.replace(washer, "roughness.surface.correlation_length", "50 um")
    rows = rf.sweep(pocket, {"geometry.depth": np.array([5e-6, 10e-6])}, models=["reynolds"])
    assert [row["geometry.depth"] for row in rows] == [5e-6, 1e-5]
    with pytest.raises(rf.InputError, match="depth"):
        rf.replace(pocket, "geometry.depth", -1e-6)
    with pytest.raises(rf.InputError, match="without a unit"):
        rf.load_scene(SCENES / "pocket.toml", set={"geometry.depth": "15e-6"})


def test_every_scene_is_itself_when_nothing_is_replaced():
    for path in sorted(SCENES.glob("*.toml")):
        if tomllib.loads(path.read_text(encoding="utf-8"))["kind"] in KINDS:
            scene = rf.load_scene(path)
            assert rf.replace(scene, {}) == scene, path.name


def test_a_frozen_scene_keeps_its_values(pocket):
    film = pocket.geometry.film
    with pytest.raises(rf.InputError, match=r"film: PocketGeometry is immutable"):
        pocket.geometry.film = 1.0
    with pytest.raises(rf.InputError, match=r"speed: Pocket is immutable"):
        pocket.speed = 1.0
    assert pocket.geometry.film == film


def test_the_uncertainty_of_flow_factors_covers_the_closed_form_of_ridges(ridges):
    gap = 3e-6 - ridges[:, 0]
    factors = rf.flow_factors(ridges, spacing=1e-6, gap=3e-6)
    exact = {
        "A11": 1 / (gap**-3).mean() / 3e-6**3,
        "A22": (gap**3).mean() / 3e-6**3,
        "B1": (gap**-2).mean() / (gap**-3).mean() / 3e-6,
    }
    for name, value in exact.items():
        assert factors[name].uncertainty < 0.01
        assert abs(factors[name].value - value) <= factors[name].uncertainty + 1e-12, name


def test_numbers_of_numpy_are_numbers(ridges):
    surface = rf.Surface(heights=ridges, spacing=(1e-6, 1e-6))
    given = [rf.press(surface, modulus=np.int64(10**9), load=load).mean_gap for load in (np.float32(1e6), 1e6)]
    assert given[0] == given[1]


def test_flow_factors_turn_with_the_surface(ridges):
    along, across = (rf.flow_factors(z, spacing=1e-6, gap=3e-6) for z in (ridges, ridges.T))
    assert along["A11"].value == pytest.approx(across["A22"].value, rel=1e-6)


def test_an_array_that_is_repeated_with_steps_at_its_edges_warns():
    """A tilt has steps at its edges, a whole wave has none; each is the array of another."""
    x = np.arange(32)
    wave, tilt = (np.tile(z[:, None], (1, 32)) for z in (1e-6 * np.cos(2 * np.pi * x / 32), 1e-7 * x))
    for call in (
        lambda z: rf.press(z, spacing=1e-6, modulus=1e9, load=1e6),
        lambda z: rf.flow_factors(z, spacing=1e-6, gap=4e-6),
        lambda z: rf.flow_factors([rf.Surface(heights=z, spacing=(1e-6, 1e-6))] * 2, gap=4e-6),
    ):
        call(wave)
        with pytest.warns(UserWarning, match=r"heights: is not periodic \(mismatch .*prepare\(\) joins its edges"):
            call(tilt)
    rf.press(tilt, spacing=1e-6, modulus=1e9, load=1e6, boundary="free")


def test_a_contact_beyond_linear_elasticity_warns():
    """A wave with Δ/λ = 0.05 is pressed flat at W = π E* Δ/λ, with the peak 2 W = 0.314 E* (Westergaard 1939)."""
    wave = 0.05 * 64e-6 * np.outer(np.cos(2 * np.pi * np.arange(64) / 64), np.ones(8))
    given = {"spacing": 1e-6, "modulus": 1e9, "poisson": 0.0, "load": 1.0001 * np.pi * 0.05 * 1e9}
    with pytest.warns(UserWarning, match=r"peak pressure 314.2 MPa exceeds 0.3 E\* = 300 MPa"):
        rf.press(wave, **given)
    rf.press(wave, **given, hardness=2.9e8)


def test_a_surface_and_its_array_give_the_same(ridges):
    surface = rf.Surface(heights=ridges, spacing=(1e-6, 1e-6))
    given = {"modulus": 1e9, "load": 1e6}
    assert np.array_equal(rf.press(surface, **given).gap, rf.press(ridges, spacing=1e-6, **given).gap)
    assert rf.parameters(surface) == rf.parameters(ridges, spacing=1e-6)


def test_parameters_of_a_surface_are_those_of_its_valid_points(ridges):
    invalid = np.zeros(ridges.shape, dtype=bool)
    invalid[5:9, 5:9] = True
    holed = rf.Surface(heights=np.where(invalid, 1.0, ridges), spacing=(1e-6, 1e-6), invalid=invalid)
    assert rf.parameters(holed)["Sz"].value == rf.parameters(ridges, spacing=1e-6)["Sz"].value


def test_a_profile_is_a_line_of_a_surface(ridges):
    line = rf.profile_parameters(ridges[:, 0], spacing=1e-6)
    assert line["Rt"].value == pytest.approx(np.ptp(ridges[:, 0]), rel=1e-12)


def test_a_contact_carries_its_load_and_grows_with_it(ridges):
    contacts = [rf.press(ridges, spacing=1e-6, modulus=1e9, load=load) for load in (1e5, 1e6, 1e7)]
    assert [one.pressure.mean() for one in contacts] == pytest.approx([1e5, 1e6, 1e7])
    for lighter, heavier in pairwise(contacts):
        assert heavier.area_fraction > lighter.area_fraction
        assert heavier.mean_gap < lighter.mean_gap


def test_the_expected_error_of_a_model_covers_its_distance_from_a_better_one(pocket):
    plain, better = (rf.solve(pocket, model=name) for name in ("inertial_reynolds", "film_slope"))
    difference = abs(plain["load"].value / better["load"].value - 1)
    assert difference < plain.expected_error["load_plus"]
    assert better.expected_error["load_plus"] < plain.expected_error["load_plus"]


def test_no_error_is_expected_of_a_scene_that_no_law_has_seen():
    beyond = rf.load_scene(SCENES / "pocket.toml", set={"motion.reynolds_number": 5000})
    assert "load_plus" not in rf.solve(beyond, model="inertial_reynolds").expected_error


def test_without_a_model_the_advised_one_within_five_percent_is_taken(pocket):
    advised = rf.advise(pocket)
    result = rf.solve(pocket)
    assert advised.within == 0.05
    assert (result.model, result.numerics.resolution) == (advised.chosen.model, advised.chosen.resolution)
    assert 0 < result.expected_error["load_plus"] <= 0.05


def test_where_no_model_is_within_five_percent_the_most_accurate_one_warns():
    fast = {"motion.reynolds_number": 3e3}
    scene = rf.load_scene(SCENES / "pocket.toml", set=fast)
    assert rf.advise(scene).chosen is None
    assert any("no model here is known to give the load within 5 %" in one for one in rf.solve(scene).warnings)
    with pytest.raises(rf.ConvergenceError, match="no model here is known"):
        rf.solve(scene, within=0.05)


def test_a_tolerance_chooses_the_advised_model(pocket):
    advice = rf.advise(pocket, quantity="friction", within=0.05)
    result = rf.solve(pocket, quantity="friction", within=0.05)
    assert advice.chosen is not None
    assert (result.model, result.numerics.resolution) == (advice.chosen.model, advice.chosen.resolution)


def test_a_sweep_has_a_row_for_every_combination_and_model(pocket):
    depths, numbers = ["5 um", "10 um"], [40, 80]
    values = {"geometry.depth": depths, "motion.reynolds_number": numbers}
    rows = rf.sweep(pocket, values, models=["reynolds", "film"])
    assert [(row["geometry.depth"], row["motion.reynolds_number"], row["model"]) for row in rows] == [
        (depth, number, model) for depth in (5e-6, 1e-5) for number in numbers for model in ("reynolds", "film")
    ]
    alone = rf.load_scene(SCENES / "pocket.toml", set={"geometry.depth": "10 um", "motion.reynolds_number": 80})
    assert rows[-1]["load_per_area"] == rf.solve(alone, model="film")["load"].value
    assert rows.units["load_per_area"] == "Pa"


def test_a_sweep_over_a_key_of_a_dimple_has_its_values_in_si_units():
    dimple = rf.load_scene(SCENES / "dimple.toml", set={"geometry.dimples.0.edge": "5 um"})
    rows = rf.sweep(dimple, {"geometry.dimples.0.depth": ["5 um", "10 um"]}, models=["reynolds"])
    assert [row["geometry.dimples.0.depth"] for row in rows] == [5e-6, 10e-6]
    assert rows.units["geometry.dimples.0.depth"] == "m"


def test_a_sweep_says_why_a_model_has_no_result():
    slider = rf.load_scene(SCENES / "parabolic_slider.toml")
    (row,) = rf.sweep(slider, {"motion.speed": ["1 m/s"]}, models=["mixed"])
    assert "load_per_width" not in row
    (mixed,) = (model for model in rf.models("bearing") if model.name == "mixed")
    assert row["outcome"] == mixed.applies(slider).reason


def test_a_comparison_measures_against_the_model_that_keeps_most(pocket):
    found = rf.compare(pocket, models=["reynolds", "inertial_reynolds", "film_slope"])
    assert found.best == "film_slope"
    assert found.errors.keys() == {"reynolds", "inertial_reynolds"}
    one, best = (found.results[name]["load_plus"].value for name in ("inertial_reynolds", "film_slope"))
    assert found.errors["inertial_reynolds"]["load_plus"] == pytest.approx((one - best) / abs(best))


def test_a_comparison_carries_the_uncertainty_of_the_best_model():
    """Density and viscosity of this oil are constant, so that two models are equal; the third does not cavitate."""
    journal = rf.load_scene(SCENES / "journal.toml")
    found = rf.compare(journal, models=["reynolds", "reynolds_incompressible", "reynolds_cavitating"])
    load = found.results["reynolds_cavitating"]["load_per_width"]
    assert found.uncertainty["load_per_width"] == pytest.approx(load.uncertainty / load.value)
    assert found.undecided["load_per_width"] == (("reynolds_incompressible", "reynolds_cavitating"),)


def test_a_stored_result_comes_back_as_it_was(pocket, tmp_path):
    result = rf.solve(pocket, model="film_slope")
    rf.save(result, tmp_path / "result.h5")
    again = rf.load_result(tmp_path / "result.h5")
    assert again.quantities == result.quantities
    assert again.expected_error == result.expected_error
    assert np.array_equal(again.fields["pressure"].values, result.fields["pressure"].values)


def test_a_result_is_shown_in_about_ten_lines(pocket, tmp_path):
    result = rf.solve(pocket, model="reynolds")
    lines = repr(result).splitlines()
    assert lines[0] == "Result of reynolds on 'pocket' (pocket)"
    assert len(lines) <= 12
    assert max(map(len, lines)) <= 100
    for name in list(result.quantities)[:4]:
        assert any(line.startswith(f"  {name} ") and str(result.quantities[name]) in line for line in lines)
    for word in ("fields: position 72", "cost: ", "s CPU", f"warnings: {len(result.warnings)}", "error of the model"):
        assert word in repr(result)
    rf.save(result, tmp_path / "result.h5")
    assert repr(rf.load_result(tmp_path / "result.h5")) == repr(result)


def test_a_quantity_is_shown_with_its_uncertainty_and_unit():
    assert str(rf.Quantity(value=2.414, unit="N", uncertainty=0.13)) == "2.41 ± 0.13 N"
    assert str(rf.Quantity(value=0.25, unit="1")) == "0.25"


def test_what_functions_return_is_shown_without_its_arrays(pocket, ridges):
    surface = rf.Surface(heights=ridges, spacing=(1e-6, 1e-6))
    shown = {
        "surface": surface,
        "contact": rf.press(surface, modulus=1e9, load=1e5),
        "advice": rf.advise(pocket, within=0.1),
        "comparison": rf.compare(pocket, models=["reynolds", "film"]),
        "sweep": rf.sweep(pocket, {"geometry.depth": ["5 um", "10 um"]}, models=["reynolds"]),
        "study": rf.load_study(STUDIES / "pocket.toml"),
        "model": rf.models("pocket")[0],
        "effects": rf.effects(rf.load_scene(SCENES / "parabolic_slider.toml"), resolution=64),
        "field": rf.Field(values=ridges, unit="m"),
    }
    for name, one in shown.items():
        assert "\n" not in repr(one), name
        assert len(repr(one)) < 600, name
    assert "<array 64×64>" in repr(surface)
    assert "2 rows of" in repr(shown["sweep"])
    assert "geometry.depth (m)" in repr(shown["sweep"])


def test_the_dataset_of_a_result_has_its_fields_over_named_coordinates(pocket, tmp_path):
    pytest.importorskip("xarray")
    result = rf.solve(pocket, model="film_slope")
    data = result.to_xarray()
    assert data["pressure"].dims == ("position",)
    assert data["pressure"].attrs["units"] == "Pa"
    assert data["position"].attrs["units"] == "m"
    assert np.array_equal(data["pressure"].values, result.fields["pressure"].values)
    peak = data["pressure"].idxmax("position").item()
    assert 0 < peak < pocket.grooves[0].width
    assert data["cell_velocity"].dims == ("x_cell", "y_cell", "component")
    middle = data["cell_x"].isel(y_cell=-1).values
    assert middle == pytest.approx(data["position"].values, abs=1e-9)
    assert float(data["load_per_area"]) == result["load"].value
    assert data["load_plus"].attrs["expected_error"] == result.expected_error["load_plus"]
    assert json.loads(data.attrs["provenance"])["scene"]["name"] == "pocket"
    data.to_netcdf(tmp_path / "pocket.nc", engine="scipy")
    assert (tmp_path / "pocket.nc").stat().st_size > data.nbytes


def test_the_dataset_of_a_bearing_is_a_grid_along_and_across_the_sliding():
    pytest.importorskip("xarray")
    washer = rf.load_scene(SCENES / "washer.toml")
    result = rf.solve(washer, model="reynolds", resolution=32)
    data = result.to_xarray()
    assert data["pressure"].dims == ("x", "y")
    assert (data["x"].attrs["units"], data["y"].attrs["units"]) == ("rad", "m")
    inner, outer = washer.geometry.inner_radius, washer.geometry.outer_radius
    assert (data["y"].values[0], data["y"].values[-1]) == pytest.approx((inner, outer))
    edge = data["pressure"].sel(y=inner, method="nearest").values
    assert edge == pytest.approx(np.full(len(data["x"]), washer.boundary.sides.low))
    assert data["load"].attrs["uncertainty"] == result["load"].uncertainty


@pytest.mark.parametrize("name", ["dry_contact.toml", "seal.toml", "random_gap.toml"])
def test_every_field_and_quantity_of_a_result_is_in_its_dataset(name):
    pytest.importorskip("xarray")
    scene = rf.load_scene(SCENES / name)
    cheapest = min((one for one in rf.models(scene.kind)), key=lambda one: one.cost(scene, one.resolution_of(scene)))
    result = rf.solve(scene, model=cheapest.name)
    data = result.to_xarray()
    assert {*result.fields, *result.quantities} <= {*data.variables}


def test_the_table_of_a_sweep_has_a_row_for_every_row(pocket):
    pytest.importorskip("pandas")
    rows = rf.sweep(pocket, {"geometry.depth": ["5 um", "10 um"]}, models=["reynolds", "film"])
    table = rows.to_dataframe()
    assert len(table) == 4
    assert table["geometry.depth"].tolist() == [5e-6, 5e-6, 1e-5, 1e-5]
    assert table.attrs["units"]["geometry.depth"] == "m"
    loads = table.pivot(index="geometry.depth", columns="model", values="load_per_area")
    assert loads.loc[1e-5, "film"] == rows[-1]["load_per_area"]
    assert {"cpu_s", "warnings", "outcome"} <= {*table}


@pytest.mark.parametrize("library", ["xarray", "pandas"])
def test_a_missing_library_is_named_with_its_installation(library, pocket, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    made = {
        "xarray": rf.solve(pocket, model="reynolds").to_xarray,
        "pandas": rf.sweep(pocket, {"geometry.depth": ["5 um"]}, models=["reynolds"]).to_dataframe,
    }
    with pytest.raises(rf.UnavailableError, match=rf"{library}: not installed; .*pip install 'roughfilm\[data\]'"):
        made[library]()


@pytest.mark.openfoam
def test_a_case_that_was_run_has_a_result_and_a_mesh(pocket, tmp_path):
    case = rf.write_case(pocket, tmp_path / "case", resolution=30)
    with pytest.raises(rf.InputError, match="run"):
        case.mesh()
    result, mesh = case.run(), case.mesh()
    assert case.result() is result
    assert {"cell_velocity (m/s)", "cell_pressure (Pa)"} <= set(mesh.cell_data)
    length, film = pocket.geometry.length, pocket.geometry.film
    assert np.ptp(mesh.points[:, 0]) == pytest.approx(length)
    area = mesh.compute_cell_sizes()["Area"].sum()
    assert length * film < area < length * film * (1 + pocket.depth)


def program(name: str, *arguments: str | Path, cwd: Path) -> str:
    done = run(ROOT / "scripts" / name, *arguments, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_cases_of_a_study_are_written_each_into_its_directory(tmp_path):
    text = (STUDIES / "pocket.toml").read_text(encoding="utf-8").partition("[study]")[0]
    (tmp_path / "study.toml").write_text(
        f'{text}[study]\nmodels = ["navier_stokes"]\nresolution = {{ navier_stokes = 12 }}\n', encoding="utf-8"
    )
    printed = program("generate_cases.py", "study.toml", "--out", "cases", cwd=tmp_path)
    places = [tmp_path / line for line in printed.splitlines()]
    assert len(places) == 12
    assert all((place / "Allrun").is_file() and place.name == "navier_stokes-12" for place in places)


def test_a_study_is_solved_once_and_its_inertia_reported(tmp_path):
    written = []
    for _ in range(2):
        lines = program("run_batch.py", STUDIES / "pocket.toml", "--out", tmp_path / "out", "--jobs", "1", cwd=tmp_path)
        assert lines.splitlines()[-1] == "inertial_reynolds: 12 of 12 cases solved"
        written.append({path: path.stat().st_mtime_ns for path in (tmp_path / "out").glob("cases/*/*.h5")})
    assert len(written[0]) == 24
    assert written[0] == written[1]
    program("inertia_report.py", tmp_path / "out", "--out", tmp_path / "page.html", cwd=tmp_path)
    assert "<svg" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_inertia_of_one_scene_is_reported(tmp_path):
    program("inertia_report.py", SCENES / "pocket.toml", cwd=tmp_path)
    assert "<svg" in (tmp_path / "inertia.html").read_text(encoding="utf-8")


def test_a_program_refuses_a_file_that_is_no_study_in_one_line(tmp_path):
    done = run(ROOT / "scripts" / "run_batch.py", "nowhere.toml", "--out", "out", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith("error: nowhere.toml")
    assert done.stderr.count("\n") == 1


def test_films_are_solved_where_quadrature_is_not():
    """The check of cavitation takes the pressure of quadrature at a resolution that needs not meet its tolerance."""
    half_circles = rf.read_scene(
        {
            "name": "half circles",
            "kind": "pocket",
            "geometry": {
                "length": "0.2 mm",
                "film": "30 um",
                "grooves": [
                    {"profile": "cylindrical", "position": at, "width": "0.1 mm", "depth": "0.05 mm"}
                    for at in ("-0.05 mm", "0.05 mm")
                ],
            },
            "lubricant": {"viscosity": "1 mPa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": 1},
        }
    )
    with pytest.raises(rf.ConvergenceError, match="loosen the tolerance"):
        rf.solve(half_circles, model="reynolds")
    assert rf.solve(half_circles, model="film")["load"].value != 0


def test_a_law_that_a_run_contradicts_states_no_error_and_is_not_advised():
    """Finite elements: load 0.9664; film_slope is 7.8 % off, since effects cancel in the load of this deep groove."""
    change = {"geometry.width": "0.3 mm", "geometry.depth": "60 um", "motion.reynolds_number": 100}
    deep = rf.load_scene(SCENES / "pocket.toml", set=change)
    result = rf.solve(deep, model="film_slope")
    assert abs(result["load_plus"].value / 0.9664 - 1) == pytest.approx(0.078, abs=2e-3)
    assert "load_plus" not in result.expected_error
    assert "friction_plus" in result.expected_error
    assert any("effects cancel" in warning for warning in result.warnings)
    chosen = rf.advise(deep, within=0.05, quantity="load_plus").chosen
    assert chosen is None or chosen.model == "navier_stokes"
