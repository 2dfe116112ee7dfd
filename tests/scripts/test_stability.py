"""The map of where models converge: what it tells of each run, and that finished runs are used again."""

import csv
import json

import numpy as np
import pytest
from typer.testing import CliRunner

from contact.errors import ConvergenceError, InputError, Outcome
from rom.ladder import find
from rom.setting import Setting
from scripts import stability, stability_pocket
from scripts.cli import app
from scripts.common import models
from scripts.runs import failure_of
from scripts.stability_map import Map, Spot, State, in_words, spot_of

NAVIER_STOKES = find(models(), "navier_stokes")


def run(*arguments):
    return CliRunner().invoke(app, ["stability", *map(str, arguments)])


@pytest.fixture
def small(monkeypatch, pocket_file):
    """A usual groove, and one so shallow that OpenFOAM at 30 columns needs its second try."""

    def family(names, reynolds_numbers=(2000.0,), depths_plus=(0.25, 1e-6)):
        chosen = tuple(model for model in models() if model.name in names)
        monkeypatch.setattr(stability_pocket, "models", lambda: chosen)
        made = stability_pocket.Family(scene=pocket_file, reynolds_numbers=reynolds_numbers, depths_plus=depths_plus)
        monkeypatch.setitem(stability.FAMILIES, "pocket", made)

    return family


@pytest.mark.parametrize(
    ("error", "state"),
    [
        (ConvergenceError("no word how"), State.FAILED),
        (ConvergenceError("it swings", outcome=Outcome.UNSTEADY, iterations=613), State.UNSTEADY),
        (ConvergenceError("nan", outcome=Outcome.DIVERGED), State.DIVERGED),
        (InputError("width: got 1; it must be 2"), State.REFUSED),
        (MemoryError(), State.FAILED),
    ],
)
def test_every_way_to_fail_has_a_state(error, state):
    spot = spot_of(160.0, 0.75, failure_of(error))
    assert (spot.reynolds_number, spot.depth_plus, spot.state) == (160.0, 0.75, state)
    assert spot.iterations == getattr(error, "iterations", None)


def test_every_outcome_of_a_solver_is_a_state():
    assert {outcome.value for outcome in Outcome} <= {state.value for state in State}


def spots(states, load=None):
    return tuple(
        Spot(reynolds_number=number, depth_plus=depth, state=state, load_plus=load)
        for (number, depth), state in states.items()
    )


def test_words_say_where_what_happened():
    first = Map(
        setting=Setting(model=NAVIER_STOKES, scheme="linear_upwind"),
        spots=spots(
            {
                (40.0, 1.0): State.CONVERGED,
                (40.0, 3.0): State.UNSTEADY,
                (160.0, 1.0): State.RESCUED,
                (160.0, 3.0): State.UNSTEADY,
            }
        ),
    )
    assert in_words(first, [first]) == [
        "Converges at 1 of 4 places.",
        "Rescued at 1: Re 160 at d+ 1.",
        "Unsteady at 2: d+ 3 at Re 40, 160.",
    ]


def test_words_compare_a_scheme_with_the_first_one():
    places = {(40.0, 1.0): State.CONVERGED, (160.0, 1.0): State.CONVERGED}
    first, second = (
        Map(setting=Setting(model=NAVIER_STOKES, scheme=scheme), spots=spots(places, load))
        for scheme, load in (("linear_upwind", 4.0), ("upwind", 5.0))
    )
    assert in_words(second, [first, second])[1:] == [
        "At half of them its load is 25 % or more from that of linear_upwind."
    ]


def test_the_scenes_of_a_family_are_where_they_say():
    family = stability.FAMILIES["pocket"]
    assert len(family.places) == len(set(family.places)) == 36
    scene = family.at(5000.0, 3.0)
    assert scene.reynolds_number == 5000.0
    along = np.linspace(-0.5e-3, 0.5e-3, 101)
    assert scene.gap().thickness(along).max() == pytest.approx(4 * 30e-6)


def test_a_map_is_a_page_a_table_and_json_and_is_not_made_twice(small, tmp_path):
    small({"reynolds", "inertial_reynolds"})
    result = run("pocket", "--out", tmp_path, "--jobs", 1, "--json")
    assert result.exit_code == 0, result.stderr
    told = json.loads(result.stdout)
    assert told == json.loads((tmp_path / "stability.json").read_text())
    assert told["provenance"]["machine"]["cores"]
    assert [(map_["model"], map_["counts"]["converged"]) for map_ in told["maps"]] == [
        ("reynolds", 2),
        ("inertial_reynolds", 2),
    ]
    with (tmp_path / "stability.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4
    assert {"model", "scheme", "reynolds_number", "depth_plus", "state", "iterations", "cpu_time (s)"} <= set(rows[0])
    page = (tmp_path / "report.html").read_text()
    assert "Converges at all of 2 places." in page
    assert "src=" not in page
    stamps = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").rglob("*.h5")}
    assert len(stamps) == 4
    assert run("pocket", "--out", tmp_path, "--jobs", 1).exit_code == 0
    assert {path: path.stat().st_mtime_ns for path in stamps} == stamps


@pytest.mark.openfoam
@pytest.mark.slow
def test_a_rescue_and_a_failure_are_told_from_what_simply_converges(small, tmp_path):
    small({"stokes", "navier_stokes"}, depths_plus=(0.25, 1e-6, 1e-9))
    assert run("pocket", "--out", tmp_path, "--resolution", 30).exit_code == 0
    told = {
        (map_["model"], map_["scheme"]): [(spot["depth_plus"], spot["state"]) for spot in map_["runs"]]
        for map_ in json.loads((tmp_path / "stability.json").read_text())["maps"]
    }
    assert told["navier_stokes", "linear_upwind"] == [(0.25, "converged"), (1e-6, "rescued"), (1e-9, "stalled")]
    assert told["stokes", ""] == [(0.25, "converged"), (1e-6, "converged"), (1e-9, "stalled")]
    runs = [spot for map_ in json.loads((tmp_path / "stability.json").read_text())["maps"] for spot in map_["runs"]]
    assert all(spot["iterations"] > 100 and spot["cpu_s"] > 0 for spot in runs)
    page = (tmp_path / "report.html").read_text()
    assert page.count('class="stalled"') == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["pockets"], "FAMILY: got 'pockets'; it must be one of pocket"),
        (["pocket", "--jobs", "0"], "--jobs: got 0; it must be 1 or more"),
    ],
)
def test_bad_input_is_one_line_and_code_2(tmp_path, arguments, words):
    result = run(*arguments, "--out", tmp_path)
    assert result.exit_code == 2
    assert words in result.stderr
    assert list(tmp_path.iterdir()) == []
