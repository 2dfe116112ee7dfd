"""The commands as a person types them: outputs, exit codes, one line for every fault."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import h5py
import pytest
import shellingham
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli import main as cli
from roughfilm.cli.first_steps import compare
from roughfilm.cli.main import app
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Availability, find, of_kind
from roughfilm.terminal.console import launch

QUANTITIES = {
    "load_plus",
    "friction_plus",
    "pressure_max_plus",
    "pressure_min_plus",
    "load_per_area",
    "friction_per_area",
    "backflow",
}


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def one_line(text: str) -> str:
    lines = [line for line in text.splitlines() if line.strip()]
    assert len(lines) == 1, text
    assert lines[0].startswith("error: ")
    return lines[0]


def test_models():
    result = run("models", "--json")
    assert result.exit_code == 0
    stated = json.loads(result.stdout)["models"]
    names = {kind: [model["name"] for model in stated if model["kind"] == kind] for kind in ("pocket", "dry_contact")}
    assert names == {
        "pocket": [
            "reynolds",
            "inertial_reynolds",
            "reynolds_cavitating",
            "film",
            "film_slope",
            "stokes",
            "navier_stokes",
        ],
        "dry_contact": ["greenwood_williamson", "bearing_area", "persson", "elastic", "elastic_plastic"],
    }
    assert "inertial" in run("models").stdout


def test_solve_json_is_one_object_and_nothing_else(pocket_file, tmp_path):
    out = tmp_path / "r.h5"
    result = run(
        "solve",
        pocket_file,
        "--model",
        "inertial_reynolds",
        "--json",
        "--out",
        out,
        "--set",
        "motion.reynolds_number=40",
    )
    assert result.exit_code == 0
    stated = json.loads(result.stdout)
    assert {"model", "quantities", "numerics", "warnings", "expected_error", "provenance"} <= set(stated)
    assert set(stated["quantities"]) == QUANTITIES
    assert all(set(quantity) == {"value", "unit", "uncertainty"} for quantity in stated["quantities"].values())
    assert {"residual", "iterations", "cpu_s", "wall_s", "degrees_of_freedom"} <= set(stated["numerics"])
    assert stated["quantities"]["load_plus"]["value"] == pytest.approx(0.890, abs=1e-3)
    with h5py.File(out) as file:
        assert file["quantities/load_plus"][()] == stated["quantities"]["load_plus"]["value"]


def test_solve_does_not_write_over_its_scene(pocket_file):
    before = pocket_file.read_bytes()
    refused = run("solve", pocket_file, "--model", "reynolds", "--out", pocket_file)
    assert refused.exit_code == 2
    assert "is an input" in refused.stderr
    assert pocket_file.read_bytes() == before


def test_solve_shows_a_table(pocket_file):
    shown = run("solve", pocket_file, "--model", "reynolds").stdout
    assert "friction, dimensionless" in shown
    assert "2.9167" in shown
    assert "residual" in shown


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--model", "raynolds"], "--model: got 'raynolds'; it must be one of reynolds, reynolds_cavitating"),
        (
            ["--model", "reynolds", "--set", "geometry.depth=7.5"],
            "scene.geometry.depth: got 7.5, a number without",
        ),
        (["--model", "reynolds", "--set", "geometry.hin=1"], "scene.geometry.hin: unknown key"),
        (["--model", "reynolds", "--resolution", "0"], "--resolution: got 0"),
        (["--model", "reynolds", "--tolerance", "-1"], "--tolerance: got -1"),
        (["--model", "reynolds", "--tolerance", "nan"], "--tolerance: got nan"),
        pytest.param(
            ["--model", "navier_stokes", "--tolerance", "nan"], "--tolerance: got nan", marks=pytest.mark.openfoam
        ),
        (["--model", "reynolds", "--scheme", "upwind"], "--scheme: got 'upwind' for reynolds; it offers no choice"),
        (["--model", "reynolds", "--processes", "2"], "--processes: got 2; reynolds runs in one process"),
        pytest.param(
            ["--model", "navier_stokes", "--scheme", "upwnd"],
            "--scheme: got 'upwnd' for navier_stokes; it must be one of linear_upwind, upwind",
            marks=pytest.mark.openfoam,
        ),
        pytest.param(
            ["--model", "navier_stokes", "--processes", "0"],
            "--processes: got 0; it must be 1 to 120",
            marks=pytest.mark.openfoam,
        ),
        pytest.param(["--model", "stokes", "--scheme", "upwind"], "it offers no choice", marks=pytest.mark.openfoam),
        (["--model", "reynolds", "--out", "/proc/none/r.h5"], "/proc/none/r.h5: cannot be written"),
        (["--model", "reynolds", "--out", "."], "is a directory"),
        (["--model", "reynolds", "--set", "name=[bold]x"], None),
    ],
)
def test_bad_input_is_one_line_and_code_2(pocket_file, arguments, words):
    result = run("solve", pocket_file, *arguments, "--json")
    if words is None:
        assert result.exit_code == 0
        return
    assert result.exit_code == 2
    assert words in one_line(result.stderr)
    assert result.stdout == ""


def test_no_scene_file(tmp_path):
    result = run("solve", tmp_path / "none.toml", "--model", "reynolds")
    assert result.exit_code == 2
    assert "no such file" in one_line(result.stderr)


def test_a_missing_tolerance_is_code_3(pocket_file):
    result = run("solve", pocket_file, "--model", "reynolds", "--tolerance", "1e-300")
    assert result.exit_code == 3
    assert "misses the tolerance" in one_line(result.stderr)


def without_openfoam(monkeypatch):
    absent = Availability(available=False, detail="no simpleFoam on the PATH; install it")
    monkeypatch.setattr("roughfilm.foamcases.openfoam.model.availability", lambda: absent)
    bare = tuple(replace(model, available=lambda: absent) if model.outside else model for model in models())
    monkeypatch.setattr("roughfilm.ladder.find", partial(find, bare))
    monkeypatch.setattr(compare, "models", partial(of_kind, bare))


def test_text_of_a_scene_is_text_in_the_table(pocket_file):
    result = run("solve", pocket_file, "--model", "reynolds", "--set", "name=[/red]x[/]")
    assert result.exit_code == 0
    assert "[/red]x[/]" in result.stdout


@pytest.mark.parametrize(
    "arguments",
    [
        ["solve"],
        ["compare", "x.toml"],
        ["solv"],
        ["solve", "x.toml", "--model", "reynolds", "--resolution", "a"],
        ["compare", "x.toml", "--out", "x", "--grids", "2"],
        ["compare", "x.toml", "--out", "x", "--grids", "9"],
    ],
)
def test_usage_errors_are_one_line_and_code_2(arguments, monkeypatch, capsys):
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as ended:
        launch(app, arguments)
    assert ended.value.code == 2
    assert "see --help" in one_line(capsys.readouterr().err)


@pytest.mark.parametrize("arguments", [("solve", SCENES / "pocket.toml", "--model", "reynolds", "--json"), ("--help",)])
def test_a_full_device_is_one_line(arguments):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "roughfilm.cli.main", *arguments],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=120,
        )
    assert done.returncode == 2
    assert "standard output: cannot be written" in one_line(done.stderr)


@pytest.mark.parametrize(("closed", "code"), [("<&-", 0), ("2>&-", 0), (">&-", 2), ("<&- >&- 2>&-", 2)])
def test_closed_streams_give_no_traceback(closed, code, tmp_path):
    said = tmp_path / "said"
    order = f'exec 2>"$1"; "$0" -m roughfilm.cli.main new pocket {closed}'
    done = subprocess.run(["sh", "-c", order, sys.executable, said], stdout=subprocess.DEVNULL, timeout=120)
    assert done.returncode == code
    lines = said.read_text().splitlines()
    assert lines == (
        ["error: standard output: cannot be written (Bad file descriptor); send it elsewhere"] * (closed == ">&-")
    )


def test_a_reader_that_ends_early_is_no_failure():
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "roughfilm.cli.main", "models"]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, timeout=120)
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.openfoam
@pytest.mark.parametrize("processes", ["1", "2"])
def test_a_terminated_solve_leaves_no_program_and_no_directory(pocket_file, tmp_path, processes):
    asked = ["--model", "navier_stokes", "--resolution", "600", "--processes", processes]
    process = subprocess.Popen(
        [sys.executable, "-m", "roughfilm.cli.main", "solve", pocket_file, *asked],
        env={**os.environ, "TMPDIR": str(tmp_path)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + 60
    while not list(tmp_path.rglob("log.simpleFoam")) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert list(tmp_path.rglob("log.simpleFoam"))
    children = Path("/proc") / str(process.pid) / "task" / str(process.pid) / "children"
    while not children.read_text() and time.monotonic() < deadline:
        pass
    (child,) = children.read_text().split()
    process.terminate()
    assert process.wait(timeout=30) == 128 + signal.SIGTERM
    assert not (Path("/proc") / child).exists()
    assert list(tmp_path.iterdir()) == []


def test_missing_openfoam_is_code_4(pocket_file, monkeypatch):
    without_openfoam(monkeypatch)
    result = run("solve", pocket_file, "--model", "stokes")
    assert result.exit_code == 4
    assert "no simpleFoam on the PATH" in one_line(result.stderr)


def test_compare_without_openfoam_says_what_is_missing_and_why(pocket_file, tmp_path, monkeypatch):
    without_openfoam(monkeypatch)
    result = run("compare", pocket_file, "--out", tmp_path / "o", "--json")
    assert result.exit_code == 0
    stated = json.loads(result.stdout)
    assert stated["model"] == "film_slope"
    assert set(stated["absent"]) == {"stokes", "navier_stokes"}
    page = (tmp_path / "o" / "report.html").read_text()
    assert "no simpleFoam on the PATH; install it" in page
    assert "navier_stokes" in page


def test_generate_needs_no_openfoam_and_never_overwrites(pocket_file, tmp_path):
    result = run("generate", pocket_file, "--out", tmp_path / "g", "--resolution", "24", "--json")
    assert result.exit_code == 0
    cases = json.loads(result.stdout)["cases"]
    assert [case["model"] for case in cases] == ["stokes", "navier_stokes"]
    assert all((Path(case["directory"]) / "constant" / "polyMesh" / "points").is_file() for case in cases)
    again = run("generate", pocket_file, "--out", tmp_path / "g")
    assert again.exit_code == 2
    assert "is not an empty directory" in one_line(again.stderr)


def test_generate_refuses_a_scheme_before_anything_is_written(pocket_file, tmp_path):
    result = run("generate", pocket_file, "--out", tmp_path / "g", "--scheme", "upwnd")
    assert result.exit_code == 2
    assert "--scheme: got 'upwnd' for navier_stokes" in one_line(result.stderr)
    assert not (tmp_path / "g").exists()


@pytest.mark.openfoam
@pytest.mark.parametrize("processes", [1, 2])
def test_a_generated_case_runs_by_hand(pocket_file, tmp_path, processes):
    run("generate", pocket_file, "--out", tmp_path, "--resolution", "30", "--processes", processes)
    done = subprocess.run([tmp_path / "navier_stokes" / "Allrun"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0
    assert "Mesh OK" in done.stdout
    assert "SIMPLE solution converged" in done.stdout


def test_doctor():
    result = run("doctor", "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert list(found) == ["Python", "OpenFOAM", "MPI", "rendering", "instrument files"]
    assert all(part["detail"] for part in found.values())
    assert found["Python"]["available"]


def test_the_command_is_installed():
    command = Path(sys.executable).parent / "roughfilm"
    done = subprocess.run([command, "--help"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0
    assert all(name in done.stdout for name in ("models", "solve", "compare", "generate", "doctor"))
    assert cli.main


def test_completion_that_cannot_be_installed_is_one_line(monkeypatch, capsys):
    monkeypatch.setattr(shellingham, "detect_shell", lambda: ("bash", "/bin/bash"))
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    monkeypatch.setenv("HOME", "/proc/none")
    with pytest.raises(SystemExit) as ended:
        launch(app, ["--install-completion"])
    assert ended.value.code == 2
    assert "/proc/none: cannot be read or written" in one_line(capsys.readouterr().err)


@pytest.mark.parametrize("option", ["--install-completion", "--show-completion"])
@pytest.mark.parametrize("shell", ["sh", None])
def test_a_shell_without_completion_is_refused_with_those_that_have_it(monkeypatch, capsys, option, shell):
    def detect_shell():
        if shell is None:
            raise shellingham.ShellDetectionFailure
        return shell, f"/bin/{shell}"

    monkeypatch.setattr(shellingham, "detect_shell", detect_shell)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as ended:
        launch(app, [option])
    assert ended.value.code == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert one_line(printed.err) == (
        f"error: {option}: the shell that runs this command is {shell or 'unknown'}; it must be one of "
        "bash, zsh, fish, powershell, pwsh: start the command from one of them"
    )
