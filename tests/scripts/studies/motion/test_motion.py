"""Random films whose walls move: draws, extrapolation of truths, counts by synthetic answers, and the page."""

import json

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import scene_entries
from scripts.studies.motion import __main__ as study
from scripts.studies.motion.counting import MARCH, SOLVE, count_scene, counted_of, judged
from scripts.studies.motion.random_scenes import HEATED, IN_TIME, KINDS, drawn, drawn_in_time, drawn_with_heat
from scripts.studies.motion.solving import RATIOS, Stated, Truth, extrapolated, nearest


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_is_a_scene_and_another_seed_another_one(kind):
    first, again, other = (scene_entries(drawn(kind, seed)) for seed in (3, 3, 4))
    assert first == again
    assert first != other


@pytest.mark.parametrize("kind", IN_TIME)
def test_a_scene_in_time_has_a_motion_and_an_end(kind):
    for seed in range(4):
        scene, end = drawn_in_time(kind, seed)
        assert end > 0
        assert scene.motion.over_time is not None or scene.body is not None


@pytest.mark.parametrize("kind", HEATED)
def test_a_scene_with_heat_has_walls_and_a_viscosity_over_temperature(kind):
    scene, again = drawn_with_heat(kind, 3), drawn_with_heat(kind, 3)
    assert scene_entries(scene) == scene_entries(again)
    assert scene.heat is not None
    assert scene.lubricant.thermoviscosity is not None


def test_temperatures_and_heat_are_judged_too():
    found = counted_of(count_scene("given_pad", 1, "adiabatic", 16))
    assert not found.refused
    names = {one.quantity for one in found.found}
    assert {"temperature_max", "temperature_mean", "heat_generated", "load", "inlet_flow"} <= names
    assert {one.model for one in found.found} == {"adiabatic"}


def test_stiffness_is_judged_with_the_temperature_of_its_film():
    found = counted_of(count_scene("pad", 1, "heated_dynamics", 32))
    assert not found.refused
    assert {"stiffness", "damping", "temperature", "outlet_temperature"} <= {one.quantity for one in found.found}


def test_values_of_second_order_are_extrapolated_to_their_limit():
    """The grid between has another shape, so that its error bounds that of the truth."""
    levels = [{"load": 5 + 3 / along**2 + 2 / across**2} for along, across in RATIOS]
    truth = extrapolated(levels, RATIOS)
    assert truth.values["load"] == pytest.approx(5, rel=1e-12)
    errors = [abs(level["load"] - 5) for level in levels[1:]]
    assert truth.uncertainty["load"] == pytest.approx(max(errors), rel=1e-9)


def test_places_on_a_bore_are_compared_by_the_nearest_turn():
    assert nearest("attitude_angle", 359.0, 1.0) == pytest.approx(-1.0)
    assert nearest("rupture", 0.02, 0.98) == pytest.approx(1.02)
    assert nearest("load", 359.0, 1.0) == 359.0


def test_each_number_is_judged_once_and_what_the_scene_prescribes_not_at_all():
    names = ("load", "friction", "torque", "friction_per_width", "film_min", "pressure_max")
    stated = Stated(
        values=dict.fromkeys(names, 1.0),
        uncertainty=dict.fromkeys(names[:-1], 0.1),
        warned=False,
        cpu_s=0.0,
    )
    truth = Truth(values=dict.fromkeys(names, 1.05) | {"film_min": 1.5}, uncertainty=dict.fromkeys(names, 1e-3))
    found = {one.quantity: one for one in judged("arc", 1, SOLVE, stated, truth)}
    assert found.keys() == {"friction", "film_min"}
    assert found["friction"].kept
    assert found["friction"].decided
    assert not found["film_min"].kept
    rows = {one.quantity: one for one in study.by_quantity(list(found.values()))}
    assert (rows["all quantities"].judged, rows["all quantities"].kept) == (2, 1)
    assert rows["friction"].width == pytest.approx(2)


def test_unknown_kinds_are_refused():
    with pytest.raises(InputError, match=r"--kinds: got 'ball'; it must be among journal"):
        study.chosen("kinds", "ball", tuple(KINDS))


def test_the_page_has_the_counts_of_its_scenes_and_the_next_run_takes_them_from_their_files(tmp_path, monkeypatch):
    options = {"scenes": 1, "kinds": "pad", "cells": 32, "march_cells": 16}
    study.command(tmp_path, **options)
    stated = json.loads((tmp_path / "motion.json").read_text(encoding="utf-8"))
    tallies = {(one["kind"], one["command"]): one for one in stated["scenes"]}
    assert tallies.keys() == {("pad", SOLVE), ("pad", MARCH)}
    assert all(one["scenes"] == 1 for one in tallies.values())
    rows = {(row["model"], row["quantity"]): row for row in stated["coverage"]}
    assert rows["solve", "all quantities"]["judged"] >= 15
    assert rows["march", "all quantities"]["judged"] >= 8
    assert rows["dynamics", "stiffness"]["judged"] == 1
    assert (tmp_path / "motion.html").read_text(encoding="utf-8").count("<svg") == 1
    monkeypatch.setattr(study, "count_scene", lambda *_: pytest.fail("a kept scene is solved again"))
    study.command(tmp_path, **options)
