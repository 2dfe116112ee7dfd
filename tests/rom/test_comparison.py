"""Differences are named after the effect they measure, and the Pareto front holds what nothing beats."""

import pytest

import rom.models
from rom.comparison import Point, effects, pareto_front, points, scale, to_best
from rom.ladder import Effect, ladder

MODELS = ladder(rom.models)


@pytest.fixture
def results(make_scene):
    return {model.name: model.solve(make_scene(0.3, 0.25, 40)) for model in MODELS}


def test_inertia_is_what_the_film_adds(results):
    found = {d.quantity: d for d in effects(MODELS, results)}
    assert found["load_plus"].effect is Effect.INERTIA
    assert (found["load_plus"].model, found["load_plus"].other) == ("film", "reynolds")
    assert found["load_plus"].absolute == pytest.approx(0.880, rel=1e-2)  # navier_stokes
    assert found["load_plus"].relative == pytest.approx(1.0)
    assert found["friction_plus"].absolute == pytest.approx(0, abs=1e-12)


def test_difference_to_the_best_solved_rung(results):
    (load,) = [d for d in to_best(MODELS, results) if d.quantity == "load_plus"]
    assert (load.model, load.other) == ("reynolds", "inertial_reynolds")
    assert load.relative == pytest.approx(-1)


def test_hardly_any_load_is_measured_against_pressure(results):
    assert scale(results["reynolds"], "load_plus") == pytest.approx(6.986, rel=1e-3)
    assert scale(results["inertial_reynolds"], "load_plus") == pytest.approx(0.880, rel=1e-2)  # navier_stokes


def test_points_leave_the_reference_out(results):
    runs = list(results.values())
    (point,) = points(results["inertial_reynolds"], runs)
    assert point.model == "reynolds"
    assert point.error["load_plus"] == pytest.approx(1)


def test_pareto_front():
    def at(cpu_s: float, error: float) -> Point:
        return Point(model="m", resolution=1, cpu_s=cpu_s, error={"load_plus": error})

    chart = (at(3, 0.1), at(1, 0.5), at(2, 0.6), at(4, 0.2), at(5, 0.01), at(1, 0.7))
    assert [(p.cpu_s, p.error["load_plus"]) for p in pareto_front(chart, "load_plus")] == [
        (1, 0.5),
        (3, 0.1),
        (5, 0.01),
    ]
