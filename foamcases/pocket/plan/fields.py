"""Read the fields of a finished case of a cell in plan as arrays over columns, rows and layers."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array, finite_arithmetic
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields, points
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.plan.mesh.hexahedra import cells, quads, upright

FINER = 8
"""Number of places between columns, along each side, at which a spline through the pressure is searched for peaks."""


@dataclass(frozen=True, kw_only=True)
class CellFlow:
    """Velocity and pressure in a whole cell with nx columns along, ny rows across, and nz layers.

    Lengths are in film thicknesses, velocities in sliding speeds u, pressures and stresses in η u / film. Layers are
    numbered from the wall at rest to the sliding wall, on which the columns are rectangles.

    Attributes
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, nz + 1, 3).
    velocity : velocity in each cell, shape (nx, ny, nz, 3).
    pressure : pressure in each cell, up to a constant, shape (nx, ny, nz).
    """

    vertices: Array
    velocity: Array
    pressure: Array

    @property
    def sides(self) -> tuple[Array, Array]:
        """The positions of the faces between the columns on the sliding wall along x and y, (nx + 1,) and (ny + 1,)."""
        return self.vertices[:, 0, -1, 0], self.vertices[0, :, -1, 1]

    @property
    def wall_pressure(self) -> Array:
        """Pressure on the sliding wall, extrapolated from the two nearest layers to second order, shape (nx, ny)."""
        far, near = np.moveaxis(1 - cells(self.vertices[:, :, -3:])[1][..., 2], -1, 0)
        return np.asarray((self.pressure[:, :, -1] * far - self.pressure[:, :, -2] * near) / (far - near))

    @property
    def wall_shear(self) -> Array:
        """Shear stress along x on the sliding wall as OpenFOAM's scheme computes it, shape (nx, ny).

        It is the one-sided difference (1 - U) / d with U the velocity in the upper layer and d the distance of its
        centroids from the wall.
        """
        distance = 1 - cells(self.vertices[:, :, -2:])[1][:, :, 0, 2]
        return np.asarray((1 - self.velocity[:, :, -1, 0]) / distance)

    def pressure_range(self) -> tuple[float, float]:
        """The least and greatest pressure on the sliding wall, by a bicubic spline through the middles of the columns.

        The spline is continued periodically, and searched within a column of the extreme ones.
        """
        from scipy.interpolate import RectBivariateSpline  # slow to import

        places = []
        for side in self.sides:
            middle, period = (side[1:] + side[:-1]) / 2, side[-1] - side[0]
            places.append(np.concatenate([middle[-3:] - period, middle, middle[:3] + period]))
        wall = self.wall_pressure
        spline = RectBivariateSpline(*places, np.pad(wall, 3, mode="wrap"), kx=3, ky=3)
        found = []
        for sign in (1, -1):
            index = np.unravel_index((sign * wall).argmin(), wall.shape)
            near = [
                np.linspace(place[3 + i - 1], place[3 + i + 1], 2 * FINER + 1)
                for place, i in zip(places, index, strict=True)
            ]
            found.append(sign * float((sign * spline(*near)).min()))
        return found[0], found[1]

    def back_flow(self) -> float:
        """The greatest speed of reverse flow in any cell, over the sliding speed; 0 if no cell has reverse flow."""
        return float(max(0.0, -self.velocity[..., 0].min()))

    def imbalance(self) -> float:
        """The difference of the drags along x on both walls, over that on the sliding wall.

        The drag on the wall at rest is that of the shear stress, the one-sided difference between the wall and the
        centroids of the cells beside it, and of the pressure, extrapolated from two layers to second order.
        """
        x, y = self.sides
        pulled = float(np.diff(x) @ self.wall_shear @ np.diff(y))
        area, place = (one[:, :, 0] for one in quads(self.vertices[:, :, :2], 2))
        normal = area / np.linalg.norm(area, axis=-1, keepdims=True)
        near, far = ((one * normal).sum(axis=-1) for one in self._from_rest(place))
        inward = self.velocity[:, :, 0] - (self.velocity[:, :, 0] * normal).sum(axis=-1)[..., None] * normal
        shear = inward[..., 0] / near * np.linalg.norm(area, axis=-1)
        pressure = (self.pressure[:, :, 0] * far - self.pressure[:, :, 1] * near) / (far - near)
        held = float((shear - pressure * area[..., 0]).sum())
        return abs(held / pulled - 1)

    def _from_rest(self, place: Array) -> tuple[Array, Array]:
        """The vectors from the faces at rest to the centroids of the two nearest layers, shape (nx, ny, 3) each."""
        _, centre = cells(self.vertices[:, :, :3])
        return centre[:, :, 0] - place, centre[:, :, 1] - place


def read_cell(directory: Path, card: Card) -> CellFlow:
    """Read the last fields of a case; a half that was solved is mirrored.

    Raises
    ------
    InputError
        If the mesh of the case is damaged.
    ConvergenceError
        If the directory holds no finished fields, or fields that are not finite.
    """
    rows = card.rows // 2 if card.mirrored else card.rows
    shape = card.columns, rows, card.layers
    nodes = tuple(n + 1 for n in shape)
    try:
        corners = points(directory / "constant" / "polyMesh" / "points", int(np.prod(nodes)))
        last, count = last_fields(directory), int(np.prod(shape))
        velocity = internal_field(last / "U", 3, count).reshape(*shape, 3, order="F")
        pressure = internal_field(last / "p", 1, count).reshape(shape, order="F") * card.reynolds_number
    except InputError as error:
        raise ConvergenceError(f"{directory}: holds no finished fields ({error})") from error
    vertices = corners.reshape(*nodes, 3, order="F")
    with finite_arithmetic(str(directory)):
        if not upright(vertices).all():
            raise InputError(f"{directory}: a cell of the mesh is folded; generate the case again")
    if not card.mirrored:
        return CellFlow(vertices=vertices, velocity=velocity, pressure=pressure)
    flip = np.array([1.0, -1.0, 1.0])
    return CellFlow(
        vertices=np.concatenate([vertices[:, :0:-1] * flip, vertices], axis=1),
        velocity=np.concatenate([velocity[:, ::-1] * flip, velocity], axis=1),
        pressure=np.concatenate([pressure[:, ::-1], pressure], axis=1),
    )
