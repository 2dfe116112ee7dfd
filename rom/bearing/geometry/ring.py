"""Films between two radii in scene files: pads and pocketed washers, over (angle, radius)."""

import math
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Coordinate, InUnit, Length, Part, plain_number
from roughfilm.rom.bearing.geometry.pad import known_film
from roughfilm.rom.cavitation.shape import Shape

Angle = Annotated[float, InUnit("rad")]

FITTING = 1e-4
"""Relative difference of an angle up to which pads fill a ring: angles are given with a few digits."""


def _fraction(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number <= 1:
        raise ValueError(f"got {number!r}; it must be 0 to 1")
    return number


Fraction = Annotated[float, BeforeValidator(_fraction)]


class Ring(Part):
    """One of the equal pieces of a film between two radii, m; ``film`` is its minimum thickness, m.

    Loads, friction and flows refer to one piece; those of the whole bearing are ``pieces`` times as large.

    Attributes
    ----------
    inner_radius : inner radius, m.
    outer_radius : outer radius, m.
    film : minimum film thickness, m; None if a load determines it.
    """

    inner_radius: Length
    outer_radius: Length
    film: Length | None = None

    @model_validator(mode="after")
    def _is_a_ring(self) -> Self:
        if self.outer_radius <= self.inner_radius:
            raise ValueError(f"outer_radius: got {self.outer_radius!r} m; it must be above inner_radius")
        if self.film is not None and self.film > self.outer_radius:
            raise ValueError(f"film: got {self.film!r} m, more than the outer radius; check the units")
        return self

    @property
    def thinnest(self) -> float:
        """The minimum film thickness, m; InputError if a load determines it."""
        return known_film(self.film)

    @property
    def widest(self) -> float:
        """The largest minimum film thickness, m: the arc length."""
        return self.length

    @property
    def dip(self) -> float:
        """The depth to which waves of the wall reach below the minimum film thickness, m: 0."""
        return 0.0

    @property
    def turn(self) -> float:
        """The angle of one piece, rad."""
        raise NotImplementedError

    @property
    def endless(self) -> bool:
        """Whether the pieces are joined without a groove between them."""
        raise NotImplementedError

    @property
    def pieces(self) -> int | None:
        """The number of equal pieces of the whole bearing; None if it is unknown."""
        raise NotImplementedError

    @property
    def radius(self) -> float:
        """The mean radius, at which the sliding speed is given, m."""
        return (self.inner_radius + self.outer_radius) / 2

    @property
    def width(self) -> float:
        """The outer minus the inner radius, m."""
        return self.outer_radius - self.inner_radius

    @property
    def length(self) -> float:
        """The arc length of a piece at the mean radius, m."""
        return self.turn * self.radius

    def at_film(self, film: float) -> Self:
        """The same wall, shifted to another minimum film thickness, m."""
        return self.model_copy(update={"film": film})


class Sector(Ring):
    """One pad of a thrust bearing with a linear taper and a parallel land behind it.

    Attributes
    ----------
    angle : angle of the pad, rad.
    rise : film thickness at the inlet minus that on the land, m; 0 for a flat pad, as a ring that is squeezed.
    taper : fraction of the angle over which the film narrows.
    joined : whether the pads are joined without a groove between them.
    pads : number of equal pads of the whole bearing; by default those that fill the ring if they are joined, and
        otherwise unknown.
    """

    shape: Literal["sector"]
    angle: Angle
    rise: Coordinate
    taper: Annotated[float, BeforeValidator(plain_number), Field(gt=0, le=1)] = 1.0
    joined: Annotated[bool, Field(strict=True)] = False
    pads: Annotated[int, Field(strict=True, ge=1, le=10_000)] | None = None

    @model_validator(mode="after")
    def _is_thin(self) -> Self:
        if self.angle > 2 * math.pi * (1 + 1e-12):
            raise ValueError(f"angle: got {self.angle!r} rad; it must be at most 2π")
        fitting = math.floor(2 * math.pi / self.angle * (1 + FITTING))
        if self.pads is not None and self.pads > fitting:
            raise ValueError(
                f"pads: got {self.pads!r}; at most {fitting} pads of {self.angle!r} rad fit into a ring; reduce one of "
                "the two"
            )
        if self.rise < 0:
            raise ValueError(f"rise: got {self.rise!r} m; it must be 0 or more")
        if self.rise > self.outer_radius:
            raise ValueError(f"rise: got {self.rise!r} m, more than the outer radius; check the units")
        return self

    @property
    def turn(self) -> float:
        """The angle of the pad, rad."""
        return self.angle

    @property
    def endless(self) -> bool:
        """Whether the pads are joined without a groove between them."""
        return self.joined

    @property
    def pieces(self) -> int | None:
        """The number of pads of the whole bearing; None if it is unknown."""
        count = 2 * math.pi / self.angle
        filled = self.joined and abs(count - round(count)) <= FITTING * count
        return round(count) if self.pads is None and filled else self.pads

    def film_shape(self) -> Shape:
        """The shape of the film over (angle, radius)."""
        end = self.taper * self.angle

        def thickness(x: Array, y: Array) -> Array:
            within = np.mod(x, self.angle) if self.joined else x
            return np.asarray(self.thinnest + self.rise * np.clip(1 - within / end, 0, None) + 0 * y)

        return Shape(
            thickness=thickness,
            breaks=tuple(sorted({0.0, end, self.angle})),
            across=(self.inner_radius, self.outer_radius),
            wide=False,
            polar=True,
            joined=(self.joined, False),
        )


class WasherPocket(Part):
    """A pocket of a washer, open to the inner edge; its floor is depth (1 - ξ)(1 - ρ) below the land.

    ξ and ρ go from 0 to 1 over the angle and the radial extent of the pocket. The floor rises to the land along the
    sliding direction from a vertical wall, and along the radius from the inner edge.

    Attributes
    ----------
    depth : greatest depth, at the wall on the inner edge, m.
    share : angle of the pocket as a fraction of the angle of the cell.
    extent : radial extent from the inner edge, m.
    start : position of the wall as a fraction of the angle of the cell.
    """

    depth: Length
    share: Annotated[float, BeforeValidator(plain_number), Field(gt=0, le=1)]
    extent: Length
    start: Fraction = 0.0

    @model_validator(mode="after")
    def _in_its_cell(self) -> Self:
        if self.start + self.share > 1 + 1e-12:
            raise ValueError(f"share: got {self.share!r} from {self.start!r} on; the pocket must end within its cell")
        return self


class Washer(Ring):
    """One of the equal cells of a thrust washer, each with a pocket in a flat land.

    The source gives only a picture and the depth of its pocket (Sahlin 2008, E.4.3, Fig. E.24).

    Attributes
    ----------
    pockets : number of equal cells of the washer.
    pocket : the pocket of each cell; without it the washer is flat.
    """

    shape: Literal["washer"]
    pockets: Annotated[int, Field(strict=True, ge=1, le=10_000)]
    pocket: WasherPocket | None = None

    @model_validator(mode="after")
    def _holds_its_pocket(self) -> Self:
        pocket = self.pocket
        if pocket is not None and pocket.extent > self.width * (1 + 1e-12):
            raise ValueError(f"pocket.extent: got {pocket.extent!r} m; the washer is only {self.width!r} m wide")
        if pocket is not None and pocket.depth > self.outer_radius:
            raise ValueError(f"pocket.depth: got {pocket.depth!r} m, more than the outer radius; check the units")
        return self

    @property
    def turn(self) -> float:
        """The angle of a cell, rad."""
        return 2 * math.pi / self.pockets

    @property
    def endless(self) -> bool:
        """True: the cells are joined without a groove between them."""
        return True

    @property
    def pieces(self) -> int:
        """The number of cells of the whole washer, one for each pocket."""
        return self.pockets

    def film_shape(self) -> Shape:
        """The shape of the film over (angle, radius)."""
        turn, pocket = self.turn, self.pocket
        begins, ends = (0.0, turn) if pocket is None else (pocket.start * turn, (pocket.start + pocket.share) * turn)

        def thickness(x: Array, y: Array) -> Array:
            if pocket is None:
                return np.asarray(self.thinnest + 0 * (x + y))
            along = (np.mod(x, turn) - begins) / (ends - begins)
            across = (y - self.inner_radius) / pocket.extent
            floor = np.where(along >= 0, np.clip(1 - along, 0, None), 0.0) * np.clip(1 - across, 0, None)
            return np.asarray(self.thinnest + pocket.depth * floor)

        slack = 1e-9 * turn
        inside = {place for place in (begins, ends) if slack < place < turn - slack}
        return Shape(
            thickness=thickness,
            breaks=(0.0, *sorted(inside), turn),
            across=(self.inner_radius, self.outer_radius),
            wide=False,
            polar=True,
            joined=(True, False),
            finest=(math.inf, math.inf) if pocket is None else (ends - begins, pocket.extent),
        )
