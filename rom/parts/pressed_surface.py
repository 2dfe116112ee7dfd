"""A rough surface pressed on a flat one: what scenes of dry contacts and of seals share."""

from abc import abstractmethod
from typing import Self

from pydantic import model_validator

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.mechanics.moments import WavePower
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.parts.solids import Counter, Pressure, RoughBody, composite_modulus, hardness
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry

COARSEST = 8
"""Points along the longer side, at least."""

COARSER = (8, 4, 2, 1)
"""For charts, the surface's own points are divided by these."""


class Load(Part):
    """Mean pressure over the nominal area, Pa."""

    pressure: Pressure


class RoughScene(Scene):
    """A scene of one rough surface."""

    @abstractmethod
    def surface(self) -> Surface:
        """The rough surface."""

    @property
    @abstractmethod
    def rms_slope(self) -> float:
        """Rms slope of the surface, 0 if it is flat."""

    @property
    def resolutions(self) -> tuple[int, ...]:
        """Points along the longer side, from coarse grids to the surface's own."""
        own = max(self.surface().shape)
        return tuple(dict.fromkeys(own // part for part in COARSER if own // part >= COARSEST or part == 1))


class RoughContact(RoughScene):
    """A periodic rough surface under a flat one, without friction or adhesion; a counter body not given is rigid."""

    geometry: SurfaceGeometry
    solid: RoughBody
    counter: Counter | None = None
    load: Load

    @model_validator(mode="after")
    def _can_be_borne(self) -> Self:
        if self.load.pressure > self.hardness:
            raise ValueError(
                f"load.pressure: got {self.load.pressure:.6g} Pa, above the hardness of {self.hardness:.6g} Pa, "
                "which is all that the whole area can bear; lower the load"
            )
        return self

    @property
    def hardness(self) -> float:
        """H, Pa; infinite for an elastic solid."""
        return hardness(self.solid)

    @property
    def composite_modulus(self) -> float:
        """E*, Pa."""
        return composite_modulus(self.solid, self.counter)

    def surface(self) -> Surface:
        """The rough surface."""
        return self.geometry.read()

    def spectrum(self) -> WavePower | None:
        """Its waves; None if it is flat."""
        return self.geometry.spectrum()

    @property
    def rms_slope(self) -> float:
        """Slope g' = sqrt(<|∇z|²>) of the surface, 0 if it is flat."""
        spectrum = self.spectrum()
        return 0.0 if spectrum is None else spectrum.moments.rms_slope

    @property
    def pressure_unit(self) -> float:
        """E* g', Pa; E* for a flat surface. In full elastic contact pressure spreads by half of it."""
        return self.composite_modulus * (self.rms_slope or 1.0)
