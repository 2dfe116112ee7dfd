"""Cases of a study, generated, run by their scripts and collected: the same answers as a batch."""

import csv
import errno
import json
import os
import shutil
import stat
import subprocess

import numpy as np
import pytest
from batches import wait_for
from foamlib import FoamFile
from places import SCENES
from slurm_node import SlurmNode
from typer.testing import CliRunner

from roughfilm.batch.plan import read_batch
from roughfilm.batch.progress import BatchProgress
from roughfilm.batch.solve import finished as batch_answers
from roughfilm.batch.solve import tasks_of
from roughfilm.cli.main import app
from roughfilm.foamcases.openfoam.allrun import FINISHED, RUNNING
from roughfilm.generated import write
from roughfilm.generated.manifest import read_manifest
from roughfilm.ladder import models
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.study import load_study
from roughfilm.rom.studies.table import read_table

GAPS = """
name = "gaps"
kind = "rough_gap"
[geometry]
surface = "sinusoid"
amplitude = ["2 um", "3 um"]
wavelength = "50 um"
mean_gap = "10 um"
[lubricant]
viscosity = "0.01 Pa*s"
density = "870 kg/m^3"
[flow]
reynolds_number = 0.5
[study]
models = ["smooth_gap", "stokes"]
resolution = { stokes = 8 }
"""

GROOVES = """
name = "grooves"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 length"
depth = ["0.25 film", "0.75 film"]
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = 40
[study]
models = ["film", "navier_stokes"]
resolution = { navier_stokes = 16 }
"""

RUN_RELATED = {"cpu_s", "iterations", "residual"}
"""Columns of numbers that belong to a run, not to its answer."""


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def generate(text, out):
    file = out.parent / f"{out.name}.toml"
    file.write_text(text)
    done = run("generate", file, "--out", out)
    assert done.exit_code == 0, done.output
    return file


def collect(out):
    done = run("collect", out, "--json", "--jobs", "1")
    assert done.exit_code in (0, 3), done.output
    return done.exit_code, json.loads(done.stdout)


def outcomes(out):
    with (out / "table.csv").open(newline="") as file:
        return [row["outcome"] for row in csv.DictReader(file)]


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """A study that was generated, run by its own script, and collected."""
    made = {}

    def make(name, text):
        if name not in made:
            out = tmp_path_factory.mktemp("solved") / name
            file = generate(text, out)
            ran = subprocess.run([out / "Allrun.all"], capture_output=True, text=True)
            assert ran.returncode == 0, ran.stdout + ran.stderr
            assert "all 2 cases have finished" in ran.stdout
            code, found = collect(out)
            assert code == 0, found["failures"]
            made[name] = file, out
        return made[name]

    return make


@pytest.mark.openfoam
@pytest.mark.parametrize(("name", "text"), [("gaps", GAPS), ("grooves", GROOVES)])
def test_the_table_is_that_of_a_batch(solved, tmp_path, name, text):
    file, out = solved(name, text)
    done = run("batch", file, "--out", tmp_path / "batch", "--jobs", "1")
    assert done.exit_code == 0, done.output
    ours, batch = read_table(out / "table.h5"), read_table(tmp_path / "batch" / "table.h5")
    assert list(ours) == list(batch)
    for column, values in batch.items():
        if values.dtype.kind != "f":
            assert ours[column].tolist() == values.tolist(), column
        elif column not in RUN_RELATED:
            uncertainty = batch.get(f"{column}_uncertainty", np.zeros(values.size))
            allowed = np.where(uncertainty > 0, uncertainty, 1e-4 * np.abs(values))
            assert (np.abs(ours[column] - values)[~np.isnan(values)] <= allowed[~np.isnan(values)]).all(), column


@pytest.mark.openfoam
def test_a_batch_and_a_report_find_the_results(solved):
    file, out = solved("gaps", GAPS)
    study = load_study(file, models)
    rows, missing = batch_answers(study, tasks_of(study, out), BatchProgress())
    assert (len(rows), missing) == (4, [])
    batch = read_batch(out)
    assert batch.missing == ()
    assert set(batch.table["outcome"].values) == {"solved"}


@pytest.mark.openfoam
def test_what_has_finished_is_neither_run_nor_read_again(solved):
    _, out = solved("gaps", GAPS)
    ran = subprocess.run([out / "Allrun.all"], capture_output=True, text=True)
    assert ran.stdout.count("has finished before") == 2
    _, found = collect(out)
    assert found["jobs"]["stokes-8"]["finished"] == 2


@pytest.mark.openfoam
def test_an_edited_case_is_marked_and_its_entries_are_named(solved, tmp_path):
    _, finished = solved("gaps", GAPS)
    out = tmp_path / "edited"
    shutil.copytree(finished, out, symlinks=True)
    first, second = (out / one.directory for one in read_manifest(out).generated)
    FoamFile(first / "along" / "system" / "fvSolution")["relaxationFactors", "equations", "U"] = 0.7
    FoamFile(first / "across" / "constant" / "transportProperties")["nu"] = 1234.0
    (first / "constant" / "polyMesh" / "owner").unlink()
    (second / "case.json").write_text((second / "case.json").read_text() + " ")
    code, found = collect(out)
    assert code == 0
    assert [one["setting"] for one in found["edited"]] == ["stokes-8", "stokes-8"]
    words = "; ".join(found["edited"][0]["edits"])
    assert "along/system/fvSolution: relaxationFactors.equations.U 0.9" in words
    assert "→ 0.7" in words
    assert "across/constant/transportProperties: nu 1000000.0 → 1234.0" in words
    assert "constant/polyMesh/owner is missing" in words
    assert found["edited"][1]["edits"] == ["case.json differs"]
    assert "the case was edited: " in (out / "table.csv").read_text(encoding="utf-8")
    result = load(first.parent / "stokes-8.h5", with_fields=False)
    assert result.warnings[0].startswith("the case was edited: ")


@pytest.mark.openfoam
def test_cases_that_run_or_were_damaged_are_no_results(solved, tmp_path):
    _, finished = solved("gaps", GAPS)
    out = tmp_path / "damaged"
    shutil.copytree(finished, out, symlinks=True)
    for path in out.glob("cases/*/*.h5"):
        path.unlink()
    first, second = (out / one.directory for one in read_manifest(out).generated)
    (first / FINISHED).unlink()
    shutil.rmtree(next(path for path in (second / "sliding").iterdir() if path.name.isdecimal() and path.name != "0"))
    code, found = collect(out)
    assert code == 3
    assert [one["reason"] for one in found["unfinished"]] == ["is running, or was interrupted"]
    assert ["are missing; run the case again" in one["message"] for one in found["failures"]] == [True]
    assert outcomes(out)[1] == "not solved yet: is running, or was interrupted"
    shutil.rmtree(first)
    (second / "along" / "log.simpleFoam").write_bytes(b"\0" * 50)
    (second / "case.json").write_text((second / "case.json").read_text() + " ")
    points = second / "constant" / "polyMesh" / "points"
    data = bytearray(points.read_bytes())
    data[len(data) // 2] ^= 1
    points.write_bytes(data)
    code, found = collect(out)
    edits = ["case.json differs", "constant/polyMesh/points differs"]
    assert [one["edits"] for one in found["edited"]] == [edits]
    assert found["failures"][0]["message"].endswith(f"; the case was edited: {'; '.join(edits)}")
    assert [one["reason"] for one in found["unfinished"]] == ["its directory is missing"]
    assert len(found["failures"]) == 1


@pytest.fixture
def without_openfoam(monkeypatch, tmp_path):
    """A machine on which no program of OpenFOAM is found."""
    from roughfilm.foamcases.openfoam import installation

    place = tmp_path / "no-programs"
    place.mkdir()
    monkeypatch.setenv("PATH", str(place))
    installation.installation.cache_clear()
    yield
    installation.installation.cache_clear()


@pytest.mark.usefixtures("without_openfoam")
def test_cases_are_written_and_awaited_without_openfoam(tmp_path):
    out = tmp_path / "out"
    generate(GROOVES.replace('"navier_stokes"]', '"stokes", "navier_stokes"]'), out)
    manifest = read_manifest(out)
    assert [one.setting for one in manifest.generated] == ["stokes", "navier_stokes-16"] * 2
    assert (out / "cases.txt").read_text().splitlines() == [one.directory for one in manifest.generated]
    for one in manifest.generated:
        assert {"Allrun", "case.json", "system/controlDict", "constant/polyMesh/points"} <= one.files.keys()
        assert (out / one.directory).parent.joinpath("scene.toml").is_file()
    code, found = collect(out)
    assert code == 0
    assert {one["reason"] for one in found["unfinished"]} == {"was not started"}
    assert found["jobs"]["film"]["solved"] == 2
    assert outcomes(out) == ["solved", *["not solved yet: was not started"] * 2] * 2
    lock = out / manifest.generated[0].directory / RUNNING
    lock.parent.mkdir()
    lock.write_text("node7 123\n")
    _, found = collect(out)
    assert found["unfinished"][0]["reason"] == "is running on node7 (process 123), or was interrupted"


def test_the_directory_is_complete_on_another_machine(tmp_path):
    np.save(tmp_path / "wavy.npy", 1e-6 * np.add.outer(np.zeros(8), np.cos(np.arange(8) * np.pi / 4)))
    text = GAPS.replace('"sinusoid"', '"wavy.npy"\nspacing = "5 um"').replace('amplitude = ["2 um", "3 um"]\n', "")
    out = tmp_path / "out"
    generate(text.replace('wavelength = "50 um"\n', "").replace('"10 um"', '["10 um", "12 um"]'), out)
    (tmp_path / "wavy.npy").unlink()
    moved = out.rename(tmp_path / "moved")
    study = read_manifest(moved).study(moved)
    assert [case.scene.surface().shape for case in study.cases] == [(8, 8), (8, 8)]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--resolution", "20"], "--resolution: "),
        (["--set", "geometry.film=20um"], "--set: "),
        (["--processes", "99"], "processes: got 99"),
        (["--dialect", "gnu"], "dialect: got 'gnu'"),
    ],
)
def test_what_a_study_states_itself_is_refused(tmp_path, options, words):
    (tmp_path / "study.toml").write_text(GROOVES)
    done = run("generate", tmp_path / "study.toml", "--out", tmp_path / "out", *options)
    assert done.exit_code == 2
    assert words in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_study_without_openfoam_is_refused(tmp_path):
    (tmp_path / "study.toml").write_text(GROOVES.replace(', "navier_stokes"]', "]").partition("resolution = {")[0])
    done = run("generate", tmp_path / "study.toml", "--out", tmp_path / "out")
    assert done.exit_code == 2
    assert "study.models: none of them runs OpenFOAM; name stokes or navier_stokes" in done.stderr


def test_a_bearing_has_cases_if_it_is_a_wide_pad_and_otherwise_reasons(tmp_path):
    written = run("generate", SCENES / "textured_slider.toml", "--resolution", "24", "--out", tmp_path / "pad")
    assert written.exit_code == 0
    assert "1 OpenFOAM case" in written.stdout  # the scene has no density, which navier_stokes needs
    assert (tmp_path / "pad" / "stokes" / "Allrun").is_file()
    done = run("generate", SCENES / "journal.toml", "--out", tmp_path / "journal")
    assert done.exit_code == 2
    assert "no model solves it in OpenFOAM: stokes: the flow is resolved across the film of pads only" in done.stderr


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"version": 1}', '{"version": 2}', '{"version": 1, "generated": 3}'])
def test_a_damaged_manifest_is_said_in_one_line(tmp_path, text):
    (tmp_path / "manifest.json").write_text(text)
    done = run("collect", tmp_path)
    assert done.exit_code == 2
    assert done.stderr.startswith("error: ")
    assert "generate" in done.stderr
    assert len(done.stderr.splitlines()) <= 3


@pytest.mark.parametrize("forged", ["cases", "settings", "generated"])
def test_a_forged_manifest_reaches_nothing_outside_of_its_directory(tmp_path, forged):
    generate(GROOVES, tmp_path / "out")
    path = tmp_path / "out" / "manifest.json"
    entries = json.loads(path.read_text())
    if forged == "generated":
        entries[forged][0]["directory"] = "/etc"
    else:
        entries[forged] = {f"../../{name}": about for name, about in entries[forged].items()}
    path.write_text(json.dumps(entries))
    done = run("collect", tmp_path / "out")
    assert done.exit_code == 2
    assert "names a place outside of its directory" in " ".join(done.stderr.split())
    assert sorted(one.name for one in tmp_path.iterdir()) == ["out", "out.toml"]


def test_a_directory_without_manifest_is_refused(tmp_path):
    assert "holds no manifest.json" in run("collect", tmp_path).stderr
    assert "is not a directory" in run("collect", tmp_path / "none").stderr


@pytest.fixture
def scripted(tmp_path):
    """A directory with the scripts of a study, whose cases only say that they were run."""
    out = tmp_path / "out"
    generate(GROOVES, out)
    cases = [out / one.directory for one in read_manifest(out).generated]
    for case, code in zip(cases, (5, 0), strict=True):
        (case / "Allrun").write_text(f'#!/bin/sh\necho "ran"\necho {code} > "$(dirname "$0")/finished"\nexit {code}\n')
        (case / "Allrun").chmod(stat.S_IRWXU)
    return out, cases


def test_all_cases_are_run_though_one_fails(scripted):
    out, cases = scripted
    for count in (2, 1):  # the case that failed is run again, the other one is not
        done = subprocess.run([out / "Allrun.all"], capture_output=True, text=True)
        assert done.returncode == 1
        assert done.stdout.count("ran") == count
        assert done.stderr.split() == ["failed:", cases[0].relative_to(out).as_posix()]


def test_a_task_of_slurm_runs_its_case(scripted):
    out, cases = scripted
    text = (out / "Allrun.slurm").read_text()
    assert text.startswith("#!/bin/bash\n")  # as "module" and the file bashrc of OpenFOAM need
    assert "#SBATCH --array=1-2\n" in text
    assert "#SBATCH --ntasks=1\n" in text

    def task(number, **more):
        there = {**os.environ, "SLURM_ARRAY_TASK_ID": str(number), "SLURM_SUBMIT_DIR": str(out), **more}
        done = subprocess.run(["bash", out / "Allrun.slurm"], capture_output=True, text=True, env=there, cwd="/")
        return done.returncode, done.stdout.splitlines()

    first, second = (case.relative_to(out).as_posix() for case in cases)
    assert task(1) == (5, [first, "ran"])
    assert task(1, SKIP="1") == (0, [second, "ran"])
    assert task(2) == (0, [f"{second} has finished before"])
    assert task(3) == (0, ["no case 3"])


def test_a_study_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("roughfilm.generated.write.write_manifest", full)
    (tmp_path / "gaps.toml").write_text(GAPS)
    done = run("generate", tmp_path / "gaps.toml", "--out", tmp_path / "gaps")
    assert done.exit_code == 2
    assert "gaps: cannot be written (No space left on device)" in done.stderr
    assert os.listdir(tmp_path) == ["gaps.toml"]


def test_cases_do_not_take_the_place_of_the_current_directory(tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    (tmp_path / "gaps.toml").write_text(GAPS)
    monkeypatch.chdir(tmp_path / "here")
    done = run("generate", "../gaps.toml", "--out", ".")
    assert done.exit_code == 2
    assert "is the current directory" in done.stderr


@pytest.fixture
def slurm():
    node = SlurmNode()
    yield node
    node.end()


@pytest.mark.slow
@pytest.mark.openfoam
def test_an_array_of_slurm_runs_all_cases(tmp_path, slurm):
    out = tmp_path / "out"
    generate(GROOVES, out)
    done = subprocess.run(
        ["sbatch", "--parsable", "Allrun.slurm"], cwd=out, env=slurm.environment, capture_output=True, text=True
    )
    assert done.stdout.strip().isdigit(), done.stderr
    wait_for(lambda: all((out / one.directory / FINISHED).is_file() for one in read_manifest(out).generated))
    code, found = collect(out)
    assert code == 0, found["failures"]
    assert outcomes(out) == ["solved"] * 4
    assert len([*out.glob("slurm-*_*.out")]) == 2


def one_case(entries):
    return next(iter(entries["cases"].values()))


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        (
            lambda entries: next(iter(entries["cases"].values()))["scene"]["geometry"].update(film="31 um"),
            "the scene of",
        ),
        (lambda entries: entries.update(tolerance=1e-3), "an entry"),
        (lambda entries: entries["generated"][0]["files"].update({"case.json": "0" * 64}), "an entry"),
        (lambda entries: entries.update(digest=""), "an entry"),
    ],
)
def test_an_edited_manifest_is_refused(tmp_path, edit, words):
    generate(GROOVES, tmp_path / "out")
    path = tmp_path / "out" / "manifest.json"
    entries = json.loads(path.read_text())
    assert read_manifest(tmp_path / "out").cases
    edit(entries)
    path.write_text(json.dumps(entries))
    done = run("collect", tmp_path / "out")
    assert done.exit_code == 2
    message = " ".join(done.stderr.split())
    assert words in message
    assert "was edited, as its digest says; put the original back, or generate again" in message


@pytest.mark.openfoam
def test_results_that_are_not_those_of_the_run_are_no_results(solved, tmp_path):
    _, finished = solved("gaps", GAPS)
    out = tmp_path / "forged"
    shutil.copytree(finished, out, symlinks=True)
    for path in out.glob("cases/*/*.h5"):
        path.unlink()
    first, second = (out / one.directory for one in read_manifest(out).generated)
    along = first / "along"
    last = max((path for path in along.iterdir() if path.name.isdecimal()), key=lambda path: int(path.name))
    pressure = FoamFile(last / "p")
    pressure["internalField"] = 1.5 * np.asarray(pressure["internalField"])
    (second / "finished").write_text("1\n")
    code, found = collect(out)
    assert code == 3
    messages = [one["message"] for one in found["failures"]]
    assert f"along/{last.name}/p was changed after the run; run the case again" in messages[0]
    assert "Allrun ended with the exit code 1; see its logs" in messages[1]


def test_a_directory_that_a_shell_would_read_is_quoted(tmp_path):
    (tmp_path / "study.toml").write_text(GROOVES)
    done = run("generate", tmp_path / "study.toml", "--out", tmp_path / "a;b&c")
    assert done.exit_code == 0
    shown = "".join(done.stdout.split())
    assert f"'{tmp_path}/a;b&c'&&sbatch" in shown
    assert f"roughfilmcollect'{tmp_path}/a;b&c'" in shown


@pytest.mark.parametrize("name", ["settings", "cases"])
def test_an_empty_manifest_and_a_long_name_are_said(tmp_path, name):
    generate(GROOVES, tmp_path / "out")
    path = tmp_path / "out" / "manifest.json"
    entries = json.loads(path.read_text())
    for forged in ({}, {"a" * 5000: next(iter(entries[name].values()))}):
        path.write_text(json.dumps(entries | {name: forged}))
        done = run("collect", tmp_path / "out")
        assert done.exit_code == 2
        assert done.stderr.startswith("error: ")
        assert len(done.stderr) < 1000


def as_of_version_1(out):
    """The manifest as it was before it had a digest."""
    path = out / "manifest.json"
    entries = json.loads(path.read_text())
    del entries["digest"]
    path.write_text(json.dumps(entries | {"version": 1}))


def test_a_manifest_without_a_digest_is_read(tmp_path):
    generate(GROOVES, tmp_path / "out")
    before = read_manifest(tmp_path / "out")
    as_of_version_1(tmp_path / "out")
    read = read_manifest(tmp_path / "out")
    assert (read.cases, read.generated) == (before.cases, before.generated)
    assert (before.has_digest, read.has_digest) == (True, False)


@pytest.mark.openfoam
def test_cases_of_an_older_manifest_that_were_cleaned_are_collected(solved, tmp_path):
    _, finished = solved("gaps", GAPS)
    out = tmp_path / "cleaned"
    shutil.copytree(finished, out, symlinks=True)
    for path in out.glob("cases/*/*.h5"):
        path.unlink()
    as_of_version_1(out)
    for one in read_manifest(out).generated:
        with (out / one.directory / "digests.sha256").open("a") as file:
            file.write(f"{'0' * 64}  ./along/processor0/1/p\n{'0' * 64}  ./along/processor1/1/p\n")
    (out / read_manifest(out).generated[0].directory / "along" / "processor0" / "1").mkdir(parents=True)
    (out / read_manifest(out).generated[0].directory / "along" / "processor0" / "1" / "p").write_text("left\n")
    code, found = collect(out)
    assert code == 0, found["failures"]
    with (out / "table.csv").open(newline="") as file:
        warnings = [row["warnings"] for row in csv.DictReader(file) if row["model"] == "stokes"]
    assert all("has version 1, without a digest" in one for one in warnings)
    assert len(warnings) == 2


def test_copies_are_made_in_the_order_of_their_names(tmp_path, monkeypatch):
    names = [f"{tmp_path}/{letter}.npy" for letter in "hcagbdfe"]
    for name in names:
        np.save(name, np.zeros((2, 2)))
    monkeypatch.setattr(write, "named_files", lambda _: frozenset(names))
    study = load_study(generate(GROOVES, tmp_path / "out"), models)
    assert list(write._copied_inputs(study, tmp_path)) == sorted(names)
