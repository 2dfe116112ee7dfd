"""Scratch directories that end with their process: what a killed process leaves, the next one removes.

A directory ``roughfilm-HOST-…`` has beside it a lock file of the same name and the suffix ``.lock``, which is made
before the directory and removed after it. Its process holds the lock as long as it lives, so that a lock that is free
says that its process was killed. ``HOST`` identifies the machine: on a file system that several machines share, each
removes what is its own.
"""

import fcntl
import os
import re
import secrets
import shutil
import signal
import tempfile
import threading
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from roughfilm.contact.foundation.errors import REMEDIES, unwritable

SHARED_MEMORY = Path("/dev/shm")
"""The directory of memory that processes share."""

HOST = f"{zlib.crc32(os.uname().nodename.encode()):08x}"
"""Part of the names that identifies this machine."""

LOCKS = re.compile(rf"\.?roughfilm-{HOST}-[0-9a-f]{{8}}\.lock")
"""Names of the lock files of this machine."""

STOPS = frozenset({signal.SIGINT, signal.SIGTERM})
"""Signals that ask a process to stop."""


@contextmanager
def scratch_directory(beside: Path | None = None) -> Iterator[Path]:
    """Yield an empty directory, which is removed at the end, or by the next process if this one is killed.

    Parameters
    ----------
    beside : a path; the directory is a hidden one in the same directory. By default it is in the temporary directory.

    Raises
    ------
    OSError
        If the directory cannot be made beside the path.
    InputError
        If it cannot be made or written in the temporary directory.
    """
    if beside is not None:
        with _made(beside.parent, ".") as place:
            yield place
        return
    parent = temporary_directory()
    try:
        with _made(parent, "") as place:
            yield place
    except OSError as error:
        if not _concerns_scratch(parent, error):
            raise
        raise unwritable(parent, error, remedy="set TMPDIR to another directory") from error


def _concerns_scratch(parent: Path, error: OSError) -> bool:
    """Whether an error of the system names a scratch file in a directory, or names no file and lacks space."""
    if error.filename is None:
        return error.errno in REMEDIES
    return str(error.filename).startswith(f"{parent}/roughfilm-{HOST}-")


def temporary_directory() -> Path:
    """The directory for temporary files, that of TMPDIR, TEMP or TMP, or ``/tmp``.

    Python's own search writes a file of a random name into it, which a process leaves if it is killed just then; here
    the permissions are looked at instead.
    """
    if tempfile.tempdir is None:
        named = [os.environ[name] for name in ("TMPDIR", "TEMP", "TMP") if os.environ.get(name)]
        places = [place for place in (*named, "/tmp") if os.path.isdir(place) and os.access(place, os.W_OK | os.X_OK)]
        tempfile.tempdir = os.path.abspath(places[0]) if places else None
    return Path(tempfile.gettempdir())


@contextmanager
def _made(parent: Path, before: str) -> Iterator[Path]:
    """Yield a scratch directory in a directory; ``before`` precedes its name.

    Only the process that made it removes it, and not a fork of that process.
    """
    _sweep_once(parent)
    owner = os.getpid()
    held: tuple[Path, int] | None = None
    try:
        with _stops_held():
            held = lock, _ = _locked(parent, before)
            place = lock.with_suffix("")
            place.mkdir(mode=0o700)
        yield place
    finally:
        if held is not None:
            with _stops_held():
                lock, descriptor = held
                if os.getpid() == owner:
                    _remove(lock.with_suffix(""), lock)
                os.close(descriptor)


@contextmanager
def _stops_held() -> Iterator[None]:
    """Hold signals to stop, whose exceptions would part a lock file from its directory, until the end of the block.

    Handlers are replaced: a mask of this thread would leave the signal to another one, and the exception still comes
    here. Other threads than the main one get no such exceptions.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    before = {number: handler for number in STOPS if (handler := signal.getsignal(number)) is not None}
    try:
        for number in before:
            signal.signal(number, lambda got, _: came.append(got))
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


def sweep(directory: Path) -> None:
    """Remove the scratch directories in a directory whose processes have ended without doing so."""
    with suppress(OSError):
        for name in [name for name in os.listdir(directory) if LOCKS.fullmatch(name)]:
            with suppress(OSError):
                _remove_unowned(directory / name)


def sweep_machine() -> None:
    """Remove what killed processes left in the temporary directory and in the shared memory of this machine."""
    with suppress(OSError):
        sweep(temporary_directory())
    sweep(SHARED_MEMORY)


def is_at(descriptor: int, path: Path) -> bool:
    """Whether an open file is the one at a path."""
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except FileNotFoundError:
        return False


@cache
def _sweep_once(directory: Path) -> None:
    """Sweep a directory at its first use in this process."""
    sweep(directory)


def _locked(parent: Path, before: str) -> tuple[Path, int]:
    """A new lock file, and the descriptor that holds it; where the file system has no locks it is held by none."""
    while True:
        lock = parent / f"{before}roughfilm-{HOST}-{secrets.token_hex(4)}.lock"
        with suppress(FileExistsError):
            descriptor = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:  # another process sweeps it
                os.close(descriptor)
                continue
            except OSError:  # no locks
                return lock, descriptor
            if is_at(descriptor, lock):
                return lock, descriptor
            os.close(descriptor)


def _remove_unowned(lock: Path) -> None:
    """Remove a lock file and its directory if no process holds the lock; OSError if one does."""
    if lock.lstat().st_uid != os.getuid():
        return
    descriptor = os.open(lock, os.O_RDWR | os.O_NOFOLLOW)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if is_at(descriptor, lock):
            _remove(lock.with_suffix(""), lock)
    finally:
        os.close(descriptor)


def _remove(place: Path, lock: Path) -> None:
    """Remove a scratch directory, then its lock file; a later sweep does it if another process still writes there."""
    try:
        place.rmdir()  # the usual case, an empty directory, is fast
    except OSError:
        shutil.rmtree(place, ignore_errors=True)
        if place.exists():
            return
    lock.unlink(missing_ok=True)
