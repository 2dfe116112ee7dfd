"""Kinds of files that are written, and the rule what an output may replace: its own kind, and never an input."""

import json
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError

BEGINNING_BYTES = 65_536
"""Number of bytes at the beginning of a file that may identify its kind."""

_inputs: dict[tuple[int, int], Path] | None = None
"""The files that the command has read as inputs, by device and inode; None outside of a command."""


class OtherKindError(InputError):
    """An output would replace a file of another kind."""


@dataclass(frozen=True)
class Kind:
    """A kind of file that is written: what a file of it is called, with its article, and how one is recognised.

    Attributes
    ----------
    words : name in messages, such as "a page of roughfilm".
    holds : holds(path), whether an existing file is of this kind; it may raise OSError.
    """

    words: str
    holds: Callable[[Path], bool]


def beginning_with(words: str, *beginnings: bytes) -> Kind:
    """The kind of files that begin with one of several sequences of bytes."""
    return Kind(words, lambda path: beginning(path).startswith(beginnings))


def entries_from(key: str) -> Kind:
    """The kind of JSON files of this project that begin with a key."""
    return beginning_with(f"a JSON file of roughfilm that begins with {key!r}", f"{{\n {json.dumps(key)}:".encode())


def beginning(path: Path) -> bytes:
    """The first ``BEGINNING_BYTES`` bytes of a file; OSError if it cannot be read."""
    with path.open("rb") as file:
        return file.read(BEGINNING_BYTES)


SIGNATURE = b"\x89HDF\r\n\x1a\n"
"""The first bytes of an HDF5 file without a header of another kind."""

JSON = beginning_with("a JSON object", b"{")
PICTURE = beginning_with("a PNG picture", b"\x89PNG\r\n\x1a\n")
FIGURE = beginning_with("a figure of roughfilm", b'<?xml version="1.0" encoding="utf-8"?>\n<svg')
PAGE = Kind("a page of roughfilm", lambda path: " – roughfilm</title>".encode() in beginning(path))


@contextmanager
def protected_inputs() -> Iterator[None]:
    """Let no output replace a file that is read as an input in the block, which is a command.

    Programs that use the library may read a surface, change it, and save it under the same name.
    """
    global _inputs
    before, _inputs = _inputs, {}
    try:
        yield
    finally:
        _inputs = before


def as_input(path: Path) -> Path:
    """The path of a file that is read as an input; no output of the command replaces it, whatever its name."""
    if _inputs is not None:
        with suppress(OSError, RuntimeError):  # the reader reports them
            status = path.expanduser().stat()
            _inputs[status.st_dev, status.st_ino] = path.expanduser().resolve()
    return path


def refuse_to_replace(path: Path, kind: Kind, *, overwrite: bool = False) -> None:
    """Raise InputError if a file may not be replaced by one of a kind; a missing or an empty file may.

    The error is an OtherKindError if ``overwrite`` would allow it.

    Parameters
    ----------
    path : the file, which need not exist.
    kind : kind of the file that is written.
    overwrite : whether a file of another kind is replaced too; an input never is.
    """
    try:
        status = path.stat()
    except OSError:
        return
    if stat.S_ISDIR(status.st_mode):
        raise InputError(f"{path}: is a directory; name a file")
    if not stat.S_ISREG(status.st_mode):
        raise InputError(f"{path}: is a device or a pipe, which cannot be replaced whole; name a file")
    read = (_inputs or {}).get((status.st_dev, status.st_ino))
    if read is not None and read.exists() and read.samefile(path):
        raise InputError(f"{path}: is an input, which no output replaces; name another place")
    if overwrite or status.st_size == 0:
        return
    try:
        known = kind.holds(path)
    except OSError:
        known = False
    if not known:
        raise OtherKindError(f"{path}: exists and is not {kind.words}; name another place or remove it")


def resolved(path: Path) -> Path:
    """A path without links and "~"; InputError if it leads nowhere."""
    try:
        return path.expanduser().resolve()
    except RuntimeError as error:  # raised by pathlib for an unknown home directory or circular links
        raise InputError(f"{path}: leads nowhere ({error}); choose another place") from error
