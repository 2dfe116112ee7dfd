"""Files written completely or not at all, by renaming a temporary file, and locks that end with their process."""

import fcntl
import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside ``path``, which is renamed to ``path`` on success and removed on failure.

    If ``path`` is a symbolic link, the file that it points to is replaced.

    A reader sees the old file or the complete new one, even if the writer is killed.

    Raises
    ------
    InputError
        If the directory cannot be made or written, or ``path`` is a directory, a device or a pipe.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "table.txt"
    >>> with replacing(target) as scratch:
    ...     _ = scratch.write_text("done")
    >>> target.read_text()
    'done'
    """
    scratch = None
    try:
        path = _resolved(Path(path))
        if path.is_dir():
            raise InputError(f"{path}: is a directory; name a file")
        if path.exists() and not path.is_file():
            raise InputError(f"{path}: is a device or a pipe, which cannot be replaced whole; name a file")
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        scratch = Path(name)
        yield scratch
        scratch.chmod(0o666 & ~_umask())
        scratch.replace(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror or error}); choose another place") from error
    finally:
        if scratch is not None:
            scratch.unlink(missing_ok=True)


def write_json(entries: Mapping[str, Any], path: Path) -> None:
    """Write entries as a JSON file, completely or not at all.

    Raises
    ------
    InputError
        If the file cannot be written.
    ValueError
        If a number is infinite or NaN, which JSON does not have.
    """
    with replacing(path) as scratch:
        scratch.write_text(json.dumps(entries, indent=1, allow_nan=False) + "\n", encoding="utf-8")


@contextmanager
def locked(lock: Path, message: str) -> Iterator[None]:
    """Hold a lock file against every other process, then remove it; the lock also ends with this process.

    Parameters
    ----------
    lock : the lock file.
    message : message of the error if another process holds the lock; "{process}" in it becomes the id of that process.

    Raises
    ------
    InputError
        If another process holds the lock, or the lock file cannot be written.
    """
    while True:
        try:
            lock.parent.mkdir(parents=True, exist_ok=True)
            file = lock.open("a+", encoding="utf-8")
        except OSError as error:
            raise InputError(f"{lock.parent}: cannot be written ({error.strerror}); choose another place") from error
        with file:
            try:
                fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                file.seek(0)
                raise InputError(message.replace("{process}", file.read().strip() or "unknown")) from None
            if not is_at(file.fileno(), lock):  # removed by the last holder since it was opened
                continue
            file.truncate(0)
            file.write(str(os.getpid()))
            file.flush()
            try:
                yield
            finally:
                lock.unlink(missing_ok=True)
            return


def is_at(descriptor: int, path: Path) -> bool:
    """Whether an open file is the one at a path."""
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except FileNotFoundError:
        return False


def _resolved(path: Path) -> Path:
    try:
        return path.expanduser().resolve()
    except RuntimeError as error:  # raised by pathlib for an unknown home directory or circular links
        raise InputError(f"{path}: leads nowhere ({error}); choose another place") from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
