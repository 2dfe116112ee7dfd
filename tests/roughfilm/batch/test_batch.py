"""Batches: what they leave behind, and that they survive being killed in every way."""

import csv
import json
import os
import random
import shutil
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import h5py
import numpy as np
import pytest
from batches import Batch, attempts, called, results, same_later, wait_for, write_study
from forging import forge
from places import SCENES, STUDIES

from roughfilm.batch import execute
from roughfilm.batch.plan import read_batch
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.writing.scratch import sweep
from roughfilm.rom.ladder.model import always
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.table import read_table

POCKET = STUDIES / "pocket.toml"


@pytest.fixture(scope="module")
def pockets(tmp_path_factory):
    """The directory of a finished batch of 12 pockets by two models."""
    place = tmp_path_factory.mktemp("pockets")
    code, output, error = Batch(POCKET, place / "out", place, "--json").end()
    assert code == 0, error
    assert json.loads(output)["cases"] == 12
    return place / "out"


def test_a_table_of_all_cases_by_all_models(pockets):
    table = read_table(pockets / "table.h5")
    assert {len(column) for column in table.values()} == {24}
    assert set(table["outcome"]) == {"solved"}
    assert set(zip(table["width_plus"], table["depth_plus"], strict=True)) == {
        (w, d) for w in (0.15, 0.3) for d in (0.25, 0.75, 1.25)
    }
    reynolds, inertial = (table["model"] == name for name in ("reynolds", "inertial_reynolds"))
    assert np.abs(table["load_plus"][reynolds]).max() < 1e-10 * table["pressure_max_plus"].max()
    slow, fast = (table["load_plus"][inertial & (table["reynolds_number"] == number)] for number in (40, 160))
    assert fast == pytest.approx(4 * slow, rel=1e-9)  # first-order inertia
    assert table["friction_plus"][inertial] == pytest.approx(table["friction_plus"][reynolds], rel=1e-12)


def test_the_two_tables_say_the_same_and_name_their_units(pockets):
    table = read_table(pockets / "table.h5")
    with (pockets / "table.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [name.partition(" (")[0] for name in rows[0]] == list(table)
    assert {"width (m)", "load_per_area (Pa)", "cpu_s (s)", "load_plus", "model"} <= set(rows[0])
    assert [float(row["load_per_area (Pa)"]) for row in rows] == table["load_per_area"].tolist()
    assert [row["case"] for row in rows] == table["case"].tolist()
    with h5py.File(pockets / "table.h5") as file:
        assert file["load_per_area"].attrs["unit"] == "Pa"


@pytest.mark.parametrize("column", ["case", "setting"])
def test_a_table_without_the_names_of_its_rows_is_read_from_the_results(pockets, tmp_path, column):
    out = tmp_path / "out"
    shutil.copytree(pockets, out)
    before = read_batch(out).table
    forge(out / "table.h5", lambda file: file.pop(column))
    after = read_batch(out).table
    assert {name: repr(one.values) for name, one in after.items()} == {
        name: repr(one.values) for name, one in before.items()
    }


def test_a_case_holds_its_scene_and_whole_results(tmp_path):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", depths=["0.25 film", "22.5 um"])
    assert Batch(study, out, tmp_path).end()[0] == 0
    depths = set()
    for place in (out / "cases").iterdir():
        scene = load_scene(place / "scene.toml")
        result = load(place / "reynolds.h5")
        assert result.provenance["scene"] == scene_entries(scene)
        assert result.fields["film_thickness"].values.max() == pytest.approx(30e-6 + scene.grooves[0].depth, rel=1e-2)
        depths.add(scene.grooves[0].depth)
    assert depths == {7.5e-6, 22.5e-6}


def test_finished_jobs_are_skipped_also_when_the_study_grows(tmp_path):
    out, study = tmp_path / "out", tmp_path / "s.toml"
    write_study(study, models=["moody"], numbers=[1, 2])
    assert Batch(study, out, tmp_path).end()[0] == 0
    stamps = {path: path.stat().st_mtime_ns for path in results(out)}
    assert len(stamps) == 2
    write_study(study, models=["moody"], numbers=[1, 2, 3], depths=["0.25 film", "0.5 film"])
    code, output, _ = Batch(study, out, tmp_path, "--dry-run", "--json").end()
    assert code == 0
    assert json.loads(output)["jobs"]["moody"] == {"finished": 2, "solved": 0, "failed": 0, "left out": 0, "to do": 4}
    assert Batch(study, out, tmp_path).end()[0] == 0
    assert sorted(attempts(tmp_path)) == ["1", "1", "2", "2", "3", "3"]
    assert {path: path.stat().st_mtime_ns for path in stamps} == stamps
    assert len(read_table(out / "table.h5")["case"]) == 6


def test_a_dry_run_makes_nothing(tmp_path):
    code, output, _ = called(POCKET, tmp_path / "out", "--dry-run")
    assert code == 0
    assert "12 cases" in output
    assert not (tmp_path / "out").exists()


def test_one_failure_stops_nothing(tmp_path):
    """One that diverges has answered and is not asked again; one that breaks, stops or kills its worker is."""
    out, study = tmp_path / "out", tmp_path / "s.toml"
    write_study(study, models=["moody", "reynolds"], numbers=[5, 6, 7, 8, 9, 9.5])
    code, output, error = Batch(study, out, tmp_path, "--json").end()
    assert code == 3
    failures = json.loads(output)["failures"]
    kinds = {failure["kind"]: failure for failure in failures if failure["outcome"] != "failed"}
    assert set(kinds) == {"ConvergenceError", "WorkerDied", "TypeError"}
    assert kinds["ConvergenceError"]["message"] == "moody: the residual grows; lower the Reynolds number"
    assert any("in solve" in line for line in kinds["TypeError"]["notes"])
    assert len([line for line in error.splitlines() if line.startswith("failed: ")]) == len(failures) == 4
    table = read_table(out / "table.h5")
    assert sum(table["outcome"] == "solved") == 8
    failed = (table["model"] == "moody") & (table["reynolds_number"] == 7)
    assert table["outcome"][failed] == ["ConvergenceError: moody: the residual grows; lower the Reynolds number"]
    assert np.isnan(table["load_plus"][failed]).all()

    before = attempts(tmp_path)
    assert Batch(study, out, tmp_path).end()[0] == 3
    assert set(attempts(tmp_path)[len(before) :]) == {"8", "9", "9.5"}


@pytest.mark.slow
@pytest.mark.parametrize("everyone", [True, False], ids=["group", "parent"])
def test_killed_at_any_moment_it_goes_on_where_it_was(tmp_path, everyone):
    out = tmp_path / "out"
    moments = random.Random(20051 + everyone)
    study = write_study(
        tmp_path / "s.toml",
        depths=[f"{0.25 + 0.1 * i:.2f} film" for i in range(5)],
        numbers=list(range(10, 20)),
        models=["moody", "inertial_reynolds"],
    )
    stamps = {}
    for _ in range(3):
        batch = Batch(study, out, tmp_path, "--jobs", 2, seconds=0.05)
        wait_for(partial(lambda count, batch: len(results(out)) > count or not batch.runs(), len(stamps), batch))
        time.sleep(moments.uniform(0, 0.2))
        if everyone:
            os.killpg(batch.process.pid, signal.SIGKILL)
        else:
            batch.process.kill()
        batch.end()
        wait_for(partial(lambda batch: not batch.family(), batch))
        stamps = same_later(stamps, out)
    stored = sum(path.name == "moody.h5" for path in stamps)
    assert 0 < len(stamps) < 100
    before = len(attempts(tmp_path))
    code, _, error = Batch(study, out, tmp_path, "--jobs", 2).end()
    assert code == 0, error
    assert len(attempts(tmp_path)) - before == 50 - stored
    same_later(stamps, out)
    assert not list((out / "cases").glob("*/.*"))
    assert not list((tmp_path / "tmp").iterdir())
    table = read_table(out / "table.h5")
    assert len(table["case"]) == 100
    assert set(table["outcome"]) == {"solved"}


@pytest.mark.slow
def test_killed_while_it_writes_it_leaves_no_part_of_a_result(tmp_path):
    out, unfinished = tmp_path / "out", 0
    study = write_study(tmp_path / "s.toml", models=["moody"])
    for _ in range(2):
        batch = Batch(study, out, tmp_path, megabytes=60)
        wait_for(
            partial(lambda batch: [*out.glob("cases/*/.roughfilm-*/moody*")] or not batch.runs(), batch), every=0.001
        )
        batch.process.kill()
        batch.end()
        unfinished += len([*out.glob("cases/*/.roughfilm-*/moody.h5")])
        assert results(out) == []
    assert unfinished
    assert Batch(study, out, tmp_path, megabytes=60).end()[0] == 0
    assert load(results(out)[0]).fields["noise"].values.nbytes == 60_000_000
    assert [*out.glob("cases/*/.*")] == []


def test_killed_alone_it_takes_its_workers_with_it(tmp_path):
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=[10, 11])
    batch = Batch(study, tmp_path / "out", tmp_path, "--jobs", 2, seconds=300)
    wait_for(lambda: len(attempts(tmp_path)) == 2)
    batch.process.kill()
    batch.process.wait()
    wait_for(lambda: not batch.family(), 20)
    batch.end()
    sweep(batch.temporary)
    assert not list(batch.temporary.iterdir())


@pytest.mark.parametrize(
    ("send", "number"),
    [(os.kill, signal.SIGTERM), (os.killpg, signal.SIGTERM), (os.killpg, signal.SIGINT)],
    ids=["terminate", "terminate-group", "ctrl-c"],
)
def test_stopped_it_ends_at_once_with_one_line_and_no_children(tmp_path, send, number):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 30)))
    batch = Batch(study, out, tmp_path, "--jobs", 2, seconds=0.5)
    wait_for(lambda: results(out))
    send(batch.process.pid, number)
    code, _, error = batch.end()
    assert code == 128 + number
    (line,) = error.splitlines()
    assert line.startswith("stopped: ")
    assert "of 20 jobs" in line
    wait_for(lambda: not batch.family(), 5)
    assert not list(batch.temporary.iterdir())
    stamps = same_later({}, out)
    assert Batch(study, out, tmp_path, "--jobs", 4).end()[0] == 0
    same_later(stamps, out)


def test_a_signal_that_is_ignored_at_the_start_stays_ignored(tmp_path):
    """A shell starts a command in the background with SIGINT ignored, so that Ctrl-C ends what is in front alone."""
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=[10, 11, 12, 13])
    batch = Batch(study, out, tmp_path, "--jobs", 2, seconds=0.5, ignored=signal.SIGINT)
    wait_for(lambda: results(out))
    os.killpg(batch.process.pid, signal.SIGINT)
    code, _, error = batch.end()
    assert code == 0, error
    assert len(results(out)) == 4


def test_two_batches_do_not_share_a_directory(tmp_path):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 14)))
    first = Batch(study, out, tmp_path, "--jobs", 1, seconds=1.0)
    wait_for(first.workers)
    code, _, error = Batch(study, out, tmp_path).end()
    assert code == 2
    (line,) = error.splitlines()
    assert f"another batch works here (process {first.process.pid})" in line
    assert first.end()[0] == 0
    assert len(attempts(tmp_path)) == 4


def test_a_worker_that_is_killed_costs_nothing_but_time(tmp_path):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 20)))
    batch = Batch(study, out, tmp_path, "--jobs", 2, seconds=0.6)
    wait_for(lambda: results(out))
    os.kill(wait_for(batch.workers)[0], signal.SIGKILL)
    code, _, error = batch.end()
    assert code == 0, error
    assert set(read_table(out / "table.h5")["outcome"]) == {"solved"}
    assert len(attempts(tmp_path)) <= 11


def test_calls_in_one_process_are_answered_one_after_the_other(monkeypatch):
    """A worker of dask may have several threads, but neither the models nor their CPU times are made for that."""
    running, most = [], []

    def solve(*_):
        running.append(1)
        most.append(len(running))
        time.sleep(0.02)
        running.pop()
        raise ConvergenceError("no answer is needed")

    monkeypatch.setattr(execute.Setting, "solve", solve)
    scene = load_scene(SCENES / "pocket.toml")
    question = (scene, "reynolds", None, None, always().detail)
    with ThreadPoolExecutor(4) as threads:
        answers = list(threads.map(lambda _: execute.ask([question], (code(), versions())), range(8)))
    assert [one.message for (one,) in answers] == ["no answer is needed"] * 8
    assert max(most) == 1


@pytest.mark.openfoam
@pytest.mark.slow
def test_a_killed_batch_of_openfoam_runs_goes_on(tmp_path):
    out = tmp_path / "out"
    study = write_study(
        tmp_path / "s.toml",
        models=["navier_stokes"],
        numbers=[20, 40, 60, 80, 100, 120, 140, 160],
        more="resolution.navier_stokes = 30\n",
    )
    batch = Batch(study, out, tmp_path, "--jobs", 2)
    wait_for(lambda: results(out) and list(batch.temporary.glob("*/roughfilm-*")))
    batch.process.kill()
    batch.end()
    wait_for(lambda: not batch.family(), 20)
    stamps = same_later({}, out)
    assert Batch(study, out, tmp_path, "--jobs", 2).end()[0] == 0
    same_later(stamps, out)
    assert not list(batch.temporary.iterdir())
    table = read_table(out / "table.h5")
    assert (np.diff(table["load_plus"]) > 0).all()  # load grows with Re


@pytest.mark.parametrize(
    ("more", "arguments", "words"),
    [
        ("", ["--jobs", "0"], "--jobs: got 0"),
        ("", ["--executor", "dask"], "--executor dask needs --scheduler ADDRESS"),
        ("", ["--scheduler", "tcp://127.0.0.1:1"], "add --executor dask"),
        ("", ["--wait=-3s"], "--wait: got '-3s'"),
        ("colour = 1\n", [], "study.colour: unknown key"),
    ],
)
def test_bad_input_is_one_line_and_code_2(tmp_path, more, arguments, words):
    study = write_study(tmp_path / "s.toml", more=more)
    code, output, error = called(study, tmp_path / "out", *arguments)
    assert code == 2
    (line,) = error.splitlines()
    assert words in line
    assert output == ""
    assert not (tmp_path / "out").exists()
