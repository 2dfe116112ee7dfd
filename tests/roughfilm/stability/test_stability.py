"""The map of where models converge: what it states of each run, and that finished runs are used again."""

import csv
import json
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.batch.jobs import failure_of
from roughfilm.cli.main import app
from roughfilm.cli.upkeep import stability
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome, UnavailableError
from roughfilm.ladder import find, models
from roughfilm.pages.render import TEMPLATES
from roughfilm.rom.ladder.setting import Setting
from roughfilm.stability import laws as stability_laws
from roughfilm.stability import pocket as stability_pocket
from roughfilm.stability.form import MEANING, SECOND_TRY, Judgement, MapOutcome, Probe, Spot, StabilityMap
from roughfilm.stability.pocket import POCKET, Places, scene_at, spot_of, summary

NAVIER_STOKES = find("pocket", "navier_stokes")
SETTING = Setting(model=NAVIER_STOKES, scheme="linear_upwind")
PLACE = {"group": "g", "row": "r", "column": "c"}


def run(*arguments):
    return CliRunner().invoke(app, ["stability", *map(str, arguments)])


@pytest.fixture
def small(monkeypatch):
    """A usual groove, and one so shallow that OpenFOAM at 30 columns needs its second try."""

    def family(names, reynolds_numbers=(2000.0,), depths_plus=(0.25, 1e-6)):
        chosen = tuple(model for model in models("pocket") if model.name in names)
        monkeypatch.setattr(stability_pocket, "models", lambda _: chosen)
        places = Places(reynolds_numbers=reynolds_numbers, depths_plus=depths_plus)
        monkeypatch.setitem(stability.FAMILIES, "pocket", replace(POCKET, solve=places.solve))

    return family


@pytest.mark.parametrize(
    ("error", "outcome", "why"),
    [
        (ConvergenceError("no word how"), "stalled", "failed"),
        (ConvergenceError("it swings", outcome=Outcome.UNSTEADY, iterations=613), "stalled", "unsteady"),
        (ConvergenceError("it stands", outcome=Outcome.STALLED), "stalled", ""),
        (ConvergenceError("nan", outcome=Outcome.DIVERGED), "stalled", "diverged"),
        (ConvergenceError("OpenFOAM: the mesh check found faults; change it"), "stalled", "no mesh"),
        (UnavailableError("no OpenFOAM"), "stalled", ""),
        (InputError("width: got 1; it must be 2"), "refused", ""),
        (MemoryError(), "wrong", "fault"),
    ],
)
def test_every_way_to_fail_has_an_outcome(error, outcome, why):
    spot = spot_of(SETTING, 160.0, 0.75, failure_of(error))
    assert (spot.row, spot.column, spot.outcome, spot.why) == ("d+ 0.75", "Re 160", outcome, why)
    assert spot.iterations == getattr(error, "iterations", None)


def judge(right, iterations=3):
    return lambda _answer: Judgement(iterations=iterations, right=right, error=1e-3, message="" if right else "off")


def raises(error):
    def ask():
        raise error

    return ask


@pytest.mark.parametrize(
    ("ask", "judged", "refused", "outcome"),
    [
        (lambda: 1, judge(True), False, "converged"),
        (lambda: 1, judge(True, 101), False, "slow"),
        (lambda: 1, judge(False), False, "wrong"),
        (lambda: 1, judge(True), True, "wrong"),
        (raises(InputError("x: got y")), judge(True), True, "refused"),
        (raises(InputError("x: got y")), judge(True), False, "wrong"),
        (raises(InputError("x:\n got y")), judge(True), True, "wrong"),
        (raises(ConvergenceError("gave up")), judge(True), False, "stalled"),
        (raises(ZeroDivisionError("oh")), judge(True), True, "wrong"),
    ],
)
def test_questions_come_to_what_they_must(ask, judged, refused, outcome):
    assert Probe(**PLACE, ask=ask, judge=judged, refused=refused).spot().outcome == outcome


def test_every_outcome_has_a_meaning_and_a_colour():
    assert set(MEANING) == set(MapOutcome)
    css = (TEMPLATES / "map.css").read_text()
    assert all(f".{outcome} {{" in css for outcome in MapOutcome)


def places(states, loads=None):
    spots = []
    for number, (reynolds_number, depth) in enumerate(states):
        outcome, _, why = states[reynolds_number, depth].partition(": ")
        spots.append(
            Spot(
                group="a model",
                row=f"d+ {depth:g}",
                column=f"Re {reynolds_number:g}",
                outcome=MapOutcome(outcome),
                why=why,
                numbers={"load": loads[number] if loads else None},
            )
        )
    return spots


def test_words_say_where_what_happened():
    own = places(
        {
            (40.0, 1.0): "converged",
            (40.0, 3.0): "stalled: unsteady",
            (160.0, 1.0): f"slow: {SECOND_TRY}",
            (160.0, 3.0): "stalled: unsteady",
        }
    )
    assert summary(own) == [
        "a model: converges at 1 of 4 places.",
        "a model: unsteady at 2: d+ 3 at Re 40, 160.",
        f"a model: {SECOND_TRY} at 1: Re 160 at d+ 1.",
    ]


def test_words_compare_a_scheme_with_the_first_one():
    where = {(40.0, 1.0): "converged", (160.0, 1.0): "converged"}
    first = [replace(spot, group="film, linear_upwind") for spot in places(where, [4.0, 4.0])]
    second = [replace(spot, group="film, upwind") for spot in places(where, [5.0, 5.0])]
    assert summary([*first, *second])[2:] == [
        "film, upwind: at half of them its load is 25 % or more from that of linear_upwind."
    ]


def test_the_scenes_of_a_family_are_where_they_say():
    scene = scene_at(5000.0, 3.0)
    assert scene.reynolds_number == pytest.approx(5000.0)
    along = np.linspace(-0.5e-3, 0.5e-3, 101)
    assert scene.gap().thickness(along).max() == pytest.approx(4 * 30e-6)


def test_a_film_solved_on_several_grids_converged_at_the_first_try():
    cavitating = find("pocket", "reynolds_cavitating")
    spot = spot_of(Setting(model=cavitating), 1000.0, 0.75, cavitating.solve(scene_at(1000.0, 0.75)))
    assert (spot.outcome, spot.why) == (MapOutcome.CONVERGED, "")


def test_a_map_is_a_page_a_table_and_json_and_is_not_made_twice(small, tmp_path):
    small({"reynolds", "inertial_reynolds"})
    result = run("pocket", "--out", tmp_path, "--jobs", 1, "--json")
    assert result.exit_code == 0, result.stderr
    report = json.loads(result.stdout)
    assert report == json.loads((tmp_path / "stability.json").read_text())
    assert report["provenance"]["machine"]["cores"]
    assert report["counts"] == dict.fromkeys(MapOutcome, 0) | {"converged": 4}
    with (tmp_path / "stability.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4
    assert {"family", "group", "row", "column", "outcome", "why", "depth_plus", "cpu_time (s)"} <= set(rows[0])
    page = (tmp_path / "report.html").read_text()
    assert "converges at all of 2 places." in page
    assert "src=" not in page
    stamps = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.h5")}
    assert len(stamps) == 4
    assert run("pocket", "--out", tmp_path, "--jobs", 1).exit_code == 0
    assert {path: path.stat().st_mtime_ns for path in stamps} == stamps


class Counted:
    """A map of one probe that counts how often it is made, and is stopped the first time if ``stops``."""

    def __init__(self, name, outcome="converged", stops=False):
        self.name, self.outcome, self.stops, self.asked = name, outcome, stops, 0
        self.map = StabilityMap(
            name=name,
            title=f"The map of {name}",
            axes="One question.",
            judge="Nobody.",
            resolution=7,
            resolution_meaning="nothing",
            solve=self.solve,
            summary=lambda _spots: [f"summary of {name}"],
            draw=lambda _spots: {"drawn": "<svg></svg>"} if name == "one" else {},
        )

    def solve(self, *_):
        self.asked += 1
        if self.stops:
            self.stops = False
            raise KeyboardInterrupt
        message = "what went wrong" * (self.outcome == "wrong")
        return [Spot(**PLACE, outcome=MapOutcome(self.outcome), message=message)], {}


def test_all_maps_stand_in_one_place_and_a_run_that_was_stopped_goes_on(monkeypatch, tmp_path):
    one, two, three = Counted("one"), Counted("two", "wrong"), Counted("three", stops=True)
    monkeypatch.setattr(stability, "FAMILIES", {each.name: each.map for each in (one, two, three)})
    assert run("all", "--out", tmp_path).exit_code != 0
    assert (one.asked, two.asked, three.asked) == (1, 1, 1)
    assert not (tmp_path / "report.html").exists()
    result = run("all", "--out", tmp_path, "--json")
    assert result.exit_code == 0, result.stderr
    assert (one.asked, two.asked, three.asked) == (1, 1, 2)
    report = json.loads(result.stdout)
    assert report == json.loads((tmp_path / "stability.json").read_text())
    assert [(each["family"], each["counts"]["wrong"]) for each in report["maps"]] == [
        ("one", 0),
        ("two", 1),
        ("three", 0),
    ]
    page = (tmp_path / "report.html").read_text()
    assert all(words in page for words in ("The map of three", "summary of two", "what went wrong", "<svg></svg>"))
    with (tmp_path / "stability.csv").open() as file:
        assert [row["family"] for row in csv.DictReader(file)] == ["one", "two", "three"]
    monkeypatch.setattr(stability, "code", lambda: "another")
    assert run("all", "--out", tmp_path).exit_code == 0
    assert (one.asked, two.asked, three.asked) == (2, 2, 3)


def test_maps_by_laws_alone_are_drawn_and_what_breaks_a_law_is_wrong(monkeypatch, tmp_path):
    monkeypatch.setattr(stability_laws, "LOADS", (0.01, 0.1, 0.6))
    result = run("seal", "--out", tmp_path, "--resolution", 32, "--json")
    assert result.exit_code == 0, result.stderr
    report = json.loads(result.stdout)
    counts = report["counts"]
    assert (counts["wrong"], counts["stalled"], counts["refused"]) == (0, 0, 12)
    inaccurate = {(run["row"], run["column"]) for run in report["runs"] if run["outcome"] == "inaccurate"}
    assert {row for row, _ in inaccurate} == {"effective_medium"}
    assert ("effective_medium", "P = 0.1 E* g'") in inaccurate
    answer = next(probe for probe in stability_laws.seals(32) if probe.row == "direct_leakage").ask()
    judge = partial(stability_laws.judged, "permeability")
    assert judge([], answer).right
    value = answer[1]["permeability"]
    less = replace(value, value=value.value / 2, uncertainty=None)
    grown = judge([replace(answer[1], quantities={**answer[1].quantities, "permeability": less})], answer)
    assert (grown.right, "permeability grows from" in grown.message) == (False, True)
    monkeypatch.setattr(stability_laws, "broken", lambda *_: ["a law is broken"])
    assert judge([], answer).message == "a law is broken"


def test_an_estimate_far_from_the_flow_through_the_gap_is_wrong_unless_it_says_so():
    """At 0.01 E* g' the effective medium is in its range."""
    probe = next(p for p in stability_laws.seals(64) if (p.row, p.column) == ("effective_medium", "P = 0.01 E* g'"))
    scene, result = probe.ask()
    assert probe.judge((scene, result)).right
    small = replace(result["permeability"], value=result["permeability"].value / 1e3, uncertainty=None)
    wrong = replace(result, quantities={**result.quantities, "permeability": small})
    judge = partial(stability_laws.judged_estimate, "permeability", [])
    assert (judge((scene, wrong)).right, judge((scene, wrong)).reported) == (False, False)
    warned = replace(wrong, warnings=("out of its range: the load",))
    assert (judge((scene, warned)).right, judge((scene, warned)).reported) == (False, True)


def test_mixed_films_near_and_far_keep_the_laws(monkeypatch):
    monkeypatch.setattr(stability_laws, "SEPARATIONS", (5.0, 1.0, 0.0))
    monkeypatch.setattr(stability_laws, "SPEEDS", (0.0, 0.1))
    asked = [probe for probe in stability_laws.films(32) if "Hurst" in probe.group]
    outcomes = [probe.spot().outcome for probe in asked]
    assert outcomes == ["converged", "converged", "refused"] * 6


@pytest.mark.openfoam
@pytest.mark.slow
def test_a_second_try_and_a_failure_are_stated_from_what_simply_converges(small, tmp_path):
    small({"stokes", "navier_stokes"}, depths_plus=(1e-9, 1e-6, 0.25))
    assert run("pocket", "--out", tmp_path, "--resolution", 30).exit_code == 0
    runs = json.loads((tmp_path / "stability.json").read_text())["runs"]
    report = {
        group: [(one["outcome"], one["why"]) for one in runs if one["group"] == group]
        for group in ("navier_stokes, linear_upwind", "stokes")
    }
    assert report["navier_stokes, linear_upwind"] == [("converged", ""), ("slow", SECOND_TRY), ("stalled", "")]
    assert report["stokes"] == [("converged", ""), ("converged", ""), ("stalled", "")]
    assert all(one["iterations"] > 50 and one["cpu_s"] > 0 for one in runs)
    assert (tmp_path / "report.html").read_text().count('td class="stalled"') == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["pockets"], "FAMILY: got 'pockets'; it must be one of pocket"),
        (["pocket", "--jobs", "0"], "--jobs: got 0; it must be 1 or more"),
        (["all", "--resolution", "30"], "--resolution: got 30 for all; every map counts it in its own way"),
        (["seal", "--resolution", "8"], "--resolution: got 8; the surfaces take 32 to 256 points along a side"),
        (["contact", "--resolution", "8"], "--resolution: got 8; the surfaces need at least 32 points"),
        (["cell", "--resolution", "8"], "--resolution: got 8; the cells take 64 to 512 nodes along a side"),
        (["cavitation", "--resolution", "8"], "--resolution: got 8; the slider takes 100 to 100000 nodes"),
        (["windows", "--resolution", "8"], "--resolution: got 8; the windows take 32 to 128 points along a side"),
        (["rough_gap", "--resolution", "16"], "--resolution: got 16; it must be even, 32 to 64"),
        (["rough_gap", "--resolution", "33"], "--resolution: got 33; it must be even, 32 to 64"),
        (["rough_gap", "--resolution", "256"], "--resolution: got 256; it must be even, 32 to 64"),
    ],
)
def test_bad_input_is_one_line_and_code_2(tmp_path, arguments, words):
    result = run(*arguments, "--out", tmp_path)
    assert result.exit_code == 2
    assert words in result.stderr
    assert [path for path in tmp_path.iterdir() if path.name != ".lock"] == []
