"""The uncertainty of a quantity of a cell in plan, from its values on coarser grids."""

from collections.abc import Sequence

SAFETY_FACTOR, SPREAD_FACTOR = 2.0, 2.0
"""Parts of the uncertainty: of the largest error that a difference to a coarser grid gives, and of their range."""

SINGLE_SAFETY_FACTOR = 8.0
"""Uncertainty over the error by a single difference, which may be small by chance."""


def refinement_uncertainty(columns: Sequence[float], values: Sequence[float], *, order: float = 2.0) -> float:
    """The uncertainty of a value on a grid, in the unit of the values.

    An error C n^-p on n columns is the difference from the grid with n_k columns over (n/n_k)^p - 1. Where values
    converge at the order p these errors agree; their range is that of walls which the coarser grids do not resolve.

    Parameters
    ----------
    columns : mean numbers of columns along a side, from fine to coarse; at least two.
    values : the value on each grid.
    order : order p at which the error decreases.
    """
    (finest, value), *coarser = zip(columns, values, strict=True)
    errors = [(value - other) / (float((finest / count) ** order) - 1) for count, other in coarser]
    if len(errors) == 1:
        return SINGLE_SAFETY_FACTOR * abs(errors[0])
    return SAFETY_FACTOR * max(map(abs, errors)) + SPREAD_FACTOR * (max(errors) - min(errors))
