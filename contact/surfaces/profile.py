"""A measured profile: heights at equal distances along one line, in metres, and their origin."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array, real_array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING

MIN_VALID = 0.5
"""Smallest fraction of measured points of a profile; with fewer it is refused."""

CONSTANT = 1e-12
"""Range of the heights over the highest one up to which they differ by rounding alone."""


@dataclass(frozen=True, kw_only=True)
class Profile:
    """Heights along a line.

    Attributes
    ----------
    heights : shape (n,), m, upward; finite. Read-only. Points given as NaN or masked (``numpy.ma``) are not measured.
    spacing : distance of neighbouring points, m.
    source : origin of the profile, as entries that JSON can hold; ``filled`` is the number of points that were not
        measured, whose heights are interpolated linearly between their neighbours.

    Raises
    ------
    InputError
        If heights or spacing are no real numbers or out of range, the heights are not in one line, there are fewer than
        2 of them, or fewer than half of the points are measured.

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
        given = real_array("profile", self.heights, "heights in m")
        if given.size != max(given.shape, default=1):
            raise InputError(f"profile: got heights of shape {given.shape}; give one line of them")
        given[np.ma.getmaskarray(self.heights)] = np.nan
        heights = given.ravel()
        if heights.size < 2:
            raise InputError(f"profile: got {heights.size} points; at least 2 are needed")
        missing = np.isnan(heights)
        if missing.mean() > 1 - MIN_VALID:
            raise InputError(f"profile: {int(missing.sum())} of {heights.size} points are invalid; measure it again")
        highest = float(np.abs(heights[~missing]).max())
        if highest > MAX_LENGTH or highest not in RANGES["m"]:
            raise InputError(f"profile: got heights up to {highest:.3g} m; look at the unit")
        step = real_array("profile", self.spacing, "one length in m as spacing")
        if step.shape != () or not MIN_SPACING <= step < MAX_LENGTH:
            raise InputError(f"profile: got a spacing of {self.spacing!r:.60} m; give one of 1e-15 m or more")
        places = np.arange(heights.size)
        heights[missing] = np.interp(places[missing], places[~missing], heights[~missing])
        heights.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "spacing", float(step))
        object.__setattr__(self, "source", {**self.source, "filled": int(missing.sum())})

    @property
    def length(self) -> float:
        """Evaluation length n dx, m."""
        return self.heights.size * self.spacing
