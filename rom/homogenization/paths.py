"""Whether a gap lets anything through, and in which direction: open paths that lead round a periodic cell."""

from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.rom.pocket.gap import Array

FOUR = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]])
"""Flow goes through faces, not through corners."""


def sealed(gap: Array) -> tuple[bool, bool]:
    """Whether no open path leads through a periodic gap, shape (nx, ny), in x and in y.

    A path is open if it goes from node to node with h > 0, and leads through a direction if it comes back to where it
    began having gone round the cell that way. One that goes round both ways at once (an oblique groove) opens both.
    """
    _, _, rounds = _pieces(gap > 0)
    return not rounds[:, 0].any(), not rounds[:, 1].any()


def leads_round(opened: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which nodes of a periodic cell, shape (nx, ny), belong to a piece of open ones that leads round it, either way.

    What flows in steadily can flow out of these alone.
    """
    labels, joints, rounds = _pieces(opened)
    count = int(labels.max()) + 1
    links = scipy.sparse.coo_array((np.ones(len(joints)), (joints[:, 0], joints[:, 1])), shape=(count, count))
    whole = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    leading = whole[joints[rounds.any(axis=1), 0]]
    return np.asarray(opened & np.isin(whole[labels], leading))


def sealed_between_ends(gap: Array, *, joined: bool) -> bool:
    """Whether no open path leads from line 0 of a gap, shape (nx, ny), to its copy one period on, inside the box.

    A path that leaves through a side comes in at the other if the sides are ``joined``; if not, the box has the first
    column's copy as its last, and none leaves it. (Between ends a path need not come out where it went in, so that a
    gap may be open here and sealed on and on; one whose paths lead round the cell is open here too.)
    """
    wide = np.pad(gap, ((0, 1), (0, 1)), mode="wrap") > 0
    labels, count = scipy.ndimage.label(wide, structure=FOUR)
    if joined:
        first, last = labels[:, 0], labels[:, -1]
        links = scipy.sparse.coo_array((np.ones(first.size), (first, last)), shape=(count + 1, count + 1))
        labels = scipy.sparse.csgraph.connected_components(links, directed=False)[1][labels]
    first, last = labels[0][wide[0]], labels[-1][wide[-1]]
    return not np.intersect1d(first, last).size


def _pieces(opened: NDArray[np.bool_]) -> tuple[NDArray[Any], Array, Array]:
    """Pieces inside the box by their number, joints between them over its seams, and how often each leads round it."""
    labels, count = scipy.ndimage.label(opened, structure=FOUR)
    joints = np.concatenate([_joints(labels[-1], labels[0], (1, 0)), _joints(labels[:, -1], labels[:, 0], (0, 1))])
    own = joints[:, 0] == joints[:, 1]
    rounds = joints[:, 2:].copy()
    rounds[~own] = _closing(joints[~own], count + 1)
    return labels, joints, rounds


def _joints(before: Array, after: Array, step: tuple[int, int]) -> Array:
    """Pieces that meet over a seam, once each: (piece before it, piece after it, the step in x, in y)."""
    both = np.unique(np.stack([before, after], axis=1)[(before > 0) & (after > 0)], axis=0)
    return np.concatenate([both, np.broadcast_to(step, (len(both), 2))], axis=1)


def _closing(joints: Array, pieces: int) -> Array:
    """How often round x and y the circles in a graph of joints go: each closes one with the spanning tree."""
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
