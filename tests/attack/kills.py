"""Stop every command that writes at random moments, mostly by SIGKILL, and judge what is left.

A series of kills takes one directory: it kills the command up to five times, each time where the last one left it,
and then runs it to its end. A kill comes at a random time, exactly before a random change of files, or a few
milliseconds after one, so that it also reaches the short moments in which files are written.
"""

import itertools
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from attack import outputs
from attack.commands import COMMANDS, SCHEDULER, lay_out
from attack.forked import ROOT, Ended, Place, Stop, prepare, run, unused
from attack.points import Finding, Point, tracebacks

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.terminal.console import BAD_INPUT

SHARED_MEMORY = Path("/dev/shm")
"""The directory of shared memory, where MPI puts files."""

FIRST_RUN_S = 240.0
"""Limit of an undisturbed run, s: its loops may have to be compiled."""

MOST_KILLS = 5
"""Largest number of kills in a series."""

IMPORTS_S = 1.5
"""Time in which a new interpreter imports the modules of a command, s, on a machine that does nothing else."""

SLOW_IN = 4
"""A slow command has one series where the others have this many."""

SIGNALS, WEIGHTS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT), (6, 2, 2)
"""Signals that stop a command, and how often each is sent."""

SHOWN = 6
"""Differences that are shown of two answers."""


@dataclass(frozen=True, kw_only=True)
class Undisturbed:
    """What a command does when nobody kills it: its end, the limit of later runs, s, and its answers by file."""

    ended: Ended
    limit_s: float
    answers: Mapping[str, Any]


class Attack:
    """Kills in a directory of their own; what commands do undisturbed is found once."""

    def __init__(self, folder: Path, scheduler: str | None, known: frozenset[int]) -> None:
        self.folder, self.scheduler, self.known = folder, scheduler, known
        self._undisturbed: dict[str, Undisturbed] = {}

    def series(self, name: str, seed: int) -> Iterator[Point]:
        """The kills of a series on a command; the judgement of the run after them is part of the last one."""
        repeat = f"kills --seed {seed} --count 1 --command {name!r}"
        try:
            usual = self.undisturbed(name)
        except AssertionError as error:
            fault = Finding(kind="answer", seen=str(error)[-2000:])
            yield Point(name=f"{name}: undisturbed", repeat=repeat, effective=False, findings=(fault,))
            return
        chance = random.Random(seed)
        place = self._place(name, f"series-{seed}")
        points: list[Point] = []
        kept: dict[str, Any] = {}
        known: set[str] = set()
        shared = set(os.listdir(SHARED_MEMORY))
        for _ in range(chance.randint(1, MOST_KILLS)):
            stop = random_stop(chance, usual.ended)
            ended = self._run(name, place, usual.limit_s, stop)
            findings = self._judged_end(ended, usual.limit_s)
            left = set(self._scratch(place))
            if ended.stopped and ended.code != -stop.number:  # it was not ended at once, as by SIGKILL
                findings += [Finding(kind="scratch", seen=one) for one in sorted(left - known)]
                findings += _judged_stop(name, ended, stop, usual.ended)
            known = left
            findings += _incomplete(place.work)
            held = _finished(place.work)
            findings += _lost(kept, held)
            kept = held
            reached = ended.stopped and ended.code != usual.ended.code
            points.append(Point(name=f"{name}: {stop}", repeat=repeat, effective=reached, findings=tuple(findings)))
        last = self._last(name, place, usual, kept)
        if COMMANDS[name].needs == "mpi":
            last += [Finding(kind="scratch", seen=one) for one in unused(set(os.listdir(SHARED_MEMORY)) - shared)]
        points[-1] = replace(points[-1], findings=(*points[-1].findings, *last))
        if not any(point.findings for point in points):
            shutil.rmtree(place.folder)
        yield from points

    def undisturbed(self, name: str) -> Undisturbed:
        """What a command does when nobody kills it."""
        if name not in self._undisturbed:
            place = self._place(name, "undisturbed")
            ended = self._run(name, place, FIRST_RUN_S)
            assert ended.code == 0, f"{name}: {ended.errors}"
            answers = {path: outputs.content(file) for path, file in outputs.files(place.work).items()}
            limit = 60.0 + 20.0 * ended.seconds
            self._undisturbed[name] = Undisturbed(ended=ended, limit_s=limit, answers=answers)
            shutil.rmtree(place.folder)
        return self._undisturbed[name]

    def _place(self, name: str, purpose: str) -> Place:
        """A directory with the files of a command, after the commands that come before it."""
        template = Place(folder=self.folder / f"before {name}".replace(" ", "-").replace(",", ""))
        if not template.folder.exists():
            lay_out(template.work)
            template.make()
            for words in COMMANDS[name].before:
                ended = run(words, template, limit_s=FIRST_RUN_S, known=self.known)
                assert ended.code == 0, f"{words}: {ended.errors}"
        place = Place(folder=self.folder / f"{purpose}-{template.folder.name}")
        shutil.rmtree(place.folder, ignore_errors=True)
        shutil.copytree(template.folder, place.folder)
        return place

    def _run(self, name: str, place: Place, limit_s: float, stop: Stop | None = None) -> Ended:
        words = [str(self.scheduler) if word == SCHEDULER else word for word in COMMANDS[name].words]
        return run(words, place, limit_s=limit_s, stop=stop, known=self.known)

    def _judged_end(self, ended: Ended, limit_s: float) -> list[Finding]:
        findings = tracebacks((ended.output, ended.errors))
        if ended.code is None:
            findings.append(Finding(kind="hang", seen=f"no end within {limit_s:.0f} s: {ended.errors[-300:]}"))
        findings += [Finding(kind="orphan", seen=line) for line in ended.orphans]
        return findings

    def _last(self, name: str, place: Place, usual: Undisturbed, kept: Mapping[str, Any]) -> list[Finding]:
        """Run the command to its end: the answers are those of the undisturbed run, and no scratch is left."""
        ended = self._run(name, place, usual.limit_s)
        findings = self._judged_end(ended, usual.limit_s)
        refused = COMMANDS[name].once and ended.code == BAD_INPUT
        if ended.code != usual.ended.code and not refused:
            findings.append(Finding(kind="answer", seen=f"exit code {ended.code}: {ended.errors[-500:]}"))
        findings += [Finding(kind="scratch", seen=one) for one in self._scratch(place)]
        broken = _incomplete(place.work)
        findings += broken
        if broken or (ended.code != 0 and not refused):
            return findings
        findings += _lost(kept, _finished(place.work))
        answers = {path: outputs.content(file) for path, file in outputs.files(place.work).items()}
        unlike = list(outputs.differences(usual.answers, answers))
        return findings + [Finding(kind="answer", seen=one) for one in unlike[:SHOWN]]

    @staticmethod
    def _scratch(place: Place) -> list[str]:
        return outputs.scratch(place.work, place.temporary, place.cache)


def random_stop(chance: random.Random, usual: Ended) -> Stop:
    """A random moment of a command, and a signal, mostly SIGKILL."""
    number = chance.choices(SIGNALS, WEIGHTS)[0]
    way = chance.randrange(10)
    if way == 0:
        return Stop(number=number, after_s=IMPORTS_S + chance.uniform(0.0, 1.0) * usual.seconds, fresh=True)
    if way <= 3 or not usual.changes:
        return Stop(number=number, after_s=chance.uniform(0.02, 1.0) * usual.seconds)
    change = chance.randint(1, usual.changes)
    if way <= 6:
        return Stop(change=change)
    return Stop(number=number, change=change, delay_s=chance.uniform(0.0, 0.01))


def points(count: int, seed: int, commands: Sequence[str] = ()) -> Iterator[Point]:
    """At least ``count`` kills, as the last series is taken to its end.

    Parameters
    ----------
    count : number of kills.
    seed : seed of the first series; each later one has the next seed.
    commands : names of the commands, by default all that can run here.
    """
    prepare()
    here = [name for name, one in COMMANDS.items() if one.here and (not commands or name in commands)]
    quick = [name for name in here if not COMMANDS[name].slow] or here
    order = [*here, *quick * (SLOW_IN - 1)]
    folder = Path(tempfile.mkdtemp(prefix="attack-"))
    done = 0
    with _cluster(folder / "cluster", any(COMMANDS[name].needs == "dask" for name in here)) as (scheduler, known):
        attack = Attack(folder, scheduler, known)
        for number in itertools.count():
            for point in attack.series(order[number % len(order)], seed + number):
                done += 1
                yield point
            if done >= count:
                break
    for path in folder.iterdir():
        if not path.name.startswith("series-"):
            shutil.rmtree(path)
    with suppress(OSError):
        folder.rmdir()  # the directories of series with faults stay


def _judged_stop(name: str, ended: Ended, stop: Stop, usual: Ended) -> list[Finding]:
    """What is wrong with the end of a command that was asked to stop: its exit code, and its line on what is left."""
    after = f"after signal {stop.number}"
    if ended.code not in (128 + stop.number, usual.code):
        return [Finding(kind="answer", seen=f"exit code {ended.code} {after}: {ended.errors[-500:]}")]
    lines = [line for line in ended.errors.splitlines() if "stopped" in line]
    if ended.code != usual.code and len(lines) != 1 and not COMMANDS[name].words[0].endswith(".py"):
        return [Finding(kind="answer", seen=f"{len(lines)} lines {after}: {ended.errors[-500:]}")]
    return []


def _incomplete(work: Path) -> list[Finding]:
    findings = []
    for path in outputs.files(work).values():
        try:
            outputs.content(path)
        except outputs.IncompleteError as error:
            findings.append(Finding(kind="incomplete", seen=str(error)))
    return findings


def _finished(work: Path) -> dict[str, Any]:
    try:
        return outputs.finished(work)
    except (OSError, LookupError):  # found already as an incomplete file
        return {}


def _lost(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[Finding]:
    findings = [Finding(kind="lost", seen=name) for name in before if name not in after]
    for name in before.keys() & after.keys():
        unlike = "; ".join(outputs.differences(before[name], after[name], costs=True))  # two NaN are alike
        if unlike:
            findings.append(Finding(kind="changed", seen=f"{name}: {unlike}"))
    return findings


@contextmanager
def _cluster(folder: Path, wanted: bool) -> Iterator[tuple[str | None, frozenset[int]]]:
    """The address of a dask scheduler with a worker, and their processes."""
    if not wanted:
        yield None, frozenset()
        return
    folder.mkdir(parents=True)
    address = folder / "address"
    started: list[subprocess.Popen[bytes]] = []
    options = ["--no-dashboard", "--host", "127.0.0.1"]

    def start(program: str, *words: str) -> None:
        command = [*terminate_with_parent(), sys.executable, "-m", f"distributed.cli.{program}", *words, *options]
        environment = {**os.environ, "TMPDIR": str(folder)}
        with (folder / f"{program}.log").open("w") as log:
            started.append(subprocess.Popen(command, cwd=ROOT, env=environment, stdout=log, stderr=log))

    try:
        start("dask_scheduler", "--port", "0", "--scheduler-file", str(address))
        deadline = time.monotonic() + 60
        while not address.exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        start("dask_worker", "--scheduler-file", str(address), "--nthreads", "1", "--no-nanny")
        yield json.loads(address.read_text())["address"], frozenset(process.pid for process in started)
    finally:
        for process in reversed(started):
            process.kill()
            with suppress(ChildProcessError):
                process.wait()
