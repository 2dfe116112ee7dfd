"""The common base of films over a rectangle."""

import math
from typing import Self

from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.geometry.texture import Texture, pocketed
from roughfilm.rom.cavitation.shape import Shape


def known_film(film: float | None) -> float:
    """The film thickness, m, or eccentricity; InputError if it is missing, because the load determines it."""
    if film is None:
        raise InputError("geometry.film: is missing; give it, or solve for the film under the load")
    return film


class Pad(Part):
    """A film over a rectangle.

    Attributes
    ----------
    length : length along the sliding direction, m.
    width : width across the sliding direction, m; None if infinitely wide.
    film : minimum film thickness without texture, m; None if a load determines it.
    texture : pockets in the still wall; None without pockets.
    """

    length: Length
    width: Length | None = None
    film: Length | None = None
    texture: Texture | None = None

    @property
    def thinnest(self) -> float:
        """The minimum film thickness without texture, m; InputError if a load determines it."""
        return known_film(self.film)

    @property
    def widest(self) -> float:
        """The largest minimum film thickness, m: the length."""
        return self.length

    @property
    def dip(self) -> float:
        """The depth to which waves of the wall reach below the minimum film thickness, m."""
        return 0.0

    def breaks(self) -> tuple[float, ...]:
        """The positions where h or its slope jumps, m."""
        return 0.0, self.length

    @property
    def finest(self) -> float:
        """The length of the shortest feature along the sliding direction, m."""
        return math.inf

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        raise NotImplementedError

    def film_shape(self) -> Shape:
        """The shape of the film, with its texture."""
        across = (0.0, self.length if self.width is None else self.width)
        smooth = Shape(
            thickness=lambda x, y: self.smooth_thickness(x) + 0 * y,
            breaks=self.breaks(),
            across=across,
            wide=self.width is None,
            finest=(self.finest, math.inf),
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)

    def at_film(self, film: float) -> Self:
        """The same wall, shifted to another minimum film thickness, m."""
        return self.model_copy(update={"film": film})

    @model_validator(mode="after")
    def _is_thin(self) -> Self:
        if self.film is not None and self.film > self.length:
            raise ValueError(f"film: got {self.film!r} m, more than the length of the bearing; check the units")
        if self.width is not None and self.film is not None and self.width < self.film:
            raise ValueError(f"width: got {self.width!r} m, less than the film thickness; check the units")
        for name in ("rise", "amplitude"):
            height = getattr(self, name, 0.0)
            if height > self.length:
                raise ValueError(f"{name}: got {height!r} m, more than the length of the bearing; check the units")
        return self
