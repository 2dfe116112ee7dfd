"""Roughness of a bearing's shaped wall, as a scene file writes it: sinusoidal ridges, or a surface that repeats."""

import hashlib
import math
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
import scipy
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Angle, Length, Part, PositiveNumber
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges
from roughfilm.rom.homogenization.table.factor_table import FactorTable
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry

LEVEL = 1e-12
"""A wave vector has no part along a direction whose cosine is below this."""

TOLERANCE, BELOW = 5e-4, 0.999
"""Of the interpolation between flow factors of a surface, and where they begin, over the narrowest film."""

SHORTEST = 4
"""Pixels: the shortest wave of a surface that a grid is asked to follow, each cell then half a pixel."""


class Sinusoid(Part):
    """h = h₀ + amplitude sin(2π (x cos β + y sin β)/wavelength + phase), β the ``direction`` of the wave vector.

    x runs along the bearing from its inlet (towards which the wall slides counts for nothing), y across; β = 0 has
    ridges across it.
    """

    kind: Literal["sinusoid"]
    amplitude: Length
    wavelength: Length
    direction: Angle = 0.0
    phase: Angle = 0.0

    @property
    def waves(self) -> tuple[float, float]:
        """Of the wave vector along x and y, waves per m."""
        parts = math.cos(self.direction), math.sin(self.direction)
        along, across = (0.0 if abs(part) < LEVEL else part / self.wavelength for part in parts)
        return along, across

    @property
    def finest(self) -> tuple[float, float]:
        """The shortest wave along x and y, m; infinite where there is none."""
        along, across = (math.inf if part == 0 else 1 / abs(part) for part in self.waves)
        return along, across

    @property
    def period(self) -> float:
        """What repeats, m."""
        return self.wavelength

    @property
    def peak(self) -> float:
        """The greatest height above the mean, m."""
        return self.amplitude

    @property
    def rms(self) -> float:
        """Of the heights, m."""
        return self.amplitude / math.sqrt(2)

    @property
    def told(self) -> str:
        """What people call it."""
        return f"sinusoidal ridges, {math.degrees(self.direction):.3g}° from across the sliding"

    def added(self, x: Array, y: Array) -> Array:
        """What the film is thicker by, m."""
        along, across = self.waves
        return np.asarray(self.amplitude * np.sin(2 * np.pi * (along * x + across * y) + self.phase))

    def factors(self, _narrowest: float) -> FactorsOverGap:
        """Averaged, for mean gaps from the narrowest on, m."""
        return sinusoidal_ridges(self.amplitude, self.direction)

    def doubt(self, _narrowest: float) -> float:
        """The part by which the factors may be off: none, they are integrals."""
        return 0.0


class RoughSurface(SurfaceGeometry):
    """h = h₀ - (heights - their mean), upward heights narrowing the gap; the surface repeats over the film.

    Its x lies along that of the bearing. Heights are multiplied by ``scale``, lengths in the plane by ``stretch``;
    between its points the surface is bilinear.
    """

    kind: Literal["surface"]
    scale: PositiveNumber = 1.0
    stretch: PositiveNumber = 1.0

    @property
    def finest(self) -> tuple[float, float]:
        """The shortest wave along x and y that counts, m; infinite where nothing varies."""
        heights, (dx, dy) = self.scaled_heights(), self.read().spacing
        along, across = (
            SHORTEST * step * self.stretch if np.ptp(heights, axis=axis).any() else math.inf
            for axis, step in enumerate((dx, dy))
        )
        return along, across

    @property
    def period(self) -> float:
        """What repeats along x, m."""
        surface = self.read()
        return self.stretch * surface.spacing[0] * surface.shape[0]

    @property
    def peak(self) -> float:
        """The greatest height above the mean, m."""
        return float(self.scaled_heights().max())

    @property
    def rms(self) -> float:
        """Of the heights, m."""
        return float(self.scaled_heights().std())

    @property
    def told(self) -> str:
        """What people call it."""
        return f"the surface {self.name}"

    def added(self, x: Array, y: Array) -> Array:
        """What the film is thicker by, m."""
        heights, spacing = self.scaled_heights(), self.read().spacing
        if not np.ptp(heights, axis=1).any():
            places = np.mod(x / (spacing[0] * self.stretch), len(heights))
            profile = np.append(heights[:, 0], heights[0, 0])
            return np.asarray(-np.interp(places, np.arange(profile.size), profile))
        pixels = (place / (step * self.stretch) for place, step in zip((x, y), spacing, strict=True))
        found = scipy.ndimage.map_coordinates(
            heights, np.array(np.broadcast_arrays(*pixels)), order=1, mode="grid-wrap"
        )
        return np.asarray(-found)

    def factors(self, narrowest: float) -> FactorTable:
        """Averaged, for mean gaps from the narrowest on, m.

        Where the walls would touch, heights are cut off, so that the mean gap counts what is left.
        """
        told = self.model_dump_json(include={"surface", "spacing", "digest"}, exclude_none=True)
        return _factors(told, narrowest / self.scale).scaled(self.scale)

    def doubt(self, narrowest: float) -> float:
        """The largest part by which the factors may be off."""
        return self.factors(narrowest).relative_uncertainty

    def scaled_heights(self) -> Array:
        """Above their mean, m, shape (nx, ny)."""
        heights = self.read().heights
        return np.asarray((heights - heights.mean()) * self.scale)

    def scaled_spacing(self) -> tuple[float, float]:
        """(dx, dy), m."""
        dx, dy = self.read().spacing
        return dx * self.stretch, dy * self.stretch


@lru_cache(maxsize=4)
def _factors(surface: str, narrowest: float) -> FactorTable:
    from roughfilm.rom.homogenization.table.tabulate import tabulate  # whose loops are slow to import

    read = SurfaceGeometry.model_validate_json(surface).read()
    return tabulate(read.heights, read.spacing, tolerance=TOLERANCE, narrowest=BELOW * narrowest)


class StoredTable(Part):
    """Flow factors over the mean gap from a file of ``roughfilm factors``, with the asperities' pressures or without.

    x of the surface lies along that of the bearing. How long its waves are the file does not say. ``digest`` is that of
    the file: a scene that was written back is not read over another table.
    """

    kind: Literal["table"]
    table: Annotated[str, Field(min_length=1)]
    digest: str | None = None

    @model_validator(mode="after")
    def _is_there(self) -> Self:
        path = Path(self.table).expanduser()
        try:
            found = hashlib.sha256(path.read_bytes()).hexdigest()[:32]
            self.read()
        except OSError as error:
            told = "no such file" if isinstance(error, FileNotFoundError) else f"cannot be read ({error.strerror})"
            raise ValueError(f"table: in {path}: {told}; name a table of flow factors") from None
        except InputError as error:
            raise ValueError(f"table: in {error}") from None
        if self.digest not in (None, found):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but {self.table} holds another table by now, {found!r}; leave the "
                "digest out to take it"
            )
        return self.model_copy(update={"digest": found})

    def read(self) -> FactorTable:
        """The table; InputError if it cannot be read."""
        path = Path(self.table).expanduser()
        state = path.stat()
        return _stored(str(path), state.st_mtime_ns, state.st_size)

    @property
    def finest(self) -> tuple[float, float]:
        """Not known."""
        return math.nan, math.nan

    @property
    def period(self) -> float:
        """Not known."""
        return math.nan

    @property
    def peak(self) -> float:
        """The greatest height above the mean, m."""
        return self.read().peak

    @property
    def rms(self) -> float:
        """Of the heights, m."""
        return self.read().rms

    @property
    def told(self) -> str:
        """What people call it."""
        return f"the roughness of {Path(self.table).name}"

    def factors(self, _narrowest: float) -> FactorTable:
        """Averaged, for mean gaps that the table reaches."""
        return self.read()

    def doubt(self, narrowest: float) -> float:
        """The largest part by which the factors may be off from the narrowest mean gap on, m."""
        return self.read().relative_uncertainty_above(narrowest)


@lru_cache(maxsize=4)
def _stored(path: str, _modified: int, _size: int) -> FactorTable:
    from roughfilm.rom.homogenization.table.store import load_table  # h5py is slow to import

    return load_table(Path(path))


AnyRoughness = Annotated[Sinusoid | RoughSurface | StoredTable, Field(discriminator="kind")]
ROUGHNESSES: dict[str, type[Part]] = {"sinusoid": Sinusoid, "surface": RoughSurface, "table": StoredTable}
