"""Read the fields of a finished case of a pad, and compute its forces and flows."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.bearing.case import PadCard
from roughfilm.foamcases.bearing.mesh import Plane
from roughfilm.foamcases.conformal.cells import centres, corners
from roughfilm.foamcases.conformal.channel import Channel
from roughfilm.foamcases.openfoam.block_mesh import used_points
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields, points

MARGIN = 1e-3
"""Distance of vertices that the mesh does not have below all others, over the largest film thickness."""


@dataclass(frozen=True, kw_only=True)
class PadFlow:
    """The flow of a pad, with velocity and pressure 0 in cells that the mesh does not have.

    Lengths are in film thicknesses h, velocities in V, pressures and stresses in η V / h, forces in η V.

    Attributes
    ----------
    channel : velocity and pressure, above that at the outlet.
    plane : the mesh.
    flow : flow per width between each column and the next, which OpenFOAM conserves, in V h, shape (nx - 1,).
    reynolds_number : Reynolds number of h and V.
    inlet : pressure at the inlet above that at the outlet.
    """

    channel: Channel
    plane: Plane
    flow: Array
    reynolds_number: float
    inlet: float

    @property
    def kept(self) -> Mask:
        """Whether each cell is in the liquid, shape (nx, ny)."""
        return self.plane.kept

    @property
    def friction(self) -> float:
        """The force on the sliding wall against its motion, in η V."""
        return float(self.channel.wall_shear @ np.diff(self.channel.vertices[:, -1, 0]))

    @property
    def load(self) -> float:
        """The integral of the pressure on the sliding wall above that at the outlet, in η V."""
        return float(self.channel.wall_pressure @ np.diff(self.channel.vertices[:, -1, 0]))

    @property
    def mass_imbalance(self) -> float:
        """The range of the flow along the film, over that which the sliding wall drags along."""
        return float(np.ptp(self.flow) / (self.channel.speed / 2))

    @property
    def force_imbalance(self) -> float:
        """The sum of all forces along x on the liquid, less the momentum that it carries away, over the friction.

        The forces are those of OpenFOAM's scheme: the shear is the velocity of the cell at a wall over its distance
        from the wall, and the pressure on a wall is that of this cell. At the end sections the velocity is that of the
        cell beside them.
        """
        ends = self._through_ends()
        drag = -self._on_floor() - self._on_sides()
        friction = self.friction
        scale = abs(self.channel.wall_shear) @ np.diff(self.channel.vertices[:, -1, 0])
        return float(abs(ends + friction - drag) / scale)

    def _through_ends(self) -> float:
        """The pressure forces at the ends, and the momentum that flows in through them less that which flows out."""
        total = 0.0
        for column, line, sign, pressure in ((0, 0, 1.0, self.inlet), (-1, -1, -1.0, 0.0)):
            heights = np.where(self.kept[column], np.diff(self.channel.vertices[line, :, 1]), 0.0)
            carried = self.reynolds_number * self.channel.velocity[column, :, 0] ** 2
            total += sign * float(heights @ (pressure + carried))
        return total

    def _on_floor(self) -> float:
        """The force along x of the still wall on the liquid, without the sides of steps."""
        columns, lowest, vertices = np.arange(self.kept.shape[0]), self.plane.lowest, self.channel.vertices
        start, end = vertices[columns, lowest], vertices[columns + 1, lowest]
        run, climb = (end - start).T
        length = np.hypot(run, climb)
        middle = centres(vertices)[columns, lowest]
        away = middle - start
        distance = (away[:, 1] * run - away[:, 0] * climb) / length
        velocity, pressure = self.channel.velocity[columns, lowest, 0], self.channel.pressure[columns, lowest]
        return float((-velocity / distance * length - pressure * climb).sum())

    def _on_sides(self) -> float:
        """The force along x of the sides of steps on the liquid."""
        vertices, total = self.channel.vertices, 0.0
        for column in np.flatnonzero(np.diff(self.plane.lowest)):
            before, behind = self.plane.lowest[column : column + 2]
            cell, sign = (column, -1.0) if before < behind else (column + 1, 1.0)
            layers = slice(min(before, behind), max(before, behind))
            heights = np.diff(vertices[column + 1, :, 1])[layers]
            half = (vertices[cell + 1, 0, 0] - vertices[cell, 0, 0]) / 2
            stress = sign * self.channel.pressure[cell, layers] - self.channel.velocity[cell, layers, 0] / half
            total += float(heights @ stress)
        return total


def read_pad(directory: Path, *, speed: float, inlet: float) -> PadFlow:
    """Read the last fields of a case.

    Parameters
    ----------
    directory : the directory of the case.
    speed : speed of the sliding wall, in V.
    inlet : pressure at the inlet above that at the outlet, in η V / h.

    Raises
    ------
    InputError
        If the directory holds no case of a pad of this version.
    ConvergenceError
        If the directory holds no finished fields, or fields that are not finite.
    """
    card = read_card(directory, PadCard)
    shape = (card.columns, card.layers)
    lowest = np.array(card.lowest or np.zeros(card.columns), dtype=np.int64)
    if lowest.shape != shape[:1] or not ((lowest >= 0) & (lowest < card.layers)).all():
        raise InputError(f"{directory}: its card has no layer for each column; generate the case again")
    kept = np.arange(card.layers) >= lowest[:, None]
    used = used_points(kept[..., None]).ravel(order="F")
    there = kept.ravel(order="F")
    corner = np.full((used.size, 3), np.nan)
    velocity, pressure = np.zeros((there.size, 3)), np.zeros(there.size)
    try:
        corner[used] = points(directory / "constant" / "polyMesh" / "points", int(used.sum()))
        last, cells = last_fields(directory), int(there.sum())
        velocity[there] = internal_field(last / "U", 3, cells)
        pressure[there] = internal_field(last / "p", 1, cells)[:, 0] * card.reynolds_number
        flow = _flow_along(kept, internal_field(last / "phi", 1)[:, 0])
    except InputError as error:
        raise ConvergenceError(f"{directory}: holds no finished fields ({error})") from error
    vertices = _filled(corner.reshape(*(n + 1 for n in shape), 2, 3, order="F")[:, :, 0, :2])
    if not (_areas(vertices)[kept] > 0).all():
        raise InputError(f"{directory}: a cell of the mesh has no area; generate the case again")
    channel = Channel(
        vertices=vertices,
        velocity=velocity.reshape(*shape, 3, order="F")[..., :2],
        pressure=pressure.reshape(shape, order="F"),
        speed=speed,
    )
    return PadFlow(
        channel=channel,
        plane=Plane(vertices=vertices, lowest=lowest),
        flow=flow,
        reynolds_number=card.reynolds_number,
        inlet=inlet,
    )


def _flow_along(kept: Mask, through: Array) -> Array:
    """The flow between each column and the next, shape (nx - 1,), from that through all inner faces of the mesh.

    OpenFOAM orders the inner faces by the cell before them and the one behind them, and cells by layers.
    """
    ahead, above = np.zeros(kept.shape, dtype=bool), np.zeros(kept.shape, dtype=bool)
    ahead[:-1], above[:, :-1] = kept[:-1] & kept[1:], kept[:, :-1] & kept[:, 1:]
    faces = np.stack([ahead, above], axis=-1).transpose(1, 0, 2)  # layers, columns, ahead or above
    if through.size != faces.sum():
        raise InputError(f"phi has {through.size} values, not {faces.sum()}; run the case again")
    flow = np.zeros(faces.shape)
    flow[faces] = through
    return np.asarray(flow[..., 0].sum(axis=0)[:-1])


def _filled(vertices: Array) -> Array:
    """The vertices with those below the wall, which the mesh does not have, evenly spaced down to the deepest one."""
    layers, y = np.arange(vertices.shape[1]), vertices[..., 1]
    first = np.isnan(y).sum(axis=1, keepdims=True)
    lowest = np.take_along_axis(vertices, first[..., None], axis=1)
    deepest = np.nanmin(y) - MARGIN * (1 - np.nanmin(y))
    share = 1 - layers / np.maximum(first, 1)
    below = lowest + np.stack([np.zeros(share.shape), share * (deepest - lowest[..., 1])], axis=-1)
    return np.where(np.isnan(vertices), below, vertices)


def _areas(vertices: Array) -> Array:
    a, b, c, d = corners(vertices)
    across, along = c - a, d - b
    return np.asarray((across[..., 0] * along[..., 1] - across[..., 1] * along[..., 0]) / 2)
