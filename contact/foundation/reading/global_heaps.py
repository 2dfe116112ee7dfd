"""A check of the global heaps of HDF5 files, in which texts are stored.

The HDF5 library reads some damaged heaps without end, so they are checked before the library opens the file.

A collection of a heap begins with the signature "GCOL", version 1 and three zero bytes, and its length in 8 bytes. Its
objects follow, each with a header of 16 bytes: number (2), references (2), zeros (4), length (8). An object of number 0
is free space, whose length includes the header; the content of another fills a multiple of 8 bytes behind the header.
The library steps from each object to the next by its length; with a length of 0 it stays at one object for ever.

Source: HDF5 File Format Specification, version 3.0, section III.E.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import opened

SIGNATURE = b"GCOL\1\0\0\0"

HEADER_BYTES = 16
"""Length of the header of a collection, and of an object, bytes."""

MAX_BYTES = 1 << 32
"""Length at which a collection is refused, bytes."""

CHUNK_BYTES = 1 << 22
"""Number of bytes searched at a time."""


def refuse_endless_heaps(path: Path, remedy: str) -> None:
    """Check the objects of all collections in an HDF5 file; the file is read once.

    Parameters
    ----------
    path : the file; its lengths have 8 bytes, as h5py writes them.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If the file cannot be read, an object does not end inside its collection, or two collections overlap.
    """
    end = 0
    with opened(path, remedy) as file:
        for start in [*_collections(file)]:
            file.seek(start)
            length = _number(file.read(HEADER_BYTES), 8, 8) - HEADER_BYTES
            if start < end or not 0 <= length < MAX_BYTES or not _ends(file.read(length)):
                raise InputError(f"{path}: is damaged (texts at byte {start}); {remedy}")
            end = start + HEADER_BYTES + length


def _collections(file: BinaryIO) -> Iterator[int]:
    """The places of the signatures in a file."""
    place, data = 0, b""
    while chunk := file.read(CHUNK_BYTES):
        data += chunk
        found = data.find(SIGNATURE)
        while found >= 0:
            yield place + found
            found = data.find(SIGNATURE, found + 1)
        kept = min(len(data), len(SIGNATURE) - 1)
        place, data = place + len(data) - kept, data[len(data) - kept :]


def _ends(objects: bytes) -> bool:
    """Whether the objects of a collection follow each other to its end."""
    place, end = 0, len(objects)
    while place + HEADER_BYTES <= end:
        length = _number(objects, place + 8, 8)
        step = HEADER_BYTES + -(-length // 8) * 8 if _number(objects, place, 2) else length
        if not 0 < step <= end - place:
            return False
        place += step
    return True


def _number(data: bytes, start: int, length: int) -> int:
    return int.from_bytes(data[start : start + length], "little")
