"""Compute the balance of momentum over a period: the forces of the walls on the liquid against the drive."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.foamcases.rough_gap.dictionaries import Drive
from roughfilm.foamcases.rough_gap.fields import GapFlow


def held(flow: GapFlow, speed: float) -> Array:
    """The force per plan area of the walls on the liquid along x and y, shape (2,), in ηV/h̄.

    The force is the sum of shear and pressure on both walls and on the edges of contact, as OpenFOAM's scheme computes
    them: the shear is the velocity at the centroid of the cell at the wall over its distance from the wall, and the
    pressure is that of this cell. In a steady flow the force is the mean pressure gradient times the volume of the
    liquid: 12 <h> along a unit gradient, and 0 under a sliding wall. Its error falls with the size of the cells.

    Parameters
    ----------
    flow : velocity and pressure on the mesh.
    speed : speed of the upper wall along x, in V.
    """
    columns = flow.columns
    vertices, kept = columns.vertices, columns.kept
    steps = vertices[1, 1, 0, :2] - vertices[0, 0, 0, :2]
    total = np.zeros(2)
    half = np.divide(columns.squared_height, columns.height, out=np.ones(kept.shape), where=kept) / (2 * flow.layers)
    for layer, sign in ((0, -1.0), (-1, 1.0)):
        z = vertices[:, :, layer, 2]
        slope = np.stack([_middle(np.diff(z, axis=axis), axis) / steps[axis] for axis in range(2)], axis=-1)
        distance = half / np.hypot(1, np.hypot(slope[..., 0], slope[..., 1]))
        wall = np.array([speed if sign > 0 else 0.0, 0.0])
        area = np.hypot(1, np.hypot(slope[..., 0], slope[..., 1]))
        shear = (flow.velocity[:, :, layer, :2] - wall) / distance[..., None] * area[..., None]
        push = -sign * flow.pressure[:, :, layer, None] * slope
        total += np.where(kept[..., None], shear + push, 0.0).mean(axis=(0, 1))
    return total + _at_edges(flow, steps)


def imbalance(flow: GapFlow, drive: Drive) -> float:
    """The largest component of |F/12 - g <h>|, the imbalance of forces over the drag 12 ηV/h̄ of a smooth gap.

    F is the force of the walls, g the mean pressure gradient of the drive and <h> the mean height of the liquid.
    """
    volume = np.where(flow.columns.kept, flow.columns.height, 0.0).mean()
    return float(np.abs(held(flow, drive.speed) / 12 - np.array(drive.gradient) * volume).max())


def _at_edges(flow: GapFlow, steps: Array) -> Array:
    """The force of the edges of contact on the liquid, shape (2,)."""
    vertices, kept = flow.columns.vertices, flow.columns.kept
    height = vertices[:, :, -1, 2] - vertices[:, :, 0, 2]
    total = np.zeros(2)
    for axis in range(2):
        sides = _middle(height, axis)  # heights of all sides of columns that are normal to the axis
        for sign, side in ((1, np.take(sides, range(1, sides.shape[axis]), axis=axis)), (-1, _first(sides, axis))):
            bare: Mask = kept & ~np.roll(kept, -sign, axis=axis)
            face = np.where(bare, side / flow.layers / steps[axis], 0.0)[..., None]
            shear = flow.velocity[..., :2] / (steps[axis] / 2)
            total += (face[..., None] * shear).sum(axis=2).mean(axis=(0, 1))
            total[axis] += sign * (face * flow.pressure).sum(axis=2).mean()
    return total


def _first(values: Array, axis: int) -> Array:
    return np.take(values, range(values.shape[axis] - 1), axis=axis)


def _middle(values: Array, axis: int) -> Array:
    """The means of neighbouring values along the other axis."""
    other = 1 - axis
    n = values.shape[other]
    return (np.take(values, range(1, n), axis=other) + np.take(values, range(n - 1), axis=other)) / 2
