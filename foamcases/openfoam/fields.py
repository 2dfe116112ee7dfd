"""Read the numbers of fields and points from OpenFOAM files, whose sizes are checked against what the files hold."""

import math
import re
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import refuse_beyond_memory
from roughfilm.contact.foundation.reading.regular import file_size, read_bytes

REMEDY = "run the case again"

TEXT_BYTES = 20
"""Peak memory for each byte of a file of numbers, bytes."""

_FIELD = re.compile(rb"\binternalField\s+(uniform|nonuniform\s+List<\w+>)\s*")
_COUNT = re.compile(rb"(\d{1,12})\s*([({])")
_HEADER = re.compile(rb"FoamFile\s*\{([^{}]*)\}")
_SIGNS = bytes.maketrans(b"()\n", b"   ")


def last_fields(case: Path) -> Path:
    """The directory of the last fields of a case; InputError if it has none but those of the start."""
    try:
        times = {
            float(place.name): place for place in case.iterdir() if re.fullmatch(r"\d+(\.\d+)?(e[-+]?\d+)?", place.name)
        }
    except OSError as error:
        raise InputError(f"{case}: cannot be read ({error.strerror}); name a case") from error
    if max(times, default=0.0) <= 0:
        raise InputError(f"{case}: holds no fields but those of the start; run the case first")
    return times[max(times)]


def internal_field(path: Path, components: int, cells: int | None = None) -> Array:
    """The values of a field in the cells.

    Parameters
    ----------
    path : the file of the field, ASCII or binary.
    components : 1 for a scalar, 3 for a vector.
    cells : number of cells; None for that of the file.

    Returns
    -------
    Array : shape (cells, components).

    Raises
    ------
    InputError
        If the file cannot be read, is damaged, or has another number of values.
    """
    data = _content(path)
    found = _FIELD.search(data)
    if found is None:
        raise InputError(f"{path}: holds no internal field; {REMEDY}")
    if found[1] == b"uniform" and cells is not None:
        one = _parsed(path, data[found.end() : found.end() + 1000].partition(b";")[0], components)
        return np.broadcast_to(one, (cells, components))
    return _list(path, data, found.end(), cells, components)


def points(path: Path, count: int) -> Array:
    """The positions of the points of a mesh, shape (count, 3); errors are those of :func:`internal_field`."""
    data = _content(path)
    header = _HEADER.search(data)
    return _list(path, data, header.end() if header else 0, count, 3)


def _content(path: Path) -> bytes:
    size = file_size(path, REMEDY)
    refuse_beyond_memory(f"{path}: reading it", TEXT_BYTES * size, "take another machine")
    return read_bytes(path, size, REMEDY)


def _list(path: Path, data: bytes, start: int, asked: int | None, components: int) -> Array:
    """The list of values that begins behind a place."""
    found = _COUNT.search(data, start, start + 4000)
    count = 0 if found is None else int(found[1])
    if found is None or count != (asked or count) or (count > len(data) and found[2] != b"{") or not count:
        raise InputError(f"{path}: claims {count} values{f', not {asked}' if asked else ''}; {REMEDY}")
    header = _HEADER.search(data)
    if found[2] == b"{" and asked is not None:
        return np.broadcast_to(_parsed(path, data[found.end() :].partition(b"}")[0], components), (count, components))
    if header is None or re.search(rb"\bformat\s+binary\b", header[1]) is None:
        ends = (b")",) if components == 1 else (b"\n)", b"))")  # OpenFOAM writes up to ten values in one line
        end = min((place for place in (data.find(one, found.end()) for one in ends) if place >= 0), default=len(data))
        return _parsed(path, data[found.end() : end], count * components).reshape(count, components)
    kind = np.dtype("<f4" if b"scalar=32" in header[1] else "<f8")
    length = count * components * kind.itemsize
    if len(data) < found.end() + length + 1 or data[found.end() + length : found.end() + length + 1] != b")":
        raise InputError(f"{path}: ends before its last value; {REMEDY}")
    values = np.frombuffer(data, kind, count * components, found.end())
    return _finite(path, values.astype(float).reshape(count, components))


def _parsed(path: Path, text: bytes, count: int) -> Array:
    """The numbers in a text; brackets separate them."""
    words = text.translate(_SIGNS).split()
    try:
        values = np.array(words, dtype=float) if len(words) == count else None
    except ValueError:
        values = None
    if values is None:
        raise InputError(f"{path}: holds {len(words)} values, of which some are no numbers, or not {count}; {REMEDY}")
    return _finite(path, values)


def _finite(path: Path, values: Array) -> Array:
    if not math.isfinite(np.abs(values).max(initial=0.0)):
        raise InputError(f"{path}: has values that are not finite; lower the Reynolds number or refine the mesh")
    return values
