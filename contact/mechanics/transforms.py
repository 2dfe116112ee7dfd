"""Filters of real grids by Fourier transforms; plans are cached on disk for the next run."""

import json
import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.contact.mechanics import kernels

SLAB_BYTES = 1 << 19
"""Size of the columns that are transformed, multiplied and transformed back together, bytes; it fits the cache."""

MAX_BYTES = 10_000_000
"""Largest size of the file of plans that is read, bytes."""

ALIGNMENT = 16
"""Number of modes to which rows are padded, plus one such block, so that rows are not a power of two apart."""


class Filter:
    """Multiplication of the Fourier modes of a real grid by real factors.

    Rows are transformed first; then columns are transformed, multiplied and transformed back, slab by slab; then rows
    are transformed back. Each thread processes its own rows and columns.

    Parameters
    ----------
    shape : number of nodes (nx, ny).
    precision : "float32" or "float64".
    in_place : whether source and result are the same grid, whose memory also holds the modes.

    Attributes
    ----------
    source, result : grids, shape (nx, ny); all zero at first. In place, rows are longer in memory than ny.
    """

    def __init__(self, shape: tuple[int, int], precision: str, team: Team, *, in_place: bool = False) -> None:
        import pyfftw  # slow to import

        self._team, self._nodes = team, math.prod(shape)
        rows, columns = shape[0], shape[1] // 2 + 1
        kind = np.result_type(precision, np.complex64)
        padded = (columns // ALIGNMENT + 2) * ALIGNMENT
        self._spectrum = pyfftw.empty_aligned((rows, padded), kind)
        modes = self._spectrum[:, :columns]
        if in_place:
            self.source = self.result = self._spectrum.view(precision)[:, : shape[1]]
        else:
            self.source, self.result = (pyfftw.empty_aligned(shape, precision) for _ in range(2))
        width = max(SLAB_BYTES // (rows * kind.itemsize * ALIGNMENT), 1) * ALIGNMENT
        with _planner() as planner:
            plan = planner.plan
            parts = team.ranges(rows)
            self._rows = [plan(self.source[low:high], modes[low:high], 1) for low, high in parts]
            self._rows_back = [plan(modes[low:high], self.result[low:high], 1, back=True) for low, high in parts]
            self._slabs = [
                [
                    (left, right, plan(modes[:, left:right], modes[:, left:right], 0),
                     plan(modes[:, left:right], modes[:, left:right], 0, back=True))
                    for left, right in _cut(first, last, width)
                ]
                for first, last in team.ranges(columns, ALIGNMENT)
            ]  # fmt: skip
        self.source[:] = self.result[:] = 0

    def cut(self, factors: Array) -> list[list[Array]]:
        """Factors of the modes, normalised and divided into slabs for ``apply``.

        They have the shape (nx // 2 + 1, ny // 2 + 1), because the modes of opposite sign along x have the same factor.
        """
        return [
            [np.asarray(factors[:, left:right] / self._nodes, self._spectrum.real.dtype) for left, right, *_ in slabs]
            for slabs in self._slabs
        ]

    def apply(self, factors: list[list[Array]]) -> None:
        """Filter the source into the result; out of place, the source stays unchanged."""
        self._team.share(lambda member: self._rows[member].execute())
        self._team.share(lambda member: self._columns(self._slabs[member], factors[member]))
        self._team.share(lambda member: self._rows_back[member].execute())

    def _columns(self, slabs: list[Any], factors: list[Array]) -> None:
        for (left, _, forth, back), factor in zip(slabs, factors, strict=True):
            forth.execute()
            kernels.scale_modes(self._spectrum, left, factor)
            back.execute()


def _cut(first: int, last: int, width: int) -> list[tuple[int, int]]:
    """Ranges of at most ``width`` that cover first to last."""
    return list(pairwise([*range(first, last, width), last]))


class _Planner:
    """Planner that uses stored plans where they exist; ``learned`` says whether it measured new ones."""

    def __init__(self) -> None:
        self.learned = False

    def plan(self, before: Any, after: Any, axis: int, *, back: bool = False) -> Any:
        """A transform along an axis; a backward transform may overwrite its input."""
        import pyfftw  # slow to import

        options = {"axes": (axis,), "direction": "FFTW_BACKWARD" if back else "FFTW_FORWARD"}
        flags = ("FFTW_MEASURE", "FFTW_DESTROY_INPUT") if back else ("FFTW_MEASURE",)
        try:
            return pyfftw.FFTW(before, after, flags=(*flags, "FFTW_WISDOM_ONLY"), **options)
        except RuntimeError:
            self.learned = True
            return pyfftw.FFTW(before, after, flags=flags, **options)


@contextmanager
def _planner() -> Iterator[_Planner]:
    """Yield a planner with the plans of earlier runs, and store new plans."""
    _recall()
    planner = _Planner()
    yield planner
    if planner.learned:
        _keep()


def _file() -> Path:
    import pyfftw  # slow to import

    home = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(home).expanduser() / "roughfilm" / f"transforms-{pyfftw.__version__}.json"


@cache
def _recall() -> None:
    """Load the plans of earlier runs; an unreadable file is ignored."""
    import pyfftw  # slow to import

    try:
        kept = from_json(read_bytes(_file(), MAX_BYTES, ""), tuple[str, ...])
        pyfftw.import_wisdom(tuple(text.encode("ascii") for text in kept))
    except (ValueError, RuntimeError):
        return


def _keep() -> None:
    """Store all plans; if the file cannot be written, the next run plans again."""
    import pyfftw  # slow to import

    try:
        with replacing(_file(), beginning_with("a list of plans", b"[")) as scratch:
            scratch.write_text(json.dumps([text.decode("ascii") for text in pyfftw.export_wisdom()]), encoding="ascii")
    except InputError:
        return
