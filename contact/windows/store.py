"""A set of windows on disk: its periodic cells as surfaces of this package, and windows.json that lists them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.store import load_surface, save_surface
from roughfilm.contact.surfaces.surface import Surface

LIST = "windows.json"
"""The file of a set that lists its windows and holds all answers."""

CELLS = "cells"
"""The directory of the cells in that of a set."""

FIRST_KEY = "windows_of"
"""The first key of the file, by which it is recognised."""

MAX_BYTES = 100_000_000
"""Largest size of a list that is read, bytes."""

SIZE_TOLERANCE = 0.01
"""Largest relative difference between the size of a set and that of its cells."""

REMEDY = "give a directory that 'roughfilm windows FILE --out DIR' wrote"


@dataclass(frozen=True, kw_only=True)
class WindowSet:
    """Windows of one size of one surface, each prepared as a periodic cell.

    Attributes
    ----------
    cells : the periodic cells.
    windows : the place of each cell on the measurement; empty for seeds of a description.
    size : length of the shorter side of a window, m.
    independent : effective number of independent windows, 1 to the number of cells.
    source : name of the file, digest and recipe of the surface, as entries that JSON can hold.
    answers : scene, quantities, scatter and warnings, as entries that JSON can hold; empty where none are known.
    """

    cells: tuple[Surface, ...]
    windows: tuple[Window, ...]
    size: float
    independent: float
    source: Mapping[str, Any]
    answers: Mapping[str, Any] = field(default_factory=dict)

    __repr__ = brief

    def __post_init__(self) -> None:
        if not self.cells:
            raise InputError("windows: got no cells; a set has one at least")
        first, count = self.cells[0], len(self.cells)
        for number, cell in enumerate(self.cells):
            if (cell.shape, cell.spacing) != (first.shape, first.spacing):
                raise InputError(
                    f"windows: cell {number + 1} has {cell.shape} points of {cell.spacing} m, the first one "
                    f"{first.shape} of {first.spacing} m; give windows of one size"
                )
        if not abs(self.size - min(first.size)) <= SIZE_TOLERANCE * min(first.size):
            raise InputError(f"size: got {self.size:g} m of cells of {min(first.size):g} m; give the length of a cell")
        if not 1 <= self.independent <= count:
            raise InputError(f"independent: got {self.independent:g}; it must be 1 to the number of windows, {count}")
        if self.windows and len(self.windows) != count:
            raise InputError(f"windows: got {len(self.windows)} places of {count} cells; give one for each")
        if any(min(window.start) < 0 or min(window.shape) < 2 for window in self.windows):
            raise InputError("windows: a place begins at a pixel below 0 or has fewer than 2 pixels along a side")


@dataclass(frozen=True, kw_only=True)
class ListEntries:
    """The content of windows.json; ``cells`` are paths in its directory, ``windows`` pairs of start and shape."""

    windows_of: Mapping[str, Any]
    size: float
    independent: float
    cells: Sequence[str]
    windows: Sequence[tuple[tuple[int, int], tuple[int, int]]]
    answers: Mapping[str, Any]


def cell_path(number: int) -> str:
    """The path of a cell in the directory of its set, from its number, 0 or more."""
    return f"{CELLS}/{number + 1:04d}.h5"


def save_windows(windows: WindowSet, directory: Path) -> None:
    """Write a set of windows: its cells, then its list, each completely or not at all.

    The list of an older set is removed first, and cells of it with higher numbers last, so that a set is never mixed.

    Raises
    ------
    InputError
        If the directory cannot be written, or holds other files under these names.
    """
    (directory / LIST).unlink(missing_ok=True)
    for number, cell in enumerate(windows.cells):
        save_surface(cell, directory / cell_path(number))
    write_json(
        {
            FIRST_KEY: dict(windows.source),
            "size": windows.size,
            "independent": windows.independent,
            "cells": [cell_path(number) for number in range(len(windows.cells))],
            "windows": [[list(window.start), list(window.shape)] for window in windows.windows],
            "answers": dict(windows.answers),
        },
        directory / LIST,
    )
    for path in (directory / CELLS).glob("[0-9][0-9][0-9][0-9]*.h5"):
        if path.stem.isdecimal() and int(path.stem) > len(windows.cells):
            path.unlink(missing_ok=True)


def stored_list(directory: Path) -> ListEntries | None:
    """The list of a set, without its cells; None if there is none, or it is damaged."""
    path = directory / LIST
    if not path.is_file():
        return None
    try:
        return from_json(read_bytes(path, MAX_BYTES, REMEDY), ListEntries)
    except (ValueError, InputError):
        return None


def read_windows(directory: Path) -> WindowSet:
    """Read a set of windows from the directory that ``roughfilm windows FILE --out DIR`` writes.

    Raises
    ------
    InputError
        If the directory has no list of windows, or the list or a cell is damaged.
    """
    path = directory / LIST
    if not path.is_file():
        raise InputError(f"{directory}: holds no {LIST}; {REMEDY}")
    try:
        entries = from_json(read_bytes(path, MAX_BYTES, REMEDY), ListEntries)
    except ValueError as error:
        raise InputError(f"{path}: {error}; write the set again") from None
    for number, name in enumerate(entries.cells):
        if name != cell_path(number):
            raise InputError(f"{path}: names {name!r:.60} in place of {cell_path(number)}; write the set again")
    try:
        return WindowSet(
            cells=tuple(load_surface(directory / name) for name in entries.cells),
            windows=tuple(Window(start=start, shape=shape) for start, shape in entries.windows),
            size=entries.size,
            independent=entries.independent,
            source=entries.windows_of,
            answers=entries.answers,
        )
    except InputError as error:
        text = str(error)
        raise InputError(text if text.startswith(str(directory)) else f"{path}: {text}; write the set again") from None
