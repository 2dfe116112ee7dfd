"""Surfaces in HDF5 of our own: written whole or not at all, the same surface always as the same bytes."""

import io
import json
from pathlib import Path

import h5py
import numpy as np

from contact.errors import InputError
from contact.files import replacing
from contact.surface import Surface

SCHEMA = 1


def save_surface(surface: Surface, path: Path) -> None:
    """Write ``heights`` (m, [x, y]) and ``invalid``, with ``spacing`` (m), ``periodic`` and ``source`` as attributes.

    Raises InputError if ``path`` cannot be written.
    """
    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        file.attrs["roughfilm_surface"] = SCHEMA
        file.attrs["spacing"] = surface.spacing
        file.attrs["spacing_unit"] = "m"
        file.attrs["periodic"] = surface.periodic
        file.attrs["source"] = json.dumps(surface.source, sort_keys=True)
        file.create_dataset("heights", data=surface.heights, compression="gzip", shuffle=True).attrs["unit"] = "m"
        if surface.invalid.any():
            file.create_dataset("invalid", data=surface.invalid, compression="gzip")
    with replacing(path) as scratch:
        scratch.write_bytes(memory.getvalue())


def is_surface(path: Path) -> bool:
    """Whether a file is HDF5 and says that it is one of our surfaces."""
    try:
        with h5py.File(path) as file:
            return "roughfilm_surface" in file.attrs
    except OSError:
        return False


def load_surface(path: Path, most: int = 100_000_000) -> Surface:
    """Read a surface back as it was; InputError if the file is damaged or claims more than ``most`` points."""
    try:
        with h5py.File(path) as file:
            if file.attrs["roughfilm_surface"] != SCHEMA:
                raise InputError(f"{path}: has schema {file.attrs['roughfilm_surface']}; this version reads {SCHEMA}")
            shape = file["heights"].shape
            if len(shape) != 2 or shape[0] * shape[1] > most:
                raise InputError(f"{path}: claims heights of shape {shape}; at most {most} points are read")
            return Surface(
                heights=file["heights"][()],
                spacing=tuple(file.attrs["spacing"]),
                invalid=file["invalid"][()] if "invalid" in file else np.zeros(shape, dtype=bool),
                periodic=bool(file.attrs["periodic"]),
                source=json.loads(file.attrs["source"]),
            )
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from None
    except (OSError, LookupError, ValueError, TypeError, AttributeError) as error:
        raise InputError(f"{path}: is a damaged surface of roughfilm; make it again") from error
