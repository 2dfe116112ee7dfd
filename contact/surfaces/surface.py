"""A measured or generated surface: heights on a uniform grid, in metres, and their origin."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask, real_array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES

MAX_LENGTH = 1e6
"""Largest height and spacing, m; larger values have a wrong unit, and their powers overflow."""

MIN_SPACING = 1e-15
"""Smallest spacing, m; smaller values have a wrong unit, and their powers underflow."""

MAX_POINTS = 100_000_000
"""Largest number of points of a surface that is read, generated or pressed."""


def check_point_count(place: object, shape: tuple[int, ...]) -> None:
    """Raise InputError, which begins with the place, for more points than are read."""
    if math.prod(shape) > MAX_POINTS:
        raise InputError(f"{place}: claims {' x '.join(map(str, shape))} points; at most {MAX_POINTS} are read")


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Heights over a rectangle of pixels.

    Attributes
    ----------
    heights : shape (nx, ny), m, upward; finite, and 0 where invalid. Read-only. Pixels that are masked in a masked
        array (``numpy.ma``) are invalid.
    spacing : (dx, dy), m, between neighbouring pixels; the surface has the lengths nx dx and ny dy.
    invalid : shape (nx, ny), bool; true where a pixel was not measured. Read-only.
    periodic : whether the surface is periodic in both directions.
    source : origin of the surface and steps of its preparation, as entries that JSON can hold.

    Raises
    ------
    InputError
        If there are fewer than 2 x 2 pixels, a valid height is not finite, every pixel is invalid, the highest
        exceeds 1e6 m or is below 1e-22 m and not 0, or a spacing is outside 1e-15 m to 1e6 m.

    Examples
    --------
    >>> surface = Surface(heights=np.zeros((4, 3)), spacing=(1e-6, 2e-6))
    >>> surface.shape, surface.size
    ((4, 3), (4e-06, 6e-06))
    """

    heights: Array
    spacing: tuple[float, float]
    invalid: Mask = field(default_factory=lambda: np.zeros((0, 0), dtype=bool))
    periodic: bool = False
    source: Mapping[str, Any] = field(default_factory=dict)

    __repr__ = brief

    def __post_init__(self) -> None:
        heights = real_array("surface", self.heights, "heights in m")
        if heights.ndim != 2 or min(heights.shape) < 2:
            raise InputError(f"surface: got heights of shape {heights.shape}; at least 2 x 2 pixels are needed")
        invalid = np.array(self.invalid, dtype=bool)
        if invalid.size == 0:
            invalid = np.zeros(heights.shape, dtype=bool)
        if invalid.shape != heights.shape:
            raise InputError(f"surface: got a mask of shape {invalid.shape} over heights of shape {heights.shape}")
        invalid |= np.ma.getmaskarray(self.heights)
        if invalid.all():
            raise InputError("surface: every pixel is invalid; measure it again")
        heights[invalid] = 0.0
        if not np.isfinite(heights).all():
            raise InputError("surface: a height is not finite; mark such pixels as invalid")
        highest = float(np.abs(heights).max())
        if highest > MAX_LENGTH or highest not in RANGES["m"]:
            raise InputError(f"surface: got a height of {highest:.3g} m; look at the unit")
        steps = real_array("surface", self.spacing, "two lengths in m as spacing")
        spacing = tuple(steps.ravel().tolist())
        if steps.shape != (2,) or not all(MIN_SPACING <= length < MAX_LENGTH for length in spacing):
            raise InputError(f"surface: got spacing {self.spacing!r}; give two lengths in m, 1e-15 or more")
        heights.flags.writeable = invalid.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "invalid", invalid)
        object.__setattr__(self, "spacing", spacing)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of pixels along x and y, (nx, ny)."""
        nx, ny = self.heights.shape
        return nx, ny

    @property
    def size(self) -> tuple[float, float]:
        """Lengths along x and y, m; one period for a periodic surface."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def valid(self) -> Mask:
        """Mask of the measured pixels, shape (nx, ny)."""
        return ~self.invalid

    def with_heights(self, heights: Array, **changes: Any) -> Self:
        """A copy with other heights, shape (nx, ny), m, and other attributes by keyword."""
        return replace(self, heights=heights, **changes)
