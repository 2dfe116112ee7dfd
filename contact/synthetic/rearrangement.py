"""Random rearrangements of a profile, which keep its heights and thereby its bearing curve."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.checks import whole_between
from roughfilm.contact.synthetic.waves import LARGEST_SEED

LARGEST_HEIGHT = 1e100


def rearranged(profile: Array, *, seed: int, folds: int = 1, levels: int = 1000) -> Array:
    """The heights of a profile in another, random order, with small steps between neighbours.

    At random levels the profile is cut where it crosses the level by a step that reaches no further than half the
    greatest step to either side; the stretches above it change places among each other and half of them are turned
    round, and so do those below it.

    Parameters
    ----------
    profile : shape (n,), m or any other unit.
    seed : 0 to 2^63 - 1.
    folds : how often the profile runs out and back before it is shuffled, each run over other points. 0 takes it as the
        period it is; 1 closes a profile whose ends do not meet; more make finer peaks, 2 folds times as many, where a
        smooth profile has too few to shuffle. n >= 4 folds.
    levels : how many levels; the more, the less is left of the old order.

    Returns
    -------
    Shape (n,): a period with the same heights, bit for bit. No step between neighbours, the joint included, is greater
    than the greatest before shuffling, which after folding is at most 2 folds times that of the profile; every level is
    crossed as often as before, so that the sum of all steps is kept too.

    Raises
    ------
    InputError
        If the profile is too short, not finite, or has more than one dimension; or another argument makes no sense.

    Notes
    -----
    Flow factors of one-dimensional roughness depend on the bearing curve alone: they are equal for all of these.

    Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025, section 3.2.
    """
    heights = np.array(profile, dtype=float)
    if heights.ndim != 1 or heights.size < 2:
        raise InputError(f"profile: got an array of shape {heights.shape}; give one dimension of at least 2 points")
    if not np.abs(heights).max() <= LARGEST_HEIGHT:
        raise InputError(f"profile: got a height that is not finite or beyond {LARGEST_HEIGHT:g}; give finite ones")
    whole_between("profile.seed", seed, 0, LARGEST_SEED)
    whole_between("profile.levels", levels, 0, 1_000_000)
    runs = 2 * whole_between("profile.folds", folds, 0, max(1, heights.size // 4))
    if runs:
        heights = np.concatenate([heights[run::runs][:: 1 - 2 * (run % 2)] for run in range(runs)])
    reach = np.abs(heights - np.roll(heights, 1)).max() / 2 * (1 - 1e-9)
    random = np.random.default_rng(seed)
    for _ in range(levels):
        link = random.integers(heights.size)
        heights = _shuffled(heights, (heights[link - 1] + heights[link]) / 2, reach, random)
    return heights


def _shuffled(heights: Array, level: float, reach: float, random: np.random.Generator) -> Array:
    """Shuffle the stretches above a level, and those below it, between steps that reach no further to either side."""
    above = heights > level
    near = np.abs(heights - level) <= reach
    begins = np.flatnonzero((above != np.roll(above, 1)) & near & np.roll(near, 1))
    begins = begins[above[begins] != np.roll(above[begins], 1)]
    count = begins.size
    if count < 4:
        return heights
    lengths = np.diff(begins, append=begins[0] + heights.size)
    order = np.empty(count, dtype=int)
    order[::2], order[1::2] = (2 * random.permutation(count // 2) + parity for parity in (0, 1))
    turned = random.random(count) < 0.5
    begins, lengths = begins[order], lengths[order]
    within = np.arange(heights.size) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    first = np.repeat(np.where(turned, begins + lengths - 1, begins), lengths)
    places: Array = heights[(first + np.where(np.repeat(turned, lengths), -within, within)) % heights.size]
    return places
