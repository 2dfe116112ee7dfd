"""Programs end with us, and each is charged with its own CPU time alone."""

import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.writing.scratch import sweep
from roughfilm.foamcases.openfoam.program import execute, succeed

SOLVERS = {"simpleFoam", "foamRun"}
"""The names of the process of simpleFoam, which is a script around foamRun from openfoam.org 11 on."""

SOLVE = """
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
MODEL.solve(load_scene({scene!r}), Request(resolution=600, processes={processes}))
"""


def burn(seconds):
    return [sys.executable, "-c", f"import time\nwhile time.process_time() < {seconds}: pass"]


def test_runs_in_parallel_threads_are_charged_apart(tmp_path):
    with ThreadPoolExecutor() as pool:
        done = list(pool.map(lambda s: execute(tmp_path, burn(s), f"log.{s}").cpu_s, (0.2, 0.8)))
    assert done == pytest.approx([0.2, 0.8], abs=0.15)


def test_a_program_can_be_stopped_by_who_watches_it(tmp_path):
    ended = execute(tmp_path, ["sleep", "60"], "log", lambda: True)
    assert ended.code == -signal.SIGTERM


CHILD = """
import time
with open("pipe", "wb", buffering=0) as pipe:
    print("started", flush=True)
    time.sleep(600)
    pipe.write(b"survived")
"""
"""A child that holds a named pipe open as long as it lives, and writes to it if nobody ends it."""

PARENT = """
import pathlib, signal, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", {child!r}], stdout=subprocess.PIPE)
child.stdout.readline()
pathlib.Path("started").touch()
{end}
"""


@pytest.mark.parametrize(
    "end", ["sys.exit(3)", "time.sleep(600)", "signal.signal(signal.SIGTERM, signal.SIG_IGN); sys.exit(0)"]
)
def test_a_program_that_breaks_leaves_no_child(tmp_path, end):
    os.mkfifo(tmp_path / "pipe")
    pipe = os.open(tmp_path / "pipe", os.O_RDONLY | os.O_NONBLOCK)  # so that the child can open it without waiting
    script = PARENT.format(child=CHILD, end=end)
    execute(tmp_path, [sys.executable, "-c", script], "log", (tmp_path / "started").is_file)
    assert (tmp_path / "started").is_file()
    os.set_blocking(pipe, True)
    with open(pipe, "rb") as held:
        assert held.read() == b""  # returns when the child has ended


def test_a_program_that_ends_just_before_it_is_stopped_has_its_own_code(tmp_path, monkeypatch):
    start, started = subprocess.Popen, []

    def watch():
        os.waitid(os.P_PID, started[0].pid, os.WEXITED | os.WNOWAIT)
        return True

    def recorded(*arguments, **options):
        started.append(start(*arguments, **options))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", recorded)
    assert execute(tmp_path, ["sh", "-c", "sleep 0.2; exit 7"], "log", watch).code == 7


def test_a_signal_that_comes_while_a_program_is_started_ends_it_too(tmp_path, monkeypatch):
    start, started = subprocess.Popen, []

    def interrupted(*arguments, **options):
        started.append(start(*arguments, **options))
        signal.raise_signal(signal.SIGINT)
        return started[-1]

    def stop(_number, _frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, stop)
    try:
        monkeypatch.setattr(subprocess, "Popen", interrupted)
        with pytest.raises(KeyboardInterrupt):
            execute(tmp_path, ["sleep", "60"], "log")
        assert started[0].poll() is not None
        assert signal.getsignal(signal.SIGINT) is stop
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_program_that_stops_in_error_is_one_of_our_errors_with_its_last_words(tmp_path):
    with pytest.raises(ConvergenceError, match="sh stopped with code 7") as caught:
        succeed(tmp_path, ["sh", "-c", "echo last words; exit 7"], "log")
    assert caught.value.__notes__ == ["last words"]


def test_without_setpriv_programs_run_all_the_same(tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda _: None)
    terminate_with_parent.cache_clear()
    try:
        assert terminate_with_parent() == ()
        assert execute(tmp_path, ["true"], "log").code == 0
    finally:
        terminate_with_parent.cache_clear()


def descendants(process_id: int) -> list[int]:
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(stat.parent.name)] = int(stat.read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
    found = [process_id]
    for ancestor in found:
        found += [child for child, parent in parents.items() if parent == ancestor]
    return found[1:]


def name_and_state(process_id: int) -> tuple[str, str]:
    try:
        name, _, rest = (Path("/proc") / str(process_id) / "stat").read_text().partition("(")[2].rpartition(")")
    except OSError:
        return "", "X"
    return name, rest.split()[0]


@pytest.mark.openfoam
@pytest.mark.slow
@pytest.mark.skipif(not terminate_with_parent(), reason="no setpriv (util-linux) on this machine")
@pytest.mark.parametrize("processes", [1, 2])
def test_a_killed_parent_leaves_no_solver(pocket_file, tmp_path, processes):
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    parent = subprocess.Popen(
        [sys.executable, "-c", SOLVE.format(scene=str(pocket_file), processes=processes)],
        env={**os.environ, "TMPDIR": str(temporary)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + 120
    solvers = []
    while len(solvers) < processes and time.monotonic() < deadline:
        time.sleep(0.2)
        solvers = [one for one in descendants(parent.pid) if name_and_state(one)[0] in SOLVERS]
    children = descendants(parent.pid)
    parent.kill()
    parent.wait()
    assert len(solvers) == processes
    deadline = time.monotonic() + 30
    while any(name_and_state(one)[1] not in "XZ" for one in children) and time.monotonic() < deadline:
        time.sleep(0.2)
    left = [one for one in children if name_and_state(one)[1] not in "XZ"]
    for one in left:
        os.kill(one, signal.SIGKILL)
    assert left == []
    sweep(temporary)
    assert not list(temporary.iterdir())


@pytest.mark.parametrize("command", [["true"], ["dd", "if=/dev/zero", "of=big", "bs=1000", "count=9"], ["mpirun"]])
def test_a_full_disk_is_one_line_whatever_the_program_says(command, tmp_path):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4_000, before[1]))
    try:
        with pytest.raises(InputError, match=r"cannot be written \(File too large\); raise the limit"):
            execute(tmp_path, command, "log")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_program_learns_the_directory_of_its_case_and_not_that_of_the_command(tmp_path, monkeypatch):
    monkeypatch.setenv("PWD", "/somewhere else")
    assert execute(tmp_path, ["printenv", "PWD"], "log").log.strip() == str(tmp_path)
