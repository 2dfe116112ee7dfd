"""The shapes of bearing films in scene files, one class for each shape."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part
from roughfilm.rom.bearing.geometry.given import Given
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pad import Pad
from roughfilm.rom.bearing.geometry.pivoted import Pivoted, PivotedSector
from roughfilm.rom.bearing.geometry.ring import Sector, Washer

Count = Annotated[int, Field(strict=True, ge=1, le=10_000)]


class Parallel(Pad):
    """A film of constant thickness."""

    shape: Literal["parallel"]

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        return np.full_like(x, self.thinnest)


class Linear(Pad):
    """A film that narrows linearly from film + rise at the inlet to film at the outlet.

    Attributes
    ----------
    rise : film thickness at the inlet minus that at the outlet, m.
    """

    shape: Literal["linear"]
    rise: Length

    def smooth_thickness(self, x: Array) -> Array:
        """The film thickness h(x) without texture, m."""
        return np.asarray(self.thinnest + self.rise * (1 - x / self.length))


class Step(Pad):
    """Rayleigh's step bearing: h = film + rise up to the distance ``step`` from the inlet, m, and film behind it.

    Attributes
    ----------
    rise : height of the step, m.
    step : distance of the step from the inlet, m.
    """

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
    """A row of ``count`` equal parabolas, each with h = film + rise at its ends and film in its middle.

    Attributes
    ----------
    rise : film thickness at the ends of a parabola minus that in its middle, m.
    count : number of parabolas.
    """

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
    """A parallel film with waves from the inlet up to ``extent``, m; by default half of the length.

    Attributes
    ----------
    amplitude : amplitude of the waves, m.
    wavelength : length of a wave, m.
    extent : distance from the inlet at which the waves end, m; by default half of the length.
    """

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


AnyShape = (
    Parallel
    | Linear
    | Step
    | Parabolic
    | SinusoidalInlet
    | SquaredCosineInlet
    | Given
    | Journal
    | Lobes
    | Pivoted
    | PivotedSector
    | Sector
    | Washer
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
    "lobes": Lobes,
    "pivoted": Pivoted,
    "pivoted_sector": PivotedSector,
    "sector": Sector,
    "washer": Washer,
}
