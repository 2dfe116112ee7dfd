"""Surfaces in HDF5 files: written completely or not at all; equal surfaces give equal bytes."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, write_checked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.hdf5_content import Json, Layout, Numbers
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface

if TYPE_CHECKING:
    import h5py

SCHEMA = 1
MARK = b"roughfilm surface, HDF5 behind 512 bytes, sha256 "
REMEDY = "make it again"

LAYOUT: Layout = {
    "heights": Numbers(shape=("nx", "ny")),
    "invalid": Numbers(shape=("nx", "ny"), kind=bool, optional=True),
    "@spacing": Numbers(shape=(2,)),
    "@periodic": Numbers(kind=bool),
    "@source": Json(kind=dict[str, Any]),
}
"""What a file of a surface holds."""


def save_surface(surface: Surface, path: Path, *, overwrite: bool = False) -> None:
    """Write a surface to an HDF5 file.

    The datasets are ``heights``, m, [x, y], and ``invalid``; attributes are ``spacing``, ``periodic``, ``source``.

    Raises
    ------
    InputError
        If ``path`` cannot be written, or holds anything but a surface and ``overwrite`` is not set.
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

    write_checked(path, MARK, fill, overwrite=overwrite)


def is_surface(path: Path) -> bool:
    """Whether a file holds a surface written by :func:`save_surface`; InputError if the file cannot be read."""
    return has_mark(path, MARK)


def load_surface(path: Path) -> Surface:
    """Read a surface, bit for bit as it was saved.

    Raises
    ------
    InputError
        If the file was damaged or changed, has another schema, or does not hold a surface.
    """
    with open_checked(path, MARK, SCHEMA, REMEDY) as content:
        stored = content.take(LAYOUT)
    (nx, ny), (dx, dy) = stored["heights"].shape, stored["@spacing"].tolist()
    if nx * ny > MAX_POINTS:
        raise InputError(f"{path}: holds {nx} x {ny} points; at most {MAX_POINTS} are read")
    try:
        return Surface(
            heights=stored["heights"],
            spacing=(dx, dy),
            invalid=np.zeros((0, 0), dtype=bool) if stored["invalid"] is None else stored["invalid"],
            periodic=stored["@periodic"],
            source=stored["@source"],
        )
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix('surface: ')}") from None
