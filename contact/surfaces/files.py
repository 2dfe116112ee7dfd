"""Reading surfaces from files: HDF5 of this package, NPY, CSV and the formats of instruments."""

import hashlib
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import refuse_beyond_memory
from roughfilm.contact.foundation.reading.npy import read_header, read_numbers
from roughfilm.contact.foundation.reading.regular import file_size, opened
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import as_input
from roughfilm.contact.surfaces import store as surface_store
from roughfilm.contact.surfaces.csv_files import NPY_REMEDY, read_csv
from roughfilm.contact.surfaces.instruments import Measurement, read_instrument
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.surfaces.surface import Surface, check_point_count

POINT_BYTES = 64
"""Peak memory for each point of a surface that is read, bytes."""

ARGUMENTS = {
    'set read.spacing = ["1 um", "1 um"] in the recipe': "give spacing=1e-6, in m",
    'set read.height_unit = "um" in the recipe': 'give height_unit="um"',
    "as in read.channel=": "as in channel=",
    "leave out the recipe's table read": "leave out spacing, channel, height_unit and invalid",
    "leave out read.channel": "leave out channel",
}
"""The remedies of a reader by keys of a recipe, and by arguments of a function."""

SAME = 1e-9
"""Relative difference up to which a height is one that marks missing points."""


def read_surface(
    path: Path,
    *,
    channel: str | None = None,
    spacing: tuple[float, float] | None = None,
    height_unit: str | None = None,
    invalid: Sequence[float] = (),
    lists: bool = True,
) -> Surface:
    """Read a surface from a file of any supported format; arguments and errors are those of :func:`read_measurement`.

    Raises
    ------
    InputError
        Also if the file holds a profile.
    """
    found = read_measurement(
        path, channel=channel, spacing=spacing, height_unit=height_unit, invalid=invalid, lists=lists
    )
    if isinstance(found, Profile):
        raise InputError(
            f"{path}: is a profile of {found.heights.size} points, where a surface is needed; roughfilm surface gives "
            "its parameters, and roughfilm fit makes a surface of its spectrum"
        )
    return found


def read_measurement(
    path: Path,
    *,
    channel: str | None = None,
    spacing: tuple[float, float] | None = None,
    height_unit: str | None = None,
    invalid: Sequence[float] = (),
    lists: bool = True,
) -> Surface | Profile:
    """Read a surface or a profile from a file of any supported format.

    The formats are HDF5 as written by :func:`roughfilm.contact.surfaces.store.save_surface`, recognised by content; NPY
    with an array [x, y]; CSV with a line for each y and a column for each x, or a list of x, y, z on a grid, or of x, z
    along a profile; and all that SurfaceTopography reads. A CSV may begin with a header such as ``# spacing: 1.5 um,
    1.5 um; heights: um``. NaN, and an empty cell of a CSV, marks an invalid point. A single row or column of heights is
    a profile.

    Parameters
    ----------
    channel : name of the channel, for instrument files with several.
    spacing : (dx, dy), m; replaces the spacing in the file. A profile takes that along it. Not allowed for HDF5.
    height_unit : unit such as "um"; replaces the unit in the file. Default for NPY: m. Not allowed for HDF5. Lists of
        coordinates without a unit have it for x and y too.
    invalid : heights that mark missing points, in the unit of the file. Not allowed for HDF5.
    lists : whether two or three columns of a CSV may be a list of coordinates; otherwise they are heights.

    Returns
    -------
    Surface or Profile : heights in m, pixel by pixel as in the file.

    Raises
    ------
    InputError
        If the file cannot be read, holds no heights, or lacks its spacing or unit.
    UnavailableError
        If the file needs SurfaceTopography and it is not installed.
    """
    if file_size(Path(path), "name a measured surface") == 0:
        raise InputError(f"{path}: is empty; export it again from the instrument")
    path = as_input(Path(path)).expanduser()
    if surface_store.is_surface(path):
        if channel or spacing or height_unit or invalid:
            raise InputError(f"{path}: holds its own spacing and unit; leave out the recipe's table read")
        return surface_store.load_surface(path)
    suffix = path.suffix.lower()
    measurement = _read_npy(path) if suffix == ".npy" else read_csv(path, lists=lists) if suffix == ".csv" else None
    if measurement is None:
        measurement = read_instrument(path, channel)
    elif channel is not None:
        raise InputError(f"{path}: has no channels; leave out read.channel")
    return _in_si(path, measurement, spacing, height_unit, invalid)


def _in_si(
    path: Path,
    measurement: Measurement,
    spacing: tuple[float, float] | None,
    height_unit: str | None,
    invalid: Sequence[float],
) -> Surface | Profile:
    raw = measurement.heights
    unit = height_unit or measurement.height_unit
    steps = spacing or _steps(path, measurement, unit)
    if unit is None:
        raise InputError(f'{path}: gives no unit of its heights; set read.height_unit = "um" in the recipe')
    try:
        factor = to_si(f"1 {unit}", "m")
    except ValueError as error:
        raise InputError(f"{path}: heights: {error}") from None
    missing = np.isnan(raw)
    for value in invalid:
        missing |= np.isclose(raw, value, rtol=SAME, atol=0)
    if (np.isinf(raw) & ~missing).any():
        place = ", ".join(f"{axis} {i}" for axis, i in zip("xy", np.argwhere(np.isinf(raw))[0], strict=False))
        raise InputError(f"{path}: the height at {place} is infinite; mark invalid points by NaN")
    heights = raw * factor
    source = {
        "file": path.name,
        "sha256": file_digest(path),
        "format": measurement.format,
        "channel": measurement.channel,
    }
    try:
        if raw.ndim == 1 or 1 in raw.shape:
            along = steps[1] if raw.ndim == 2 and raw.shape[0] == 1 else steps[0]
            return Profile(heights=np.where(missing, np.nan, heights), spacing=along, source=source)
        return Surface(heights=heights, spacing=(steps[0], steps[1]), invalid=missing, source=source)
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix('surface: ').removeprefix('profile: ')}") from None


def _steps(path: Path, measurement: Measurement, unit: str | None) -> tuple[float, ...]:
    """The distances of the points that the file gives, m."""
    if measurement.size is not None:
        return tuple(length / count for length, count in zip(measurement.size, measurement.heights.shape, strict=True))
    if measurement.steps is None:
        raise InputError(f'{path}: gives no spacing of its points; set read.spacing = ["1 um", "1 um"] in the recipe')
    if unit is None:
        raise InputError(
            f'{path}: gives no unit of its coordinates and heights; set read.height_unit = "um" in the recipe, which '
            "holds for all"
        )
    try:
        return tuple(step * to_si(f"1 {unit}", "m") for step in measurement.steps)
    except ValueError as error:
        raise InputError(f"{path}: heights: {error}") from None


def by_arguments(error: InputError) -> InputError:
    """The error of a reader whose remedies name arguments of a function in place of keys of a recipe."""
    message = str(error)
    for key, argument in ARGUMENTS.items():
        message = message.replace(key, argument)
    return InputError(message)


def has_header(path: Path) -> bool:
    """Whether a file is CSV with a header that gives the spacing and the unit of its heights."""
    with opened(path, "name a measured surface") as file:
        return path.suffix.lower() == ".csv" and file.read(16).lstrip().startswith(b"#")


def file_digest(path: Path) -> str:
    """The SHA-256 digest of the bytes of a file, in hexadecimal."""
    with opened(path, "name a measured surface") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _read_npy(path: Path) -> Measurement:
    header = read_header(path, NPY_REMEDY)
    if len(header.shape) not in (1, 2):
        raise InputError(f"{path}: got {header.dtype} of shape {header.shape}; {NPY_REMEDY}")
    check_point_count(path, header.shape)
    points = " x ".join(map(str, header.shape))
    needed = POINT_BYTES * math.prod(header.shape)
    refuse_beyond_memory(f"{path}: a surface of {points} points", needed, "give a smaller one")
    return Measurement(heights=read_numbers(path, header), height_unit="m", size=None, format="npy", channel="")
