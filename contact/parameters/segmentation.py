"""Hills of a surface by watershed segmentation, without those that Wolf pruning removes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.compiled import called, compiled

Indices = NDArray[np.intp]


@dataclass(frozen=True, kw_only=True)
class Hills:
    """The significant hills of a surface.

    Attributes
    ----------
    peaks : flat index of the highest point of each hill, shape (n,), in descending order of height.
    labels : number of the hill, 0 to n − 1, to which each point belongs, −1 where it is invalid; shape (nx, ny).
    """

    peaks: Indices
    labels: Indices

    def inside(self) -> Mask:
        """Whether each hill is free of the four edges of the array, shape (n,)."""
        free = np.ones(self.peaks.size, dtype=bool)
        for edge in (self.labels[0], self.labels[-1], self.labels[:, 0], self.labels[:, -1]):
            free[edge[edge >= 0]] = False
        return free


def hills(heights: Array, valid: Mask, *, periodic: bool, pruning: float) -> Hills:
    """The hills of a surface whose peaks are higher than ``pruning`` above their highest saddle.

    Every point belongs to the hill of its highest neighbour, out of eight; a point without a higher neighbour is a
    peak. The points are visited in descending order, so that components of the surface above a level grow and meet at
    saddle points. Where components meet, all of their peaks but the highest one have their saddle; a peak whose height
    above the saddle is below ``pruning`` is removed, and its hill is merged with the one that it meets there. This is
    Wolf pruning, which removes hills in the order of increasing height: hills that meet a higher one at a saddle above
    are pruned before those that meet it further below.

    Parameters
    ----------
    heights : shape (nx, ny), m; of any value where invalid.
    valid : mask of the points that count, shape (nx, ny).
    periodic : whether the hills extend across the edges.
    pruning : height in m, at least 0; hills without any height above their saddle (plateaus of several points) are
        merged in any case. The highest hill of each connected region of valid points remains.

    Notes
    -----
    A merge tree by union-find: the cost is O(n log n) for n points, which is that of sorting. Of equal heights the
    first one in the order of the array counts as the higher one. Source: ISO 25178-2:2021, clause 5; G. W. Wolf,
    Cartography and Geographic Information Systems 18 (1991) 101; P. J. Scott, Proc. R. Soc. A 460 (2004) 2845.
    """
    order = np.flatnonzero(valid.ravel())
    order = order[np.argsort(-heights.ravel()[order], kind="stable")]
    basins = np.full(heights.size, -1, dtype=np.intp)
    peaks, component, joined = (np.empty(order.size, dtype=np.intp) for _ in range(3))
    count = _flood(np.ascontiguousarray(heights), order, basins, peaks, component, joined, periodic, pruning)
    hill = _ends(joined[:count])
    kept = np.flatnonzero(hill == np.arange(count))
    number = np.empty(count, dtype=np.intp)
    number[kept] = np.arange(kept.size)
    labels = np.full(heights.size, -1, dtype=np.intp)
    labels[order] = number[hill[basins[order]]]
    return Hills(peaks=peaks[kept], labels=labels.reshape(heights.shape))


def _ends(joined: Indices) -> Indices:
    """The hill that each basin was merged with in the end, shape (basins,)."""
    while True:
        further = joined[joined]
        if np.array_equal(further, joined):
            return joined
        joined = further


@called
def _root(component, basin):  # type: ignore[no-untyped-def]
    """The first basin of a component; the path to it is halved."""
    while component[basin] != basin:
        component[basin] = component[component[basin]]
        basin = component[basin]
    return basin


@called
def _neighbour(i, j, side, nx, ny, periodic):  # type: ignore[no-untyped-def]
    """Flat index of one of the 3 x 3 points around a point, −1 beyond the edge of a surface that is not periodic."""
    ni, nj = i + side // 3 - 1, j + side % 3 - 1
    if 0 <= ni < nx and 0 <= nj < ny:
        return ni * ny + nj
    return (ni + nx) % nx * ny + (nj + ny) % ny if periodic else -1


@compiled
def _flood(heights, order, basins, peaks, component, joined, periodic, pruning):  # type: ignore[no-untyped-def]
    """Fill in the basin of each point, and the peak and the neighbour of each basin; return the number of basins.

    Basins are numbered in descending order of their peaks, so that the first basin of a component has its highest peak.
    """
    nx, ny = heights.shape
    z = heights.reshape(-1)
    count = 0
    for point in order:
        i, j = point // ny, point % ny
        best, several = -1, False
        for side in range(9):
            near = _neighbour(i, j, side, nx, ny, periodic)
            if near < 0 or basins[near] < 0:
                continue
            several |= best >= 0 and basins[near] != basins[best]
            if best < 0 or z[near] > z[best]:
                best = near
        if best < 0:
            peaks[count] = point
            component[count] = joined[count] = basins[point] = count
            count += 1
            continue
        basin = basins[best]
        basins[point] = basin
        if not several:
            continue
        first = elder = _root(component, basin)
        across = best
        for side in range(9):
            near = _neighbour(i, j, side, nx, ny, periodic)
            if near >= 0 and basins[near] >= 0:
                other = _root(component, basins[near])
                if other < elder or (other == elder != first and z[near] > z[across]):
                    elder, across = other, near
        if first != elder:
            drop = z[peaks[first]] - z[point]
            if drop < pruning or drop <= 0:
                joined[first] = basins[across]
            component[first] = elder
        for side in range(9):
            near = _neighbour(i, j, side, nx, ny, periodic)
            if near >= 0 and basins[near] >= 0:
                other = _root(component, basins[near])
                if other != elder:
                    drop = z[peaks[other]] - z[point]
                    if drop < pruning or drop <= 0:
                        joined[other] = basin
                    component[other] = elder
    return count
