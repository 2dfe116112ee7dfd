"""What the programs of the gallery compute and draw: kept by a build of the manual, and read by the tests.

Programs run here as the tests run them: warnings are errors, and the cache of results is empty. An outcome is kept with
the digest of all code and data that a program may read, and is read only while this digest is right.
"""

import contextlib
import hashlib
import os
import pickle
import sys
import tempfile
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from io import BytesIO
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

ROOT = Path(__file__).resolve().parent.parent.parent
GALLERY = ROOT / "scripts" / "examples" / "gallery"
KEPT = ROOT / "runs" / "outcomes"
READ = ("contact", "foamcases", "rom", "roughfilm", "scripts/examples", "scripts/manual")
"""The folders whose files a program may read."""

CACHE = "ROUGHFILM_CACHE"
PROGRAM, OTHER_TEXT = ".py", ".rst"


@dataclass(frozen=True)
class Figure:
    """What is looked at in a figure after it was drawn: its size, labels, and legends that cover a line."""

    width: float
    labels: tuple[str, ...]
    covered: tuple[str, ...]


@dataclass(frozen=True)
class Outcome:
    """The variables of a program at its end, its figures, and the names of files that it left in its folder."""

    values: Mapping[str, Any]
    figures: tuple[Figure, ...]
    left: frozenset[str]


def outcome(program: Path, values: Mapping[str, Any]) -> Outcome:
    """The outcome of a program that has just run, with the figures that are open."""
    figures = tuple(looked_at(plt.figure(number)) for number in plt.get_fignums())
    left = frozenset(one.name for one in program.parent.iterdir() if one.suffix not in (PROGRAM, OTHER_TEXT))
    return Outcome(values=values, figures=figures, left=left)


def looked_at(figure: Drawing) -> Figure:
    """Draw a figure, and read its size, its labels and what its legends cover."""
    figure.canvas.draw()
    labels = [label for ax in figure.axes for label in (ax.get_xlabel(), ax.get_ylabel()) if label and ax.axison]
    covered = [label for ax in figure.axes for label in covered_by_legend(ax)]
    return Figure(width=figure.get_figwidth(), labels=tuple(labels), covered=tuple(covered))


def covered_by_legend(ax: Axes) -> list[str]:
    """The labels of the lines that pass below the legend."""
    legend = ax.get_legend()
    if legend is None:
        return []
    box, along = legend.get_window_extent(), np.linspace(0, 1, 20)[:, None, None]
    found = []
    for line in ax.lines:
        points = line.get_transform().transform(np.asarray(line.get_xydata(), dtype=float))
        points = points[np.isfinite(points).all(axis=1)]
        x, y = (points[:-1] + along * np.diff(points, axis=0)).reshape(-1, 2).T
        if ((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1)).any():
            found.append(str(line.get_label()))
    return found


@cache
def digest() -> str:
    """The digest of Python, of the packages that are installed, and of all files that a program may read."""
    found = hashlib.sha256(sys.version.encode())
    found.update((ROOT / "requirements.lock").read_bytes())
    for path in sorted(path for folder in READ for path in _files(ROOT / folder)):
        found.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes())
    return found.hexdigest()


def _files(folder: Path) -> Iterator[Path]:
    """The files below a folder, without those that are compiled from others."""
    return (path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)


def keep(program: Path, found: Outcome, kept: Path = KEPT) -> None:
    """Keep an outcome, without modules and what is drawn; nothing is kept if another variable cannot be stored."""
    target = _place(program, kept)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.unlink(missing_ok=True)
    values = {}
    try:
        for name, value in found.values.items():
            if not isinstance(value, ModuleType) and not name.startswith("__"):
                with contextlib.suppress(_DrawnError):
                    values[name] = _stored(value)
    except (pickle.PicklingError, AttributeError, TypeError):
        return
    part = target.with_suffix(f".{os.getpid()}")
    part.write_bytes(pickle.dumps((digest(), Outcome(values=values, figures=found.figures, left=found.left))))
    part.replace(target)  # a test that reads meanwhile finds the whole file or none


class _DrawnError(Exception):
    """A variable contains a part of a figure, which would be opened again where it is read."""


class _WithoutFigures(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, Artist):
            raise _DrawnError
        if isinstance(value, MappingProxyType):
            return _read_only, (dict(value),)
        return NotImplemented


def _read_only(values: dict[Any, Any]) -> Mapping[Any, Any]:
    return MappingProxyType(values)


def _stored(value: Any) -> bytes:
    found = BytesIO()
    _WithoutFigures(found).dump(value)
    return found.getvalue()


def kept_outcome(program: Path, kept: Path = KEPT) -> Outcome | None:
    """The outcome of a program that was kept for the present code; None if there is none."""
    try:
        stored = _place(program, kept).read_bytes()
    except FileNotFoundError:
        return None
    of, found = pickle.loads(stored)
    return (
        replace(found, values={name: pickle.loads(one) for name, one in found.values.items()})
        if of == digest()
        else None
    )


def _place(program: Path, kept: Path) -> Path:
    return kept / program.relative_to(GALLERY).with_suffix(".pickle")


def scraper(_block: Any, block_vars: Mapping[str, Any], _conf: Any) -> str:
    """Keep what a program has given after one of its parts; Sphinx-Gallery calls this. No text is added to its page."""
    program = Path(block_vars["src_file"])
    found = outcome(program, dict(block_vars["example_globals"]))
    apart.figures += found.figures
    keep(program, replace(found, figures=apart.figures), KEPT)
    return ""


class _Apart:
    """Runs each program with an empty cache and with warnings as errors, between two calls by Sphinx-Gallery."""

    def __init__(self) -> None:
        self.figures: tuple[Figure, ...] = ()
        self._end = contextlib.ExitStack()

    def __call__(self, _conf: Any, _program: str | None, when: str) -> None:
        self._end.close()
        self.figures = ()
        if when == "before":
            self._end.enter_context(warnings.catch_warnings())
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="FigureCanvasAgg is non-interactive")
            place = self._end.enter_context(tempfile.TemporaryDirectory(prefix="roughfilm-cache-"))
            self._end.enter_context(mock.patch.dict(os.environ, {CACHE: place}))


apart = _Apart()
"""For ``reset_modules`` of Sphinx-Gallery, before and after each program."""
