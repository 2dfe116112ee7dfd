"""Run a program of OpenFOAM in a case to its end: keep its log, measure its CPU time, leave no process running."""

import errno
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome, unwritable, writing
from roughfilm.contact.foundation.writing.scratch import SHARED_MEMORY, scratch_directory
from roughfilm.foamcases.openfoam.installation import Installation, installation

POLL_INTERVAL_S = 0.02
"""Time between two checks of a running program, s."""

STOP_TIME_S = 5.0
"""Time after which a stopped program that still runs is killed, s; mpirun needs it to end its processes."""

LOG_TAIL_LINES = 12
"""Number of last lines of a log that an error quotes."""

FILE_TOO_LARGE = (-signal.SIGXFSZ, 128 + signal.SIGXFSZ)
"""Exit codes of a program, and of mpirun, after a write beyond the limit of the size of a file."""

LEAST_SPACE_BYTES = 1 << 16
"""Space that must be left during a run, bytes: OpenFOAM ends without an error where a disk is full."""

MPI_SPACE_BYTES = 1 << 24
"""Space that mpirun needs for temporary files, bytes: Open MPI takes 8.2 MB, and can wait for ever without them."""

SPACE_INTERVAL_S = 1.0
"""Time between two checks of the space that is left, s."""

MPI_PLACES = ("TMPDIR", "OMPI_MCA_btl_vader_backing_directory", "OMPI_MCA_btl_sm_backing_directory")
"""Environment variables that say where Open MPI puts its files and its shared memory."""

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

    Raises
    ------
    InputError
        If the disk is full while the command runs or at its end, there is no space for the files of mpirun, or the
        limit of the size of a file is reached.
    """
    log, here = directory / log_name, installation()
    process = None
    with _environment(here, command) as environment:
        if command[0] == "mpirun":
            _refuse_full(Path(environment.get("TMPDIR") or "/tmp"), MPI_SPACE_BYTES)
        try:
            with log.open("wb") as output, uninterrupted():
                process = subprocess.Popen(
                    [*terminate_with_parent(), *here.command, *command],
                    cwd=directory,
                    env={**environment, "PWD": str(directory.absolute())},  # OpenFOAM believes it
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=output,
                    process_group=0,  # so that its children end with it
                )
            checked = time.monotonic()
            while True:
                ended, status, used = os.wait4(process.pid, os.WNOHANG)
                if ended:
                    break
                if time.monotonic() > checked + SPACE_INTERVAL_S:
                    _refuse_full(directory)
                    checked = time.monotonic()
                if watch():
                    os.kill(process.pid, signal.SIGTERM)  # Popen.terminate may collect the end that wait4 waits for
                time.sleep(POLL_INTERVAL_S)
        except BaseException:
            if process is not None:
                _stop(process)
            raise
        finally:
            if process is not None:
                _signal(process, signal.SIGKILL)  # the children that it left
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode in FILE_TOO_LARGE:
        raise unwritable(directory, OSError(errno.EFBIG, os.strerror(errno.EFBIG)))
    _refuse_full(directory)
    text = log.read_text(encoding="utf-8", errors="replace")
    return Ended(code=process.returncode, log=text, cpu_s=used.ru_utime + used.ru_stime)


def _refuse_full(directory: Path, size: int = LEAST_SPACE_BYTES) -> None:
    """Raise InputError if there is no space for another file of a size, bytes, in a directory."""
    with writing(directory), tempfile.TemporaryFile(dir=directory) as probe:
        os.posix_fallocate(probe.fileno(), 0, size)


@contextmanager
def _environment(here: Installation, command: Sequence[str]) -> Iterator[Mapping[str, str]]:
    """Yield the environment of a command; files that MPI leaves when it is killed are in a scratch directory.

    A command put in front, such as that of a container, may not see the directory and has its own.
    """
    if command[0] != "mpirun":
        yield here.environment
        return
    if here.command:
        _refuse_full(Path(os.environ.get("TMPDIR") or "/tmp"), MPI_SPACE_BYTES)
        yield here.environment
        return
    roomy = os.access(SHARED_MEMORY, os.W_OK) and shutil.disk_usage(SHARED_MEMORY).free > 2 * MPI_SPACE_BYTES
    beside = SHARED_MEMORY / "mpi" if roomy else None
    with scratch_directory(beside) as place:
        _refuse_full(place, MPI_SPACE_BYTES)
        yield {**here.environment, **dict.fromkeys(MPI_PLACES, str(place))}


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


SEE_LOG = "see its log in the directory of the case, or the end of the log by 'roughfilm solve'"
"""Remedy for a program that stopped: a generated case keeps its log, and ``solve`` prints the end of it."""


def succeed(directory: Path, command: Sequence[str], log_name: str) -> Ended:
    """Run a command as ``execute`` does; ConvergenceError if its exit code is not 0."""
    return succeeded(execute(directory, command, log_name), command[0])


def succeeded(ended: Ended, program: str) -> Ended:
    """The end of a program; ConvergenceError if its exit code is not 0."""
    if ended.code != 0:
        raise failure(f"{program} stopped with code {ended.code}; {SEE_LOG}", ended.log)
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
    """Terminate a program with its children, and kill them if they still run after ``STOP_TIME_S``."""
    _signal(process, signal.SIGTERM)
    try:
        process.wait(STOP_TIME_S)
    except subprocess.TimeoutExpired:
        _signal(process, signal.SIGKILL)
        process.wait()


def _signal(process: "subprocess.Popen[bytes]", number: int) -> None:
    """Send a signal to all that is left of the process group of a program."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, number)
