"""HDF5 files with a checksum: a file that was damaged or changed is refused before it is opened.

A header of 512 bytes, which the HDF5 format allows as a user block, holds a mark and the SHA-256 digest of all bytes
that follow. A damaged file can crash or hang the HDF5 library.
"""

import hashlib
import io
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.global_heaps import refuse_endless_heaps
from roughfilm.contact.foundation.reading.hdf5_content import Content, Json, Numbers, Text
from roughfilm.contact.foundation.reading.regular import holds_data, opened
from roughfilm.contact.foundation.writing.kinds import SIGNATURE, Kind, beginning_with

if TYPE_CHECKING:
    import h5py

HEADER_BYTES = 512
"""Length of the header, bytes: the smallest user block of HDF5."""

CHUNK_BYTES = 1 << 22
"""Number of bytes read at a time to compute a digest."""


def header_block(mark: bytes, digest: str) -> bytes:
    """The header of a file, 512 bytes: the mark, the digest of the content in hexadecimal, a line feed, and zeros."""
    return (mark + digest.encode() + b"\n").ljust(HEADER_BYTES, b"\0")


def has_mark(path: Path, mark: bytes) -> bool:
    """Whether a file begins with a mark, whatever its name; raises InputError if it cannot be read."""
    with opened(path, "name a file") as file:
        return file.read(len(mark)) == mark


def refuse_damaged(path: Path, mark: bytes, remedy: str) -> None:
    """Raise InputError if a file does not begin with the mark and the digest of its content."""
    with opened(path, remedy) as file:
        header, digest = file.read(HEADER_BYTES), hashlib.sha256()
        while chunk := file.read(CHUNK_BYTES):
            digest.update(chunk)
    if header != header_block(mark, digest.hexdigest()):
        raise InputError(f"{path}: was damaged or changed since it was written; {remedy}")


def marked(mark: bytes) -> Kind:
    """The kind of files that begin with a mark."""
    return beginning_with(f"a file of {mark.partition(b',')[0].decode()}", mark)


def checked_bytes(mark: bytes, fill: "Callable[[h5py.File], None]", *, ordered: bool = False) -> bytes:
    """The bytes of an HDF5 file with its header; equal contents give equal bytes.

    Parameters
    ----------
    mark : the first bytes of the file, which identify its content.
    fill : function that writes attributes and datasets into the open file.
    ordered : whether names in the file keep the order in which they were written.
    """
    import h5py  # slow to import

    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=HEADER_BYTES, track_order=ordered) as file:
        fill(file)
    data = memory.getvalue()[HEADER_BYTES:]
    return header_block(mark, hashlib.sha256(data).hexdigest()) + data


def write_checked(path: Path, mark: bytes, fill: "Callable[[h5py.File], None]", *, overwrite: bool = False) -> None:
    """Write an HDF5 file with its header, completely or not at all; equal contents give equal bytes.

    Parameters
    ----------
    path : the file; an existing one with the same mark is replaced.
    mark : the first bytes of the file, which identify its content.
    fill : function that writes attributes and datasets into the open file.
    overwrite : whether any existing file is replaced, unless it is an input.

    Raises
    ------
    InputError
        If ``path`` cannot be written, or is another kind of file.
    """
    data = checked_bytes(mark, fill)
    with replacing(path, marked(mark), overwrite=overwrite) as scratch:
        scratch.write_bytes(data)


@contextmanager
def open_checked(path: Path, mark: bytes, schema: int, remedy: str) -> Iterator[Content]:
    """Open a file for reading after a check of its mark, its digest and its attribute ``schema``.

    Parameters
    ----------
    path : the file, which `write_checked` wrote.
    mark : the first bytes that the file must have.
    schema : the version of the file format that the attribute ``schema`` must hold.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or has another schema.
    """
    refuse_damaged(path, mark, remedy)
    with _open(path, "a whole HDF5 file", remedy) as content:
        if (found := content.one("@schema", Numbers(kind=int))) != schema:
            raise InputError(f"{path}: has schema {found}; this version reads {schema}, {remedy}")
        yield content


def write_inputs(file: "h5py.File", inputs: Inputs, schema: int) -> None:
    """Write the schema of a file and the inputs to which it belongs, by which ``open_if_of`` opens it again."""
    file.attrs["schema"] = schema
    file.attrs["digest"] = inputs.digest
    file.attrs["settings"] = json.dumps(inputs.settings, sort_keys=True, allow_nan=False)


def write_column(file: "h5py.File", name: str, column: Sequence[float] | Sequence[Sequence[float]], unit: str) -> None:
    """Write a column of numbers, or of rows of them, with its unit."""
    file.create_dataset(name, data=np.array(column, dtype=float)).attrs["unit"] = unit


@contextmanager
def open_if_of(
    inputs: Inputs, path: Path, mark: bytes, schema: int, *, kind: str, remedy: str
) -> Iterator[Content | None]:
    """Open a file as `open_checked` does if it belongs to these inputs; None if there is no file or an empty one.

    Parameters
    ----------
    inputs : the inputs whose digest the attribute ``digest`` of the file must hold; ``settings`` are for the message.
    path, mark, schema, remedy : as in `open_checked`.
    kind : what the file must hold, for the message.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, holds something else, or belongs to other inputs.
    """
    if not holds_data(path, remedy):
        yield None
        return
    if not has_mark(path, mark):
        raise InputError(f"{path}: is no {kind}; {remedy}")
    with open_checked(path, mark, schema, remedy) as content:
        stored = content.take({"@digest": Text(), "@settings": Json(kind=dict[str, Any])})
        if stored["@digest"] != inputs.digest:
            raise InputError(f"{path}: holds another {kind}, {inputs.difference(stored['@settings'])}; {remedy}")
        yield content


@contextmanager
def open_plain(path: Path, kind: str, remedy: str) -> Iterator[Content]:
    """Open an HDF5 file without a header, as older versions wrote it, for reading; its bytes are not checked.

    Parameters
    ----------
    path : the file.
    kind : what the file must be, for the message.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If the file is not HDF5 or cannot be read.
    """
    if not has_mark(path, SIGNATURE):
        raise InputError(f"{path}: is not {kind}; {remedy}")
    with _open(path, kind, remedy) as content:
        yield content


@contextmanager
def _open(path: Path, kind: str, remedy: str) -> Iterator[Content]:
    import h5py  # slow to import

    refuse_endless_heaps(path, remedy)
    try:
        file = h5py.File(path.expanduser(), "r", locking=False)
    except (OSError, RuntimeError, ValueError) as error:
        raise InputError(f"{path}: is not {kind}; {remedy}") from error
    with file:
        yield Content(file, path, remedy)
