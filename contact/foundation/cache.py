"""Files that are kept in the user's cache directory for later runs: by digest, bounded in size, oldest use first out.

The directory is that of the environment variable ``ROUGHFILM_CACHE``, or ``roughfilm`` in ``XDG_CACHE_HOME``, or
``~/.cache/roughfilm``. A run without a directory that it can write computes the same and keeps nothing.
"""

import fcntl
import logging
import os
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.writing.scratch import sweep

VARIABLE = "ROUGHFILM_CACHE"
"""Environment variable with the directory."""

LIMIT_BYTES = 2_000_000_000
"""Largest size of all entries, bytes."""

FOLDERS = ("tables", "leakage")
"""Folders of the directory that hold entries."""

ENTRY = re.compile(r"[0-9a-f]{64}\.h5")
"""Names of entries: the digest of what determines them."""

LOCK = re.compile(r"[0-9a-f]{64}\.lock")
"""Names of locks, which a killed process leaves."""

LOCK_S = 86_400.0
"""Age above which locks are removed, s."""

WAIT_S = 0.2
"""Time between two attempts to take the lock of an entry, s."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A file of the cache: its ``path``, its ``size``, bytes, and the time of its last ``use``, s since 1970."""

    path: Path
    size: int
    use: float


def user_directory() -> Path:
    """The cache directory, whether or not it exists; raises InputError if the home directory is unknown."""
    named = os.environ.get(VARIABLE)
    home = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return Path(named).expanduser() if named else Path(home).expanduser() / "roughfilm"
    except RuntimeError as error:
        raise InputError(f"{VARIABLE}: {named or home}: {error}; set it to a directory") from error


def entry_path(folder: str, digest: str) -> Path | None:
    """The path of an entry; None, after a warning, where no directory can be made.

    Parameters
    ----------
    folder : one of ``FOLDERS``.
    digest : digest of what determines the entry, 64 hexadecimal digits.
    """
    try:
        path = user_directory() / folder / f"{digest}.h5"
        path.parent.mkdir(parents=True, exist_ok=True)
    except InputError as error:
        warn(str(error))
        return None
    except OSError as error:
        warn(f"{error.filename}: cannot be made ({error.strerror}); set {VARIABLE} to another directory")
        return None
    return path


@cache
def warn(reason: str) -> None:
    """Log once in a process that nothing is kept, with the reason."""
    logging.getLogger(__name__).warning("nothing is kept for later runs: %s", reason)


def use(path: Path) -> None:
    """Record that an entry is used now."""
    with suppress(OSError):
        os.utime(path)


def entries() -> list[Entry]:
    """All entries, the one whose last use is longest ago first."""
    found = []
    for path in _files(ENTRY):
        with suppress(OSError):
            status = path.stat()
            found.append(Entry(path=path, size=status.st_size, use=status.st_mtime))
    return sorted(found, key=lambda entry: (entry.use, entry.path))


def trim(limit: int = LIMIT_BYTES) -> list[Entry]:
    """Remove entries, longest unused first, until their size is at most a limit, bytes; return those removed.

    Locks that nobody has used for a day, and what killed processes left, are removed too.

    Raises
    ------
    InputError
        If an entry cannot be removed.
    """
    removed, known = [], entries()
    left = sum(entry.size for entry in known)
    for entry in known:
        if left <= limit:
            break
        try:
            entry.path.unlink(missing_ok=True)
        except OSError as error:
            raise InputError(f"{entry.path}: cannot be removed ({error.strerror}); change its permissions") from error
        left -= entry.size
        removed.append(entry)
    for path in _files(LOCK):
        with suppress(OSError):
            if time.time() - path.stat().st_mtime > LOCK_S:
                path.unlink()
    for folder in FOLDERS:
        sweep(user_directory() / folder)
    return removed


def _files(name: re.Pattern[str]) -> Iterator[Path]:
    """The files of the cache with a name of this form."""
    for folder in FOLDERS:
        with suppress(OSError, InputError):
            yield from [path for path in (user_directory() / folder).iterdir() if name.fullmatch(path.name)]


@contextmanager
def alone_with(path: Path, waiting: Callable[[], object]) -> Iterator[None]:
    """Hold the lock of an entry; where another process or thread holds it, wait until it is done or has ended.

    Where the file system has no locks, the block runs without one.

    Parameters
    ----------
    path : the entry.
    waiting : called regularly meanwhile.
    """
    try:
        descriptor = os.open(path.with_suffix(".lock"), os.O_RDWR | os.O_CREAT, 0o666)
    except OSError:
        yield
        return
    held = False
    try:
        while not held:
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                held = True
            except BlockingIOError:
                waiting()
                time.sleep(WAIT_S)
            except OSError:
                break
        yield
    finally:
        if held:
            with suppress(OSError):
                path.with_suffix(".lock").unlink()
        os.close(descriptor)
