"""The fields from which a rough gap's flow is iterated: those of the Reynolds equation."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.rough_gap.dictionaries import Drive
from roughfilm.foamcases.rough_gap.mesh import Columns
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.rough_gap.walls import Walls

TOLERANCE = 1e-6
"""Tolerance of the initial flow."""


class Start:
    """Velocity and pressure of thin-film flow in the cells of a gap's mesh, any drive.

    In units of the mean gap h̄, of V = h̄²G/(12η) and of ηV/h̄: with the correctors χ of the cell problems, p = -12 χ_i
    under a mean gradient along i and p = 6 U χ₃ under an upper wall that slides at U; v = -h²∇p/12 less the mean
    gradient's part; velocity v 6 s (1 - s) + U s at the part s of the way from the lower wall to the upper one. (Its
    component from wall to wall, which is smaller by the slope, is left to the first iteration: it saves none.)
    """

    def __init__(self, walls: Walls, unit: float, columns: Columns) -> None:
        spacing = walls.spacing[0] / unit, walls.spacing[1] / unit
        self._correctors = solve_cell(walls.gap / unit, spacing, tolerance=TOLERANCE).correctors
        self._spacing, self._columns = spacing, columns

    def fields(self, drive: Drive) -> tuple[Array, Array]:
        """Velocity (nx, ny, layers, 3) and pressure (nx, ny, layers)."""
        gx, gy = drive.gradient
        chi = np.pad(
            gx * self._correctors[0] + gy * self._correctors[1] - drive.speed / 2 * self._correctors[2],
            ((0, 1), (0, 1)),
            mode="wrap",
        )
        layers = self._columns.vertices.shape[2] - 1
        s = (np.arange(layers) + 0.5) / layers
        shape = (*self._columns.kept.shape, layers)
        velocity = np.zeros((*shape, 3))
        for axis, gradient in enumerate(drive.gradient):
            mean = self._columns.height**2 * (gradient + _slope(chi, axis) / self._spacing[axis])
            velocity[..., axis] = mean[..., None] * 6 * s * (1 - s)
        velocity[..., 0] += drive.speed * s
        pressure = -12 * (chi[1:, 1:] + chi[1:, :-1] + chi[:-1, 1:] + chi[:-1, :-1]) / 4
        return velocity, np.broadcast_to(pressure[..., None], shape)


def _slope(values: Array, axis: int) -> Array:
    """Differences along an axis between nodes, in the middle of the columns."""
    steps = np.moveaxis(np.diff(values, axis=axis), axis, 0)
    return np.moveaxis((steps[:, 1:] + steps[:, :-1]) / 2, 0, axis)
