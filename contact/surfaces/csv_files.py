"""CSV files: a matrix of heights with a line for each y, or a list of coordinates and heights."""

import re
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import refuse_beyond_memory
from roughfilm.contact.foundation.reading.regular import file_size, read_text
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.surfaces.instruments import Measurement
from roughfilm.contact.surfaces.surface import check_point_count

MAX_CSV_BYTES = 2_000_000_000
"""Size of a CSV file, bytes, above which it is refused unread."""

TEXT_BYTES = 10
"""Peak memory for each byte of a CSV file, bytes."""

CELL_BYTES = 100
"""Peak memory for each cell of a line of a CSV file, bytes."""

LIST_LINES = 9
"""Number of lines from which two or three columns without a header are a list of coordinates."""

SAME_STEP = 1e-3
"""Difference of a coordinate from its place on a grid, in steps, up to which it is there."""

NPY_REMEDY = "save numbers of shape (nx, ny) with numpy.save"

HEADER_EXAMPLE = "# spacing: 1.5 um, 1.5 um; heights: um"
"""A correct first line of a CSV file, for messages."""

_CELLS = re.compile(r"[-+0-9.eE, \tnaNAinfINF\r]*")
_HEADER = re.compile(r"#\s*spacing:\s*([^,;]+),\s*([^,;]+);\s*heights:\s*(\S+)\s*")


def read_csv(path: Path, *, lists: bool = True) -> Measurement:
    """Read a matrix of heights, a list of x, y, z on a grid, or a list of x, z along a profile.

    With ``lists``, three columns of nine lines or more, without a header, are a list of x, y, z; points of the grid
    that it leaves out are NaN. Two such columns, of which the first increases, are a profile.

    Raises
    ------
    InputError
        If the file is no such table, or the points of a list lie on no grid.
    """
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
    if lists and step is None and heights.shape[1] >= LIST_LINES:
        if heights.shape[0] == 3:
            return _of_list(path, heights)
        if heights.shape[0] == 2 and (np.diff(heights[0]) > 0).all():
            return _of_line(path, heights)
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
        check_point_count(path, (len(rows) + 1, width))
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
    if len(rows) > 1 and empty.any() and not empty.all():
        column = int(np.argmax(empty)) + 1
        raise InputError(f"{path}: column {column} is empty; take it out, or a comma at the end of each line")
    return heights


def _of_list(path: Path, columns: Array) -> Measurement:
    """The grid of a list of x, y, z, shape (3, n)."""
    if not np.isfinite(columns[:2]).all():
        raise InputError(f"{path}: is a list of x, y, z in which a coordinate is missing; take such lines out")
    places, steps = zip(*(_on_grid(path, name, one) for name, one in zip("xy", columns[:2], strict=True)), strict=True)
    i, j = places
    shape = (int(i.max()) + 1, int(j.max()) + 1)
    check_point_count(path, shape)
    heights = np.full(shape, np.nan)
    heights[i, j] = columns[2]
    if np.unique(i * shape[1] + j).size < i.size:
        raise InputError(f"{path}: is a list of x, y, z with several heights at one point; leave one for each")
    if 2 * i.size < heights.size:
        raise InputError(
            f"{path}: is a list of {i.size} x, y, z on {shape[0]} x {shape[1]} points, most of which are missing; "
            "interpolate it on a grid"
        )
    return Measurement(heights=heights, height_unit=None, size=None, format="csv", channel="", steps=steps)


def _of_line(path: Path, columns: Array) -> Measurement:
    """The profile of a list of x, z, shape (2, n)."""
    _, step = _on_grid(path, "x", columns[0])
    if step * (columns.shape[1] - 1) > (1 + SAME_STEP) * np.ptp(columns[0]):
        raise InputError(f"{path}: is a profile with missing points; write a line for each, with an empty height")
    return Measurement(heights=columns[1], height_unit=None, size=None, format="csv", channel="", steps=(step,))


def _on_grid(path: Path, name: str, values: Array) -> tuple[Array, float]:
    """The numbers of the places of coordinates on a grid of equal steps, and the step."""
    distinct = np.unique(values)
    apart = np.diff(distinct)
    apart = apart[apart > SAME_STEP * apart.max(initial=0.0)]
    if not apart.size:
        raise InputError(f"{path}: has one {name} in all lines; a list of coordinates needs several")
    span = np.ptp(values)
    step = span / max(round(span / apart.min()), 1)
    places = (values - values.min()) / step
    if np.abs(places - np.rint(places)).max() > SAME_STEP:
        raise InputError(
            f"{path}: is a list of coordinates whose {name} are not equidistant, so that it has no grid of points; "
            "interpolate it on one"
        )
    return np.rint(places).astype(np.intp), float(step)
