"""Parameters of a profile that depend on positions along it: section lengths, profile elements and gradient."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

SECTIONS = 5
"""Usual number of section lengths in an evaluation length (ISO 21920-3)."""

DISCRIMINATION = 0.1
"""Height of a hill over Rp, and depth of a dale over Rv, below which it bounds no profile element."""


@dataclass(frozen=True, kw_only=True)
class SectionHeights:
    """Heights of a profile, averaged over its section lengths, m.

    Attributes
    ----------
    peak : Rp, the mean of the largest heights above the mean line of the whole profile.
    valley : Rv, the mean of the largest depths below it, positive.
    """

    peak: float
    valley: float

    @property
    def total(self) -> float:
        """The maximum height Rz, the mean over the sections of the distance of the highest and the lowest point, m."""
        return self.peak + self.valley


@dataclass(frozen=True, kw_only=True)
class Elements:
    """Profile elements: a hill and the dale beside it, in both orders.

    Attributes
    ----------
    spacings : lengths of the elements, shape (n,), m; their mean is Rsm.
    heights : distance of the highest and the lowest point of each element, shape (n,), m; their mean is Rc.
    """

    spacings: Array
    heights: Array


def section_heights(z: Array, sections: int = SECTIONS) -> SectionHeights:
    """Rp, Rv and Rz as means over section lengths of equal numbers of points, or of numbers that differ by one.

    Parameters
    ----------
    z : heights from the mean of the whole profile, shape (n,), m.
    sections : number of section lengths, from 1 to n.

    Raises
    ------
    InputError
        If the number of sections is out of range.

    Notes
    -----
    Source: ISO 21920-2:2021, whose other height parameters are those of the whole evaluation length. ISO 4287:1997 had
    the same Rp, Rv and Rz, but averaged Ra and Rq over sampling lengths as well.
    """
    if isinstance(sections, bool) or not isinstance(sections, int) or not 1 <= sections <= z.size:
        raise InputError(f"sections: got {sections!r:.20} in a profile of {z.size} points; give 1 to {z.size}")
    parts = np.array_split(z, sections)
    return SectionHeights(
        peak=float(np.mean([part.max() for part in parts])), valley=float(np.mean([-part.min() for part in parts]))
    )


def rms_profile_gradient(z: Array, spacing: float) -> float:
    """The root mean square gradient Rdq = √⟨(dz/dx)²⟩ from differences of neighbours, m/m.

    Parameters
    ----------
    z : heights, shape (n,), m.
    spacing : distance of neighbouring points, m.

    Notes
    -----
    The error is of second order in the spacing, as that of Sdq: a wave with the wave number q has the factor
    sin(q dx/2)/(q dx/2). The seven-point formula of ISO 4287:1997 is of sixth order; both agree where the profile is
    resolved.
    """
    slope = np.diff(z) / spacing
    return math.sqrt((slope * slope).mean())


def profile_elements(z: Array, spacing: float, heights: SectionHeights) -> Elements | None:
    """The profile elements, separated where the profile crosses its mean line.

    A hill is a part of the profile above the mean line with a point higher than 10 % of Rp, a dale a part below with a
    point deeper than 10 % of Rv; parts without such points are not counted. Between a hill and a dale the profile
    crosses the mean line; where it does so several times, the middle between the first and the last crossing counts,
    so that the direction of the profile is without influence. An element reaches from one of these crossings to the
    next but one.

    Parameters
    ----------
    z : heights from the mean of the whole profile, shape (n,), m.
    spacing : distance of neighbouring points, m.
    heights : Rp and Rv.

    Returns
    -------
    Elements or None : None if the profile has no complete element.

    Notes
    -----
    Crossings are located by linear interpolation, with an error of second order. Source: ISO 21920-2:2021 (crossing
    the line segmentation).
    """
    marks = np.where(z > DISCRIMINATION * heights.peak, 1, 0) - np.where(z < -DISCRIMINATION * heights.valley, 1, 0)
    marked = np.flatnonzero(marks)
    turns = np.flatnonzero(np.diff(marks[marked]))
    if turns.size < 3:
        return None
    above = z > 0
    cross = np.flatnonzero(above[1:] != above[:-1])
    place = cross + z[cross] / (z[cross] - z[cross + 1])
    first = np.searchsorted(cross, marked[turns])
    last = np.searchsorted(cross, marked[turns + 1]) - 1
    middle = (place[first] + place[last]) / 2
    ends = np.ceil(middle).astype(np.intp)
    return Elements(
        spacings=spacing * (middle[2:] - middle[:-2]),
        heights=np.array([np.ptp(z[a:b]) for a, b in zip(ends[:-2], ends[2:], strict=True)]),
    )
