"""HDF5 files with a checksum: a file that was damaged or changed is refused before it is opened.

A header of 512 bytes, which the HDF5 format allows as a user block, holds a mark and the SHA-256 digest of all bytes
that follow. A damaged file can crash or hang the HDF5 library.
"""

import hashlib
import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing

if TYPE_CHECKING:
    import h5py

HEADER_BYTES = 512
"""Length of the header, bytes: the smallest user block of HDF5."""

CHUNK_BYTES = 1 << 22
"""Number of bytes read at a time to compute a digest."""


def header_block(mark: bytes, digest: str) -> bytes:
    """The header of a file, 512 bytes: the mark, the digest of the content in hexadecimal, a line feed, and zeros."""
    return (mark + digest.encode() + b"\n").ljust(HEADER_BYTES, b"\0")


def content_digest(path: Path) -> str:
    """The SHA-256 digest, in hexadecimal, of all bytes after the header of a file."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        file.seek(HEADER_BYTES)
        while chunk := file.read(CHUNK_BYTES):
            digest.update(chunk)
    return digest.hexdigest()


def has_mark(path: Path, mark: bytes) -> bool:
    """Whether a file begins with a mark, whatever its name; raises OSError if it cannot be read."""
    with path.open("rb") as file:
        return file.read(len(mark)) == mark


def refuse_damaged(path: Path, mark: bytes, remedy: str) -> None:
    """Raise InputError if a file does not begin with the mark and the digest of its content."""
    with path.open("rb") as file:
        if file.read(HEADER_BYTES) != header_block(mark, content_digest(path)):
            raise InputError(f"{path}: was damaged or changed since it was written; {remedy}")


def write_checked(path: Path, mark: bytes, fill: "Callable[[h5py.File], None]") -> None:
    """Write an HDF5 file with its header, completely or not at all; equal contents give equal bytes.

    Parameters
    ----------
    path : the file; an existing one is replaced.
    mark : the first bytes of the file, which identify its content.
    fill : function that writes attributes and datasets into the open file.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    import h5py  # slow to import

    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=HEADER_BYTES) as file:
        fill(file)
    data = memory.getvalue()[HEADER_BYTES:]
    with replacing(path) as scratch:
        scratch.write_bytes(header_block(mark, hashlib.sha256(data).hexdigest()) + data)


@contextmanager
def open_checked(path: Path, mark: bytes, schema: int, remedy: str) -> "Iterator[h5py.File]":
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
        If the file was damaged or changed, or has another schema.
    OSError
        If the file cannot be read.
    """
    import h5py  # slow to import

    refuse_damaged(path, mark, remedy)
    with h5py.File(path, "r") as file:
        if file.attrs["schema"] != schema:
            raise InputError(f"{path}: has schema {file.attrs['schema']}; this version reads {schema}, {remedy}")
        yield file
