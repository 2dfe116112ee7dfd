"""The shapes of bearing films in scene files, one class for each shape."""

import math
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part, plain_number
from roughfilm.rom.bearing.given import Given
from roughfilm.rom.bearing.pad import Pad, known_film
from roughfilm.rom.bearing.ring import Sector, Washer
from roughfilm.rom.bearing.texture import Texture, pocketed
from roughfilm.rom.cavitation.shape import Shape


def _below_one(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number < 1:
        raise ValueError(f"got {number!r}; it must be 0 or more and below 1")
    return number


Ratio = Annotated[float, BeforeValidator(_below_one)]
Count = Annotated[int, Field(strict=True, ge=1, le=10_000)]


class Parallel(Pad):
    """A film of constant thickness."""

    shape: Literal["parallel"]

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        return np.full_like(x, self.thinnest)


class Linear(Pad):
    """A film that narrows linearly from film + rise at the inlet to film at the outlet."""

    shape: Literal["linear"]
    rise: Length

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        return np.asarray(self.thinnest + self.rise * (1 - x / self.length))


class Step(Pad):
    """Rayleigh's step bearing: h = film + rise up to the distance ``step`` from the inlet, m, and film behind it."""

    shape: Literal["step"]
    rise: Length
    step: Length

    @model_validator(mode="after")
    def _inside(self) -> Self:
        if self.step >= self.length:
            raise ValueError(f"step: got {self.step!r} m; it must lie inside the length of {self.length!r} m")
        return self

    def breaks(self) -> tuple[float, ...]:
        """The positions where h or its slope jumps, m."""
        return 0.0, self.step, self.length

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        return np.where(x < self.step, self.thinnest + self.rise, self.thinnest)


class Parabolic(Pad):
    """A row of ``count`` equal parabolas, each with h = film + rise at its ends and film in its middle."""

    shape: Literal["parabolic"]
    rise: Length
    count: Count = 1

    @property
    def finest(self) -> float:
        """The length of the shortest feature along the sliding direction, m."""
        return self.length / self.count

    def breaks(self) -> tuple[float, ...]:
        """The positions where h or its slope jumps, m."""
        return (*(self.length * number / self.count for number in range(self.count)), self.length)

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        period = self.length / self.count
        along = x - period * np.clip(np.floor(x / period), 0, self.count - 1)
        return np.asarray(self.thinnest + self.rise * (2 * along / period - 1) ** 2)


class Wavy(Pad):
    """A parallel film with waves from the inlet up to ``extent``, m; by default half of the length."""

    amplitude: Length
    wavelength: Length
    extent: Length | None = None

    @property
    def end(self) -> float:
        """The position where the waves end, m."""
        return self.length / 2 if self.extent is None else self.extent

    @property
    def finest(self) -> float:
        """The length of the shortest feature along the sliding direction, m."""
        return self.wavelength

    @model_validator(mode="after")
    def _inside(self) -> Self:
        if self.end > self.length:
            raise ValueError(f"extent: got {self.extent!r} m; it must be at most the length, {self.length!r} m")
        return self

    def breaks(self) -> tuple[float, ...]:
        """The positions where h or its slope jumps, m."""
        return tuple(sorted({0.0, self.end, self.length}))


class SinusoidalInlet(Wavy):
    """A film with h = film + amplitude sin(2π x/wavelength) at the inlet."""

    shape: Literal["sinusoidal_inlet"]

    @property
    def dip(self) -> float:
        """The depth to which waves of the wall reach below the minimum film thickness, m: the amplitude."""
        return self.amplitude

    @model_validator(mode="after")
    def _open(self) -> Self:
        if self.film is not None and self.amplitude >= self.film:
            raise ValueError(f"amplitude: got {self.amplitude!r} m; it must be below film, or the walls touch")
        return self

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        wave = self.amplitude * np.sin(2 * np.pi * x / self.wavelength)
        return np.asarray(self.thinnest + np.where(x < self.end, wave, 0.0))


class SquaredCosineInlet(Wavy):
    """A film with h = film + amplitude cos²(π x/wavelength) at the inlet, and a step where the waves end."""

    shape: Literal["squared_cosine_inlet"]

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        wave = self.amplitude * np.cos(np.pi * x / self.wavelength) ** 2
        return np.asarray(self.thinnest + np.where(x < self.end, wave, 0.0))


class Journal(Part):
    """A full journal bearing, unrolled from the widest place: h = clearance (1 + eccentricity cos φ), x = R φ."""

    shape: Literal["journal"]
    radius: Length
    clearance: Length
    eccentricity: Ratio | None = None
    width: Length | None = None
    texture: Texture | None = None

    @property
    def film(self) -> float | None:
        """The minimum film thickness, m; None if a load determines it."""
        return None if self.eccentricity is None else self.clearance * (1 - self.eccentricity)

    @property
    def thinnest(self) -> float:
        """The minimum film thickness, m; InputError if a load determines it."""
        return known_film(self.film)

    @property
    def widest(self) -> float:
        """The largest minimum film thickness, m: the clearance."""
        return self.clearance

    @property
    def dip(self) -> float:
        """The depth to which waves of the wall reach below the minimum film thickness, m: 0."""
        return 0.0

    @property
    def length(self) -> float:
        """The circumference, m."""
        return 2 * math.pi * self.radius

    def at_film(self, film: float) -> Self:
        """The same shaft at another minimum film thickness, m, which is at most the clearance."""
        return self.model_copy(update={"eccentricity": 1 - film / self.clearance})

    @model_validator(mode="after")
    def _is_thin(self) -> Self:
        if self.clearance > 0.1 * self.radius:
            raise ValueError(f"clearance: got {self.clearance!r} m; it must be at most a tenth of the radius")
        return self

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


AnyShape = (
    Parallel | Linear | Step | Parabolic | SinusoidalInlet | SquaredCosineInlet | Given | Journal | Sector | Washer
)
SHAPES: dict[str, type[Part]] = {
    "parallel": Parallel,
    "linear": Linear,
    "step": Step,
    "parabolic": Parabolic,
    "sinusoidal_inlet": SinusoidalInlet,
    "squared_cosine_inlet": SquaredCosineInlet,
    "given": Given,
    "journal": Journal,
    "sector": Sector,
    "washer": Washer,
}
