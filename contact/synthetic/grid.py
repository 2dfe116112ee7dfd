"""The grid of a synthetic surface."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import refuse_beyond_memory
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface
from roughfilm.contact.synthetic.checks import length, whole_between

POINT_BYTES = 84
"""Largest memory for each point of a surface while it is made, bytes, measured at 2048 x 2048 points."""


@dataclass(frozen=True, kw_only=True)
class Grid:
    """A period with points at x = i Lx/nx and y = j Ly/ny.

    Attributes
    ----------
    kind : kind of the surface, for messages.
    size : (Lx, Ly), m.
    points : (nx, ny).

    Raises
    ------
    InputError
        If a side has fewer than 2 points, there are more than 1e8 points or more than the memory holds, a length is out
        of range, or the ratio of the sides exceeds 1e6.
    """

    kind: str
    size: tuple[float, float]
    points: tuple[int, int]

    def __post_init__(self) -> None:
        for name, pair in (("size", self.size), ("points", self.points)):
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                raise InputError(f"{self.kind}.{name}: got {pair!r}; write two values, along x and along y")
        for side in self.size:
            length(f"{self.kind}.size", side)
        for count in self.points:
            whole_between(f"{self.kind}.points", count, 2, MAX_POINTS)
        if self.points[0] * self.points[1] > MAX_POINTS:
            raise InputError(f"{self.kind}.points: got {self.points[0]} x {self.points[1]}; write at most 1e8 in total")
        what = f"{self.kind}.points: a surface of {self.points[0]} x {self.points[1]} points"
        refuse_beyond_memory(what, POINT_BYTES * self.points[0] * self.points[1], "write fewer points")
        if not 1e-6 <= self.size[0] / self.size[1] <= 1e6:
            raise InputError(f"{self.kind}.size: got {self.size[0]:.3g} m by {self.size[1]:.3g} m; look at the units")

    @property
    def spacing(self) -> tuple[float, float]:
        """The spacing (dx, dy), m."""
        return self.size[0] / self.points[0], self.size[1] / self.points[1]

    @property
    def shortest_wavelength(self) -> float:
        """The shortest wavelength resolved in all directions, m: twice the longer side of a pixel."""
        return 2 * max(self.spacing)

    @property
    def axes(self) -> tuple[Array, Array]:
        """Coordinates over the period, x/Lx of shape (nx, 1) and y/Ly of shape (1, ny)."""
        nx, ny = self.points
        return np.arange(nx)[:, None] / nx, np.arange(ny)[None, :] / ny

    def resolves(self, name: str, value: float, pixel: float | None = None) -> float:
        """The length, m, if it is at least two pixels (by default their longer side); raises InputError otherwise."""
        least = self.shortest_wavelength if pixel is None else 2 * pixel
        if length(f"{self.kind}.{name}", value) < least * (1 - 1e-9):
            raise InputError(
                f"{self.kind}.{name}: got {value:.5g} m, below two pixels; write at least {least:.5g} m, or more points"
            )
        return value

    def surface(self, heights: Array, given: Mapping[str, Any], achieved: Mapping[str, Any]) -> Surface:
        """The periodic surface; its source holds the arguments, as text of a description, and the achieved values."""
        asked = {"kind": self.kind, "size": [metres(side) for side in self.size], "points": list(self.points)}
        asked |= {key: value for key, value in given.items() if value is not None}
        return Surface(
            heights=heights,
            spacing=self.spacing,
            periodic=True,
            source={"synthetic": asked, "achieved": dict(achieved)},
        )


def metres(value: float | None) -> str | None:
    """A length as text of a description."""
    return None if value is None else with_unit(float(value), "m")


def radians(value: float) -> str:
    """An angle as text of a description."""
    return with_unit(float(value), "rad")
