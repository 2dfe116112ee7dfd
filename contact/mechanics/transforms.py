"""Real grids filtered by Fourier transforms; what planning finds out is kept for the next run on this machine."""

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

SLAB = 1 << 19
"""Bytes of the columns that are taken forth, multiplied and taken back at a time, while the cache holds them."""

ALIGNED = 16
"""Modes; a row of modes is a whole number of these, and one more, so that no two lie a power of two apart."""


class Filter:
    """Multiplies the modes of real grids by real factors, from some grids into another, on which it is planned.

    Rows are transformed forth; columns forth, multiplied, and back, a slab at a time; rows back. Each member of the
    team has its rows and its columns.

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
        padded = (columns // ALIGNED + 2) * ALIGNED
        self._spectrum = pyfftw.empty_aligned((rows, padded), kind)
        modes = self._spectrum[:, :columns]
        width = max(SLAB // (rows * kind.itemsize * ALIGNED), 1) * ALIGNED
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
                for first, last in team.ranges(columns, ALIGNED)
            ]  # fmt: skip

    def cut(self, factors: Array) -> list[list[Array]]:
        """Factors (nx, ny // 2 + 1) of the modes as ``apply`` takes them, with the normalisation of the transforms."""
        factors = factors / self._nodes
        return [
            [np.ascontiguousarray(factors[:, left:right], dtype=self._spectrum.real.dtype) for left, right, *_ in slabs]
            for slabs in self._slabs
        ]

    def apply(self, source: int, factors: list[list[Array]]) -> None:
        """Filter the grid of that number into the result; the other grids keep what they hold."""
        self._team.share(lambda member: self._rows[source][member].execute())
        self._team.share(lambda member: self._columns(self._slabs[member], factors[member]))
        self._team.share(lambda member: self._rows_back[member].execute())

    def _columns(self, slabs: list[Any], factors: list[Array]) -> None:
        for (left, _, forth, back), factor in zip(slabs, factors, strict=True):
            forth.execute()
            kernels.scale_modes(self._spectrum, left, factor)
            back.execute()


def _cut(first: int, last: int, width: int) -> list[tuple[int, int]]:
    """Ranges of at most that width."""
    return list(pairwise([*range(first, last, width), last]))


class _Planner:
    """Plans from what is known where that suffices; ``learned`` says whether it had to measure."""

    def __init__(self) -> None:
        self.learned = False

    def plan(self, before: Any, after: Any, axis: int, *, back: bool = False) -> Any:
        """A transform along an axis, which may overwrite what it reads if it goes back."""
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
    """Plan with what earlier runs learned, and keep what is learned now."""
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
    """Take up what earlier runs kept; a file that cannot be understood is as good as none."""
    import pyfftw  # slow to import

    try:
        kept = json.loads(_file().read_text(encoding="ascii"))
        pyfftw.import_wisdom(tuple(text.encode("ascii") for text in kept))
    except (OSError, ValueError, TypeError, AttributeError, RuntimeError):
        return


def _keep() -> None:
    """Keep what is known by now; where there is no place for it, the next run plans again."""
    import pyfftw  # slow to import

    try:
        with replacing(_file()) as scratch:
            scratch.write_text(json.dumps([text.decode("ascii") for text in pyfftw.export_wisdom()]), encoding="ascii")
    except InputError:
        return
