"""Whether it is the joint of a periodic gap that seals it: the lines where one period meets the next."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.paths import sealed_between_ends

MARGIN = 16
"""Of a side, one part in so many is left out at each of its ends."""


def joint_seals(gap: Array) -> tuple[bool, bool]:
    """Whether a gap, shape (nx, ny), is sealed in x, in y, but open between ends that stand a sixteenth off the joint.

    What is sealed by its last grains of contact may be open without a sixteenth of it anyway, so that this means
    nothing where the joint is as good as any other place.
    """
    return _seals(gap), _seals(gap.T)


def _seals(gap: Array) -> bool:
    if not sealed_between_ends(gap, joined=True):
        return False
    off = max(1, len(gap) // MARGIN)
    inside = gap[off:-off]
    return len(inside) > 1 and not sealed_between_ends(np.concatenate([np.ones_like(gap[:1]), inside]), joined=True)
