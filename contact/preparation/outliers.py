"""Step 3 of the preparation: clip the highest and lowest heights to quantiles, if asked for."""

from dataclasses import dataclass

import numpy as np

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


def cut_outliers(surface: Surface, quantile: float = 0.0) -> tuple[Surface, Cut]:
    """Clip the heights to their quantiles q and 1 − q.

    The limits are measured heights, the outermost ones within the quantiles, so that at most the fraction q of the
    valid points is clipped at each end; all others stay unchanged.

    Parameters
    ----------
    quantile : q, from 0 to below 0.5; 0 clips nothing.

    Returns
    -------
    surface : with clipped heights.
    cut : limits and numbers of clipped points.

    Notes
    -----
    Summits carry the load in contact: even small quantiles change the contact area and the gap under load.
    """
    heights = surface.heights[surface.valid]
    beyond = int(quantile * heights.size)
    ordered = np.partition(heights, (beyond, heights.size - 1 - beyond))
    lowest, highest = float(ordered[beyond]), float(ordered[heights.size - 1 - beyond])
    cut = Cut(highest=highest, lowest=lowest, above=int((heights > highest).sum()), below=int((heights < lowest).sum()))
    if cut.above == cut.below == 0:
        return surface, cut
    return surface.with_heights(np.where(surface.invalid, 0.0, np.clip(surface.heights, lowest, highest))), cut
