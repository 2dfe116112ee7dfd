"""The command of the tests announces its steps and fails where one of them does; scripts stand for what it starts."""

import os
import subprocess

import pytest
from places import ROOT


def run_in(place, **codes):
    """The command in a small tree, whose programs print their names and end with the given codes."""
    programs = place / ".venv" / "bin"
    programs.mkdir(parents=True)
    for name in ("ruff", "mypy", "python"):
        (programs / name).write_text(f'#!/bin/sh\necho "{name} $*"\nexit {codes.get(name, 0)}\n')
    for folder in ("contact", "foamcases", "rom", "roughfilm", "tests"):
        (place / folder).mkdir(parents=True)
    (place / "conftest.py").touch()
    (place / "scripts").mkdir()
    (place / "scripts" / "setup").write_text("#!/bin/sh\n")
    (place / "scripts" / "test").write_bytes((ROOT / "scripts" / "test").read_bytes())
    for path in (*programs.iterdir(), *(place / "scripts").iterdir()):
        path.chmod(0o755)
    command = [place / "scripts" / "test", "-k", "some tests"]
    return subprocess.run(command, env={"PATH": os.environ["PATH"]}, capture_output=True, text=True, timeout=60)


def test_each_step_says_what_it_does_and_how_long_it_takes(tmp_path):
    done = run_in(tmp_path)
    assert done.returncode == 0, done.stderr
    announced = [line for line in done.stderr.splitlines() if line.startswith("test: ")]
    assert [line.split()[1].strip(",") for line in announced if "types: mypy" not in line] == ["lint", "types", "tests"]
    assert "test: types: mypy " in announced
    assert "python -m pytest --numprocesses 2 --dist loadfile --no-loadscope-reorder -k some tests" in done.stdout


@pytest.mark.parametrize(("program", "code"), [("ruff", 1), ("mypy", 1), ("python", 5)])
def test_a_step_that_fails_fails_the_command_and_types_let_the_tests_run(tmp_path, program, code):
    done = run_in(tmp_path, **{program: code})
    assert done.returncode == code, done.stderr
    assert ("pytest" in done.stdout) is (program != "ruff")
    assert ("mypy" in done.stdout) is (program == "mypy")
