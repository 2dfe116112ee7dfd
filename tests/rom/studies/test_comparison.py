"""Differences are named after the effect they measure, and the Pareto front holds what nothing beats."""

import pytest

from roughfilm import rom
from roughfilm.rom.ladder.model import Effect, ladder, of_kind
from roughfilm.rom.studies.comparison import Point, effects, pareto_front, points, scale, to_best

MODELS = [model for model in of_kind(ladder(rom), "pocket") if model.name in ("reynolds", "inertial_reynolds", "film")]


@pytest.fixture
def results(make_scene):
    return {model.name: model.solve(make_scene(0.3, 0.25, 40)) for model in MODELS}


def test_inertia_is_what_the_film_adds(results):
    """Reference: the load of an independent Navier-Stokes solver, 0.880; the film leaves slope out of it."""
    found = {d.quantity: d for d in effects(MODELS, results)}
    assert found["load_plus"].effect is Effect.INERTIA
    assert (found["load_plus"].model, found["load_plus"].other) == ("film", "reynolds")
    assert found["load_plus"].absolute == pytest.approx(0.880, rel=1e-2)
    assert found["load_plus"].relative == pytest.approx(1)


def test_difference_to_the_best_solved_rung(results):
    loads = {d.model: d for d in to_best(MODELS, results) if d.quantity == "load_plus"}
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
