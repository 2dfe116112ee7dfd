"""Flow vectors in a cell."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.conductance import FaceRule, faces, without_traces


def flux(
    gap: Array, spacing: tuple[float, float], corrector: Array, direction: int, rule: FaceRule = FaceRule.LINEAR
) -> Array:
    """h³(e_i + ∇χ_i) at the nodes, shape (2, nx, ny), m³, the mean over the adjacent faces.

    Its mean over the cell is the column i = ``direction`` (0 or 1) of A.

    Parameters
    ----------
    gap : h, m, shape (nx, ny).
    spacing : (dx, dy), m.
    corrector : χ_i, m, shape (nx, ny), as ``flow_factors`` returns it.
    """
    parts = faces(without_traces(gap), rule)
    drops = _drops(corrector, spacing)
    drops[direction] += 1
    return _at_nodes(parts.east * drops[0], parts.north * drops[1])


def sliding_flux(gap: Array, spacing: tuple[float, float], corrector: Array, rule: FaceRule = FaceRule.LINEAR) -> Array:
    """Twice the flow over the sliding speed, h e₁ - h³∇χ₃, at the nodes, shape (2, nx, ny), m. Its mean is B.

    Parameters
    ----------
    gap : h, m, shape (nx, ny).
    spacing : (dx, dy), m.
    corrector : χ₃, 1/m, shape (nx, ny).
    """
    parts = faces(without_traces(gap), rule)
    drops = _drops(corrector, spacing)
    return _at_nodes(parts.drag - parts.east * drops[0], -parts.north * drops[1])


def _drops(corrector: Array, spacing: tuple[float, float]) -> list[Array]:
    return [(np.roll(corrector, -1, axis=axis) - corrector) / spacing[axis] for axis in range(2)]


def _at_nodes(east: Array, north: Array) -> Array:
    return np.array([(through + np.roll(through, 1, axis=axis)) / 2 for axis, through in enumerate((east, north))])
