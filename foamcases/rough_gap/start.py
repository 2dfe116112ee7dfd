"""The initial fields of a rough gap's flow, from the Reynolds equation."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.rough_gap.dictionaries import Drive
from roughfilm.foamcases.rough_gap.mesh import Columns
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.rough_gap.walls import Walls

TOLERANCE = 1e-6
"""Tolerance of the cell problems of the initial flow."""


class Start:
    """Velocity and pressure of thin-film flow in the cells of a gap's mesh, for any drive.

    Lengths are in mean gaps h̄, velocities in V = h̄²G/(12η), pressures in ηV/h̄. χ are the correctors of the cell
    problems. The pressure is p = -12 χ_i under a mean gradient along i, and p = 6 U χ₃ under an upper wall that slides
    at U; it leaves out the part of the mean gradient g. The mean velocity across the gap by pressure is
    v = h² (g - ∇p/12), and the velocity is 6 v s (1 - s) + U s, where s is 0 on the lower and 1 on the upper wall. The
    component from wall to wall, which is smaller by the slope, is 0; its value would save no iteration.

    Parameters
    ----------
    walls : heights of the walls on the nodes of the mesh.
    unit : unit of length of the mesh, m; the mean gap.
    columns : the mesh.
    """

    def __init__(self, walls: Walls, unit: float, columns: Columns) -> None:
        spacing = walls.spacing[0] / unit, walls.spacing[1] / unit
        self._correctors = solve_cell(walls.gap / unit, spacing, tolerance=TOLERANCE).correctors
        self._spacing, self._columns = spacing, columns

    def fields(self, drive: Drive) -> tuple[Array, Array]:
        """The velocity, shape (nx, ny, layers, 3), and the pressure, shape (nx, ny, layers), of a drive."""
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
    """Differences between neighbouring nodes along an axis, in the middles of the columns."""
    steps = np.moveaxis(np.diff(values, axis=axis), axis, 0)
    return np.moveaxis((steps[:, 1:] + steps[:, :-1]) / 2, 0, axis)
