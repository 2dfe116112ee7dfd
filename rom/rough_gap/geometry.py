"""The scene entries of the walls of a rough gap: a surface or a sinusoid, and optionally a second rough wall."""

from functools import lru_cache
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, NamesFile
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, joint_mismatch
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.sinusoids import sinusoid
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry, surface_entry

SINUSOID = "sinusoid"
"""The value of ``surface`` for a sinusoidal wall."""

SINUSOID_POINTS = (256, 2)
"""Numbers of points of a sinusoid along the wave and across it."""

SINUSOID_PIXEL_RATIO = 4
"""Ratio of width to length of the pixels of a sinusoid."""

SIZE_TOLERANCE = 1e-6
"""Relative tolerance of the equal sides of both walls."""


class RoughWall(SurfaceGeometry):
    """A periodic wall: a surface, or ``"sinusoid"`` with ``amplitude`` a and ``wavelength`` λ.

    The sinusoid is a cos(2π x/λ), one wave long, with ridges along y.

    Attributes
    ----------
    surface : name of a file of heights, a table that describes a synthetic surface, or "sinusoid".
    amplitude : amplitude of a sinusoid, m.
    wavelength : wavelength of a sinusoid, m.
    """

    surface: Annotated[str | dict[str, Any], BeforeValidator(surface_entry), NamesFile(words=(SINUSOID,))]
    amplitude: Length | None = None
    wavelength: Length | None = None

    @model_validator(mode="before")
    @classmethod
    def _has_what_its_kind_needs(cls, entries: Any) -> Any:
        if not isinstance(entries, dict):
            return entries
        wave = [key for key in ("amplitude", "wavelength") if entries.get(key) is not None]
        if entries.get("surface") != SINUSOID:
            if wave:
                raise ValueError(f'{wave[0]}: needs surface = "sinusoid"; leave it out, or set surface')
            return entries
        if len(wave) < 2:
            missing = "wavelength" if wave == ["amplitude"] else "amplitude"
            raise ValueError(f'{missing}: is missing; surface = "sinusoid" needs an amplitude and a wavelength')
        return entries

    @model_validator(mode="after")
    def _is_periodic(self) -> Self:
        if not self.described and not self.read().periodic:
            mismatch = _mismatch(self.model_dump_json(include={"surface", "spacing", "digest"}, exclude_none=True))
            if mismatch > MISMATCH_THRESHOLD:
                raise ValueError(
                    f"surface: is not periodic (edge mismatch {mismatch:.2g}; it must be at most "
                    f"{MISMATCH_THRESHOLD:g}); prepare it with: roughfilm surface"
                )
        return self

    @property
    def _kind(self) -> str:
        return SINUSOID if self.surface == SINUSOID else super()._kind

    @property
    def name(self) -> str:
        """The name of the file, or the kind of a described surface."""
        return SINUSOID if self.surface == SINUSOID else super().name

    def read(self) -> Surface:
        """One period of the wall; errors are those of :meth:`SurfaceGeometry.read`."""
        if self.surface != SINUSOID:
            return super().read()
        assert self.amplitude is not None
        assert self.wavelength is not None
        return _sinusoid(self.amplitude, self.wavelength)


class GapGeometry(RoughWall):
    """The lower wall, the distance of the mean planes of both walls, and a rough upper wall.

    Without ``mean_gap`` a load determines the gap. ``upper`` has the same period as the lower wall, and its heights are
    positive upward too; without it the upper wall is flat.

    Attributes
    ----------
    mean_gap : distance of the mean planes, m; leave it out where a load presses the walls.
    upper : the other wall; without it that wall is flat.
    """

    mean_gap: Length | None = None
    upper: RoughWall | None = None

    @model_validator(mode="after")
    def _same_period(self) -> Self:
        if self.upper is not None:
            (length, width), (other_length, other_width) = self.read().size, self.upper.read().size
            if abs(other_length / length - 1) > SIZE_TOLERANCE or abs(other_width / width - 1) > SIZE_TOLERANCE:
                raise ValueError(
                    f"upper: got a period of {other_length:.6g} × {other_width:.6g} m; it must be that of the lower "
                    f"wall, {length:.6g} × {width:.6g} m"
                )
            if self.upper.read().shape != self.read().shape:
                raise ValueError(
                    f"upper: got {self.upper.read().shape} points; it must have {self.read().shape} as the lower wall, "
                    "resample one of them"
                )
        return self

    def heights(self) -> tuple[Array, Array]:
        """The heights of the lower and the upper wall above their means, m, shape (nx, ny); 0 for a flat wall."""
        lower = _centred(self.read())
        return lower, np.zeros(lower.shape) if self.upper is None else _centred(self.upper.read())


def _centred(surface: Surface) -> Array:
    return np.asarray(surface.heights - surface.heights.mean())


@lru_cache(maxsize=4)
def _mismatch(wall: str) -> float:
    return joint_mismatch(SurfaceGeometry.model_validate_json(wall).read())


@lru_cache(maxsize=4)
def _sinusoid(amplitude: float, wavelength: float) -> Surface:
    points, across = SINUSOID_POINTS
    return sinusoid(
        size=(wavelength, wavelength * across / points * SINUSOID_PIXEL_RATIO),
        points=SINUSOID_POINTS,
        amplitude=amplitude,
        wavelength_x=wavelength,
    )
