"""The relaxation of velocity in SIMPLEC, by the size of the cells."""

UNRELAXED_COLUMNS = 12.0
"""Product of the number of columns and 1 less the relaxation of velocity, at which runs need the fewest iterations."""

MIN_RELAXATION = 0.85
"""Least relaxation of velocity in SIMPLEC."""


def velocity_relaxation(columns: int) -> float:
    """The relaxation of velocity on a mesh of a film, which is nearer to 1 for smaller cells."""
    return max(MIN_RELAXATION, 1 - UNRELAXED_COLUMNS / columns)
