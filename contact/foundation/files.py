"""Files that are whole or absent: written beside their place, then renamed into it; locks that end with a process."""

import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a scratch path beside ``path``; rename it into place on success, remove it on failure; a link is followed.

    A reader sees the old file or the new one, never a part of it, even if the writer is killed.

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


@contextmanager
def locked(lock: Path, told: str) -> Iterator[None]:
    """Hold a lock file against every other process until the end, then remove it; it ends with this process anyhow.

    Parameters
    ----------
    told : who is in the way, for the error: "{process}" in it becomes the number of the process that holds the lock.

    Raises
    ------
    InputError
        If another process holds it, or it cannot be written.
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
                raise InputError(told.replace("{process}", file.read().strip() or "unknown")) from None
            if not _is_at(file.fileno(), lock):  # removed by the last holder since it was opened
                continue
            file.truncate(0)
            file.write(str(os.getpid()))
            file.flush()
            try:
                yield
            finally:
                lock.unlink(missing_ok=True)
            return


def _is_at(descriptor: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except FileNotFoundError:
        return False


def _resolved(path: Path) -> Path:
    try:
        return path.expanduser().resolve()
    except RuntimeError as error:  # pathlib's word for a home that is not known and for links that go in circles
        raise InputError(f"{path}: leads nowhere ({error}); choose another place") from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
