"""Surfaces from files: our own HDF5, NPY and CSV, and all else that instruments write."""

import hashlib
import re
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.surfaces import store as surface_store
from roughfilm.contact.surfaces.instruments import Measurement, read_instrument
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface

LARGEST_TEXT = 2_000_000_000
"""Bytes; a longer CSV is refused unread."""

HEADER = "# spacing: 1.5 um, 1.5 um; heights: um"
_CELLS = re.compile(r"[-+0-9.eE, \tnaNAinfINF\r]*")
_HEADER = re.compile(r"#\s*spacing:\s*([^,;]+),\s*([^,;]+);\s*heights:\s*(\S+)\s*")


def read_surface(
    path: Path,
    *,
    channel: str | None = None,
    spacing: tuple[float, float] | None = None,
    height_unit: str | None = None,
) -> Surface:
    """Read a surface from a file of any kind.

    HDF5 as :func:`contact.surfaces.store.save_surface` writes it, whatever its name; NPY, an array [x, y]; CSV, a line
    for each y and a column for each x, after a header such as ``# spacing: 1.5 um, 1.5 um; heights: um`` where nothing
    else tells these. NaN (in a CSV an empty cell too) marks an invalid point. Every other file goes to
    SurfaceTopography.

    Parameters
    ----------
    channel : which one, where an instrument's file holds several.
    spacing : (dx, dy), m; in place of what the file says, if it says it at all. Not for our own HDF5.
    height_unit : likewise, such as "um"; heights of NPY are in m unless told.

    Raises
    ------
    InputError
        One line that names the file, what is wrong in it and what to do.
    UnavailableError
        If the file needs SurfaceTopography and it is not installed.
    """
    try:
        path = Path(path).expanduser()
        if not path.is_file():
            raise InputError(f"{path}: {'is no' if path.exists() else 'no such'} file; name a measured surface")
        if path.stat().st_size == 0:
            raise InputError(f"{path}: is empty; export it again from the instrument")
        if surface_store.is_surface(path):
            if channel or spacing or height_unit:
                raise InputError(f"{path}: says all of itself; leave out the recipe's table read")
            return surface_store.load_surface(path)
        suffix = path.suffix.lower()
        found = _read_npy(path) if suffix == ".npy" else _read_csv(path) if suffix == ".csv" else None
        if found is None:
            found = read_instrument(path, channel)
        elif channel is not None:
            raise InputError(f"{path}: has no channels; leave out read.channel")
        return _surface(path, found, spacing, height_unit)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); check the file") from error
    except RuntimeError as error:  # pathlib's word for a home that is not known and for links that go in circles
        if isinstance(error, ConvergenceError):
            raise
        raise InputError(f"{path}: leads nowhere ({error}); write the path out") from error


def _surface(path: Path, found: Measurement, spacing: tuple[float, float] | None, height_unit: str | None) -> Surface:
    if min(found.heights.shape) < 2:
        nx, ny = found.heights.shape
        raise InputError(f"{path}: holds {nx} x {ny} points; a surface has at least 2 x 2")
    if spacing is None:
        if found.size is None:
            raise InputError(
                f'{path}: tells no spacing of its points; say read.spacing = ["1 um", "1 um"] in the recipe'
            )
        spacing = (found.size[0] / found.heights.shape[0], found.size[1] / found.heights.shape[1])
    unit = height_unit or found.height_unit
    if unit is None:
        raise InputError(f'{path}: tells no unit of its heights; say read.height_unit = "um" in the recipe')
    try:
        factor = to_si(f"1 {unit}", "m")
    except ValueError as error:
        raise InputError(f"{path}: heights: {error}") from None
    if np.isinf(found.heights).any():
        i, j = np.argwhere(np.isinf(found.heights))[0]
        raise InputError(f"{path}: the height at x {i}, y {j} is infinite; mark invalid points by NaN")
    try:
        return Surface(
            heights=found.heights * factor,
            spacing=spacing,
            invalid=np.isnan(found.heights),
            source={
                "file": path.name,
                "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
                "format": found.format,
                "channel": found.channel,
            },
        )
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix('surface: ')}") from None


def _read_npy(path: Path) -> Measurement:
    try:
        # A map, since it refuses a header that claims more than the file holds before any memory is taken.
        array = np.lib.format.open_memmap(path, mode="r")
    except Exception as error:  # a damaged header ends in many kinds of error
        raise InputError(f"{path}: is no whole NPY array; save one of shape (nx, ny) with numpy.save") from error
    if array.ndim != 2 or array.dtype.kind not in "fiu":
        raise InputError(f"{path}: got {array.dtype} of shape {array.shape}; save numbers of shape (nx, ny)")
    _count(path, array.shape)
    return Measurement(heights=np.array(array, dtype=float), height_unit="m", size=None, format="npy", channel="")


def _read_csv(path: Path) -> Measurement:
    if path.stat().st_size > LARGEST_TEXT:
        raise InputError(f"{path}: is larger than {LARGEST_TEXT} bytes; save it as NPY")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; save it as UTF-8 text") from error
    lines = [(number, line) for number, line in enumerate(text.split("\n"), 1) if line.strip()]
    step = unit = None
    if lines and lines[0][1].startswith("#"):
        number, line = lines.pop(0)
        head = _HEADER.fullmatch(line)
        if head is None:
            raise InputError(f"{path}: line {number} is no header of a surface; write for example: {HEADER}")
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
        cells = line.split(",")
        if rows and len(cells) != rows[0].size:
            raise InputError(
                f"{path}: line {number} has {len(cells)} cells, the first {rows[0].size}; write a matrix with commas"
            )
        for cell in () if _CELLS.fullmatch(line) else cells:
            if not _CELLS.fullmatch(cell):
                raise InputError(f"{path}: line {number}: got {cell.strip()[:40]!r}; write numbers with commas between")
        try:
            rows.append(np.array([float(cell) if cell.strip() else np.nan for cell in cells]))
        except ValueError as error:
            reason = str(error).rpartition(": ")[2][:40]
            raise InputError(f"{path}: line {number}: got {reason}; write numbers with commas between") from None
        _count(path, (len(rows), len(cells)))
    if not rows:
        raise InputError(f"{path}: holds no numbers; write a matrix of heights, separated by commas")
    heights = np.array(rows).T
    empty = np.isnan(heights).all(axis=1)
    if empty.any() and not empty.all():
        column = int(np.argmax(empty)) + 1
        raise InputError(f"{path}: column {column} is empty; take it out, or a comma at the end of each line")
    return heights


def _count(path: Path, shape: tuple[Any, ...]) -> None:
    if shape[0] * shape[1] > MAX_POINTS:
        raise InputError(f"{path}: claims {shape[0]} x {shape[1]} points; at most {MAX_POINTS} are read")
