"""Differences are named after the effect they measure, and the Pareto front holds what nothing beats."""

from dataclasses import replace

import pytest

from roughfilm import rom
from roughfilm.rom.ladder.model import Effect, ladder, of_kind
from roughfilm.rom.studies.comparison import (
    Point,
    distinguished,
    effects,
    pareto_front,
    points,
    scale,
    to_best,
    undecided,
    with_uncertainty,
)

MODELS = [model for model in of_kind(ladder(rom), "pocket") if model.name in ("reynolds", "inertial_reynolds", "film")]


@pytest.fixture
def scene(make_scene):
    return make_scene(0.3, 0.25, 40)


@pytest.fixture
def results(scene):
    return {model.name: model.solve(scene) for model in MODELS}


def test_inertia_is_what_the_film_adds(scene, results):
    """Reference: the load of an independent Navier-Stokes solver, 0.880; the film leaves slope out of it."""
    found = {d.quantity: d for d in effects(scene, MODELS, results)}
    assert found["load_plus"].effect is Effect.INERTIA
    assert (found["load_plus"].model, found["load_plus"].other) == ("film", "reynolds")
    assert found["load_plus"].absolute == pytest.approx(0.880, rel=1e-2)
    assert found["load_plus"].relative == pytest.approx(1)


def test_difference_to_the_best_solved_rung(scene, results):
    loads = {d.model: d for d in to_best(scene, MODELS, results) if d.quantity == "load_plus"}
    assert set(loads) == {"reynolds", "inertial_reynolds"}
    assert {d.other for d in loads.values()} == {"film"}
    assert loads["reynolds"].relative == pytest.approx(-1)
    assert 0 < loads["inertial_reynolds"].relative < 0.02


def test_hardly_any_load_is_measured_against_pressure(results):
    assert scale(results["reynolds"], "load_plus") == pytest.approx(6.986, rel=1e-3)
    assert scale(results["inertial_reynolds"], "load_plus") == pytest.approx(0.890, abs=1e-3)


def test_points_leave_the_reference_out(results):
    first, second = points(results["film"], list(results.values()))
    assert {first.model, second.model} == {"reynolds", "inertial_reynolds"}
    assert max(first.error["load_plus"], second.error["load_plus"]) == pytest.approx(1)


def test_pareto_front():
    def at(cpu_s: float, error: float) -> Point:
        return Point(model="m", resolution=1, cpu_s=cpu_s, error={"load_plus": error})

    chart = (at(3, 0.1), at(1, 0.5), at(2, 0.6), at(4, 0.2), at(5, 0.01), at(1, 0.7))
    assert [(p.cpu_s, p.error["load_plus"]) for p in pareto_front(chart, "load_plus")] == [
        (1, 0.5),
        (3, 0.1),
        (5, 0.01),
    ]


def carrying(result, quantity: str, uncertainty: float):
    return with_uncertainty(result, {quantity: uncertainty})


def test_errors_carry_the_uncertainty_of_the_reference(scene, results):
    """The film is the reference: a bar of 0.0088 is 1 % of its load, 0.880."""
    known = {**results, "film": carrying(results["film"], "load_plus", 0.0088)}
    of_load = {d.model: d for d in to_best(scene, MODELS, known) if d.quantity == "load_plus"}
    assert [d.uncertainty for d in of_load.values()] == pytest.approx([0.01, 0.01], rel=1e-2)
    own = results["reynolds"].quantities
    unknown = {**own, "load_plus": replace(own["load_plus"], uncertainty=None)}
    known["reynolds"] = replace(results["reynolds"], quantities=unknown)
    (effect,) = (d for d in effects(scene, MODELS, known) if d.quantity == "load_plus")
    assert effect.uncertainty is None
    known["reynolds"] = carrying(results["reynolds"], "load_plus", 0.0088)
    (effect,) = (d for d in effects(scene, MODELS, known) if d.quantity == "load_plus")
    assert effect.uncertainty == pytest.approx(0.01 * 2**0.5, rel=1e-2)


def test_a_larger_uncertainty_of_the_run_itself_is_kept(results):
    once = carrying(results["film"], "load_plus", 0.2)
    assert carrying(once, "load_plus", 0.1)["load_plus"].uncertainty == 0.2


@pytest.mark.parametrize(
    ("error", "other", "uncertainty", "apart"),
    [
        (0.02, 0.05, 0.01, True),
        (0.02, -0.05, 0.01, True),
        (0.02, 0.03, 0.01, False),
        (0.02, -0.025, 0.01, False),
        (0.02, 0.03, 0.0, True),
        (0.02, 0.5, None, False),
    ],
)
def test_errors_are_stated_apart_where_their_intervals_do_not_overlap(error, other, uncertainty, apart):
    assert distinguished(error, other, uncertainty) is apart
    assert distinguished(other, error, uncertainty) is apart


def test_models_within_the_uncertainty_of_the_reference_are_not_ranked(scene, results):
    """Reynolds has no load (an error of 100 %), inertial_reynolds is off by 1 %."""
    assert undecided(scene, MODELS, results)["load_plus"] == (
        ("reynolds", "inertial_reynolds"),
        ("reynolds", "film"),
        ("inertial_reynolds", "film"),
    )
    coarse = {**results, "film": carrying(results["film"], "load_plus", 0.01 * 0.88)}
    assert undecided(scene, MODELS, coarse)["load_plus"] == (("inertial_reynolds", "film"),)
    fine = {**results, "film": carrying(results["film"], "load_plus", 1e-4 * 0.88)}
    assert "load_plus" not in undecided(scene, MODELS, fine)


def test_the_front_leaves_out_what_the_reference_does_not_separate():
    def at(cpu_s: float, error: float) -> Point:
        return Point(model="m", resolution=1, cpu_s=cpu_s, error={"load_plus": error})

    chart = (at(1, 0.5), at(2, 0.030), at(3, 0.020), at(4, 0.004))
    assert [p.cpu_s for p in pareto_front(chart, "load_plus", 0.01)] == [1, 2, 4]
    assert [p.cpu_s for p in pareto_front(chart, "load_plus", 0.02)] == [1, 2]
    assert [p.cpu_s for p in pareto_front(chart, "load_plus", None)] == [1]
