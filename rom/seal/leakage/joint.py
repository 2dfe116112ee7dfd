"""Sealing at the joint of a periodic gap, the lines where one period meets the next."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.paths import sealed_between_ends

SIDE_TO_MARGIN = 16
"""Ratio of a side to the margin that is removed at each of its ends."""


def joint_seals(gap: Array) -> tuple[bool, bool]:
    """Whether a gap, shape (nx, ny), is sealed in x, and in y, but open without a sixteenth at each end.

    A gap sealed by few contacts may open without a sixteenth of it in any case, so that the result only has a meaning
    for surfaces that are not periodic.
    """
    return _seals(gap), _seals(gap.T)


def _seals(gap: Array) -> bool:
    if not sealed_between_ends(gap, joined=True):
        return False
    margin = max(1, len(gap) // SIDE_TO_MARGIN)
    inside = gap[margin:-margin]
    return len(inside) > 1 and not sealed_between_ends(np.concatenate([np.ones_like(gap[:1]), inside]), joined=True)
