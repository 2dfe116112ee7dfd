"""The public interface: light to import, documented, strict about its input, and the same as the library beneath."""

import ast
import inspect
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from places import ROOT, SCENES, STUDIES

import roughfilm as rf

HEAVY = ("matplotlib", "numba", "pandas", "pint", "pyvista", "scipy.interpolate", "typer")
EXAMPLES = sorted((ROOT / "scripts" / "examples" / "python").glob("*.py"))
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
    "a sweep over one value": (lambda scene, z: rf.sweep(scene, {"geometry.depth": "5 um"}), "give a list"),
    "a sweep over a list": (lambda scene, z: rf.sweep(scene, ["geometry.depth"]), "values: got"),
    "a sweep over no key": (lambda scene, z: rf.sweep(scene, {"geometry.dep": ["5 um"]}), "geometry.dep"),
    "heights in a row": (lambda scene, z: rf.press(z[0], spacing=1e-6, modulus=1e9, load=1e5), "shape (64,)"),
    "heights of ragged rows": (lambda scene, z: rf.parameters([[1.0], [1.0, 2.0]], spacing=1e-6), "heights: got"),
    "heights as text": (lambda scene, z: rf.parameters([["a", "b"]], spacing=1e-6), "give real numbers"),
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


def test_a_surface_and_its_array_give_the_same(ridges):
    surface = rf.Surface(heights=ridges, spacing=(1e-6, 1e-6))
    given = {"modulus": 1e9, "load": 1e6}
    assert np.array_equal(rf.press(surface, **given).gap, rf.press(ridges, spacing=1e-6, **given).gap)
    assert rf.parameters(surface) == rf.parameters(ridges, spacing=1e-6)


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


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_takes_ten_lines_at_most(example):
    tree = ast.parse(example.read_text(encoding="utf-8"))
    assert sum((node.end_lineno or 0) - node.lineno + 1 for node in tree.body[1:]) <= 10


@pytest.mark.parametrize(
    "example",
    [pytest.param(path, marks=pytest.mark.openfoam) if "openfoam" in path.stem else path for path in EXAMPLES],
    ids=lambda path: path.stem,
)
def test_an_example_runs_as_it_stands(example, tmp_path):
    (tmp_path / "scripts").symlink_to(ROOT / "scripts")
    done = run(example, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout or (tmp_path / "load_over_depth.png").stat().st_size > 1000


def program(name: str, *arguments: str | Path, cwd: Path) -> str:
    done = run(ROOT / "scripts" / name, *arguments, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_cases_of_a_study_are_written_each_into_its_directory(tmp_path):
    options = ("--out", tmp_path / "cases", "--resolution", "12")
    told = program("generate_cases.py", STUDIES / "pocket.toml", *options, cwd=tmp_path)
    places = [Path(line) for line in told.splitlines()]
    assert len(places) == 12
    assert all((place / "Allrun").is_file() and place.name == "navier_stokes" for place in places)


def test_a_study_is_solved_once_and_its_inertia_reported(tmp_path):
    written = []
    for _ in range(2):
        told = program("run_batch.py", STUDIES / "pocket.toml", "--out", tmp_path / "out", "--jobs", "1", cwd=tmp_path)
        assert told.splitlines()[-1] == "inertial_reynolds: 12 of 12 cases solved"
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
