"""The roughness of the shaped wall in scene files: sinusoidal ridges, a periodic surface, or a stored table."""

import math
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
import scipy
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Angle, Length, Part, PositiveNumber, ScenePath
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import file_size
from roughfilm.contact.surfaces.files import file_digest
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges
from roughfilm.rom.homogenization.table.factor_table import FactorTable
from roughfilm.rom.ladder.model import report
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry

ZERO_COSINE = 1e-12
"""Direction cosine below which a component of a wave vector counts as zero."""

FACTOR_TOLERANCE = 5e-4
"""Tolerance of the interpolation between flow factors of a surface."""

FIRST_GAP_RATIO = 0.999
"""Largest mean gap of the first point of a table of flow factors, over that of the narrowest film."""

STEPS_PER_OCTAVE = 2
"""Number of possible first mean gaps of a table for each factor of 2, so that films of many thicknesses share one."""

PIXELS_PER_WAVE = 4
"""Length of the shortest wave of a surface that a grid resolves, in pixels; a cell is then half a pixel."""


class Sinusoid(Part):
    """Ridges: h = h₀ + amplitude sin(2π (x cos β + y sin β)/wavelength + phase), β the ``direction``.

    x runs along the bearing from its inlet and y across, whichever way the wall slides; ridges with β = 0 run across.

    Attributes
    ----------
    amplitude : amplitude of the ridges, m.
    wavelength : distance of the ridges, m.
    direction : angle β of the wave vector from x towards y, rad; 0 for ridges across the sliding.
    phase : phase at the inlet, rad.
    """

    kind: Literal["sinusoid"]
    amplitude: Length
    wavelength: Length
    direction: Angle = 0.0
    phase: Angle = 0.0

    @property
    def waves(self) -> tuple[float, float]:
        """The components of the wave vector along x and y, waves per m."""
        cosines = math.cos(self.direction), math.sin(self.direction)
        along, across = (0.0 if abs(cosine) < ZERO_COSINE else cosine / self.wavelength for cosine in cosines)
        return along, across

    @property
    def finest(self) -> tuple[float, float]:
        """The lengths of the shortest waves along x and y, m; infinite where there is none."""
        along, across = (math.inf if number == 0 else 1 / abs(number) for number in self.waves)
        return along, across

    @property
    def period(self) -> float:
        """The period, m."""
        return self.wavelength

    @property
    def peak(self) -> float:
        """The maximum height above the mean, m."""
        return self.amplitude

    @property
    def rms(self) -> float:
        """The root mean square of the heights about their mean, m."""
        return self.amplitude / math.sqrt(2)

    @property
    def label(self) -> str:
        """The name of the roughness in messages."""
        return f"sinusoidal ridges, {math.degrees(self.direction):.3g}° from across the sliding"

    def added(self, x: Array, y: Array) -> Array:
        """The change of the film thickness at each position, m."""
        along, across = self.waves
        return np.asarray(self.amplitude * np.sin(2 * np.pi * (along * x + across * y) + self.phase))

    def factors(self, _narrowest: float) -> FactorsOverGap:
        """The flow factors over the mean gap."""
        return sinusoidal_ridges(self.amplitude, self.direction)

    def factor_uncertainty(self, _narrowest: float) -> float:
        """The relative uncertainty of the flow factors: 0, because they are integrals."""
        return 0.0


class RoughSurface(SurfaceGeometry):
    """A periodic surface: h = h₀ - (heights - their mean), bilinear between its points.

    The x axes of the surface and of the bearing are parallel.

    Attributes
    ----------
    scale : factor of the heights.
    stretch : factor of the lengths in the plane.
    """

    kind: Literal["surface"]
    scale: PositiveNumber = 1.0
    stretch: PositiveNumber = 1.0

    @property
    def finest(self) -> tuple[float, float]:
        """The lengths of the shortest resolved waves along x and y, m; infinite where the heights are constant."""
        heights, (dx, dy) = self.scaled_heights(), self.read().spacing
        along, across = (
            PIXELS_PER_WAVE * step * self.stretch if np.ptp(heights, axis=axis).any() else math.inf
            for axis, step in enumerate((dx, dy))
        )
        return along, across

    @property
    def period(self) -> float:
        """The period along x, m."""
        surface = self.read()
        return self.stretch * surface.spacing[0] * surface.shape[0]

    @property
    def peak(self) -> float:
        """The maximum height above the mean, m."""
        return float(self.scaled_heights().max())

    @property
    def rms(self) -> float:
        """The root mean square of the heights about their mean, m."""
        return float(self.scaled_heights().std())

    @property
    def label(self) -> str:
        """The name of the roughness in messages."""
        return f"the surface {self.name}"

    def added(self, x: Array, y: Array) -> Array:
        """The change of the film thickness at each position, m."""
        heights, spacing = self.scaled_heights(), self.read().spacing
        if not np.ptp(heights, axis=1).any():
            places = np.mod(x / (spacing[0] * self.stretch), len(heights))
            profile = np.append(heights[:, 0], heights[0, 0])
            return np.asarray(-np.interp(places, np.arange(profile.size), profile))
        pixels = (place / (step * self.stretch) for place, step in zip((x, y), spacing, strict=True))
        places = np.array(np.broadcast_arrays(*pixels))
        return np.asarray(-scipy.ndimage.map_coordinates(heights, places, order=1, mode="grid-wrap"))

    def factors(self, narrowest: float) -> FactorTable:
        """The flow factors at mean gaps of at least ``narrowest``, m; overlapping heights are truncated.

        The table begins at the peak of the roughness times a power of √2.
        """
        entries = self.model_dump_json(include={"surface", "spacing", "digest"}, exclude_none=True)
        highest = self.peak / self.scale
        steps = STEPS_PER_OCTAVE * math.log2(FIRST_GAP_RATIO * narrowest / self.scale / highest) if highest > 0 else 0.0
        return _factors(entries, highest * 2 ** (math.floor(steps) / STEPS_PER_OCTAVE)).scaled(self.scale)

    def factor_uncertainty(self, narrowest: float) -> float:
        """The largest relative uncertainty of the flow factors at mean gaps of at least ``narrowest``, m."""
        return self.factors(narrowest).relative_uncertainty_above(narrowest)

    def scaled_heights(self) -> Array:
        """The heights above their mean, m, shape (nx, ny)."""
        heights = self.read().heights
        return np.asarray((heights - heights.mean()) * self.scale)

    def scaled_spacing(self) -> tuple[float, float]:
        """The spacing (dx, dy), m."""
        dx, dy = self.read().spacing
        return dx * self.stretch, dy * self.stretch


@lru_cache(maxsize=16)
def _factors(surface: str, first: float) -> FactorTable:
    from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs  # whose loops are slow to import
    from roughfilm.rom.homogenization.table.tabulate import tabulate

    geometry = SurfaceGeometry.model_validate_json(surface)
    heights, spacing = geometry.read().heights, geometry.read().spacing

    def progress(done: float, words: str) -> None:
        report(done, f"table of {geometry.name}: {words}")

    return kept_table(
        table_inputs(
            heights, spacing, "rom.homogenization.table.tabulate", tolerance=FACTOR_TOLERANCE, narrowest=first
        ),
        lambda known, keep: tabulate(
            heights,
            spacing,
            tolerance=FACTOR_TOLERANCE,
            narrowest=first,
            known=known,
            keep=keep,
            progress=progress,
        ),
        about={"surface": geometry.name, "kind": "flow factors"},
        progress=progress,
    )


class StoredTable(Part):
    """A stored table of flow factors over the mean gap, with or without contact pressures of asperities.

    The x axes of the surface and of the bearing are parallel. The file has no wavelengths.

    Attributes
    ----------
    table : path of a file written by ``roughfilm factors``.
    digest : digest of the file; a file that has changed since is rejected.
    """

    kind: Literal["table"]
    table: ScenePath
    digest: str | None = None

    @model_validator(mode="after")
    def _can_be_read(self) -> Self:
        path = Path(self.table).expanduser()
        try:
            file_size(path, "name a table of flow factors")
            self.read()
            digest = file_digest(path)[:32]
        except InputError as error:
            raise ValueError(f"table: in {error}") from None
        if self.digest not in (None, digest):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but {self.table} now has {digest!r}; leave the digest out to "
                "accept it"
            )
        return self.model_copy(update={"digest": digest})

    def read(self) -> FactorTable:
        """The table; raises InputError if it cannot be read."""
        path = Path(self.table).expanduser()
        state = path.stat()
        return _stored(str(path), state.st_mtime_ns, state.st_size)

    @property
    def finest(self) -> tuple[float, float]:
        """NaN, because the file has no wavelengths."""
        return math.nan, math.nan

    @property
    def period(self) -> float:
        """NaN, because the file has no wavelengths."""
        return math.nan

    @property
    def peak(self) -> float:
        """The maximum height above the mean, m."""
        return self.read().peak

    @property
    def rms(self) -> float:
        """The root mean square of the heights about their mean, m."""
        return self.read().rms

    @property
    def label(self) -> str:
        """The name of the roughness in messages."""
        return f"the roughness of {Path(self.table).name}"

    def factors(self, _narrowest: float) -> FactorTable:
        """The flow factors at mean gaps in the range of the table."""
        return self.read()

    def factor_uncertainty(self, narrowest: float) -> float:
        """The largest relative uncertainty of the flow factors at mean gaps of at least ``narrowest``, m."""
        return self.read().relative_uncertainty_above(narrowest)


@lru_cache(maxsize=4)
def _stored(path: str, _modified: int, _size: int) -> FactorTable:
    from roughfilm.rom.homogenization.table.store import load_table  # h5py is slow to import

    return load_table(Path(path))


AnyRoughness = Annotated[Sinusoid | RoughSurface | StoredTable, Field(discriminator="kind")]
ROUGHNESSES: dict[str, type[Part]] = {"sinusoid": Sinusoid, "surface": RoughSurface, "table": StoredTable}
