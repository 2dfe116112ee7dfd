"""The walls of a rough gap as a scene file writes them: a surface or a sinusoid, and perhaps a second rough wall."""

from functools import lru_cache
from typing import Any, Self

import numpy as np
from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.sinusoids import sinusoid
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry

SINUSOID = "sinusoid"

SINUSOID_POINTS = (256, 2)
"""Along the wave, and across it, where nothing changes."""

ACROSS = 4
"""Pixels of a sinusoid are so many times as wide as long."""

LIKE = 1e-6
"""Of the sides of both walls, which must be the same."""


class Rough(SurfaceGeometry):
    """A wall that repeats itself: a surface, or ``"sinusoid"`` with ``amplitude`` a and ``wavelength`` λ.

    The sinusoid is a cos(2π x/λ), one wave long, with ridges along y.
    """

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
                raise ValueError(f'{wave[0]}: is for surface = "sinusoid"; leave it out, or write that')
        elif len(wave) < 2:
            missing = "wavelength" if wave == ["amplitude"] else "amplitude"
            raise ValueError(f'{missing}: is missing; surface = "sinusoid" needs an amplitude and a wavelength')
        return entries

    @model_validator(mode="after")
    def _repeats_itself(self) -> Self:
        if not self.described and not self.read().periodic:
            mismatch = _mismatch(self.model_dump_json(include={"surface", "spacing", "digest"}, exclude_none=True))
            if mismatch > MISMATCH_THRESHOLD:
                raise ValueError(
                    f"surface: does not repeat itself (its edges meet with a mismatch of {mismatch:.2g}, at most "
                    f"{MISMATCH_THRESHOLD:g} is taken); prepare it with: roughfilm surface"
                )
        return self

    @property
    def _kind(self) -> str:
        return SINUSOID if self.surface == SINUSOID else super()._kind

    @property
    def name(self) -> str:
        """The file's name, or the kind of a described one."""
        return SINUSOID if self.surface == SINUSOID else super().name

    def read(self) -> Surface:
        """One period of it; raises InputError as :meth:`SurfaceGeometry.read` does."""
        if self.surface != SINUSOID:
            return super().read()
        assert self.amplitude is not None
        assert self.wavelength is not None
        return _sinusoid(self.amplitude, self.wavelength)


class GapGeometry(Rough):
    """The lower wall, and how far the upper one is above it.

    ``mean_gap`` lies between their mean planes; without it a load makes the gap. ``upper`` is rough too, on the same
    period, its heights upward as well; without it the upper wall is flat.
    """

    mean_gap: Length | None = None
    upper: Rough | None = None

    @model_validator(mode="after")
    def _fit_each_other(self) -> Self:
        if self.upper is not None:
            (length, width), (other_length, other_width) = self.read().size, self.upper.read().size
            if abs(other_length / length - 1) > LIKE or abs(other_width / width - 1) > LIKE:
                raise ValueError(
                    f"upper: got a period of {other_length:.6g} × {other_width:.6g} m, the lower wall has "
                    f"{length:.6g} × {width:.6g} m; take surfaces of one size"
                )
            if self.upper.read().shape != self.read().shape:
                raise ValueError(
                    f"upper: got {self.upper.read().shape} points, not {self.read().shape} as the lower wall has; "
                    "resample one of them"
                )
        return self

    def heights(self) -> tuple[Array, Array]:
        """Of the lower and the upper wall, each above its mean, m, shape (nx, ny); 0 if it is flat."""
        lower = _centred(self.read())
        return lower, np.zeros(lower.shape) if self.upper is None else _centred(self.upper.read())


def _centred(surface: Surface) -> Array:
    return np.asarray(surface.heights - surface.heights.mean())


@lru_cache(maxsize=4)
def _mismatch(wall: str) -> float:
    return periodicity_mismatch(SurfaceGeometry.model_validate_json(wall).read())


@lru_cache(maxsize=4)
def _sinusoid(amplitude: float, wavelength: float) -> Surface:
    points, across = SINUSOID_POINTS
    return sinusoid(
        size=(wavelength, wavelength * across / points * ACROSS),
        points=SINUSOID_POINTS,
        amplitude=amplitude,
        wavelength_x=wavelength,
    )
