"""Scenes of a rough surface pressed on a flat one, for dry contacts and seals."""

from abc import abstractmethod
from typing import Self

from pydantic import model_validator

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.mechanics.moments import WavePower
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.parts.solids import Counter, Pressure, RoughBody, composite_modulus, hardness
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry

MIN_SIDE_POINTS = 8
"""Smallest number of points along the longer side."""

COARSENING_RATIOS = (8, 4, 2, 1)
"""Ratios of the surface's own number of points to those of a convergence study."""


class Load(Part):
    """The mean pressure on the nominal area, Pa.

    Attributes
    ----------
    pressure : mean pressure on the nominal area, Pa.
    """

    pressure: Pressure


class RoughScene(Scene):
    """A scene of one rough surface."""

    @abstractmethod
    def surface(self) -> Surface:
        """The rough surface."""

    @property
    @abstractmethod
    def rms_slope(self) -> float:
        """Rms slope of the surface; 0 if it is flat."""

    def unit_warnings(self) -> tuple[str, ...]:
        """The warnings that a unit of the file of the surface may be wrong."""
        return ()

    @property
    def resolutions(self) -> tuple[int, ...]:
        """Numbers of points along the longer side of a convergence study, up to the surface's own."""
        own = max(self.surface().shape)
        ratios = (ratio for ratio in COARSENING_RATIOS if own // ratio >= MIN_SIDE_POINTS or ratio == 1)
        return tuple(dict.fromkeys(own // ratio for ratio in ratios))


class RoughContact(RoughScene):
    """A periodic rough surface under a flat one, without friction or adhesion; the default counter body is rigid."""

    geometry: SurfaceGeometry
    solid: RoughBody
    counter: Counter | None = None
    load: Load

    @model_validator(mode="after")
    def _below_hardness(self) -> Self:
        if self.load.pressure > self.hardness:
            raise ValueError(
                f"load.pressure: got {self.load.pressure:.6g} Pa; it must be at most the hardness of "
                f"{self.hardness:.6g} Pa, lower the load"
            )
        return self

    @property
    def hardness(self) -> float:
        """Hardness H, Pa; infinite for an elastic solid."""
        return hardness(self.solid)

    @property
    def composite_modulus(self) -> float:
        """Composite modulus E*, Pa."""
        return composite_modulus(self.solid, self.counter)

    def surface(self) -> Surface:
        """The rough surface."""
        return self.geometry.read()

    def unit_warnings(self) -> tuple[str, ...]:
        """The warnings that a unit of the file of the surface may be wrong."""
        return self.geometry.warnings()

    def spectrum(self) -> WavePower | None:
        """The spectrum of the surface; None if it is flat."""
        return self.geometry.spectrum()

    @property
    def rms_slope(self) -> float:
        """Rms slope g' = sqrt(<|∇z|²>) of the surface; 0 if it is flat."""
        spectrum = self.spectrum()
        return 0.0 if spectrum is None else spectrum.moments.rms_slope

    @property
    def pressure_unit(self) -> float:
        """The unit of contact pressure: E* g', Pa, or E* for a flat surface."""
        return self.composite_modulus * (self.rms_slope or 1.0)
