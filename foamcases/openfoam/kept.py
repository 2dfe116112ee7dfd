"""Read what the script ``Allrun`` of a case left: how its programs ended, their times, and the release of OpenFOAM."""

import re
from collections.abc import Iterator
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError, Outcome
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.foamcases.openfoam.allrun import DIGESTS, EXIT_CODE, FINISHED, RUNNING, SETTLED
from roughfilm.foamcases.openfoam.dialect import Family, Release, dialect_named
from roughfilm.foamcases.openfoam.iterate import Asked, Settled, Try, second, tried
from roughfilm.foamcases.openfoam.program import Ended, failure
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals

TIMES = re.compile(r"^ExecutionTime = (\S+) s\s+ClockTime = (\S+) s", re.MULTILINE)
"""Line of a log with the CPU time of one process and the wall-clock time since its start."""

PROCESSES = re.compile(r"^nProcs\s*: (\d+)", re.MULTILINE)
"""Line of a log with the number of processes."""

CODE = re.compile(rf"^{EXIT_CODE} (\d+)$", re.MULTILINE)

RELEASES: tuple[tuple[Family, re.Pattern[str]], ...] = (
    ("com", re.compile(r"^Build\s*:.*\bOPENFOAM=(\d+)", re.MULTILINE)),
    ("org", re.compile(r"openfoam\.org.*?\bVersion:\s+([^\s|-]+)", re.DOTALL)),
)
"""Each family with the lines of a log that state the number of its release."""

MAX_LOG_BYTES = 1_000_000_000
"""Largest size of a log that is read, bytes."""

BANNER_LENGTH = 2000
"""Number of first characters of a log that state the release."""


def is_finished(directory: Path) -> bool:
    """Whether ``Allrun`` of a case has come to its end, with success or without."""
    return (directory / FINISHED).is_file()


def exit_code(directory: Path) -> str:
    """The exit code that ``Allrun`` of a case wrote at its end, as text."""
    return _text(directory / FINISHED).strip()


def digests_at_end(directory: Path) -> dict[str, str]:
    """The SHA-256 digest of each file of a case at the end of its run, by its path; empty if ``Allrun`` took none."""
    path = directory / DIGESTS
    if not path.is_file():
        return {}
    pairs = (line.partition(" ") for line in _text(path).splitlines())
    return {name.lstrip(" *").removeprefix("./"): digest for digest, _, name in pairs}


def runner(directory: Path) -> str:
    """The host and process of the ``Allrun`` that holds the lock of a case, in words; "" if none does."""
    try:
        host, _, process = _text(directory / RUNNING).strip().partition(" ")
    except InputError:  # there is none, or it has just ended
        return ""
    return f"{host} (process {process})"


def was_started(directory: Path) -> bool:
    """Whether ``Allrun`` of a case has run a program."""
    return next(directory.glob("**/log.*"), None) is not None


def ended(directory: Path, log_name: str) -> Ended:
    """The end of a program that ``Allrun`` ran.

    Raises
    ------
    ConvergenceError
        If the log is missing or does not end with an exit code.
    """
    path = directory / log_name
    try:
        log = _text(path)
    except InputError:
        raise failure(f"{path} is missing; run the case again", "") from None
    code = CODE.search(log)
    if code is None:
        raise failure(f"{path} ends without an exit code of Allrun; run the case again", log)
    cpu, _ = _times(log)
    return Ended(code=int(code[1]), log=log[: code.start()], cpu_s=cpu)


def kept_tries(directory: Path, asked: Asked, judged: Judged, settled: Settled | None) -> tuple[Try, ...]:
    """The tries of a flow that ``Allrun`` ran, as :func:`roughfilm.foamcases.openfoam.iterate.iterate` returns them."""

    def attempt(log_name: str, end: Settled | None = None) -> Try:
        done, residuals = ended(directory, log_name), Residuals(directory / log_name, judged)
        residuals.read()
        still = end is not None and done.code == 0 and (SETTLED in done.log or end(residuals))
        return tried(done, residuals, asked.tolerance, settled=still)

    first = attempt("log.simpleFoam", settled)
    if first.outcome is Outcome.CONVERGED or not (directory / "log.start").is_file():
        return (first,)
    start = attempt("log.start")
    rest = attempt("log.retry", settled) if start.outcome is Outcome.CONVERGED else None
    return (first, second(start, rest))


def latest_iteration(directory: Path) -> int:
    """The number of the last iteration whose fields are on disk; 0 if there are only the initial ones."""
    return max((int(path.name) for path in directory.iterdir() if path.name.isdecimal() and path.is_dir()), default=0)


def wall_time(directory: Path) -> float:
    """The sum of the wall-clock times, s, in all logs of a case; OpenFOAM states whole seconds."""
    return sum(_times(log)[1] for log in _logs(directory))


def release_of(directory: Path, dialect: str) -> str:
    """The release of OpenFOAM that ran a case, as its logs state it.

    Raises
    ------
    InputError
        If the release does not read the dialect in which the case is written.
    """
    for banner in (log[:BANNER_LENGTH] for log in _logs(directory)):
        for family, pattern in RELEASES:
            if found := pattern.search(banner):
                release = Release(family=family, number=found[1])
                if release.dialect.name != dialect:
                    raise InputError(f"{directory}: {dialect_named(dialect).refusal}")
                return str(release)
    return "OpenFOAM, version unknown"


def _text(log: Path) -> str:
    return read_bytes(log, MAX_LOG_BYTES, "run the case again").decode("utf-8", "replace")


def _logs(directory: Path) -> Iterator[str]:
    """The text of each log of a case."""
    for path in sorted(directory.glob("**/log.*")):
        if path.is_file():
            yield _text(path)


def _times(log: str) -> tuple[float, float]:
    """The CPU time of all processes and the wall-clock time of a program, s; 0 if its log states none."""
    found = TIMES.findall(log)
    if not found:
        return 0.0, 0.0
    processes = PROCESSES.search(log)
    try:
        cpu, wall = map(float, found[-1])
    except ValueError:
        return 0.0, 0.0
    return cpu * (int(processes[1]) if processes else 1), wall
