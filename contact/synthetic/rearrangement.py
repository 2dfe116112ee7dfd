"""Random rearrangements of a profile that keep its heights and therefore its bearing curve."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.checks import whole_between
from roughfilm.contact.synthetic.waves import MAX_SEED

MAX_HEIGHT = 1e100
"""Largest absolute height."""


def rearranged(profile: Array, *, seed: int, folds: int = 1, levels: int = 1000) -> Array:
    """The heights of a profile in a random order with small steps between neighbours.

    At each of several random levels the profile is cut where it crosses the level by a step that extends no further
    than half the largest step to either side. The segments above the level are permuted and half of them reversed, and
    so are the segments below it.

    Parameters
    ----------
    profile : shape (n,), m or any other unit.
    seed : 0 to 2^63 - 1.
    folds : number of times that the profile is traversed forth and back before it is shuffled, each time over other
        points. 0 takes the profile as periodic; 1 closes a profile whose ends differ; more give 2 folds times as many
        and finer peaks, for smooth profiles with few segments. n >= 4 folds.
    levels : number of levels, 0 to 1 000 000; more levels leave less of the original order.

    Returns
    -------
    Array : one period, shape (n,), with the same heights bit for bit. No step between neighbours exceeds the largest
        step before shuffling, which after folding is at most 2 folds times that of the profile. The number of crossings
        of every level and the sum of all steps stay.

    Raises
    ------
    InputError
        If the profile is too short, not finite or not one-dimensional, or another argument is out of range.

    Notes
    -----
    Flow factors of one-dimensional roughness depend on the bearing curve alone, so rearrangement does not change them.

    Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025, section 3.2.
    """
    heights = np.array(unmasked("profile", profile), dtype=float)
    if heights.ndim != 1 or heights.size < 2:
        raise InputError(f"profile: got an array of shape {heights.shape}; give one dimension of at least 2 points")
    if not np.abs(heights).max() <= MAX_HEIGHT:
        raise InputError(f"profile: got a height that is not finite or beyond {MAX_HEIGHT:g}; give finite ones")
    whole_between("profile.seed", seed, 0, MAX_SEED)
    whole_between("profile.levels", levels, 0, 1_000_000)
    runs = 2 * whole_between("profile.folds", folds, 0, max(1, heights.size // 4))
    if runs:
        heights = np.concatenate([heights[run::runs][:: 1 - 2 * (run % 2)] for run in range(runs)])
    half_step = np.abs(heights - np.roll(heights, 1)).max() / 2 * (1 - 1e-9)
    random = np.random.default_rng(seed)
    for _ in range(levels):
        link = random.integers(heights.size)
        heights = _shuffled(heights, (heights[link - 1] + heights[link]) / 2, half_step, random)
    return heights


def _shuffled(heights: Array, level: float, half_step: float, random: np.random.Generator) -> Array:
    """Permute the segments above a level and those below it, cut at steps within ``half_step`` of the level."""
    above = heights > level
    near = np.abs(heights - level) <= half_step
    starts = np.flatnonzero((above != np.roll(above, 1)) & near & np.roll(near, 1))
    starts = starts[above[starts] != np.roll(above[starts], 1)]
    count = starts.size
    if count < 4:
        return heights
    lengths = np.diff(starts, append=starts[0] + heights.size)
    order = np.empty(count, dtype=int)
    order[::2], order[1::2] = (2 * random.permutation(count // 2) + parity for parity in (0, 1))
    mirrored = random.random(count) < 0.5
    starts, lengths = starts[order], lengths[order]
    within = np.arange(heights.size) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    first = np.repeat(np.where(mirrored, starts + lengths - 1, starts), lengths)
    return np.asarray(heights[(first + np.where(np.repeat(mirrored, lengths), -within, within)) % heights.size])
