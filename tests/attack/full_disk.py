"""Run every command that writes on a full disk, on which its outputs, temporary files or cache lie, or under a limit.

A point runs a command in a process that mounts a file system of its own, with a random amount of space, and then once
more with enough space. The first run ends with exit code 0, or with one line of error and exit code 2; it leaves whole
files under their final names, and no scratch. The second run ends as an undisturbed one, and keeps what was finished.
"""

import ctypes
import os
import pickle
import random
import resource
import shutil
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from attack import outputs
from attack.commands import COMMANDS
from attack.forked import Ended, Place, prepare
from attack.kills import Attack, Undisturbed, _finished, _incomplete
from attack.points import Finding, Point

NEW_MOUNTS, NEW_USER = 0x20000, 0x10000000
REMOUNT, BIND, PRIVATE_BELOW = 32, 4096, 16384 | 1 << 18
"""Flags of the system calls unshare and mount."""

ROOMY = 1 << 29
"""Size of a file system on which every command succeeds, bytes."""

LEAST, MOST = 4096, 1 << 20
"""Smallest and largest space that is left, or size of a file that is allowed, bytes."""

DISKS = {"work": ("work",), "temporary": ("temporary",), "cache": ("cache",), "all": ("work", "temporary", "cache")}
"""What lies on the full disk, by its name; "limit" is a limit of the size of each file instead."""

PLACES = (*DISKS, "limit")


def points(count: int, seed: int, commands: Sequence[str] = ()) -> Iterator[Point]:
    """Runs of all commands that can run here, on disks of all kinds.

    Parameters
    ----------
    count : number of runs.
    seed : seed of the first run; each later one has the next seed.
    commands : names of the commands, by default all that can run here.
    """
    reason = cannot_mount()
    if reason:
        sys.exit(f"full_disk: no file system can be mounted here ({reason})")
    prepare()
    here = [name for name, one in COMMANDS.items() if one.here and not one.slow and one.needs != "dask"]
    pairs = [(name, place) for name in here for place in PLACES if not commands or name in commands]
    random.Random(0).shuffle(pairs)
    folder = Path(tempfile.mkdtemp(prefix="full-disk-"))  # a forked command would remove a TemporaryDirectory
    attack = Attack(folder, None, frozenset())
    for number in range(seed, seed + count):
        name, where = pairs[number % len(pairs)]
        chance = random.Random(number)
        size = int(LEAST * (MOST / LEAST) ** chance.random())
        usual, place = attack.undisturbed(name), attack._place(name, f"disk-{number}")
        found = _in_child(lambda at=(attack, name, usual, place, where, size): _findings(*at))  # type: ignore[misc]
        yield Point(
            name=f"{name}: {where}, {size} bytes",
            repeat=" ".join(["full_disk", f"--seed {number} --count 1", *(f"--command {one!r}" for one in commands)]),
            effective=bool(found[0]),
            findings=found[1],
        )
        shutil.rmtree(place.folder)
    shutil.rmtree(folder)


def cannot_mount() -> str:
    """Why no file system can be mounted here; "" where one can."""

    def attempt() -> tuple[bool, tuple[Finding, ...]]:
        _enter_namespace()
        _mount(Path(tempfile.gettempdir()), LEAST)
        return True, ()

    return "; ".join(one.seen.strip().splitlines()[-1] for one in _in_child(attempt)[1])


def _findings(
    attack: Attack, name: str, usual: Undisturbed, place: Place, where: str, size: int
) -> tuple[bool, tuple[Finding, ...]]:
    """Whether a command met a full disk, and what is wrong."""
    prepare()  # this process is the parent of what the command leaves
    disk = place.folder / "disk"
    if where in DISKS:
        _enter_namespace()
        disk.mkdir()
        _mount(disk, ROOMY)
        for one in DISKS[where]:
            path: Path = getattr(place, one)
            shutil.copytree(path, disk / one)
            _mount(path, source=disk / one, flags=BIND)
        status = os.statvfs(disk)
        _mount(disk, (status.f_blocks - status.f_bfree) * status.f_frsize + size, flags=REMOUNT)
        first = attack._run(name, place, usual.limit_s)
        _mount(disk, ROOMY, flags=REMOUNT)
    else:
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
        first = attack._run(name, place, usual.limit_s)
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    found = [*attack._judged_end(first, usual.limit_s), *_wrong_end(first, where)]
    found += [Finding(kind="scratch", seen=one) for one in attack._scratch(place)]
    broken = _incomplete(place.work)
    found += broken
    if first.code == 0 and not broken:
        answers = {path: outputs.content(file) for path, file in outputs.files(place.work).items()}
        found += [Finding(kind="answer", seen=one) for one in outputs.differences(usual.answers, answers)][:6]
    elif not broken:
        found += attack._last(name, place, usual, _finished(place.work))
    return first.code == 2, tuple(found)


def _wrong_end(first: Ended, where: str) -> list[Finding]:
    """What is wrong with the exit code and the messages of a command on a full disk."""
    errors = [line for line in first.errors.splitlines() if line.startswith("error: ")]
    allowed = (0,) if where == "cache" else (0, 2)
    if first.code not in allowed or len(errors) != (first.code == 2):
        return [Finding(kind="answer", seen=f"exit code {first.code}, full {where}: {first.errors[-1500:]}")]
    return []


def _enter_namespace() -> None:
    """Give this process mounts of its own, which end with it; where it is not root, as root of a namespace of users."""
    libc, user, group = ctypes.CDLL(None, use_errno=True), os.getuid(), os.getgid()
    if libc.unshare(NEW_MOUNTS | (NEW_USER if user else 0)) != 0:
        raise OSError(ctypes.get_errno(), "the system allows no mounts of its own to a process")
    if user:
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    if libc.mount(b"none", b"/", None, PRIVATE_BELOW, None) != 0:
        raise OSError(ctypes.get_errno(), "mounts cannot be made private")


def _mount(directory: Path, size: int | None = None, *, source: Path = Path("none"), flags: int = 0) -> None:
    """Mount a file system of a size, bytes, in memory, change its size, or bind another directory."""
    libc = ctypes.CDLL(None, use_errno=True)
    options = None if size is None else f"size={size}".encode()
    if libc.mount(os.fsencode(source), os.fsencode(directory), b"tmpfs", flags, options) != 0:
        raise OSError(ctypes.get_errno(), f"{directory}: nothing can be mounted")


def _in_child(call: Callable[[], tuple[bool, tuple[Finding, ...]]]) -> tuple[bool, tuple[Finding, ...]]:
    """The return value of a call in a fork of this process; an exception is a finding."""
    reader, writer = os.pipe()
    process = os.fork()
    if process == 0:
        try:
            answer = call()
        except BaseException:
            answer = True, (Finding(kind="traceback", seen=traceback.format_exc()),)
        with os.fdopen(writer, "wb") as pipe:
            pickle.dump(answer, pipe)
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as pipe:
        answer = pickle.load(pipe)
    os.waitpid(process, 0)
    return answer
