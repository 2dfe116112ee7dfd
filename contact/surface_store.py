"""Surfaces in HDF5 of our own: written whole or not at all, the same surface always as the same bytes.

The HDF5 file stands behind a block of 512 bytes, as that format allows, which holds the digest of all that follows. A
file whose digest is wrong is never opened: a damaged one can crash or hang the library.
"""

import hashlib
import io
import json
from pathlib import Path

import h5py
import numpy as np

from contact.errors import InputError
from contact.files import replacing
from contact.surface import MOST_POINTS, Surface

SCHEMA = 1
MARK = b"roughfilm surface, HDF5 behind 512 bytes, sha256 "
BLOCK = 512


def save_surface(surface: Surface, path: Path) -> None:
    """Write ``heights`` (m, [x, y]) and ``invalid``, with ``spacing`` (m), ``periodic`` and ``source`` as attributes.

    Raises InputError if ``path`` cannot be written.
    """
    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=BLOCK) as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["spacing"] = surface.spacing
        file.attrs["spacing_unit"] = "m"
        file.attrs["periodic"] = surface.periodic
        file.attrs["source"] = json.dumps(surface.source, sort_keys=True, allow_nan=False)
        file.create_dataset("heights", data=surface.heights, compression="gzip", shuffle=True).attrs["unit"] = "m"
        if surface.invalid.any():
            file.create_dataset("invalid", data=surface.invalid, compression="gzip")
    data = memory.getvalue()[BLOCK:]
    with replacing(path) as scratch:
        scratch.write_bytes(_block(data) + data)


def _block(data: bytes) -> bytes:
    return (MARK + hashlib.sha256(data).hexdigest().encode() + b"\n").ljust(BLOCK, b"\0")


def is_surface(path: Path) -> bool:
    """Whether a file begins as our surfaces do, whatever its name."""
    with path.open("rb") as file:
        return file.read(len(MARK)) == MARK


def load_surface(path: Path) -> Surface:
    """Read a surface back as it was; InputError if the file was damaged or changed, or is of another version."""
    data = path.read_bytes()
    if data[:BLOCK] != _block(data[BLOCK:]):
        raise InputError(f"{path}: was damaged or changed since it was written; make it again")
    with h5py.File(io.BytesIO(data)) as file:
        if file.attrs["schema"] != SCHEMA:
            raise InputError(f"{path}: has schema {file.attrs['schema']}; this version reads {SCHEMA}, make it again")
        shape = file["heights"].shape
        if shape[0] * shape[1] > MOST_POINTS:
            raise InputError(f"{path}: holds {shape[0]} x {shape[1]} points; at most {MOST_POINTS} are read")
        return Surface(
            heights=file["heights"][()],
            spacing=tuple(file.attrs["spacing"]),
            invalid=file["invalid"][()] if "invalid" in file else np.zeros(shape, dtype=bool),
            periodic=bool(file.attrs["periodic"]),
            source=json.loads(file.attrs["source"]),
        )
