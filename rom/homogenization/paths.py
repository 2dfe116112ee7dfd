"""Open paths through a gap: whether and in which direction a periodic cell is permeable."""

from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array

FACE_NEIGHBOURS = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]])
"""Nodes are connected through faces, not through corners."""


def sealed(gap: Array) -> tuple[bool, bool]:
    """Whether no open path leads through a periodic gap, shape (nx, ny), in x and in y.

    An open path connects nodes with h > 0 through faces; it leads through a direction if it returns to its start after
    passing around the cell in that direction. A path around both directions at once (an oblique groove) opens both.
    """
    _, _, rounds = _pieces(gap > 0)
    return not rounds[:, 0].any(), not rounds[:, 1].any()


def leads_round(opened: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mask of the open nodes of a periodic cell, shape (nx, ny), that are connected to a path around it.

    Steady flow exists in these nodes alone.
    """
    labels, joints, rounds = _pieces(opened)
    count = int(labels.max()) + 1
    links = scipy.sparse.coo_array((np.ones(len(joints)), (joints[:, 0], joints[:, 1])), shape=(count, count))
    whole = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    leading = whole[joints[rounds.any(axis=1), 0]]
    return np.asarray(opened & np.isin(whole[labels], leading))


def sealed_between_ends(gap: Array, *, joined: bool) -> bool:
    """Whether no open path leads from line 0 of a gap, shape (nx, ny), to its copy one period on, inside the box.

    A path that leaves through a side enters at the other one if the sides are ``joined``; if not, the box has a copy of
    the first column as its last, and no path leaves it. A path may end at another position than it starts, so a gap
    that is sealed when repeated periodically may be open here; the converse cannot occur.
    """
    wide = np.pad(gap, ((0, 1), (0, 1)), mode="wrap") > 0
    labels, count = scipy.ndimage.label(wide, structure=FACE_NEIGHBOURS)
    if joined:
        first, last = labels[:, 0], labels[:, -1]
        links = scipy.sparse.coo_array((np.ones(first.size), (first, last)), shape=(count + 1, count + 1))
        labels = scipy.sparse.csgraph.connected_components(links, directed=False)[1][labels]
    first, last = labels[0][wide[0]], labels[-1][wide[-1]]
    return not np.intersect1d(first, last).size


def _pieces(opened: NDArray[np.bool_]) -> tuple[NDArray[Any], Array, Array]:
    """Labels of the connected pieces, joints between them across the seams, and the winding number of each joint."""
    labels, count = scipy.ndimage.label(opened, structure=FACE_NEIGHBOURS)
    joints = np.concatenate([_joints(labels[-1], labels[0], (1, 0)), _joints(labels[:, -1], labels[:, 0], (0, 1))])
    own = joints[:, 0] == joints[:, 1]
    rounds = joints[:, 2:].copy()
    rounds[~own] = _closing(joints[~own], count + 1)
    return labels, joints, rounds


def _joints(before: Array, after: Array, step: tuple[int, int]) -> Array:
    """Pairs of pieces that meet across a seam: (piece before it, piece after it, step in x, step in y)."""
    both = np.unique(np.stack([before, after], axis=1)[(before > 0) & (after > 0)], axis=0)
    return np.concatenate([both, np.broadcast_to(step, (len(both), 2))], axis=1)


def _closing(joints: Array, pieces: int) -> Array:
    """Winding numbers in x and y of the cycles that each joint closes with a spanning tree of the joints."""
    links = scipy.sparse.coo_array((np.ones(len(joints)), (joints[:, 0], joints[:, 1])), shape=(pieces, pieces)).tocsr()
    steps: dict[tuple[int, int], tuple[int, int]] = {}
    for first, second, x, y in joints.tolist():
        steps[first, second], steps[second, first] = (x, y), (-x, -y)
    place = np.zeros((pieces, 2), dtype=np.int64)
    seen = np.zeros(pieces, dtype=bool)
    for root in np.unique(joints[:, 0]):
        if seen[root]:
            continue
        order, previous = scipy.sparse.csgraph.breadth_first_order(links, root, directed=False)
        seen[order] = True
        for piece in order[1:]:
            parent = previous[piece]
            place[piece] = place[parent] + steps[int(parent), int(piece)]
    return np.asarray(place[joints[:, 0]] + joints[:, 2:] - place[joints[:, 1]])
