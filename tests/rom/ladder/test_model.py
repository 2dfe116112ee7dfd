"""The contract that every rung keeps, and the lattice they form."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from places import SCENES

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Effect, best, find, ladder, of_kind, one_effect_away
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Field, SolverRun
from roughfilm.rom.ladder.scene import load_scene

ALL = ladder(rom, foamcases)
MODELS = of_kind(ALL, "pocket")
CONTACTS = of_kind(ALL, "dry_contact")
NEEDS_OPENFOAM = [pytest.param(m, marks=pytest.mark.openfoam) if m.outside else m for m in MODELS]


def test_the_rungs_are_found_in_order():
    assert [model.name for model in MODELS] == [
        "reynolds",
        "reynolds_cavitating",
        "inertial_reynolds",
        "film",
        "stokes",
        "film_slope",
        "navier_stokes",
    ]


def test_the_lattice():
    names = {(model.name, other.name): effect for model in MODELS for other, effect in one_effect_away(model, MODELS)}
    assert names == {
        ("reynolds", "reynolds_cavitating"): Effect.CAVITATION,
        ("reynolds", "film"): Effect.INERTIA,
        ("reynolds", "stokes"): Effect.SLOPE,
        ("film", "navier_stokes"): Effect.SLOPE,
        ("stokes", "navier_stokes"): Effect.INERTIA,
    }
    assert best(MODELS).name == "navier_stokes"


def test_the_lattice_of_contacts():
    assert [model.name for model in CONTACTS] == [
        "greenwood_williamson",
        "elastic",
        "bearing_area",
        "persson",
        "elastic_plastic",
    ]
    steps = {(a.name, b.name): effect for a in CONTACTS for b, effect in one_effect_away(a, CONTACTS)}
    assert steps == {
        ("elastic", "elastic_plastic"): Effect.PLASTICITY,
        ("bearing_area", "elastic_plastic"): Effect.DEFORMATION,
    }
    assert best(CONTACTS).name == "elastic_plastic"


def test_every_model_solves_a_kind_of_scene_and_has_a_name_of_its_own():
    assert {model.kind for model in ALL} == set(kinds())
    assert len({(model.kind, model.name) for model in ALL}) == len(ALL)


def test_an_unknown_name_is_refused_with_the_known_ones():
    with pytest.raises(
        InputError,
        match="one of reynolds, reynolds_cavitating, inertial_reynolds, film, stokes, film_slope, navier_stokes",
    ):
        find(MODELS, "pocket", "raynolds")


@pytest.mark.parametrize("model", NEEDS_OPENFOAM)
def test_contract(model, make_scene):
    scene = make_scene(0.3, 0.25, 20)
    seen = []
    resolution = model.resolutions_of(scene)[1]
    request = Request(resolution=resolution)
    result = model.solve(scene, request, progress=lambda done, words: seen.append((done, words)))
    assert result.model == model.name
    cavities = {"cavitated_fraction", "theta_min"} if Effect.CAVITATION in model.keeps else set()
    assert set(result.quantities) - cavities == {
        "load_plus",
        "friction_plus",
        "pressure_max_plus",
        "pressure_min_plus",
        "load_per_area",
        "friction_per_area",
        "backflow",
    }
    assert {"position", "film_thickness", "pressure", "shear_stress"} <= set(result.fields)
    sizes = {result.fields[name].values.shape for name in ("position", "film_thickness", "pressure", "shear_stress")}
    assert len(sizes) == 1
    numbers = result.numerics
    assert np.isfinite(numbers.residual)
    assert min(numbers.cpu_s, numbers.wall_s, numbers.degrees_of_freedom, numbers.iterations) > 0
    assert numbers.resolution == resolution
    assert numbers.scheme == (model.schemes[0] if model.schemes else "")
    assert result.provenance["keeps"] == sorted(model.keeps)
    assert result.provenance["sources"] == list(model.sources)
    assert all(0 <= done <= 1 for done, _ in seen)
    assert model.applies(scene).applies
    assert model.applies(scene).reason
    assert model.cost(scene, model.resolution_of(scene)) > 0
    ratio = result.quantities["load_per_area"].value / scene.pressure_unit * scene.plus_factor
    assert ratio == pytest.approx(result.quantities["load_plus"].value)


@pytest.mark.parametrize("model", NEEDS_OPENFOAM)
def test_choices_that_a_model_does_not_offer_are_refused(model, make_scene):
    offered = "one of " + ", ".join(model.schemes) if model.schemes else "it offers no choice"
    with pytest.raises(InputError, match=f"^scheme: got 'hybrid' for {model.name}; .*{offered}"):
        model.solve(make_scene(0.3, 0.25, 20), Request(scheme="hybrid"))
    if not model.outside:
        with pytest.raises(InputError, match=f"^processes: got 2; {model.name}"):
            model.solve(make_scene(0.3, 0.25, 20), Request(processes=2))


def test_resolutions_are_sorted_and_hold_the_default(make_scene):
    scenes = (make_scene(0.3, 0.25, 20), load_scene(SCENES / "dimple.toml"))
    for model, scene in product(MODELS, scenes):
        offered = model.offered(scene)
        assert list(offered.series) == sorted(set(offered.series))
        assert offered.default in offered.series
        assert offered.least <= offered.series[0] <= offered.series[-1] <= offered.most


def answering(change=lambda result: result, cost=1.0):
    """The model reynolds of pockets with another answer."""
    known = find(MODELS, "pocket", "reynolds")
    return replace(
        known,
        cost=lambda scene, resolution: cost,
        compute=lambda model, scene, request, progress: change(known.compute(model, scene, request, progress)),
    )


def overflowing(result):
    square = float(np.float64(1e300) * np.float64(1e300))
    return replace(result, quantities={"load": Quantity(value=square, unit="N")})


UNSOUND = {
    "overflow": overflowing,
    "division": lambda result: replace(result, quantities={"load": Quantity(value=1.0 / (result is None), unit="N")}),
    "quantity": lambda result: replace(result, quantities={"load": Quantity(value=float("nan"), unit="N")}),
    "residual": lambda result: replace(result, numerics=replace(result.numerics, residual=float("inf"))),
    "field": lambda result: replace(result, fields={"film": Field(values=np.array([1.0, np.inf]), unit="m")}),
}


@pytest.mark.parametrize("fault", UNSOUND)
def test_a_number_that_is_not_finite_is_an_error_in_one_line_and_never_a_warning(fault, make_scene):
    with pytest.raises(ConvergenceError, match=r"^reynolds: .*; check the units") as caught:
        answering(UNSOUND[fault]).solve(make_scene(0.3, 0.25, 1.0))
    assert "\n" not in str(caught.value)


def test_what_is_unknown_is_left_out(make_scene):
    def change(result):
        quantities = {"load": Quantity(value=1.0, unit="N", uncertainty=float("inf"))}
        runs = (SolverRun(iterations=1, residual=float("nan"), imbalance=0.5),)
        numerics = replace(result.numerics, details={"balance": float("inf"), "films": 3.0}, runs=runs)
        return replace(result, quantities=quantities, numerics=numerics, expected_error={"load": float("inf")})

    result = answering(change).solve(make_scene(0.3, 0.25, 1.0))
    assert result.quantities["load"].uncertainty is None
    assert result.expected_error == {}
    assert result.numerics.details == {"films": 3.0}
    assert (result.numerics.runs[0].residual, result.numerics.runs[0].imbalance) == (None, 0.5)


def test_a_time_that_is_one_time_but_for_round_off_is_not_below_0(make_scene):
    model = answering(lambda result: replace(result, numerics=replace(result.numerics, cpu_s=-7e-18)))
    assert model.solve(make_scene(0.3, 0.25, 20)).numerics.cpu_s == 0


def test_a_request_that_would_take_for_months_is_refused(make_scene):
    with pytest.raises(InputError, match=r"^resolution: .* would take reynolds more than 1e\+09 s of CPU"):
        answering(cost=1e10).solve(make_scene(0.3, 0.25, 1.0))
