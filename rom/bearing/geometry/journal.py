"""Shafts in bores: the full journal bearing, unrolled from its widest place."""

import math
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.entries import Length, Part, plain_number
from roughfilm.rom.bearing.geometry.pad import known_film
from roughfilm.rom.bearing.geometry.texture import Texture, pocketed
from roughfilm.rom.cavitation.shape import Shape


def _below_one(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number < 1:
        raise ValueError(f"got {number!r}; it must be 0 or more and below 1")
    return number


Ratio = Annotated[float, BeforeValidator(_below_one)]


class Shaft(Part):
    """A shaft in a bore.

    Attributes
    ----------
    radius : radius of the shaft, m.
    clearance : radial clearance, m.
    width : width along the axis, m; without it infinitely wide.
    """

    radius: Length
    clearance: Length
    width: Length | None = None

    @model_validator(mode="after")
    def _is_thin(self) -> Self:
        if self.clearance > 0.1 * self.radius:
            raise ValueError(f"clearance: got {self.clearance!r} m; it must be at most a tenth of the radius")
        return self

    @property
    def length(self) -> float:
        """The circumference, m."""
        return 2 * math.pi * self.radius

    @property
    def widest(self) -> float:
        """The largest minimum film thickness, m: the clearance."""
        return self.clearance

    @property
    def dip(self) -> float:
        """The depth to which waves of the wall reach below the minimum film thickness, m: 0."""
        return 0.0


class Journal(Shaft):
    """A full journal bearing, unrolled from the widest place: h = clearance (1 + eccentricity cos φ), x = R φ.

    Attributes
    ----------
    radius : radius of the shaft, m.
    clearance : radial clearance, m.
    eccentricity : distance of the axes over the clearance, 0 to 1.
    width : width along the axis, m; without it infinitely wide.
    texture : pockets in the still wall.
    """

    shape: Literal["journal"]
    eccentricity: Ratio | None = None
    texture: Texture | None = None

    @property
    def film(self) -> float | None:
        """The minimum film thickness, m; None if a load determines it."""
        return None if self.eccentricity is None else self.clearance * (1 - self.eccentricity)

    @property
    def thinnest(self) -> float:
        """The minimum film thickness, m; InputError if a load determines it."""
        return known_film(self.film)

    def at_film(self, film: float) -> Self:
        """The same shaft at another minimum film thickness, m, which is at most the clearance."""
        return self.model_copy(update={"eccentricity": 1 - film / self.clearance})

    def film_shape(self) -> Shape:
        """The shape of the film, with its texture."""
        off_centre = known_film(self.eccentricity)
        smooth = Shape(
            thickness=lambda x, y: self.clearance * (1 + off_centre * np.cos(x / self.radius)) + 0 * y,
            breaks=(0.0, self.length),
            across=(0.0, self.length if self.width is None else self.width),
            wide=self.width is None,
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)
