"""Which part of a gap belongs to which end, and where the narrowest place of the widest path is."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.paths import FACE_NEIGHBOURS, sealed_between_ends


class Pool(IntEnum):
    """What a node of a gap between two reservoirs belongs to."""

    CONTACT = 0
    ISOLATED = 1
    INLET = 2
    OUTLET = 3
    THROUGH = 4


def pools(gap: Array) -> NDArray[np.int8]:
    """The :class:`Pool` of each node of a gap, shape (nx, ny), that is fed at line 0 and drained at its copy.

    Sides are joined. Line 0 itself is the inlet.
    """
    wide = np.concatenate([gap, gap[:1]]) > 0
    labels, count = scipy.ndimage.label(wide, structure=FACE_NEIGHBOURS)
    both = wide[:, 0] & wide[:, -1]
    first, last = labels[both, 0], labels[both, -1]
    links = scipy.sparse.coo_array((np.ones(first.size), (first, last)), shape=(count + 1, count + 1))
    piece = scipy.sparse.csgraph.connected_components(links, directed=False)[1][labels]
    fed, drained = np.isin(piece, piece[0][wide[0]]) & wide, np.isin(piece, piece[-1][wide[-1]]) & wide
    found = np.where(wide, np.int8(Pool.ISOLATED), np.int8(Pool.CONTACT))
    found[fed], found[drained], found[fed & drained] = Pool.INLET, Pool.OUTLET, Pool.THROUGH
    return found[:-1]


@dataclass(frozen=True, kw_only=True)
class Constriction:
    """The narrowest place of the path that is widest there: its gap, m, and its node."""

    gap: float
    node: tuple[int, int]


def constriction(gap: Array) -> Constriction | None:
    """Where the widest path between the ends of a gap, shape (nx, ny), sides joined, is narrowest; None if sealed.

    All that leaks passes places that are no wider than this one: near sealing, this one.
    """
    if sealed_between_ends(gap, joined=True):
        return None
    levels = np.unique(gap[gap > 0])
    low, high = 0, levels.size
    while high - low > 1:
        middle = (low + high) // 2
        if sealed_between_ends(np.where(gap >= levels[middle], gap, 0.0), joined=True):
            high = middle
        else:
            low = middle
    i, j = np.argwhere(gap == levels[low])[0]
    return Constriction(gap=float(levels[low]), node=(int(i), int(j)))
