"""The forces on each pad of a journal bearing, and the place and moments of a pad that tilts about its pivot."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting

CARRYING = 1e-6
"""Force on a pad over the sum over all pads below which it carries no load."""


def pad_forces(geometry: Lobes, x: Array, force: Array) -> Array:
    """The force on each lobe, N (N/m): the sum over its nodes, without those in the gap behind it.

    Parameters
    ----------
    x : positions of the nodes in the coordinates of the scene, m.
    force : force of the film on each node, N, shape (nx, ny).
    """
    lobes, inside = geometry.lobe(x).astype(int), ~geometry.in_gap(x)
    carried = np.where(inside, force.sum(axis=1), 0.0)
    return np.asarray(np.bincount(lobes, weights=carried, minlength=geometry.lobes), dtype=np.float64)


def unloaded(geometry: Lobes, x: Array, force: Array) -> list[int]:
    """The numbers from 1 of the pads that carry no load; parameters as in :func:`pad_forces`."""
    forces = pad_forces(geometry, x, force)
    return [int(pad) + 1 for pad in np.flatnonzero(forces <= CARRYING * np.abs(forces).sum())]


def of_pad(geometry: Tilting, x: Array, y: Array, force: Array) -> dict[str, tuple[float, str]]:
    """The place of a pad about its pivot, and the moments of its film about axes along x and y through the pivot.

    With the force P of the film on each node at the distances ξ along and ζ across from the pivot they are
    M_x = Σ ζ P and M_y = -Σ ξ P, since z points from the sliding wall to the pad.

    Parameters
    ----------
    x, y : positions of the nodes in the coordinates of the scene.
    force : force of the film on each node, N, shape (nx, ny).
    """
    slopes = geometry.slopes or (0.0, 0.0)
    along, across = geometry.offsets(x[:, None], y[None, :])
    values = {"pivot_film": (geometry.pivot_film, "m"), "slope_x": (slopes[0], "rad")}
    if y.size > 1:
        values["slope_y"] = (slopes[1], "rad")
        values["moment_x"] = (float((across * force).sum()), "N*m")
        values["moment_y"] = (-float((along * force).sum()), "N*m")
    return values
