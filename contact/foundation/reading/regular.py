"""Regular files: pipes, devices, sockets and directories are refused, since reading one can wait for ever."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError

KINDS = {
    stat.S_IFDIR: "a directory",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
"""Words for what is not a regular file, by the file type of its status."""


MAX_NAME_BYTES = 255
"""Largest length of a part of a path, bytes: that of all usual file systems."""


def named_path(place: str, name: object) -> Path:
    """The path of a name from a program; InputError for what is no name of a file, or too long for one.

    Examples
    --------
    >>> named_path("out", "results")
    PosixPath('results')
    >>> named_path("out", 7)
    Traceback (most recent call last):
    ...
    roughfilm.contact.foundation.errors.InputError: out: got 7 (int); give the name of a file or a directory
    """
    if not isinstance(name, str | os.PathLike) or not isinstance(found := os.fspath(name), str):
        raise InputError(
            f"{place}: got {repr(name)[:60]} ({type(name).__name__}); give the name of a file or a directory"
        )
    if "\0" in found or any(len(os.fsencode(part)) > MAX_NAME_BYTES for part in found.split(os.sep)):
        raise InputError(f"{place}: got {found!r:.60}; a name has no zero byte and up to {MAX_NAME_BYTES} bytes")
    return Path(found)


def file_size(path: Path, remedy: str) -> int:
    """The size of a regular file, bytes.

    Parameters
    ----------
    path : the file; "~" is the home directory.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If there is no such file, it is not a regular file, or its status cannot be read.

    Examples
    --------
    >>> try:
    ...     file_size(Path("/dev/zero"), "name a table")
    ... except InputError as error:
    ...     print(error)
    /dev/zero: is no file, but a device; name a table
    """
    with _readable(path, remedy):
        return _regular_size(path, path.expanduser().stat(), remedy)


def holds_data(path: Path, remedy: str) -> bool:
    """Whether a file exists and is not empty; errors are those of :func:`file_size` for a file that exists."""
    with _readable(path, remedy):
        try:
            status = path.expanduser().stat()
        except FileNotFoundError:
            return False
        return _regular_size(path, status, remedy) > 0


@contextmanager
def opened(path: Path, remedy: str) -> Iterator[BufferedReader]:
    """Open a regular file for reading; errors are those of :func:`file_size`, also while the block reads the file."""
    with _readable(path, remedy):
        _regular_size(path, path.expanduser().stat(), remedy)
        file = path.expanduser().open("rb")
    try:
        with file:
            yield file
    except OSError as error:
        raise _unreadable(path, error, remedy) from error


def read_bytes(path: Path, most: int, remedy: str) -> bytes:
    """The content of a regular file.

    Parameters
    ----------
    path : the file.
    most : size above which the file is refused unread, bytes.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If the file is larger, or cannot be read as in :func:`file_size`.
    """
    with opened(path, remedy) as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise InputError(f"{path}: is larger than {most} bytes; {remedy}")
    return data


def read_text(path: Path, most: int, remedy: str) -> str:
    """The content of a regular file in UTF-8, with or without a byte order mark; parameters as in `read_bytes`.

    Raises
    ------
    InputError
        If the file is not UTF-8, with its line, or for a reason of :func:`read_bytes`.
    """
    data = read_bytes(path, most, remedy)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(f"{path}:{line}: byte {error.start} is not UTF-8; save the file as UTF-8 text") from error


def _regular_size(path: Path, status: os.stat_result, remedy: str) -> int:
    if not stat.S_ISREG(status.st_mode):
        kind = KINDS.get(stat.S_IFMT(status.st_mode), "of another type")
        raise InputError(f"{path}: is no file, but {kind}; {remedy}")
    return status.st_size


@contextmanager
def _readable(path: Path, remedy: str) -> Iterator[None]:
    """Raise InputError in place of the errors of the operating system."""
    try:
        yield
    except FileNotFoundError as error:
        raise InputError(f"{path}: no such file; {remedy}") from error
    except OSError as error:
        raise _unreadable(path, error, remedy) from error
    except RuntimeError as error:  # raised by pathlib for an unknown home directory or circular links
        raise InputError(f"{path}: leads nowhere ({error}); {remedy}") from error
    except ValueError as error:  # raised for a null character in the name
        if isinstance(error, InputError):
            raise
        raise InputError(f"{str(path)!r:.80}: is no name of a file ({error}); {remedy}") from error


def _unreadable(path: Path, error: OSError, remedy: str) -> InputError:
    remedy = "allow reading it" if isinstance(error, PermissionError) else remedy
    return InputError(f"{path}: cannot be read ({error.strerror or error}); {remedy}")
