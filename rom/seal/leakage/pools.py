"""The parts of a gap that are connected to its inlet and outlet, and the narrowest place of the widest path."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.paths import FACE_NEIGHBOURS, sealed_between_ends


class Pool(IntEnum):
    """The connection of a node of a gap to the two reservoirs."""

    CONTACT = 0
    ISOLATED = 1
    INLET = 2
    OUTLET = 3
    THROUGH = 4


def pools(gap: Array) -> NDArray[np.int8]:
    """The :class:`Pool` of each node, shape (nx, ny), of a gap h >= 0 of that shape with periodic sides.

    The inlet is at the line i = 0 and the outlet at its copy i = nx.
    """
    opened = np.concatenate([gap, gap[:1]]) > 0
    labels, count = scipy.ndimage.label(opened, structure=FACE_NEIGHBOURS)
    both = opened[:, 0] & opened[:, -1]
    first, last = labels[both, 0], labels[both, -1]
    links = scipy.sparse.coo_array((np.ones(first.size), (first, last)), shape=(count + 1, count + 1))
    piece = scipy.sparse.csgraph.connected_components(links, directed=False)[1][labels]
    fed, drained = (np.isin(piece, piece[end][opened[end]]) & opened for end in (0, -1))
    pool = np.where(opened, np.int8(Pool.ISOLATED), np.int8(Pool.CONTACT))
    pool[fed], pool[drained], pool[fed & drained] = Pool.INLET, Pool.OUTLET, Pool.THROUGH
    return pool[:-1]


@dataclass(frozen=True, kw_only=True)
class Constriction:
    """The narrowest place of the widest path, with its gap, m, and its node (i, j)."""

    gap: float
    node: tuple[int, int]


def constriction(gap: Array) -> Constriction | None:
    """The narrowest place of the widest path between the ends of a gap, shape (nx, ny), periodic sides; None if sealed.

    Every path through the gap has a place that is at most as wide. Near sealing all leakage passes this place.
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
