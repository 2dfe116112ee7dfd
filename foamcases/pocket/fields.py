"""Read the fields of a finished pocket case as arrays over columns and layers."""

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array, finite_arithmetic
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields, points
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.mesh.cells import centres


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Velocity and pressure of a channel with nx columns and ny layers.

    Lengths are in film thicknesses Ly, velocities in sliding speeds u, pressures and stresses in η u / Ly. Layers are
    numbered from the lower wall, which is at rest, to the upper wall, which slides.

    Attributes
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, 2).
    velocity : velocity in each cell, shape (nx, ny, 2).
    pressure : pressure in each cell, shape (nx, ny); it is zero at the periodic boundary on the upper wall.
    """

    vertices: Array
    velocity: Array
    pressure: Array

    @property
    def position(self) -> Array:
        """Positions of the middles of the columns on the sliding wall along x, shape (nx,)."""
        x = self.vertices[:, -1, 0]
        return np.asarray((x[1:] + x[:-1]) / 2)

    @property
    def wall_distance(self) -> Array:
        """Distance from the sliding wall of the centres of the two nearest layers, nearest first, shape (2, nx)."""
        return np.asarray(1 - centres(self.vertices[:, -3:])[:, ::-1, 1].T)

    @property
    def wall_pressure(self) -> Array:
        """Pressure on the sliding wall, extrapolated from the two nearest layers to second order, shape (nx,)."""
        near, far = self.wall_distance
        return np.asarray((self.pressure[:, -1] * far - self.pressure[:, -2] * near) / (far - near))

    @property
    def wall_shear(self) -> Array:
        """Shear stress on the sliding wall as OpenFOAM's scheme computes it, in η u / Ly, shape (nx,).

        It is the one-sided difference (1 - U) / d with U the velocity in the upper layer and d the distance of its
        centres from the wall. Its mean balances the drag on the other wall exactly, and is of second order.
        """
        return np.asarray((1 - self.velocity[:, -1, 0]) / self.wall_distance[0])

    def mean(self, values: Array) -> float:
        """The mean over the sliding wall of values in the columns, shape (nx,), weighted by the columns' width."""
        x = self.vertices[:, -1, 0]
        return float((values * np.diff(x)).sum() / (x[-1] - x[0]))

    def pressure_range(self) -> tuple[float, float]:
        """The least and greatest pressure on the sliding wall, by a cubic spline through the middles of the columns."""
        from scipy.interpolate import CubicSpline  # slow to import, and most commands do not need it

        spline = CubicSpline(self.position, self.wall_pressure)
        turns = spline.derivative().roots(extrapolate=False)
        values = np.concatenate([self.wall_pressure, spline(turns), [0.0]])
        return float(values.min()), float(values.max())

    def back_flow(self) -> float:
        """The greatest speed of reverse flow in any cell, over the sliding speed; 0 if no cell has reverse flow."""
        return float(max(0.0, -self.velocity[..., 0].min()))


def read_channel(directory: Path) -> Channel:
    """Read the last fields of a case.

    Raises
    ------
    InputError
        If the directory holds no pocket case of this version.
    ConvergenceError
        If the directory holds no finished fields, or fields that are not finite.
    """
    card = read_card(directory, Card)
    shape, nodes = (card.columns, card.layers), (card.columns + 1, card.layers + 1, 2)
    try:
        corners = points(directory / "constant" / "polyMesh" / "points", math.prod(nodes))
        last, cells = last_fields(directory), card.columns * card.layers
        velocity = internal_field(last / "U", 3, cells).reshape(*shape, 3, order="F")[..., :2]
        pressure = internal_field(last / "p", 1, cells).reshape(shape, order="F")
    except InputError as error:
        raise ConvergenceError(f"{directory}: holds no finished fields ({error})") from error
    vertices = corners.reshape(*nodes, 3, order="F")[:, :, 0, :2]
    with finite_arithmetic(str(directory)):
        up, down = vertices[1:, 1:] - vertices[:-1, :-1], vertices[:-1, 1:] - vertices[1:, :-1]
        if not (up[..., 0] * down[..., 1] - up[..., 1] * down[..., 0] > 0).all():
            raise InputError(f"{directory}: a cell of the mesh has no area; generate the case again")
        channel = Channel(vertices=vertices, velocity=velocity, pressure=pressure * card.reynolds_number)
        first, last_column = np.diff(vertices[:, -1, 0])[[0, -1]] / 2
        wall = channel.wall_pressure
        boundary = (wall[0] * last_column + wall[-1] * first) / (first + last_column)
        return replace(channel, pressure=channel.pressure - boundary)
