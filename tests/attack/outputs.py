"""What the files of a command hold: complete or not, finished parts, and answers that can be compared."""

import csv
import hashlib
import json
import math
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics import store as contact_store
from roughfilm.contact.surfaces import store as surface_store
from roughfilm.rom.homogenization.table.store import load_table
from roughfilm.rom.ladder import store as result_store
from roughfilm.rom.seal.leakage import series as leakage_series
from roughfilm.rom.studies.table import read_table

COSTS = re.compile(
    r"cpu_s|cpu_time|wall_s|one_time|machine|_found|^commit$|^created$|^load_average$|^measured|^jobs$|^speed_up|^cost"
    r"|seconds|CPU|^spent|^on_front$|^cheapest$"
)
"""Names of entries that differ between two runs of one command: they say what it cost, and what was used again."""

AS_BYTES = frozenset({".toml", ".msh", ".stl", ".vtu", ".npy"})
"""Endings of files that are the same, byte for byte, whenever a command writes them."""

TIME = re.compile(r"\d[\d.e+-]* (?:CPU )?(?:ms|s|min|h)\b")
"""Times in sentences, which differ as the costs do."""

HIDDEN = re.compile(r"(^|/)\.|\.lock$")
"""Names of scratch and of locks."""


class IncompleteError(Exception):
    """A file under its final name that is not whole."""


def files(work: Path) -> dict[str, Path]:
    """The files of a directory under their final names, by their path in it."""
    found = (path for path in sorted(work.rglob("*")) if path.is_file())
    return {name: path for path in found if not HIDDEN.search(name := str(path.relative_to(work)))}


def content(path: Path) -> Any:
    """What a file holds, as far as it can be compared; None where only its completeness can be judged."""
    try:
        return _READERS.get(path.suffix, _bytes if path.suffix in AS_BYTES else _something)(path)
    except (InputError, ValueError, LookupError, OSError) as error:
        raise IncompleteError(f"{path.name}: {type(error).__name__}: {error}") from error


def finished(work: Path) -> dict[str, Any]:
    """The finished results in a directory: stored results by file, and the rows of series by file and row.

    Each has its costs, so that a result that was computed again is a changed one.
    """
    found: dict[str, Any] = {}
    for name, path in files(work).items():
        if path.suffix != ".h5":
            continue
        if {"results", "cases"} & set(Path(name).parts):
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
            continue
        with h5py.File(path, "r", locking=False) as file:
            for group in ("series", "points"):
                if group in file:
                    found |= {f"{name}: {key}": row for key, row in _rows(file[group])}
            for load, group in file.get("loads", {}).items():
                found[f"{name}: fields at {load}"] = {field: _digest(values[()]) for field, values in group.items()}
    return found


def differences(one: Any, other: Any, place: str = "", *, costs: bool = False) -> Iterator[str]:
    """The entries that differ; costs are left out unless asked for. Numbers may differ by rounding."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        for name in sorted({*one, *other}):
            if costs or not COSTS.search(str(name)):
                missing = object()
                yield from differences(one.get(name, missing), other.get(name, missing), f"{place}/{name}", costs=costs)
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for number, (left, right) in enumerate(zip(one, other, strict=True)):
            yield from differences(left, right, f"{place}/{number}", costs=costs)
    elif isinstance(one, float | int) and isinstance(other, float | int):
        if one != other and not (math.isnan(one) and math.isnan(other)):
            yield f"{place}: {one!r}, {other!r}"
    elif isinstance(one, str) and isinstance(other, str):
        if one != other and (costs or TIME.sub("", one) != TIME.sub("", other)):
            yield f"{place}: {one!r:.80}, {other!r:.80}"
    elif one != other:
        yield f"{place}: {one!r:.80}, {other!r:.80}"


def scratch(work: Path, temporary: Path, cache: Path) -> list[str]:
    """What a command left behind: hidden files and locks, and anything in its temporary directory."""
    left = [f"beside: {name}" for path in work.rglob("*") if HIDDEN.search(name := str(path.relative_to(work)))]
    left += [f"temporary: {path.name}" for path in temporary.iterdir()]
    kept = re.compile(r"[0-9a-f]{64}\.h5")
    left += [f"cache: {path.name}" for path in cache.rglob("*") if path.is_file() and not kept.fullmatch(path.name)]
    return left


def _rows(group: h5py.Group) -> Iterator[tuple[str, dict[str, float]]]:
    """The rows of a series by what identifies them, without the errors of interpolation between rows."""
    columns = {name: item[()] for name, item in group.items() if item.ndim == 1 and not name.endswith("missed")}
    keys = ("pressure", "speed") if "speed" in columns else ("load", "separation")
    for row in range(len(columns["load"])):
        numbers = {name: float(values[row]) for name, values in columns.items()}
        yield ", ".join(f"{name} {numbers[name]!r}" for name in keys if name in numbers), numbers


def _digest(values: Any) -> str:
    return hashlib.sha256(np.ascontiguousarray(values).tobytes()).hexdigest()


def _hdf5(path: Path) -> Any:
    """Everything in an HDF5 file, after a reading by the project's own reader."""
    with h5py.File(path, "r", locking=False) as file:
        groups = set(file)
        held = _node(file)
    with path.open("rb") as raw:
        start = raw.read(64)
    if start.startswith(contact_store.MARK):
        for load in contact_store.load_series(path)[1]:
            contact_store.load_contact(path, load)
        held["loads"] = {load: held["loads"][load] for load in sorted(held["loads"])}
    elif start.startswith(surface_store.MARK):
        surface_store.load_surface(path)
    elif start.startswith(leakage_series.MARK):
        leakage_series.load_series(path)
    elif start.startswith(b"roughfilm factors"):
        load_table(path)
    elif "quantities" in groups:
        result_store.load(path)
    elif not start.startswith(b"roughfilm"):
        read_table(path)
    return held


def _node(node: Any) -> Any:
    entries = {f"@{name}": _attribute(value) for name, value in node.attrs.items()}
    if isinstance(node, h5py.Dataset):
        values = node.asstr()[()] if node.dtype.kind == "O" else node[()]
        return {"values": np.asarray(values).tolist(), **entries}
    return {name: _node(item) for name, item in node.items()} | entries


def _attribute(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    try:
        return json.loads(value)
    except (TypeError, ValueError):
        return value


def _csv(path: Path) -> Any:
    text = path.read_text(encoding="utf-8")
    rows = list(csv.reader(text.splitlines()))
    if not text.endswith("\n") or len({len(row) for row in rows}) != 1:
        raise ValueError("rows of different lengths, or no end of line")
    return [{head: _number(cell) for head, cell in zip(rows[0], row, strict=True)} for row in rows[1:]]


def _number(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text


def _json(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def _ends_with(end: bytes) -> Callable[[Path], None]:
    def check(path: Path) -> None:
        if not path.read_bytes().rstrip().endswith(end):
            raise ValueError(f"does not end with {end!r}")

    return check


def _bytes(path: Path) -> str:
    return _digest(np.frombuffer(path.read_bytes(), dtype=np.uint8))


def _something(path: Path) -> None:
    path.read_bytes()


_READERS: dict[str, Callable[[Path], Any]] = {
    ".h5": _hdf5,
    ".csv": _csv,
    ".json": _json,
    ".html": _ends_with(b"</html>"),
    ".svg": _ends_with(b"</svg>"),
    ".png": _ends_with(b"IEND\xaeB`\x82"),
}
