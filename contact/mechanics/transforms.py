"""Filters of real grids by Fourier transforms; plans are cached on disk for the next run."""

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics import kernels

SLAB_BYTES = 1 << 19
"""Size of the columns that are transformed, multiplied and transformed back together, bytes; it fits the cache."""

ALIGNMENT = 16
"""Number of modes to which rows are padded, plus one such block, so that rows are not a power of two apart."""


class Filter:
    """Multiplication of the Fourier modes of real grids by real factors.

    Rows are transformed first; then columns are transformed, multiplied and transformed back, slab by slab; then rows
    are transformed back. Each thread processes its own rows and columns.

    Parameters
    ----------
    sources : grids (nx, ny), C-contiguous and aligned by pyfftw; planning overwrites them.
    result : a grid like these, or one of them.
    """

    def __init__(self, sources: Sequence[Any], result: Any, team: Team) -> None:
        import pyfftw  # slow to import

        self._team, self._nodes = team, result.size
        rows, columns = result.shape[0], result.shape[1] // 2 + 1
        kind = np.result_type(result.dtype, np.complex64)
        padded = (columns // ALIGNMENT + 2) * ALIGNMENT
        self._spectrum = pyfftw.empty_aligned((rows, padded), kind)
        modes = self._spectrum[:, :columns]
        width = max(SLAB_BYTES // (rows * kind.itemsize * ALIGNMENT), 1) * ALIGNMENT
        with _planner() as planner:
            plan = planner.plan
            self._rows = [
                [plan(source[low:high], modes[low:high], 1) for low, high in team.ranges(rows)] for source in sources
            ]
            self._rows_back = [plan(modes[low:high], result[low:high], 1, back=True) for low, high in team.ranges(rows)]
            self._slabs = [
                [
                    (left, right, plan(modes[:, left:right], modes[:, left:right], 0),
                     plan(modes[:, left:right], modes[:, left:right], 0, back=True))
                    for left, right in _cut(first, last, width)
                ]
                for first, last in team.ranges(columns, ALIGNMENT)
            ]  # fmt: skip

    def cut(self, factors: Array) -> list[list[Array]]:
        """Factors of the modes, shape (nx, ny // 2 + 1), normalised and divided into slabs for ``apply``."""
        factors = factors / self._nodes
        return [
            [np.ascontiguousarray(factors[:, left:right], dtype=self._spectrum.real.dtype) for left, right, *_ in slabs]
            for slabs in self._slabs
        ]

    def apply(self, source: int, factors: list[list[Array]]) -> None:
        """Filter the source grid of index ``source`` into the result; other grids stay unchanged."""
        self._team.share(lambda member: self._rows[source][member].execute())
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
        kept = json.loads(_file().read_text(encoding="ascii"))
        pyfftw.import_wisdom(tuple(text.encode("ascii") for text in kept))
    except (OSError, ValueError, TypeError, AttributeError, RuntimeError):
        return


def _keep() -> None:
    """Store all plans; if the file cannot be written, the next run plans again."""
    import pyfftw  # slow to import

    try:
        with replacing(_file()) as scratch:
            scratch.write_text(json.dumps([text.decode("ascii") for text in pyfftw.export_wisdom()]), encoding="ascii")
    except InputError:
        return
