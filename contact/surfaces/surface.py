"""A measured or made surface: heights on a uniform grid, in metres, and where they came from."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError

MAX_LENGTH = 1e6
"""m; what lies beyond is a wrong unit, and its powers overflow."""

MIN_SPACING = 1e-15
"""m; likewise."""

MAX_POINTS = 100_000_000
"""No file or grid with more points is read or made."""


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Heights over a rectangle of pixels, which need not be square.

    Attributes
    ----------
    heights : shape (nx, ny), m, upward; finite, and 0 where invalid. Read-only.
    spacing : (dx, dy), m, between neighbouring pixels; the surface is nx dx long and ny dy wide.
    invalid : shape (nx, ny), bool: pixels that were not measured. Read-only.
    periodic : whether the surface repeats itself in both directions.
    source : where it came from and what was done to it, as entries that JSON can hold.

    Raises
    ------
    InputError
        If there are fewer than 2 x 2 pixels, a height that counts is not finite, every pixel is invalid, or a length is
        below 1e-15 m or beyond 1000 km.

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

    def __post_init__(self) -> None:
        heights = np.array(self.heights, dtype=np.float64)
        if heights.ndim != 2 or min(heights.shape) < 2:
            raise InputError(f"surface: got heights of shape {heights.shape}; at least 2 x 2 pixels are needed")
        invalid = np.array(self.invalid, dtype=bool)
        if invalid.size == 0:
            invalid = np.zeros(heights.shape, dtype=bool)
        if invalid.shape != heights.shape:
            raise InputError(f"surface: got a mask of shape {invalid.shape} over heights of shape {heights.shape}")
        if invalid.all():
            raise InputError("surface: every pixel is invalid; measure it again")
        heights[invalid] = 0.0
        if not np.isfinite(heights).all():
            raise InputError("surface: a height is not finite; mark such pixels as invalid")
        if np.abs(heights).max() > MAX_LENGTH:
            raise InputError(f"surface: got a height of {np.abs(heights).max():.3g} m; look at the unit")
        spacing = tuple(float(length) for length in self.spacing)
        if len(spacing) != 2 or not all(MIN_SPACING <= length < MAX_LENGTH for length in spacing):
            raise InputError(f"surface: got spacing {self.spacing!r}; give two lengths in m, 1e-15 or more")
        heights.flags.writeable = invalid.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "invalid", invalid)
        object.__setattr__(self, "spacing", spacing)

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels along x and y."""
        nx, ny = self.heights.shape
        return nx, ny

    @property
    def size(self) -> tuple[float, float]:
        """Length along x and y, m: one period if the surface is periodic."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def valid(self) -> Mask:
        """Where heights were measured, shape (nx, ny)."""
        return ~self.invalid

    def with_heights(self, heights: Array, **changes: Any) -> Self:
        """The same surface with other heights (and other fields, by name)."""
        return replace(self, heights=heights, **changes)
