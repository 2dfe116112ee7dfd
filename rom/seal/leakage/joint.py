"""Sealing at the joint of a periodic gap, which is the pair of lines where neighbouring periods meet."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.paths import sealed_between_ends

EDGE_REMEDY = "prepare it by roughfilm surface, with another window or a larger edges.width"
"""What to do about a surface that is not periodic, for messages."""

SIDE_TO_MARGIN = 16
"""Ratio of a side to the margin that is removed at each of its ends."""


def joint_seals(gap: Array) -> tuple[bool, bool]:
    """Whether a gap seals only near the joint, in x and in y.

    This is the case if the whole gap, shape (nx, ny), is sealed, but open after a sixteenth of its length is removed at
    each end. A gap that few contacts seal may also open in this way far from a joint, so that the result has a meaning
    only for surfaces that are not periodic.
    """
    return _seals(gap), _seals(gap.T)


def _seals(gap: Array) -> bool:
    if not sealed_between_ends(gap, joined=True):
        return False
    margin = max(1, len(gap) // SIDE_TO_MARGIN)
    inside = gap[margin:-margin]
    return len(inside) > 1 and not sealed_between_ends(np.concatenate([np.ones_like(gap[:1]), inside]), joined=True)
