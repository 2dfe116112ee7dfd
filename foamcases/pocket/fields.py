"""The fields of a finished case, read back as arrays over columns and layers."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.pocket.case import Card


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Velocity and pressure of a channel, in units of film thickness, sliding speed and η u / Ly.

    ``vertices`` has shape (nx + 1, ny + 1, 2), ``velocity`` (nx, ny, 2), ``pressure`` (nx, ny), zero at the periodic
    boundary on the upper wall. Layers count from the still lower wall to the sliding upper one.
    """

    vertices: Array
    velocity: Array
    pressure: Array

    @property
    def position(self) -> Array:
        """Position of the middle of each column, shape (nx,)."""
        x = self.vertices[:, -1, 0]
        return np.asarray((x[1:] + x[:-1]) / 2)

    @property
    def film_thickness(self) -> Array:
        """Distance of the walls in the middle of each column, shape (nx,)."""
        h = self.vertices[:, -1, 1] - self.vertices[:, 0, 1]
        return np.asarray((h[1:] + h[:-1]) / 2)

    @property
    def wall_pressure(self) -> Array:
        """Pressure on the sliding wall, extrapolated through the two nearest layers; second order; shape (nx,)."""
        return np.asarray(1.5 * self.pressure[:, -1] - 0.5 * self.pressure[:, -2])

    @property
    def wall_shear(self) -> Array:
        """Shear stress on the sliding wall as the scheme itself sees it, in η u / Ly; shape (nx,).

        The one-sided difference over half a layer; its mean balances the other wall's drag exactly, and is of
        second order.
        """
        layer = self.film_thickness / self.velocity.shape[1]
        return np.asarray((1 - self.velocity[:, -1, 0]) / (layer / 2))

    def mean(self, values: Array) -> float:
        """Mean over the sliding wall of one value per column."""
        x = self.vertices[:, -1, 0]
        return float((values * np.diff(x)).sum() / (x[-1] - x[0]))

    def pressure_range(self) -> tuple[float, float]:
        """Least and greatest pressure on the sliding wall, of the cubic spline through the columns."""
        from scipy.interpolate import CubicSpline  # slow to import, and most commands do without

        spline = CubicSpline(self.position, self.wall_pressure)
        turns = spline.derivative().roots(extrapolate=False)
        values = np.concatenate([self.wall_pressure, spline(turns), [0.0]])
        return float(values.min()), float(values.max())

    def back_flow(self) -> float:
        """The fastest reverse flow in any cell, as a fraction of the sliding speed; 0 where there is none."""
        return float(max(0.0, -self.velocity[..., 0].min()))


def read_channel(directory: Path) -> Channel:
    """Read the last fields of a case.

    Raises
    ------
    InputError
        If the directory holds no case of ours.
    ConvergenceError
        If it holds no finished fields, or fields that are not finite.
    """
    from foamlib import FoamCase, FoamFile  # slow to import

    card = read_card(directory, Card)
    shape = (card.columns, card.layers)
    try:
        last = FoamCase(directory)[-1]
        velocity = np.asarray(last["U"].internal_field, dtype=float)
        pressure = np.asarray(last["p"].internal_field, dtype=float)
        points = np.asarray(FoamFile(directory / "constant" / "polyMesh" / "points")[None], dtype=float)
        velocity = velocity.reshape(*shape, 3, order="F")[..., :2]
        pressure = pressure.reshape(shape, order="F") * card.reynolds_number
        vertices = points.reshape(shape[0] + 1, shape[1] + 1, 2, 3, order="F")[:, :, 0, :2]
    except (OSError, LookupError, ValueError) as error:
        raise ConvergenceError(f"{directory}: holds no finished fields; run the case first") from error
    if not (np.isfinite(velocity).all() and np.isfinite(pressure).all()):
        raise ConvergenceError(f"{directory}: the fields are not finite; lower the Reynolds number or refine the mesh")
    channel = Channel(vertices=vertices, velocity=velocity, pressure=pressure)
    first, last_column = np.diff(vertices[:, -1, 0])[[0, -1]] / 2
    wall = channel.wall_pressure
    boundary = (wall[0] * last_column + wall[-1] * first) / (first + last_column)
    return Channel(vertices=vertices, velocity=velocity, pressure=pressure - boundary)
