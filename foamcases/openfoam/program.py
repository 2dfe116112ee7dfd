"""Run a program of OpenFOAM in a case to its end: keep its log, measure its CPU time, leave no process running."""

import os
import re
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.foamcases.openfoam.installation import environment

POLL_INTERVAL_S = 0.02
"""Time between two checks of a running program, s."""

STOP_TIME_S = 5.0
"""Time after which a stopped program that still runs is killed, s; mpirun needs it to end its processes."""

LOG_TAIL_LINES = 12
"""Number of last lines of a log that an error quotes."""

TRACE = re.compile(r"#\d+ ")
"""Pattern of a line of the stack trace that OpenFOAM prints after a floating-point exception."""

Watch = Callable[[], bool]
"""Function called every ``POLL_INTERVAL_S`` while a program runs; it returns True to stop the program."""


@dataclass(frozen=True, kw_only=True)
class Ended:
    """The end of a program: its exit code (minus the number of the signal that ended it), log and CPU time, s."""

    code: int
    log: str
    cpu_s: float


def execute(directory: Path, command: Sequence[str], log_name: str, watch: Watch = lambda: False) -> Ended:
    """Run a command in a directory, with its output in the file ``log_name`` there.

    The command is stopped when this process ends, for whatever reason.

    Parameters
    ----------
    directory : the directory in which the command runs.
    command : the program and its arguments.
    log_name : name of the log.
    watch : called while the command runs; the command is stopped when it returns True.
    """
    log = directory / log_name
    process = None
    try:
        with log.open("wb") as output, uninterrupted():
            process = subprocess.Popen(
                [*terminate_with_parent(), *command],
                cwd=directory,
                env=environment(),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
            )
        while True:
            ended, status, used = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            if watch():
                process.terminate()
            time.sleep(POLL_INTERVAL_S)
    except BaseException:
        if process is not None:
            _stop(process)
        raise
    process.returncode = os.waitstatus_to_exitcode(status)
    text = log.read_text(encoding="utf-8", errors="replace")
    return Ended(code=process.returncode, log=text, cpu_s=used.ru_utime + used.ru_stime)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Delay SIGTERM and SIGINT to the end of the block, so that no program is started and left without control.

    Outside of the main thread nothing is delayed.
    """
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread handles signals
        return
    came: list[int] = []
    before = {number: signal.signal(number, lambda n, _: came.append(n)) for number in (signal.SIGTERM, signal.SIGINT)}
    try:
        yield
    finally:
        for stop, handler in before.items():
            signal.signal(stop, signal.SIG_DFL if handler is None else handler)
        for number in came:
            signal.raise_signal(number)


def succeed(directory: Path, command: Sequence[str], log_name: str) -> Ended:
    """Run a command as ``execute`` does; ConvergenceError if its exit code is not 0."""
    ended = execute(directory, command, log_name)
    if ended.code != 0:
        raise failure(f"{command[0]} stopped with code {ended.code}; look into the log below", ended.log)
    return ended


def failure(
    reason: str, log: str, *, outcome: Outcome = Outcome.FAILED, iterations: int | None = None
) -> ConvergenceError:
    """The error for a run that failed, with its outcome, iterations and the last lines of its log."""
    tail = [line for line in log.splitlines() if line.strip() and not TRACE.match(line)][-LOG_TAIL_LINES:]
    error = ConvergenceError(f"OpenFOAM: {reason}", outcome=outcome, iterations=iterations)
    if tail:
        error.add_note("\n".join(tail))
    return error


def _stop(process: "subprocess.Popen[bytes]") -> None:
    process.terminate()
    try:
        process.wait(STOP_TIME_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
