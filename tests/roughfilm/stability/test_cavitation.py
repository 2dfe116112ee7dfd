"""The map of the cavitation solvers: its judges separate right from wrong, and the default solver is right."""

from dataclasses import replace

import numpy as np
import pytest

from roughfilm.rom.bearing.geometry.ring import Sector
from roughfilm.rom.bearing.geometry.shapes import Parabolic
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import solve
from roughfilm.stability import cavitation as stability_cavitation
from roughfilm.stability.cavitation import methods
from roughfilm.stability.checks.cavitation import broken_balance
from roughfilm.stability.form import MapOutcome
from roughfilm.stability.questions.cavitation import PLANE, probes
from roughfilm.stability.questions.films import film_probe, liquid, slider


def test_a_film_is_balanced_and_a_changed_one_is_not():
    found = solve(slider(0.55, liquid(0.07)), (200, 1))
    assert broken_balance(found) < 1e-8
    state = found.state
    middle = int(np.argmax(state.pressure))
    bent = state.pressure.copy()
    bent[middle] *= 1.001
    assert broken_balance(replace(found, state=replace(state, pressure=bent))) > 1e-4
    emptied = state.fill.copy()
    emptied[5] -= 0.01
    assert broken_balance(replace(found, state=replace(state, fill=emptied))) > 1e-3
    for change in ({"pressure": -bent}, {"fill": 2 * emptied}, {"pressure": np.where(bent == 0, np.nan, bent)}):
        assert broken_balance(replace(found, state=replace(state, **change))) == np.inf
    assert broken_balance(replace(found, problem=replace(found.problem, speed=4.5))) > 1e-3
    assert broken_balance(replace(found, problem=replace(found.problem, ends=Ends(theta=0.56)))) > 1e-3


@pytest.mark.parametrize("theta", [0.6, 1.0])
def test_a_film_of_finite_width_is_balanced_and_a_changed_one_is_not(theta):
    shape = Parabolic(shape="parabolic", length="76 mm", width="50 mm", film="25 um", rise="25 um").film_shape()
    problem = Problem(
        shape=shape,
        ends=Ends(theta=theta, sides=(0.0, 1e5)),
        speed=3.0,
        viscosity=0.02,
        compressibility=liquid(0.1),
    )
    found = solve(problem, (24, 16))
    assert broken_balance(found) < 1e-8
    assert broken_balance(replace(found, problem=replace(problem, viscosity=0.0201))) > 1e-4
    bent = found.state.pressure.copy()
    bent[12, 8] *= 1.01
    assert broken_balance(replace(found, state=replace(found.state, pressure=bent))) > 1e-4


def test_a_sector_is_balanced_and_a_plane_film_of_its_pressure_is_not():
    sector = Sector(
        shape="sector", inner_radius="30 mm", outer_radius="60 mm", angle="45 deg", film="20 um", rise="20 um"
    )
    ends = Ends(inlet=1e5, outlet=1e5, sides=(1e5, 1e5))
    problem = Problem(shape=sector.film_shape(), ends=ends, speed=100.0, viscosity=0.03)
    found = solve(problem, (20, 12))
    assert broken_balance(found) < 1e-8
    turned = replace(problem, shape=replace(problem.shape, polar=False))
    assert broken_balance(replace(found, problem=turned)) > 1e-3


@pytest.mark.parametrize(("error", "right"), [(1e-4, True), (2e-3, False), (np.nan, False)])
def test_an_answer_is_right_up_to_its_bound(error, right):
    found = film_probe("g", "r", "c", lambda: (3, error), 1e-3).spot()
    assert (found.outcome is MapOutcome.CONVERGED) is right


def test_the_default_and_the_schur_complement_converge_all_over_a_small_map(monkeypatch):
    monkeypatch.setattr(stability_cavitation, "THETAS", (0.2, 0.55, 1.0))
    monkeypatch.setattr(stability_cavitation, "MODULI", (0.05, 1.0, 100.0))
    asked = list(methods(100))
    assert len(asked) == 3 * 9
    spots = [one.spot() for one in asked]
    assert {spot.outcome for spot in spots if spot.group != "switch"} == {MapOutcome.CONVERGED}
    assert max(spot.iterations for spot in spots if spot.group != "switch") <= 20


def test_the_probes_are_different_and_hold_what_they_should():
    asked = list(probes(PLANE))
    places = {(one.group, one.row, one.column) for one in asked}
    assert len(places) == len(asked)
    assert {one.refused for one in asked if one.group == "Barus"} == {False, True}
    assert {one.group for one in asked} >= {"reversed sliding", "at rest", "wrong starts", "in the plane"}


@pytest.mark.parametrize("group", ["reversed sliding", "at rest", "very starved", "many cavities"])
def test_the_default_solver_answers(group):
    outcomes = {one.spot().outcome for one in probes() if one.group == group}
    assert outcomes <= {MapOutcome.CONVERGED, MapOutcome.SLOW}


def test_films_at_rest_and_stiffening_liquids_are_solved_where_a_solution_exists():
    spots = [one.spot() for one in probes() if one.group in ("at rest", "Barus")]
    assert {spot.outcome for spot in spots} == {MapOutcome.CONVERGED, MapOutcome.REFUSED}
