"""Reading surfaces from files: HDF5 of this package, NPY, CSV and the formats of instruments."""

import hashlib
import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import refuse_beyond_memory
from roughfilm.contact.foundation.reading.npy import read_header, read_numbers
from roughfilm.contact.foundation.reading.regular import file_size, opened, read_text
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import as_input
from roughfilm.contact.surfaces import store as surface_store
from roughfilm.contact.surfaces.instruments import Measurement, read_instrument
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface

MAX_CSV_BYTES = 2_000_000_000
"""Size of a CSV file, bytes, above which it is refused unread."""

TEXT_BYTES = 10
"""Peak memory for each byte of a CSV file, bytes."""

CELL_BYTES = 100
"""Peak memory for each cell of a line of a CSV file, bytes."""

POINT_BYTES = 64
"""Peak memory for each point of a surface that is read, bytes."""

SAME = 1e-9
"""Relative difference up to which a height is one that marks missing points."""

NPY_REMEDY = "save numbers of shape (nx, ny) with numpy.save"

HEADER_EXAMPLE = "# spacing: 1.5 um, 1.5 um; heights: um"
"""A correct first line of a CSV file, for messages."""
_CELLS = re.compile(r"[-+0-9.eE, \tnaNAinfINF\r]*")
_HEADER = re.compile(r"#\s*spacing:\s*([^,;]+),\s*([^,;]+);\s*heights:\s*(\S+)\s*")


def read_surface(
    path: Path,
    *,
    channel: str | None = None,
    spacing: tuple[float, float] | None = None,
    height_unit: str | None = None,
    invalid: Sequence[float] = (),
) -> Surface:
    """Read a surface from a file of any supported format.

    The formats are HDF5 as written by :func:`roughfilm.contact.surfaces.store.save_surface`, recognised by content; NPY
    with an array [x, y]; CSV with a line for each y and a column for each x; and all that SurfaceTopography reads. A
    CSV may begin with a header such as ``# spacing: 1.5 um, 1.5 um; heights: um``. NaN, and an empty cell of a CSV,
    marks an invalid point.

    Parameters
    ----------
    channel : name of the channel, for instrument files with several.
    spacing : (dx, dy), m; replaces the spacing in the file. Not allowed for HDF5.
    height_unit : unit such as "um"; replaces the unit in the file. Default for NPY: m. Not allowed for HDF5.
    invalid : heights that mark missing points, in the unit of the file. Not allowed for HDF5.

    Returns
    -------
    Surface : heights in m, pixel by pixel as in the file.

    Raises
    ------
    InputError
        If the file cannot be read, holds no surface, or lacks its spacing or unit.
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
    measurement = _read_npy(path) if suffix == ".npy" else _read_csv(path) if suffix == ".csv" else None
    if measurement is None:
        measurement = read_instrument(path, channel)
    elif channel is not None:
        raise InputError(f"{path}: has no channels; leave out read.channel")
    return _surface(path, measurement, spacing, height_unit, invalid)


def _surface(
    path: Path,
    measurement: Measurement,
    spacing: tuple[float, float] | None,
    height_unit: str | None,
    invalid: Sequence[float],
) -> Surface:
    if min(measurement.heights.shape) < 2:
        nx, ny = measurement.heights.shape
        raise InputError(f"{path}: holds {nx} x {ny} points; a surface has at least 2 x 2")
    if spacing is None:
        if measurement.size is None:
            raise InputError(
                f'{path}: gives no spacing of its points; set read.spacing = ["1 um", "1 um"] in the recipe'
            )
        spacing = (
            measurement.size[0] / measurement.heights.shape[0],
            measurement.size[1] / measurement.heights.shape[1],
        )
    unit = height_unit or measurement.height_unit
    if unit is None:
        raise InputError(f'{path}: gives no unit of its heights; set read.height_unit = "um" in the recipe')
    try:
        factor = to_si(f"1 {unit}", "m")
    except ValueError as error:
        raise InputError(f"{path}: heights: {error}") from None
    missing = np.isnan(measurement.heights)
    for value in invalid:
        missing |= np.isclose(measurement.heights, value, rtol=SAME, atol=0)
    if np.isinf(measurement.heights).any():
        i, j = np.argwhere(np.isinf(measurement.heights))[0]
        raise InputError(f"{path}: the height at x {i}, y {j} is infinite; mark invalid points by NaN")
    try:
        return Surface(
            heights=measurement.heights * factor,
            spacing=spacing,
            invalid=missing,
            source={
                "file": path.name,
                "sha256": file_digest(path),
                "format": measurement.format,
                "channel": measurement.channel,
            },
        )
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix('surface: ')}") from None


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
    if len(header.shape) != 2:
        raise InputError(f"{path}: got {header.dtype} of shape {header.shape}; {NPY_REMEDY}")
    _check_point_count(path, header.shape)
    nx, ny = header.shape
    refuse_beyond_memory(f"{path}: a surface of {nx} x {ny} points", POINT_BYTES * nx * ny, "give a smaller one")
    return Measurement(heights=read_numbers(path, header), height_unit="m", size=None, format="npy", channel="")


def _read_csv(path: Path) -> Measurement:
    refuse_beyond_memory(f"{path}: reading it", TEXT_BYTES * file_size(path, NPY_REMEDY), "save it as NPY")
    text = read_text(path, MAX_CSV_BYTES, "save it as NPY")
    lines = [(number, line) for number, line in enumerate(text.split("\n"), 1) if line.strip()]
    step = unit = None
    if lines and lines[0][1].startswith("#"):
        number, line = lines.pop(0)
        head = _HEADER.fullmatch(line)
        if head is None:
            raise InputError(f"{path}: line {number} is no header of a surface; write for example: {HEADER_EXAMPLE}")
        try:
            step = to_si(head[1], "m"), to_si(head[2], "m")
        except ValueError as error:
            raise InputError(f"{path}: line {number}: {error}") from None
        unit = head[3]
    heights = _numbers(path, lines)
    size = None if step is None else (step[0] * heights.shape[0], step[1] * heights.shape[1])
    return Measurement(heights=heights, height_unit=unit, size=size, format="csv", channel="")


def _numbers(path: Path, lines: list[tuple[int, str]]) -> Array:
    rows: list[Array] = []
    for number, line in lines:
        width = line.count(",") + 1
        if rows and width != rows[0].size:
            raise InputError(
                f"{path}: line {number} has {width} cells, the first {rows[0].size}; write a matrix with commas"
            )
        _check_point_count(path, (len(rows) + 1, width))
        if not rows:
            refuse_beyond_memory(f"{path}: line {number} of {width} cells", CELL_BYTES * width, "save it as NPY")
        cells = line.split(",")
        for cell in () if _CELLS.fullmatch(line) else cells:
            if not _CELLS.fullmatch(cell):
                raise InputError(f"{path}: line {number}: got {cell.strip()[:40]!r}; write numbers with commas between")
        try:
            rows.append(np.array([float(cell) if cell.strip() else np.nan for cell in cells]))
        except ValueError as error:
            reason = str(error).rpartition(": ")[2][:40]
            raise InputError(f"{path}: line {number}: got {reason}; write numbers with commas between") from None
    if not rows:
        raise InputError(f"{path}: holds no numbers; write a matrix of heights, separated by commas")
    heights = np.array(rows).T
    empty = np.isnan(heights).all(axis=1)
    if empty.any() and not empty.all():
        column = int(np.argmax(empty)) + 1
        raise InputError(f"{path}: column {column} is empty; take it out, or a comma at the end of each line")
    return heights


def _check_point_count(path: Path, shape: tuple[int, ...]) -> None:
    if math.prod(shape) > MAX_POINTS:
        raise InputError(f"{path}: claims {shape[0]} x {shape[1]} points; at most {MAX_POINTS} are read")
