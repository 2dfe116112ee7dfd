"""Velocity and pressure of a plane flow between a still wall and a sliding one, on a structured mesh."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.conformal.cells import centres


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Velocity and pressure of a channel with nx columns and ny layers.

    Lengths are in film thicknesses Ly, velocities in a speed V, which is the sliding speed of a pocket, pressures and
    stresses in η V / Ly. Layers are numbered from the lower wall, which is at rest, to the upper wall, which slides.

    Attributes
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, 2).
    velocity : velocity in each cell, shape (nx, ny, 2).
    pressure : pressure in each cell, shape (nx, ny).
    speed : speed of the upper wall.
    """

    vertices: Array
    velocity: Array
    pressure: Array
    speed: float = 1.0

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
        """Shear stress on the sliding wall as OpenFOAM's scheme computes it, in η V / Ly, shape (nx,).

        It is the one-sided difference (speed - U) / d with U the velocity in the upper layer and d the distance of its
        centres from the wall. Its mean balances the drag on the other wall exactly, and is of second order.
        """
        return np.asarray((self.speed - self.velocity[:, -1, 0]) / self.wall_distance[0])

    def mean(self, values: Array) -> float:
        """The mean over the sliding wall of values in the columns, shape (nx,), weighted by the columns' width."""
        x = self.vertices[:, -1, 0]
        return float((values * np.diff(x)).sum() / (x[-1] - x[0]))

    def pressure_range(self, *ends: float) -> tuple[float, float]:
        """The least and greatest pressure on the sliding wall, by a cubic spline through the middles of the columns.

        ``ends`` are the pressures at the ends.
        """
        from scipy.interpolate import CubicSpline  # slow to import, and most commands do not need it

        spline = CubicSpline(self.position, self.wall_pressure)
        turns = spline.derivative().roots(extrapolate=False)
        values = np.concatenate([self.wall_pressure, spline(turns), ends])
        return float(values.min()), float(values.max())

    def back_flow(self) -> float:
        """The greatest speed of reverse flow in any cell, in V; 0 if no cell has reverse flow."""
        return float(max(0.0, -self.velocity[..., 0].min()))
