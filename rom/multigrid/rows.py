"""The matrix of all levels of a multigrid hierarchy by rows."""

from typing import Any, NamedTuple

MIN_PIVOT = 1e-13
"""Smallest pivot over the diagonal; an unknown with a smaller pivot is set to 0."""

MIN_HOLE_WEIGHT = 1e-5
"""Smallest interpolation weight from a node outside the problem; smaller ones are set to 0."""


class Rows(NamedTuple):
    """A matrix by rows and their factors, shape (rows, m) each.

    ``leak`` is the diagonal minus all couplings. It is coarsened separately, and centre and pivots are computed from
    it, since a leak may be far below the round-off of the couplings. ``up`` and ``down`` have no rows on the finest
    level, and ``border`` has none unless rows are periodic. ``factor`` is the coupling towards the middle of the row
    times the ``inverse`` of the pivot.
    """

    leak: Any
    centre: Any
    north: Any
    east: Any
    up: Any
    down: Any
    inverse: Any
    factor: Any
    border: Any
