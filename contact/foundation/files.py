"""Files written completely or not at all, which replace only their own kind, and locks that end with their process."""

import fcntl
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError, unwritable
from roughfilm.contact.foundation.writing.kinds import Kind, entries_from, refuse_to_replace, resolved
from roughfilm.contact.foundation.writing.scratch import is_at, scratch_directory


@contextmanager
def replacing(path: Path, kind: Kind, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield a temporary path, which is renamed to ``path`` on success and removed on failure.

    If ``path`` is a symbolic link, the file that it points to is replaced.

    A reader sees the old file or the complete new one, even if the writer is killed.

    Parameters
    ----------
    path : the file.
    kind : kind of the file; an existing file of another kind is not replaced.
    overwrite : whether an existing file of another kind is replaced too.

    Raises
    ------
    InputError
        If the directory cannot be made or written, or ``path`` is an input, a file of another kind, a directory, a
        device or a pipe.

    Examples
    --------
    >>> import tempfile
    >>> from roughfilm.contact.foundation.writing.kinds import beginning_with
    >>> target = Path(tempfile.mkdtemp()) / "table.txt"
    >>> with replacing(target, beginning_with("a table", b"done")) as scratch:
    ...     _ = scratch.write_text("done")
    >>> target.read_text()
    'done'
    """
    try:
        path = resolved(Path(path))
        refuse_to_replace(path, kind, overwrite=overwrite)
        path.parent.mkdir(parents=True, exist_ok=True)
        with scratch_directory(beside=path) as place:
            scratch = place / path.name
            yield scratch
            refuse_to_replace(path, kind, overwrite=overwrite)
            scratch.chmod(0o666 & ~_umask())
            scratch.replace(path)
    except OSError as error:
        raise unwritable(path, error) from error


def write_json(entries: Mapping[str, Any], path: Path, *, overwrite: bool = False) -> None:
    """Write entries as a JSON file, completely or not at all; an existing file must begin with the same key.

    Raises
    ------
    InputError
        If the file cannot be written, or holds something else and ``overwrite`` is not set.
    ValueError
        If a number is infinite or NaN, which JSON does not have.
    """
    text = json.dumps(entries, indent=1, allow_nan=False) + "\n"
    with replacing(path, entries_from(next(iter(entries))), overwrite=overwrite) as scratch:
        scratch.write_text(text, encoding="utf-8")


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
            raise unwritable(lock.parent, error) from error
        with file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.seek(0)
                raise InputError(message.replace("{process}", file.read().strip() or "unknown")) from None
            except OSError as error:  # a file system without locks
                raise unwritable(lock, error, done="locked") from error
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


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
