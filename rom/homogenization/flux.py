"""Where the flow goes in a cell."""

import numpy as np

from rom.gap import Array
from rom.homogenization.conductance import FaceRule, faces, without_traces


def flux(
    gap: Array, spacing: tuple[float, float], corrector: Array, direction: int, rule: FaceRule = FaceRule.LINEAR
) -> Array:
    """h³(e_i + ∇χ_i) at the nodes, shape (2, nx, ny), m³: the mean of the two faces in x and of those in y.

    Its mean over the cell is the column i = ``direction`` (0 or 1) of A.

    Parameters
    ----------
    gap : h, m, shape (nx, ny).
    spacing : (dx, dy), m.
    corrector : χ_i, m, shape (nx, ny), as :func:`rom.homogenization.flow_factors.flow_factors` gives it.
    """
    parts = faces(without_traces(gap), rule)
    found = []
    for axis, conductance in enumerate((parts.east, parts.north)):
        drop = (np.roll(corrector, -1, axis=axis) - corrector) / spacing[axis] + (axis == direction)
        through = conductance * drop
        found.append((through + np.roll(through, 1, axis=axis)) / 2)
    return np.array(found)
