"""Read the flow through a rough gap from its cases as arrays over columns and layers, and compute its means."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields
from roughfilm.foamcases.rough_gap.case import GapCard
from roughfilm.foamcases.rough_gap.mesh import Columns


@dataclass(frozen=True, kw_only=True)
class GapFlow:
    """A flow through the mesh of a gap, with velocity and pressure 0 in columns that the mesh does not have.

    Lengths are in mean gaps h̄, velocities in V = h̄²G/(12η), and pressures and stresses in ηV/h̄.

    Attributes
    ----------
    columns : the mesh.
    velocity : velocity in each cell, shape (nx, ny, layers, 3).
    pressure : pressure in each cell with mean 0, without the part of the mean gradient, shape (nx, ny, layers).
    """

    columns: Columns
    velocity: Array
    pressure: Array

    @property
    def layers(self) -> int:
        """The number of cells across the gap."""
        return int(self.velocity.shape[2])

    @property
    def flow_per_width(self) -> Array:
        """The flow per width ∫u dz along x and y, as the mean over each column, in V h̄, shape (nx, ny, 2)."""
        return np.asarray(self.velocity[..., :2].mean(axis=2) * self.columns.height[..., None])

    @property
    def flow(self) -> Array:
        """The mean of the flow per width over the period, contact included, in V h̄, shape (2,)."""
        return np.asarray(self.flow_per_width.mean(axis=(0, 1)))

    def lowest_pressure(self, axis: int | None) -> float:
        """The lowest pressure in a cell above ambient, in ηV/h̄.

        Under a gradient along ``axis``, which is 12 in these units, the lowest pressure at the outlet of the period is
        ambient; the result is then 0 unless the pressure is lower elsewhere. Without one (None) the mean is.
        """
        kept = np.broadcast_to(self.columns.kept[..., None], self.pressure.shape)
        if axis is None:
            return float(self.pressure[kept].min())
        x = self.columns.vertices[..., axis]
        ends = np.moveaxis(x, axis, 0)[:, 0, 0]
        fall = 12 * (ends[1:] + ends[:-1]) / 2
        total = np.moveaxis(self.pressure, axis, 0) - fall[:, None, None]
        kept = np.moveaxis(kept, axis, 0)
        last = np.flatnonzero(kept.any(axis=(1, 2)))[-1]
        outlet = total[last][kept[last]].min()
        return float(min(0.0, total[kept].min() - outlet))

    def pull(self, speed: float) -> float:
        """The mean over the period of η ∂u/∂z on a flat upper wall that slides along x at ``speed``, in ηV/h̄.

        The shear is the one-sided difference between the wall and the centroid of the highest cells, as OpenFOAM's
        scheme computes it. It is positive if the liquid resists the motion of the wall.
        """
        kept = self.columns.kept
        distance = np.divide(self.columns.squared_height, self.columns.height, out=np.ones(kept.shape), where=kept)
        shear = (speed - self.velocity[:, :, -1, 0]) / (distance / (2 * self.layers))
        return float(np.where(kept, shear, 0.0).mean())


def read_gap_flow(case: Path, card: GapCard, columns: Columns) -> GapFlow:
    """Read the last fields of one drive of a case on the mesh of its scene.

    Raises
    ------
    InputError
        If the case has another number of cells than the mesh.
    ConvergenceError
        If the case holds no finished fields, or fields that are not finite.
    """
    shape = (*columns.kept.shape, card.layers)
    kept = np.broadcast_to(columns.kept[..., None], shape).ravel(order="F")
    if int(kept.sum()) != card.cells:
        raise InputError(f"{case}: has {card.cells} cells, and the scene's mesh {int(kept.sum())}; generate it again")
    velocity, pressure = np.zeros((kept.size, 3)), np.zeros(kept.size)
    try:
        last = last_fields(case)
        velocity[kept] = internal_field(last / "U", 3, card.cells)
        pressure[kept] = internal_field(last / "p", 1, card.cells)[:, 0] * card.reynolds_number
    except InputError as error:
        raise ConvergenceError(f"{case}: holds no finished fields ({error})") from error
    pressure[kept] -= pressure[kept].mean()
    return GapFlow(
        columns=columns,
        velocity=velocity.reshape(*shape, 3, order="F"),
        pressure=pressure.reshape(shape, order="F"),
    )
