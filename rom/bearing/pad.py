"""What the shapes of films over a rectangle have in common."""

import math
from typing import Self

from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part
from roughfilm.rom.bearing.texture import Texture, pocketed
from roughfilm.rom.cavitation.shape import Shape


class Pad(Part):
    """A film over a rectangle: ``length`` along the sliding, ``width`` across, infinitely wide without it; m.

    ``film`` is the least film thickness without texture.
    """

    length: Length
    width: Length | None = None
    film: Length
    texture: Texture | None = None

    def breaks(self) -> tuple[float, ...]:
        """Where h or its slope jumps, m."""
        return 0.0, self.length

    @property
    def finest(self) -> float:
        """The shortest feature along the sliding, m."""
        return math.inf

    def untextured(self, x: Array) -> Array:
        """h(x), m."""
        raise NotImplementedError

    def film_shape(self) -> Shape:
        """The film."""
        across = (0.0, self.length if self.width is None else self.width)
        smooth = Shape(
            thickness=lambda x, y: self.untextured(x) + 0 * y,
            breaks=self.breaks(),
            across=across,
            wide=self.width is None,
            finest=(self.finest, math.inf),
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)

    def at_film(self, film: float) -> Self:
        """The same wall, shifted."""
        return self.model_copy(update={"film": film})

    @model_validator(mode="after")
    def _thin(self) -> Self:
        if self.film > self.length:
            raise ValueError(f"film: got {self.film!r} m, thicker than the bearing is long; look at the units")
        if self.width is not None and self.width < self.film:
            raise ValueError(f"width: got {self.width!r} m, less than the film is thick; look at the units")
        for name in ("rise", "amplitude"):
            height = getattr(self, name, 0.0)
            if height > self.length:
                raise ValueError(f"{name}: got {height!r} m, higher than the bearing is long; look at the units")
        return self
