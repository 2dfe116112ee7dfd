"""The map of cavitating films: its judges tell right from wrong by themselves, and it is drawn and stored."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.ring import Sector
from roughfilm.rom.bearing.shapes import Parabolic
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import solve
from roughfilm.stability import cavitation as stability_cavitation
from roughfilm.stability.cavitation import methods, put, sizes, told
from roughfilm.stability.checks.cavitation import broken_balance
from roughfilm.stability.form import Outcome as Found
from roughfilm.stability.questions.cavitation import PLANE, probes
from roughfilm.stability.questions.films import REFUSED, Answer, Probe, bound, liquid, slider


def test_the_balance_of_a_film_is_told_and_a_wrong_one_is_found():
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
def test_the_balance_in_the_plane_is_told(theta):
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


def test_the_balance_of_a_sector_is_told():
    sector = Sector(
        shape="sector", inner_radius="30 mm", outer_radius="60 mm", angle="45 deg", film="20 um", rise="20 um"
    )
    ends = Ends(inlet=1e5, outlet=1e5, sides=(1e5, 1e5))
    problem = Problem(shape=sector.film_shape(), ends=ends, speed=100.0, viscosity=0.03)
    found = solve(problem, (20, 12))
    assert broken_balance(found) < 1e-8
    turned = replace(problem, shape=replace(problem.shape, polar=False))
    assert broken_balance(replace(found, problem=turned)) > 1e-3


def probe(ask, **given):
    return Probe(**{"group": "g", "row": "r", "column": "c", "ask": ask, "bound": 1e-3, **given})


def test_every_way_to_go_wrong_is_told():
    def raises(error):
        def ask():
            raise error

        return ask

    stalled = ConvergenceError("cavitation: stalled", outcome=Outcome.STALLED, iterations=7)
    assert put(probe(lambda: Answer(iterations=3, error=1e-4))).outcome is Found.CONVERGED
    assert put(probe(lambda: Answer(iterations=101, error=1e-4))).outcome is Found.SLOW
    assert put(probe(lambda: Answer(iterations=3, error=2e-3))).outcome is Found.WRONG
    assert put(probe(lambda: Answer(iterations=3, error=np.nan))).outcome is Found.WRONG
    assert put(probe(lambda: Answer(iterations=3, error=0.0), expected=REFUSED)).outcome is Found.WRONG
    found = put(probe(raises(stalled)))
    assert (found.outcome, found.iterations) == (Found.STALLED, 7)
    assert "Stalled: g: r, c (7 iterations): cavitation: stalled" in told([found])
    assert put(probe(raises(stalled), expected=REFUSED)).outcome is Found.REFUSED
    assert put(probe(raises(InputError("x: got y")))).outcome is Found.WRONG
    broken = put(probe(raises(ZeroDivisionError("oh")), expected=REFUSED))
    assert (broken.outcome, broken.message) == (Found.WRONG, "ZeroDivisionError: oh")


def test_sizes_go_by_decades():
    assert sizes(100) == [100]
    assert sizes(999) == [100]
    assert sizes(100_000) == [100, 1000, 10_000, 100_000]
    assert bound(1000) == pytest.approx(1.01e-4)


def test_the_default_and_the_schur_complement_converge_all_over_a_small_map(monkeypatch):
    monkeypatch.setattr(stability_cavitation, "THETAS", (0.2, 0.55, 1.0))
    monkeypatch.setattr(stability_cavitation, "MODULI", (0.05, 1.0, 100.0))
    asked = list(methods(100))
    assert len(asked) == 3 * 9
    spots = [put(one) for one in asked]
    assert {spot.outcome for spot in spots if spot.group != "switch"} == {Found.CONVERGED}
    assert max(spot.iterations for spot in spots if spot.group != "switch") <= 20


def test_the_probes_are_different_and_hold_what_they_should():
    asked = list(probes(PLANE))
    places = {(one.group, one.row, one.column) for one in asked}
    assert len(places) == len(asked)
    assert {one.expected for one in asked if one.group == "Barus"} == {"solved", REFUSED}
    assert {one.group for one in asked} >= {"reversed sliding", "at rest", "wrong starts", "in the plane"}


@pytest.mark.parametrize("group", ["reversed sliding", "at rest", "very starved", "many cavities"])
def test_the_default_solver_answers(group):
    outcomes = {put(one).outcome for one in probes() if one.group == group}
    assert outcomes <= {Found.CONVERGED, Found.SLOW}


def test_the_map_is_a_page_a_table_and_json(tmp_path, monkeypatch):
    some = [one for one in probes() if one.group in ("at rest", "Barus")]
    monkeypatch.setattr(stability_cavitation, "probes", lambda: iter(some))
    monkeypatch.setattr(stability_cavitation, "THETAS", (0.2, 0.55, 1.0))
    monkeypatch.setattr(stability_cavitation, "MODULI", (0.05, 100.0))
    result = CliRunner().invoke(
        app, ["stability", "cavitation", "--out", str(tmp_path), "--resolution", "100", "--json"]
    )
    assert result.exit_code == 0, result.stderr
    entries = json.loads(result.stdout)
    assert entries == json.loads((tmp_path / "stability.json").read_text())
    assert sum(entries["counts"].values()) == 3 * 6 + len(some)
    with (tmp_path / "stability.csv").open() as file:
        assert len(list(csv.DictReader(file))) == len(entries["runs"])
    page = (tmp_path / "report.html").read_text()
    assert "The switch algorithm of the thesis" in page
    assert "α p0 = 2" in page
    assert "src=" not in page


def test_too_few_nodes_are_refused(tmp_path):
    result = CliRunner().invoke(app, ["stability", "cavitation", "--out", str(tmp_path), "--resolution", "8"])
    assert result.exit_code == 2
    assert "--resolution: got 8; the slider takes 100 to 100000 nodes" in result.stderr
