"""Films between two rings, over (angle, radius), as a scene file writes them: a pad, or a cell of a pocketed washer."""

import math
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, Length, Part, plain_number
from roughfilm.rom.cavitation.shape import Shape

Angle = Annotated[float, InUnit("rad")]


def _part(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number <= 1:
        raise ValueError(f"got {number!r}; it must be 0 to 1")
    return number


Fraction = Annotated[float, BeforeValidator(_part)]


class Ring(Part):
    """Between two radii, m; loads, friction and flows are those of one piece of it. ``film`` is the least thickness."""

    inner_radius: Length
    outer_radius: Length
    film: Length

    @model_validator(mode="after")
    def _is_a_ring(self) -> Self:
        if self.outer_radius <= self.inner_radius:
            raise ValueError(f"outer_radius: got {self.outer_radius!r} m; it must be above inner_radius")
        if self.film > self.outer_radius:
            raise ValueError(f"film: got {self.film!r} m, thicker than the bearing is wide; look at the units")
        return self

    @property
    def turn(self) -> float:
        """The angle of one piece, rad."""
        raise NotImplementedError

    @property
    def endless(self) -> bool:
        """Whether the pieces follow one another without a groove between them."""
        raise NotImplementedError

    @property
    def radius(self) -> float:
        """The mean one, where the sliding speed is given, m."""
        return (self.inner_radius + self.outer_radius) / 2

    @property
    def width(self) -> float:
        """From the inner to the outer radius, m."""
        return self.outer_radius - self.inner_radius

    @property
    def length(self) -> float:
        """Along the mean radius, m."""
        return self.turn * self.radius

    def at_film(self, film: float) -> Self:
        """The same wall, shifted."""
        return self.model_copy(update={"film": film})


class Sector(Ring):
    """One pad of a thrust bearing: over ``angle``, the film falls evenly by ``rise`` over the first ``taper`` of it.

    Behind the taper the land is parallel. ``joined`` pads follow one another without a groove between them.
    """

    shape: Literal["sector"]
    angle: Angle
    rise: Length
    taper: Annotated[float, BeforeValidator(plain_number), Field(gt=0, le=1)] = 1.0
    joined: Annotated[bool, Field(strict=True)] = False

    @model_validator(mode="after")
    def _can_be(self) -> Self:
        if self.angle > 2 * math.pi * (1 + 1e-12):
            raise ValueError(f"angle: got {self.angle!r} rad; it must be at most a full turn")
        if self.rise > self.outer_radius:
            raise ValueError(f"rise: got {self.rise!r} m, higher than the bearing is wide; look at the units")
        return self

    @property
    def turn(self) -> float:
        """The angle of the pad, rad."""
        return self.angle

    @property
    def endless(self) -> bool:
        """As ``joined`` says."""
        return self.joined

    def film_shape(self) -> Shape:
        """The film, over (angle, radius)."""
        end = self.taper * self.angle

        def thickness(x: Array, y: Array) -> Array:
            within = np.mod(x, self.angle) if self.joined else x
            return np.asarray(self.film + self.rise * np.clip(1 - within / end, 0, None) + 0 * y)

        return Shape(
            thickness=thickness,
            breaks=tuple(sorted({0.0, end, self.angle})),
            across=(self.inner_radius, self.outer_radius),
            wide=False,
            polar=True,
            joined=(self.joined, False),
        )


class Pocket(Part):
    """A pocket open to the inner edge of a washer, ``depth`` deep there where it begins, m.

    It begins with a wall at ``start`` and reaches over ``share``, both parts of the cell's angle, and over ``extent``,
    m, from the inner edge outwards. With ξ and ρ from 0 to 1 over the two, its floor is depth (1 - ξ)(1 - ρ) below the
    land: along the sliding it rises from the wall to the land, along the radius from the inner edge to it.
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
    """One of the equal cells of a thrust washer, each with a pocket; between the pockets the land is flat.

    The source shows its pocket in a picture and says its depth alone (Sahlin 2008, E.4.3, Fig. E.24).
    """

    shape: Literal["washer"]
    pockets: Annotated[int, Field(strict=True, ge=1, le=10_000)]
    pocket: Pocket | None = None

    @model_validator(mode="after")
    def _holds_its_pocket(self) -> Self:
        pocket = self.pocket
        if pocket is not None and pocket.extent > self.width * (1 + 1e-12):
            raise ValueError(f"pocket.extent: got {pocket.extent!r} m; the washer is only {self.width!r} m wide")
        if pocket is not None and pocket.depth > self.outer_radius:
            raise ValueError(f"pocket.depth: got {pocket.depth!r} m, deeper than the washer is wide; look at the units")
        return self

    @property
    def turn(self) -> float:
        """The angle of a cell, rad."""
        return 2 * math.pi / self.pockets

    @property
    def endless(self) -> bool:
        """The cells go round."""
        return True

    def film_shape(self) -> Shape:
        """The film, over (angle, radius)."""
        turn, pocket = self.turn, self.pocket
        begins, ends = (0.0, turn) if pocket is None else (pocket.start * turn, (pocket.start + pocket.share) * turn)

        def thickness(x: Array, y: Array) -> Array:
            if pocket is None:
                return np.asarray(self.film + 0 * (x + y))
            along = (np.mod(x, turn) - begins) / (ends - begins)
            across = (y - self.inner_radius) / pocket.extent
            floor = np.where(along >= 0, np.clip(1 - along, 0, None), 0.0) * np.clip(1 - across, 0, None)
            return np.asarray(self.film + pocket.depth * floor)

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
