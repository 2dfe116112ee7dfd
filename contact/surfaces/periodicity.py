"""How well a surface repeats itself: its joints against every other place in it."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface

MISMATCH_THRESHOLD = 0.1
"""Above it a joint is worth a warning: of random surfaces, some 4 in 100 that are truly periodic lie above it, and
all raw windows of them."""

INTERIOR_QUANTILE = 0.98
"""Part of the places inside that are no worse than the one the joint is held against: scratches do not count."""

LAG_DIVISOR = 16
"""The longest lag is this part of the surface: a longer one has too few other places to be compared with."""


def periodicity_mismatch(surface: Surface) -> float:
    """What the worst joint of the repeated surface adds to what is usual inside it, from 0 to 1 and more.

    For a direction and a lag l, S(i) = ⟨(h_{k+l} − h_k)²⟩ over the l pairs of lines k = i − l … i − 1 that straddle
    place i. The joint is place 0 of the repeated surface, and its excess is (S(0) − s) / 2 Sq², where 98 % of the
    places inside have S(i) below s. The mismatch is the largest excess over both directions and the lags 1, 2, 4 … up
    to a sixteenth of the surface; 0 if the joint is nowhere worse than the surface itself. The two sides of a joint
    that know nothing of each other give 1 where the surface inside is smooth over that lag. Lags beyond a pixel find
    ridges that do not go on across a joint which blending has made smooth. A surface that is as rough everywhere as
    its joint hides it: noise from pixel to pixel, or square grooves of which one is cut to another width.

    Invalid pixels count as 0 m: fill them first.
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
