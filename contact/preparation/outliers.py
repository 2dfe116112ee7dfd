"""Step 3: points far from the main body of the bearing curve, cut."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface


@dataclass(frozen=True, kw_only=True)
class Cut:
    """What was cut: heights (m) that nothing exceeds or undercuts any more, and how many points did before."""

    highest: float
    lowest: float
    above: int
    below: int


def cut_outliers(surface: Surface, *, bins: int = 1000, points: int = 10) -> tuple[Surface, Cut]:
    """Cut heights at the first bin, from the top and from the bottom, that holds at least so many points.

    The range of the valid heights is split into equal bins; the upper edge of the first full one from the top and the
    lower edge of the first full one from the bottom become the highest and the lowest height. Points beyond are set
    to that height. So heights inside stay untouched, and cutting again with the same edges changes nothing.

    Raises
    ------
    InputError
        If no bin holds so many points, or bins are finer than the heights are known.

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
