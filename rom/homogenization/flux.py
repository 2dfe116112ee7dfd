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


def widening(gap: Array, spacing: tuple[float, float], corrector: Array, direction: int) -> float:
    """The derivative of A_ii, i = ``direction``, by a uniform increase of the open gap, m²: 3 <h² |e_i + ∇χ_i|²>.

    A_ii is the minimum <h³ |e_i + ∇χ_i|²> over χ_i, so that a change of χ_i does not count. The derivative is that of
    the linear interpolation between the nodes; the parameters are those of :func:`flux`.
    """
    h = without_traces(gap)
    parts = faces(h, FaceRule.LINEAR)
    drops = _drops(corrector, spacing)
    drops[direction] += 1
    total = 0.0
    for axis, conductance in enumerate((parts.east, parts.north)):
        ahead, some = np.roll(h, -1, axis=axis), conductance > 0
        own, other = h[some], ahead[some]
        rate = conductance[some] * (2 / own + 2 / other - 2 / (own + other))
        total += float((rate * drops[axis][some] ** 2).sum())
    return total / h.size


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
