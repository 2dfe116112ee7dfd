"""A sample of the kills: as many as take some seconds."""

import json
import subprocess
import sys

import pytest
from attack import outputs
from places import ROOT

KILLED = ("solve", "contact", "batch")
"""Commands that are killed here; each of them stands for one way to write files."""


@pytest.mark.slow
def test_killed_commands_lose_nothing_and_leave_nothing(tmp_path):
    """In a process of its own, because the attack forks and takes over all processes whose parent has ended."""
    failures = tmp_path / "failures.json"
    words = ["kills", "--count", "8", "--seed", "8", "--failures", str(failures)]
    words += [word for name in KILLED for word in ("--command", name)]
    done = subprocess.run([sys.executable, "-m", "tests.attack", *words], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    tally = json.loads(failures.read_text())["kills"]
    assert tally["points"] >= 8
    assert tally["effective"] > 0
    assert tally["failures"] == []


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.html", "<html>"),
        ("a.csv", "x,y\n1,2\n3\n"),
        ("a.csv", "x,y\n1,2"),
        ("a.json", '{"a": [1'),
        ("a.h5", "\x89HDF"),
    ],
)
def test_a_cut_output_is_incomplete(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(outputs.IncompleteError, match=name):
        outputs.content(tmp_path / name)


def test_answers_differ_in_numbers_and_not_in_costs():
    usual = {"quantities": [1.0, 2.0], "cpu_s": 1.0, "unit": "Pa"}
    assert not list(outputs.differences(usual, usual | {"cpu_s": 2.0}))
    assert list(outputs.differences(usual, usual | {"quantities": [1.0, 2.125]})) == ["/quantities/1: 2.0, 2.125"]
    assert list(outputs.differences(usual, usual | {"quantities": [1.0, 2.0 + 1e-12]}))
    assert not list(outputs.differences(["9 right, 1.5 s in all"], ["9 right, 2 s in all"]))
    assert list(outputs.differences(["9 right, 1.5 s in all"], ["8 right, 1.5 s in all"]))
    assert list(outputs.differences(usual, {"unit": "Pa"}))


def test_scratch_is_what_is_hidden_temporary_or_locked(tmp_path):
    work, temporary, cache = (tmp_path / name for name in ("work", "tmp", "cache"))
    for path in (work / "study" / ".scratch", temporary / "roughfilm-1", cache / "tables"):
        path.mkdir(parents=True)
    (work / "result.h5").touch()
    (cache / "tables" / f"{'0' * 64}.h5").touch()
    (cache / "tables" / f"{'0' * 64}.lock").touch()
    left = outputs.scratch(work, temporary, cache)
    assert left == ["beside: study/.scratch", "temporary: roughfilm-1", f"cache: {'0' * 64}.lock"]
