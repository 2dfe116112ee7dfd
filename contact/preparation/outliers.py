"""Step 3 of the preparation: clip the last outliers to the ends of the height histogram."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface


@dataclass(frozen=True, kw_only=True)
class Cut:
    """Limits to which heights were clipped, and the number of points beyond them.

    Attributes
    ----------
    highest, lowest : limits of the heights, m.
    above, below : number of points that were clipped to each limit.
    """

    highest: float
    lowest: float
    above: int
    below: int


def cut_outliers(surface: Surface, *, bins: int = 1000, points: int = 10) -> tuple[Surface, Cut]:
    """Clip heights to the outermost bins of their histogram that hold at least ``points`` points.

    The range of the valid heights is divided into equal bins. The upper edge of the highest such bin and the lower edge
    of the lowest one become the limits; points beyond are set to the limit, all others stay unchanged.

    Parameters
    ----------
    bins : number of bins.
    points : number of points that a bin must hold; 0 clips nothing.

    Returns
    -------
    surface : with clipped heights.
    cut : limits and numbers of clipped points.

    Raises
    ------
    InputError
        If no bin holds enough points, or the bins are finer than the rounding of the heights.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1 (1000 bins, 10 points).
    """
    try:
        counts, edges = np.histogram(surface.heights[surface.valid], bins=bins)
    except ValueError as error:
        raise InputError(f"outliers: {bins} bins are finer than the digits of the heights; take fewer") from error
    full = np.flatnonzero(counts >= points)
    if full.size == 0:
        raise InputError(f"outliers: no bin of {bins} holds {points} points; take fewer bins or points")
    lowest, highest = float(edges[full[0]]), float(edges[full[-1] + 1])
    cut = Cut(
        highest=highest,
        lowest=lowest,
        above=int(counts[full[-1] + 1 :].sum()),
        below=int(counts[: full[0]].sum()),
    )
    heights = np.where(surface.invalid, 0.0, np.clip(surface.heights, lowest, highest))
    return surface.with_heights(heights), cut
