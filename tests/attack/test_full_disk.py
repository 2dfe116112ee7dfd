"""A sample of the commands on a full disk."""

import json
import subprocess
import sys

import pytest
from attack.full_disk import cannot_mount
from places import ROOT


def test_a_full_disk_ends_a_command_in_one_line_and_loses_nothing(tmp_path):
    """In a process of its own, because the attack forks and takes over all processes whose parent has ended."""
    if reason := cannot_mount():
        pytest.skip(f"no file system can be mounted here: {reason}")
    failures = tmp_path / "failures.json"
    words = ["full_disk", "--count", "6", "--seed", "1", "--command", "solve", "--failures", str(failures)]
    done = subprocess.run([sys.executable, "-m", "tests.attack", *words], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    tally = json.loads(failures.read_text())["full_disk"]
    assert tally["points"] == 6
    assert tally["effective"] > 0
