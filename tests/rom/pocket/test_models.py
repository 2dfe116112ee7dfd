"""The film models against reference values, symmetry, invariance and their own convergence."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from roughfilm import rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene

MODELS = of_kind(ladder(rom), "pocket")
QUADRATURE = [model for model in MODELS if model.order is None]
PLUS = ("load_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus")

REFERENCE = [
    ("reynolds", 0.30, 0.25, 160, (0.0, 2.917, 6.986, -6.986)),
    ("inertial_reynolds", 0.30, 0.25, 40, (0.890, 2.917, 8.82, -6.89)),
    ("inertial_reynolds", 0.50, 0.25, 160, (6.552, 2.850, 21.84, -8.90)),
]


def plus(result):
    return np.array([result.quantities[name].value for name in PLUS])


@pytest.mark.parametrize(("name", "width", "depth", "reynolds_number", "expected"), REFERENCE)
def test_reference_values_of_an_independent_solver(make_scene, name, width, depth, reynolds_number, expected):
    got = plus(find("pocket", name).solve(make_scene(width, depth, reynolds_number)))
    assert got == pytest.approx(np.array(expected), rel=1e-3, abs=1e-9)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_a_shallow_groove_is_a_smooth_wall(make_scene, model):
    got = plus(model.solve(make_scene(0.3, 1e-6, 160)))
    assert got[1] == pytest.approx(3.0, abs=1e-5)
    assert np.abs(got[[0, 2, 3]]).max() < 1e-3


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_numbers_do_not_depend_on_units_or_scale(pocket_file, model):
    one = load_scene(pocket_file, ["motion.reynolds_number=37"])
    scaled = load_scene(
        pocket_file,
        [
            "geometry.length=1 inch",
            "geometry.film=0.762 mm",
            "geometry.width=0.3 inch",
            "geometry.depth=0.1905 mm",
            "lubricant.viscosity=3 cP",
            "lubricant.density=0.7 g/cm^3",
            "motion.reynolds_number=37",
        ],
    )
    assert plus(model.solve(one)) == pytest.approx(plus(model.solve(scaled)), rel=1e-9, abs=1e-12)


def test_pressure_field_starts_from_zero_and_has_the_units_it_says(make_scene):
    scene = make_scene(0.3, 0.25, 40)
    result = find("pocket", "inertial_reynolds").solve(scene)
    pressure, x = result.fields["pressure"], result.fields["position"]
    assert (pressure.unit, x.unit) == ("Pa", "m")
    assert np.all(np.diff(x.values) > 0)
    plus_unit = 0.01 * scene.speed * 1e-3 / (100 * 3e-5**2)  # Pa in one p+
    assert pressure.values.max() == pytest.approx(8.82 * plus_unit, rel=0.01)
    near_ends = np.interp([-scene.geometry.length / 2, scene.geometry.length / 2], x.values, pressure.values)
    assert np.abs(near_ends).max() < 0.01 * pressure.values.max()


def test_reynolds_pressure_is_antisymmetric(make_scene):
    pressure = find("pocket", "reynolds").solve(make_scene(0.4, 0.9, 80)).fields["pressure"].values
    assert np.abs(pressure + pressure[::-1]).max() < 1e-12 * np.abs(pressure).max()


@pytest.mark.parametrize("model", QUADRATURE, ids=lambda model: model.name)
def test_error_falls_geometrically_and_the_residual_sees_it(make_scene, model):
    scene = make_scene(0.3, 0.75, 60)
    orders = [4, 8, 16, 32]
    exact = plus(model.solve(scene, Request(resolution=96)))
    runs = [model.solve(scene, Request(resolution=order)) for order in orders]
    errors = [np.abs(plus(run) - exact)[1] for run in runs]
    assert all(later < earlier / 5 for earlier, later in pairwise(errors[:3]))
    residuals = [run.numerics.residual for run in runs]
    assert all(later < earlier / 5 for earlier, later in pairwise(residuals))


def test_default_resolution_refines_until_the_tolerance_is_met(make_scene):
    deep = make_scene(0.15, 2.0, 1)
    result = find("pocket", "reynolds").solve(deep, Request(tolerance=1e-10))
    assert result.numerics.residual <= 1e-10
    assert result.numerics.iterations > 1
    finer = find("pocket", "reynolds").solve(deep, Request(resolution=2 * result.numerics.resolution))
    assert plus(result) == pytest.approx(plus(finer), rel=1e-8, abs=1e-12)


def test_a_half_circle_is_solved_or_refused(make_scene):
    half_circle = make_scene(0.3, 5.0, 1)
    result = find("pocket", "reynolds").solve(half_circle)
    assert result.numerics.residual <= 1e-7
    with pytest.raises(ConvergenceError, match="loosen the tolerance"):
        find("pocket", "reynolds").solve(half_circle, Request(tolerance=1e-14))


def test_a_given_resolution_that_misses_the_tolerance_is_a_warning(make_scene):
    scene = make_scene(0.3, 0.25, 1)
    coarse, fine = (find("pocket", "reynolds").solve(scene, Request(resolution=n)) for n in (2, 24))
    assert any("misses the tolerance" in warning for warning in coarse.warnings)
    assert not any("misses the tolerance" in warning for warning in fine.warnings)


@pytest.mark.parametrize(
    ("name", "reynolds_number", "words"),
    [
        (
            "inertial_reynolds",
            5000,
            ["no law gives its error, as Re = 5e+03 is outside", "ruptures"],
        ),
        ("reynolds", 5000, ["no law gives its error, as Re = 5e+03 is outside", "ruptures"]),
        ("inertial_reynolds", 1, []),
    ],
)
def test_cautions_beyond_the_range_of_a_model(make_scene, name, reynolds_number, words):
    result = find("pocket", name).solve(make_scene(0.3, 0.25, reynolds_number))
    assert len(result.warnings) == len(words)
    assert all(word in warning for word, warning in zip(words, result.warnings, strict=True))
    assert len(result.outside) == (reynolds_number == 5000)


@pytest.mark.parametrize(("option", "value"), [("resolution", 1), ("resolution", 10**9), ("tolerance", 0.0)])
def test_options_out_of_range(make_scene, option, value):
    with pytest.raises(InputError, match=f"{option}: got"):
        MODELS[0].solve(make_scene(0.3, 0.25, 1), Request(**{option: value}))


@settings(max_examples=60, deadline=None)
@given(
    film=st.floats(1e-7, 1e-3),
    length=st.floats(2, 1e3),
    width=st.floats(0.01, 0.99),
    depth=st.floats(1e-6, 1),
    reynolds_number=st.floats(1e-6, 1e4),
)
def test_random_grooves_give_finite_numbers_in_bounds_or_one_of_our_errors(film, length, width, depth, reynolds_number):
    wide = width * length * film
    entries = {
        "name": "random",
        "kind": "pocket",
        "geometry": {
            "length": f"{length * film!r} m",
            "film": f"{film!r} m",
            "width": f"{wide!r} m",
            "depth": f"{depth * wide / 2!r} m",
        },
        "lubricant": {"viscosity": "0.03 Pa*s", "density": "870 kg/m^3"},
        "motion": {"reynolds_number": reynolds_number},
    }
    try:
        scene = read_scene(entries)
    except InputError:
        reject()
    smooth = scene.plus_factor
    for model in MODELS:
        try:
            result = model.solve(scene, Request(resolution=model.resolutions_of(scene)[0] if model.order else None))
            load, friction, highest, lowest = plus(result)
        except ConvergenceError:
            continue
        assert np.isfinite([load, friction, highest, lowest]).all()
        assert 0 < friction <= smooth * (1 + 1e-9 if model.order is None else 2)  # inertia may thin the shear layer
        assert lowest <= load <= highest
        assert lowest <= 1e-12 <= highest + 2e-12
