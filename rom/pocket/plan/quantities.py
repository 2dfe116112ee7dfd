"""The quantities and fields of a cell in plan."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.rounding import round_off
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import Field, beyond_round_off
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities

LOADS = ("load_plus", "load_from_corner_plus")
EXTREMES = ("pressure_max_plus", "pressure_min_plus")
FRICTION = "friction_plus"


@dataclass(frozen=True, kw_only=True)
class OnSlidingWall:
    """Pressure and shear stress on the sliding wall of a cell, at the middles of its columns.

    Lengths are in film thicknesses, pressures and stresses in η u / film.

    Attributes
    ----------
    x, y : positions of the faces between the columns, increasing over one period, shapes (nx + 1,) and (ny + 1,).
    thickness : film thickness at the middles of the columns, shape (nx, ny).
    pressure : pressure, up to a constant, shape (nx, ny).
    shear_stress : shear stress along the sliding direction, shape (nx, ny).
    on_edge : pressure along the edge x = ±length/2, shape (ny,), of solvers that have it; None if it follows from the
        columns beside the edge.
    at_corner : pressure at the corner of the cell, of solvers that have it; None if it follows from that on the edge.
    """

    x: Array
    y: Array
    thickness: Array
    pressure: Array
    shear_stress: Array
    on_edge: Array | None = None
    at_corner: float | None = None

    @property
    def middles(self) -> tuple[Array, Array]:
        """The positions of the middles of the columns, shapes (nx,) and (ny,)."""
        return (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2

    def mean(self, values: Array) -> float:
        """The mean over the cell of values in the columns, shape (nx, ny)."""
        total = np.diff(self.x) @ values @ np.diff(self.y)
        return float(total / ((self.x[-1] - self.x[0]) * (self.y[-1] - self.y[0])))

    @property
    def edge(self) -> Array:
        """The pressure along the periodic edge x = ±length/2 at the middles of its columns, shape (ny,)."""
        if self.on_edge is not None:
            return self.on_edge
        first, last = np.diff(self.x)[[0, -1]]
        return np.asarray((self.pressure[0] * last + self.pressure[-1] * first) / (first + last))

    @property
    def edge_mean(self) -> float:
        """The length-weighted mean of the pressure over the edge, from which pressures count."""
        return float(self.edge @ np.diff(self.y) / (self.y[-1] - self.y[0]))

    @property
    def corner(self) -> float:
        """The pressure at the corner x = ±length/2, y = ±breadth/2."""
        if self.at_corner is not None:
            return self.at_corner
        first, last = np.diff(self.y)[[0, -1]]
        edge = self.edge
        return float((edge[0] * last + edge[-1] * first) / (first + last))


def plan_quantities(
    scene: Pocket,
    wall: OnSlidingWall,
    *,
    backflow: float,
    pressure_range: tuple[float, float] | None = None,
) -> dict[str, Quantity]:
    """The quantities of a cell in plan, with pressures that count from their mean over the edges x = ±length/2.

    Parameters
    ----------
    scene : a scene in plan.
    wall : pressure and shear stress on the sliding wall.
    backflow : the greatest speed of reverse flow over the sliding speed.
    pressure_range : least and greatest pressure on the sliding wall, in η u / film and with the zero of ``wall``; by
        default those in the columns.
    """
    mean, zero = wall.mean(wall.pressure), wall.edge_mean
    lowest, highest = pressure_range or (float(wall.pressure.min()), float(wall.pressure.max()))
    found = pocket_quantities(
        scene,
        load=mean - zero,
        friction=wall.mean(wall.shear_stress),
        pressure_max=highest - zero,
        pressure_min=lowest - zero,
        backflow=backflow,
        parts=wall.pressure.size,
        offset=zero,
    )
    of_corner, size = mean - wall.corner, max(abs(lowest), abs(highest)) + abs(wall.corner)
    rounding = round_off(size, wall.pressure.size)
    return {
        **found,
        **{
            name: beyond_round_off(Quantity(value=of_corner * factor, unit=unit), rounding * factor)
            for name, factor, unit in (
                ("load_from_corner_plus", scene.plus_factor, "1"),
                ("load_from_corner_per_area", scene.pressure_unit, "Pa"),
            )
        },
    }


def plan_fields(scene: Pocket, wall: OnSlidingWall) -> dict[str, Field]:
    """The fields on the sliding wall of a cell in plan, each of shape (nx, ny)."""
    film, pascal = scene.geometry.film, scene.pressure_unit
    x, y = np.meshgrid(*wall.middles, indexing="ij")
    return {
        "x": Field(values=x * film, unit="m"),
        "y": Field(values=y * film, unit="m"),
        "film_thickness": Field(values=wall.thickness * film, unit="m"),
        "pressure": Field(values=(wall.pressure - wall.edge_mean) * pascal, unit="Pa"),
        "shear_stress": Field(values=wall.shear_stress * pascal, unit="Pa"),
    }
