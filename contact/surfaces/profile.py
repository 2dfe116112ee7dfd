"""A measured profile: heights at equal distances along one line, in metres, and their origin."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING

MIN_VALID = 0.5
"""Smallest fraction of measured points of a profile; with fewer it is refused."""


@dataclass(frozen=True, kw_only=True)
class Profile:
    """Heights along a line.

    Attributes
    ----------
    heights : shape (n,), m, upward; finite. Read-only.
    spacing : distance of neighbouring points, m.
    source : origin of the profile, as entries that JSON can hold; ``filled`` is the number of points that were not
        measured, whose heights are interpolated linearly between their neighbours.

    Raises
    ------
    InputError
        If there are fewer than 2 points, a height is infinite, fewer than half of the points are measured, or heights
        or spacing are out of range.

    Examples
    --------
    >>> profile = Profile(heights=np.array([0.0, np.nan, 2e-6]), spacing=1e-6)
    >>> float(profile.heights[1]), profile.source["filled"]
    (1e-06, 1)
    """

    heights: Array
    spacing: float
    source: Mapping[str, Any] = field(default_factory=dict)

    __repr__ = brief

    def __post_init__(self) -> None:
        heights = np.array(self.heights, dtype=np.float64).ravel()
        if heights.size < 2:
            raise InputError(f"profile: got {heights.size} points; at least 2 are needed")
        missing = np.isnan(heights)
        if missing.mean() > 1 - MIN_VALID:
            raise InputError(f"profile: {int(missing.sum())} of {heights.size} points are invalid; measure it again")
        if not np.abs(heights[~missing]).max() <= MAX_LENGTH:
            raise InputError(f"profile: got heights up to {np.abs(heights[~missing]).max():.3g} m; look at the unit")
        if not MIN_SPACING <= self.spacing < MAX_LENGTH:
            raise InputError(f"profile: got a spacing of {self.spacing!r} m; give one of 1e-15 m or more")
        places = np.arange(heights.size)
        heights[missing] = np.interp(places[missing], places[~missing], heights[~missing])
        heights.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "source", {**self.source, "filled": int(missing.sum())})

    @property
    def length(self) -> float:
        """Evaluation length n dx, m."""
        return self.heights.size * self.spacing
