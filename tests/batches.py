"""Batches as processes, with a model whose runs fail on purpose, and what batches leave behind."""

import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from places import ROOT
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.ladder.store import load

MOODY = ROOT / "tests" / "roughfilm" / "batch" / "moody"

STUDY = """
name = "tried"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 length"
depth = {depths}
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = {numbers}
[study]
models = {models}
"""


def write_study(path, *, depths=("0.25 film",), numbers=(40,), models=("reynolds",), more=""):
    text = STUDY.format(depths=json.dumps(depths), numbers=json.dumps(numbers), models=json.dumps(models))
    path.write_text(text + more)
    return path


class Threads(ThreadPoolExecutor):
    """Workers of a batch that are threads of this process."""

    def executor(self, _needs=None):
        return self

    def watch(self):
        pass


class Batch:
    """``roughfilm batch`` in a session of its own, found again by a mark that its children inherit."""

    def __init__(self, study, out, tmp_path, *arguments, seconds=0.0, megabytes=0.0, ignored=None, environment=()):
        self.mark = f"ROUGHFILM_TRIED={tmp_path}-{out}"
        name, value = self.mark.split("=", 1)
        notes = {
            "MOODY_NOTES": str(tmp_path / "notes"),
            "MOODY_SECONDS": str(seconds),
            "MOODY_MEGABYTES": str(megabytes),
            "PYTHONPATH": str(MOODY),
        }
        self.temporary = tmp_path / "tmp"
        self.temporary.mkdir(exist_ok=True)
        notes["TMPDIR"] = str(self.temporary)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "roughfilm.cli.main", "batch", str(study), "--out", str(out), *map(str, arguments)],
            env={**os.environ, **notes, name: value, **dict(environment)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=None if ignored is None else partial(signal.signal, ignored, signal.SIG_IGN),
        )

    def end(self):
        out, err = self.process.communicate(timeout=300)
        return self.process.returncode, out, err

    def runs(self):
        return self.process.poll() is None

    def family(self):
        """The processes that are left of it, itself not counted."""
        found = []
        for place in Path("/proc").iterdir():
            try:
                marked = place.name.isdigit() and self.mark.encode() in (place / "environ").read_bytes()
                if (
                    marked
                    and int(place.name) != self.process.pid
                    and "\nState:\tZ" not in (place / "status").read_text()
                ):
                    found.append(int(place.name))
            except OSError:
                continue
        return found

    def workers(self):
        """Those that lead a process group of their own."""
        return [pid for pid in self.family() if group(pid) == pid]


def called(study, out, *arguments):
    """``roughfilm batch`` in this process: exit code, output and errors."""
    result = CliRunner().invoke(app, ["batch", str(study), "--out", str(out), *map(str, arguments)])
    return result.exit_code, result.stdout, result.stderr


def group(pid):
    try:
        return os.getpgid(pid)
    except OSError:
        return None


def wait_for(condition, seconds=60.0, *, every=0.02):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if found := condition():
            return found
        time.sleep(every)
    raise AssertionError("it did not happen")


def results(out):
    return sorted((out / "cases").glob("*/[!.]*.h5"))


def attempts(tmp_path):
    notes = tmp_path / "notes"
    return notes.read_text().split() if notes.exists() else []


def same_later(stamps, out):
    """Every result that was there is there untouched, and all that are there are whole."""
    now = {path: path.stat().st_mtime_ns for path in results(out)}
    for path in now:
        load(path)
    assert stamps.items() <= now.items()
    return now
