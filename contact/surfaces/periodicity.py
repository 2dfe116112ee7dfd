"""The periodicity mismatch of a surface: steps across its opposite edges, compared with steps inside it."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface

MISMATCH_THRESHOLD = 0.1
"""Mismatch above which a warning is given.

About 4 in 100 periodic random surfaces lie above it, and all windows cut from them without joining the edges."""

INTERIOR_QUANTILE = 0.98
"""Quantile of the interior structure function with which the joint is compared; scratches lie above it."""

LAG_DIVISOR = 16
"""Length of the surface over the longest lag; longer lags leave too few interior places for comparison."""


def periodicity_mismatch(surface: Surface) -> float:
    """The excess of the structure function across the joint of opposite edges over its interior values.

    For a direction and a lag l, S(i) = ⟨(h_{k+l} − h_k)²⟩ over the l pairs of lines k = i − l … i − 1 that straddle
    place i. The joint is place 0 of the repeated surface; its excess is (S(0) − s) / (2 Sq²), where s is the 98 %
    quantile of S inside. The mismatch is the largest excess over both directions and the lags 1, 2, 4 … up to a
    sixteenth of the surface.

    Parameters
    ----------
    surface : without invalid pixels; they would count as 0 m.

    Returns
    -------
    float : 0 if the joint is no rougher than the interior; about 1 for uncorrelated edges of a smooth surface.

    Notes
    -----
    Lags above one pixel detect ridges that end at a joint smoothed by blending. The measure fails where the interior is
    as rough as the joint: white noise, or square grooves of which one has another width.
    """
    centred = surface.heights - surface.heights.mean()
    variance = float(np.mean(centred**2))
    if variance == 0:
        return 0.0
    excesses = [
        _excess(lines, 2**power)
        for lines in (centred, centred.T)
        for power in range(max(1, lines.shape[0] // LAG_DIVISOR).bit_length())
    ]
    return max(0.0, *excesses) / (2 * variance)


def _excess(lines: Array, lag: int) -> float:
    count = lines.shape[0]
    squares = np.mean((np.roll(lines, -lag, axis=0) - lines) ** 2, axis=1)
    sums = np.concatenate([[0.0], np.cumsum(squares)])
    inside = (sums[lag : count - lag + 1] - sums[: count - 2 * lag + 1]) / lag
    joint = (sums[count] - sums[count - lag]) / lag
    return float(joint - np.quantile(inside, INTERIOR_QUANTILE))
