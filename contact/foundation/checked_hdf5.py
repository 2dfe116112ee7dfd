"""HDF5 files of our own, behind a digest: what was damaged or changed is told and never opened.

The HDF5 file stands behind a block of 512 bytes, as that format allows, which holds a mark and the digest of all that
follows. A damaged file can crash or hang the library that reads it.
"""

import hashlib
import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing

HEADER_BYTES = 512
CHUNK_BYTES = 1 << 22


def header_block(mark: bytes, digest: str) -> bytes:
    """The first bytes of a file that has the digest."""
    return (mark + digest.encode() + b"\n").ljust(HEADER_BYTES, b"\0")


def content_digest(path: Path) -> str:
    """Of all that follows the block."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        file.seek(HEADER_BYTES)
        while piece := file.read(CHUNK_BYTES):
            digest.update(piece)
    return digest.hexdigest()


def has_mark(path: Path, mark: bytes) -> bool:
    """Whether a file begins with a mark, whatever its name; OSError if it cannot be read."""
    with path.open("rb") as file:
        return file.read(len(mark)) == mark


def refuse_damaged(path: Path, mark: bytes, remedy: str) -> None:
    """InputError if a file does not begin with the mark and the digest of what follows."""
    with path.open("rb") as file:
        if file.read(HEADER_BYTES) != header_block(mark, content_digest(path)):
            raise InputError(f"{path}: was damaged or changed since it was written; {remedy}")


def write_checked(path: Path, mark: bytes, fill: Callable[[h5py.File], None]) -> None:
    """Write a file whole or not at all, the same contents always as the same bytes.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=HEADER_BYTES) as file:
        fill(file)
    data = memory.getvalue()[HEADER_BYTES:]
    with replacing(path) as scratch:
        scratch.write_bytes(header_block(mark, hashlib.sha256(data).hexdigest()) + data)


@contextmanager
def open_checked(path: Path, mark: bytes, schema: int, remedy: str) -> Iterator[h5py.File]:
    """Open a file whose digest is right and whose attribute ``schema`` is this.

    Raises
    ------
    InputError
        If it was damaged or changed, or is of another version; ``remedy`` says what to do.
    """
    refuse_damaged(path, mark, remedy)
    with h5py.File(path, "r") as file:
        if file.attrs["schema"] != schema:
            told = f"{path}: has schema {file.attrs['schema']}; this version reads {schema}"
            raise InputError(f"{told}, {remedy}")
        yield file
