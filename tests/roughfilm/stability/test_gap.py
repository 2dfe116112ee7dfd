"""The map of rough gaps: its judge finds wrong answers by itself, and it is drawn, stored and used again."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from batches import Threads
from typer.testing import CliRunner

from roughfilm.batch import answers as stability_runs
from roughfilm.batch.jobs import failure_of
from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.result import SolverRun
from roughfilm.rom.ladder.setting import Setting
from roughfilm.stability import gap as stability_gap
from roughfilm.stability.checks.gap import JUDGED, Coefficients, agreeing, exact_stokes, exact_thin, extrapolated
from roughfilm.stability.form import SECOND_TRY, MapOutcome
from roughfilm.stability.gap import (
    CUT_OUT,
    NOT_REPORTED,
    REPORTED,
    SLOPE_LEFT_OUT,
    TOO_SMALL,
    UNJUDGED,
    judged,
    spot_of,
    summary,
)
from roughfilm.stability.questions.gap import CUT, CUTS, DISTANCES, INERTIA, NEAR, gap_runs, wave_scene
from roughfilm.stability.wave import Wave

LADDER = models("rough_gap")
TWO_RUNS = (
    SolverRun(name="along", outcome="stalled", iterations=900),
    SolverRun(name="along", iterations=400, recipe="started by upwind"),
)
CHEAP = [find("rough_gap", name) for name in ("homogenized", "slope_corrected")]


@pytest.fixture(scope="module")
def every():
    return list(gap_runs(LADDER, 32))


@pytest.fixture(scope="module")
def asked(every):
    """A thin film over ridges, and what solves it."""
    probe = next(one for one in every if one.group == f"{NEAR}: ridges" and one.setting.model is CHEAP[0])
    return probe, probe.setting.solve(probe.scene)


def other(result, *, part=1.0, name="A22", runs=(), iterations=None):
    """The same answer with another coefficient, without error bars, or by other means."""
    changed = replace(result[name], value=part * result[name].value)
    numerics = result.numerics if iterations is None else replace(result.numerics, iterations=iterations)
    return replace(result, quantities={**result.quantities, name: changed}, numerics=replace(numerics, runs=runs))


def without_bars(result):
    bare = {name: replace(one, uncertainty=None) for name, one in result.quantities.items()}
    return replace(result, quantities=bare, warnings=())


@pytest.mark.parametrize("amplitude", [0.3, 0.9])
def test_thin_films_over_ridges_are_those_of_means(amplitude):
    h = 1 + amplitude * np.cos(2 * np.pi * np.arange(400) / 400)
    second, third = np.mean(h**-2.0), np.mean(h**-3.0)
    means = (1 / third, np.mean(h**3), second / third, 4 * np.mean(1 / h) - 3 * second**2 / third)
    found = exact_thin(Wave(amplitude=amplitude, wavelength=5.0))
    assert tuple(found.values.values()) == pytest.approx(means, rel=1e-9)


def test_stokes_flow_over_long_ridges_is_that_of_thin_films_and_steep_ones_are_out_of_reach():
    wave = Wave(amplitude=0.3, wavelength=300.0)
    thin, stokes = exact_thin(wave).values, exact_stokes(wave).values
    assert stokes == pytest.approx(thin, rel=wave.slope**2)
    assert exact_stokes(Wave(amplitude=0.8, wavelength=1.0)) is None
    assert exact_stokes(Wave(amplitude=0.999, wavelength=10.0)) is None
    assert exact_stokes(replace(wave, bumps=True)) is None


def test_two_meshes_of_second_order_state_the_limit(asked):
    result = asked[1]
    right = {name: result.quantities[name].value for name in JUDGED}
    coarse, fine = result, result
    for name in right:
        coarse, fine = other(coarse, part=1.04, name=name), other(fine, part=1.01, name=name)
    found = extrapolated(coarse, fine)
    assert found.values == pytest.approx(right)
    assert found.uncertainties == pytest.approx({name: 0.03 * abs(value) for name, value in right.items()})


def test_the_judge_states_right_from_wrong(asked):
    probe, result = asked
    right = exact_thin(probe.wave)
    assert spot_of(probe, result, right, right).outcome is MapOutcome.CONVERGED
    wrong = spot_of(probe, other(result, part=1.01), right, right)
    assert (wrong.outcome, wrong.why) == (MapOutcome.WRONG, TOO_SMALL)
    assert wrong.error == pytest.approx(0.01, rel=1e-3)
    assert "A22: error" in wrong.message
    bare = without_bars(result)
    assert spot_of(probe, other(bare, part=1.01), right).outcome is MapOutcome.CONVERGED
    far = spot_of(probe, replace(other(bare, part=0.94), warnings=result.warnings), right)
    assert (far.outcome, far.why) == (MapOutcome.INACCURATE, SLOPE_LEFT_OUT)
    unsaid = spot_of(probe, other(bare, part=0.94), right)
    assert (unsaid.outcome, unsaid.why) == (MapOutcome.WRONG, NOT_REPORTED)
    resolved = replace(probe, setting=Setting(model=find("rough_gap", "stokes"), resolution=32))
    silent = spot_of(resolved, replace(other(bare, part=0.94), model="stokes"), right)
    assert (silent.outcome, silent.why) == (MapOutcome.WRONG, NOT_REPORTED)
    warned = replace(bare, model="stokes", warnings=("coarse",))
    report = spot_of(resolved, other(warned, part=0.94), right)
    assert (report.outcome, report.why) == (MapOutcome.INACCURATE, REPORTED)
    again = spot_of(probe, other(bare, runs=TWO_RUNS), right)
    assert (again.outcome, again.why) == (MapOutcome.SLOW, SECOND_TRY)
    assert spot_of(probe, other(bare, iterations=101), right).outcome is MapOutcome.SLOW
    alone = spot_of(probe, bare, None)
    assert (alone.outcome, alone.why, alone.error) == (MapOutcome.CONVERGED, UNJUDGED, None)


@pytest.mark.parametrize(("name", "part"), [("A11", 1.06), ("A22", 1.06), ("friction", 0.94)])
def test_what_no_flow_can_do_is_stated_of_all_but_thin_films(asked, name, part):
    probe, result = asked
    bare, thin = without_bars(result), exact_thin(probe.wave)
    resolved = replace(probe, setting=Setting(model=find("rough_gap", "stokes"), resolution=32))
    impossible = spot_of(resolved, other(bare, part=part, name=name), None, thin)
    assert (impossible.outcome, impossible.why) == (MapOutcome.WRONG, NOT_REPORTED)
    assert f"than is possible: {name} is" in impossible.message
    assert spot_of(resolved, other(bare, part=2 - part, name=name), None, thin).why == UNJUDGED
    assert spot_of(probe, other(bare, part=part, name=name), None, thin).why == UNJUDGED


def test_bars_of_thin_films_are_about_thin_films_and_their_error_about_all(asked):
    probe, result = asked
    thin = exact_thin(probe.wave)
    steep = Coefficients(
        values={**thin.values, "A11": thin.values["A11"] / 1.1}, uncertainties=thin.uncertainties, source="somewhere"
    )
    found = spot_of(probe, result, steep, thin)
    assert (found.outcome, found.why, found.message) == (
        MapOutcome.INACCURATE,
        SLOPE_LEFT_OUT,
        "A11 judged by somewhere",
    )
    assert found.error == pytest.approx(0.1, rel=1e-2)
    assert spot_of(probe, other(result, part=1.01), steep, thin).outcome is MapOutcome.WRONG


def test_two_meshes_that_disagree_judge_no_cheap_rung():
    truth = Coefficients(
        values={"A11": 0.5, "friction": 2.0}, uncertainties={"A11": 0.04, "friction": 0.3}, source="two meshes"
    )
    assert agreeing(truth).values == {"A11": 0.5}
    assert agreeing(replace(truth, uncertainties={"A11": 0.06, "friction": 0.3})) is None
    assert agreeing(None) is None


def test_a_run_without_an_answer_has_no_numbers_and_is_stated(asked):
    failure = failure_of(ConvergenceError("it swings", outcome=Outcome.UNSTEADY, iterations=613))
    spot = spot_of(asked[0], failure, exact_thin(asked[0].wave))
    assert (spot.outcome, spot.why, spot.numbers["A11"]) == (MapOutcome.STALLED, "unsteady", None)
    assert f"unsteady at {spot.row} with {spot.column}." in summary([spot])[0]


def test_the_probes_are_what_their_places_say(every):
    assert len({(one.group, one.row, one.column) for one in every}) == len(every)
    scenes = {}
    for one in every:
        assert scenes.setdefault(one.place, one.scene) == one.scene
    for nearest in (DISTANCES[0], DISTANCES[-1]):
        for bumps in (False, True):
            wave = Wave(amplitude=1 - nearest, wavelength=10.0, bumps=bumps)
            walls = wave_scene(wave).walls(64)
            assert walls.gap.min() / walls.mean_gap == pytest.approx(nearest)
    steep = wave_scene(Wave(amplitude=0.5, wavelength=2.5, bumps=True))
    assert steep.rms_slope == pytest.approx(Wave(amplitude=0.5, wavelength=2.5).slope)
    for group in {one.group for one in every if one.group.startswith(f"{CUT}:")}:
        pressed = {one.column: one.scene for one in every if one.group == group}
        closed = [np.mean(pressed[f"{cut:g}"].walls(64).gap == 0) for cut in CUTS]
        assert sorted(closed, reverse=True) == closed
        assert closed[0] > closed[-1] > 0


def test_two_meshes_judge_inertia_and_the_smallest_cut_the_pressed(every, asked):
    result = without_bars(asked[1])
    some = [one for one in every if one.group.startswith(INERTIA) and one.column == "Re = 1"]
    some += [one for one in every if one.group.startswith(f"{CUT}:") and one.row == "homogenized"]
    found = [(one, other(result, part=1.1 if one.column == f"{CUTS[0]:g}" else 1.0)) for one in some]
    with Threads(1) as executor:
        spots = judged(found, executor)
    assert {spot.message.split(" (")[0].split()[-1] for spot in spots} == {"meshes", f"{CUTS[-1]:g}"}
    pressed = [spot for spot in spots if spot.group.startswith(CUT)]
    assert {spot.column for spot in pressed if spot.why == CUT_OUT} == {f"{CUTS[0]:g}"}
    assert [spot.error for spot in pressed if spot.why == CUT_OUT] == pytest.approx([0.1] * 3)


def test_the_map_is_a_page_a_table_and_json_and_is_used_again(tmp_path, monkeypatch):
    def few(given, columns):
        every = gap_runs([model for model in given if model in CHEAP], columns)
        ridges = (one for one in every if one.wave is None or not one.wave.bumps)
        return (one for one in ridges if one.column in ("0.5", f"{CUTS[-1]:g}"))

    for module in (stability_gap, stability_runs):
        monkeypatch.setattr(module, "local", lambda *_: Threads(1))
    monkeypatch.setattr(stability_gap, "gap_runs", few)
    result = CliRunner().invoke(app, ["stability", "rough_gap", "--out", str(tmp_path), "--jobs", "1", "--json"])
    assert result.exit_code == 0, result.stderr
    entries = json.loads(result.stdout)
    assert entries == json.loads((tmp_path / "stability.json").read_text())
    assert not [one for one in entries["runs"] if one["why"] == "fault"]
    assert sum(entries["counts"].values()) == len(entries["runs"])
    with (tmp_path / "stability.csv").open() as file:
        assert len(list(csv.DictReader(file))) == len(entries["runs"])
    page = (tmp_path / "report.html").read_text()
    assert "<svg" in page
    assert "src=" not in page
    runs = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.h5")}
    assert runs
    again = CliRunner().invoke(app, ["stability", "rough_gap", "--out", str(tmp_path), "--jobs", "1", "--json"])
    assert json.loads(again.stdout)["runs"] == entries["runs"]
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.h5")} == runs
