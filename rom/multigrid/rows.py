"""A matrix by rows, as the multigrid hierarchy keeps it on all levels."""

from typing import Any, NamedTuple

GROUNDED = 1e-13
"""Of its diagonal: an unknown with a smaller pivot is set to 0."""

THIN = 1e-5
"""A share below it is none if it comes from a hole."""


class Rows(NamedTuple):
    """A matrix by rows and their factors, shape (rows, m) each.

    ``leak`` is what the diagonal is more than all couplings. It is carried from level to level by itself, and centre
    and pivots are made from it, as a leak may be far below the rounding of the couplings. ``up`` and ``down`` have no
    rows on the finest level, and ``border`` has none unless rows are rings. ``factor`` is the coupling towards the
    middle of the row times the ``inverse`` of the pivot.
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
