"""Surfaces in HDF5 files: written completely or not at all; equal surfaces give equal bytes."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, write_checked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface

if TYPE_CHECKING:
    import h5py

SCHEMA = 1
MARK = b"roughfilm surface, HDF5 behind 512 bytes, sha256 "


def save_surface(surface: Surface, path: Path) -> None:
    """Write a surface to an HDF5 file.

    The datasets are ``heights``, m, [x, y], and ``invalid``; attributes are ``spacing``, ``periodic``, ``source``.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """

    def fill(file: "h5py.File") -> None:
        file.attrs["schema"] = SCHEMA
        file.attrs["spacing"] = surface.spacing
        file.attrs["spacing_unit"] = "m"
        file.attrs["periodic"] = surface.periodic
        file.attrs["source"] = json.dumps(surface.source, sort_keys=True, allow_nan=False)
        file.create_dataset("heights", data=surface.heights, compression="gzip", shuffle=True).attrs["unit"] = "m"
        if surface.invalid.any():
            file.create_dataset("invalid", data=surface.invalid, compression="gzip")

    write_checked(path, MARK, fill)


def is_surface(path: Path) -> bool:
    """Whether a file holds a surface written by :func:`save_surface`, whatever its name."""
    return has_mark(path, MARK)


def load_surface(path: Path) -> Surface:
    """Read a surface, bit for bit as it was saved.

    Raises
    ------
    InputError
        If the file was damaged or changed, or has another schema.
    """
    with open_checked(path, MARK, SCHEMA, "make it again") as file:
        shape = file["heights"].shape
        if shape[0] * shape[1] > MAX_POINTS:
            raise InputError(f"{path}: holds {shape[0]} x {shape[1]} points; at most {MAX_POINTS} are read")
        return Surface(
            heights=file["heights"][()],
            spacing=tuple(file.attrs["spacing"]),
            invalid=file["invalid"][()] if "invalid" in file else np.zeros(shape, dtype=bool),
            periodic=bool(file.attrs["periodic"]),
            source=json.loads(file.attrs["source"]),
        )
