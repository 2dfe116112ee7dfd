"""The matrix of all levels of a multigrid hierarchy by rows."""

from typing import Any, NamedTuple

import numpy as np

MIN_PIVOT = 1e-13
"""Smallest pivot over the diagonal; an unknown with a smaller pivot is set to 0."""

MIN_HOLE_WEIGHT = 1e-5
"""Smallest interpolation weight from a node outside the problem; smaller ones are set to 0."""


class Rows(NamedTuple):
    """A matrix by rows and their factors: two arrays of rows of length m, and the first row of each part in its array.

    ``base`` has leak, centre and north, which only the set-up of the hierarchy needs. ``solver`` has the other parts.
    ``leak`` is the diagonal minus all couplings. It is coarsened separately, and centre and pivots are computed from
    it, since a leak may be far below the round-off of the couplings. ``factor`` is the coupling towards the middle of
    the row times the ``inverse`` of the pivot. ``border`` is the response to the last unknown of a periodic row, whose
    couplings to the first unknown and to the one before it are the last values of ``border`` and ``factor``. A part
    that a level does not have begins at -1: ``up`` and ``down`` on the finest level, ``border`` unless rows are
    periodic.
    """

    base: Any
    solver: Any
    count: Any
    leak: Any
    centre: Any
    north: Any
    east: Any
    inverse: Any
    factor: Any
    border: Any
    up: Any
    down: Any


def rows_of_zeros(total: int, finest: int, length: int, *, ring: bool, kind: type) -> Rows:
    """Rows of length m = ``length``, ``total`` on all levels and ``finest`` on the finest one, for :class:`Rows`.

    The first rows of ``up`` and ``down`` are those of the second level, so that both begin ``finest`` rows earlier.
    """
    first = np.arange(0, 7 * total, total)
    east, inverse, factor, border = first[:4]
    up = first[4 if ring else 3] - finest
    down = up + total - finest
    return Rows(
        base=np.zeros((3 * total, length), kind),
        solver=np.zeros((down + total, length), kind),
        count=np.int64(finest),
        leak=first[0],
        centre=first[1],
        north=first[2],
        east=east,
        inverse=inverse,
        factor=factor,
        border=border if ring else np.int64(-1),
        up=up,
        down=down,
    )
