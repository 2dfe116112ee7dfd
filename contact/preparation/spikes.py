"""Step 2 of the preparation: find spikes, and the rims of invalid regions that deviate from their surroundings."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.surfaces.surface import Surface

TAIL = 0.05
"""Fraction of the points beyond each of the two quantiles that measure the spread of the heights."""

MIN_SPREAD = 0.1
"""Smallest spread on one side of the median, in units of the distance of the two quantiles."""

SPIKE_PIXELS = 7
"""Largest extent of a spike along x and along y, pixels; longer and wider features belong to the surface."""

RIM_PIXELS = 3
"""Largest distance of the points of a rim from an invalid point or a spike, pixels, the larger of x and y."""

SURROUNDINGS_PIXELS = 15
"""Largest distance of the points with which a point of a rim is compared, pixels, the larger of x and y."""

MIN_SURROUNDINGS = 96
"""Smallest number of these points, a tenth of all; a rim with fewer is kept."""

RIM_FACTOR = 2.5
"""Standard deviations of the surroundings beyond which a rim deviates, over the limit in spreads."""

MAX_RIMS = 3
"""Largest number of rims around a region, each next to the one that was found before."""

MIN_DEVIATION = 0.01
"""Smallest standard deviation of the surroundings, in units of the distance of the two quantiles."""


@dataclass(frozen=True, kw_only=True)
class Spikes:
    """Masks of the points that are no part of the surface, shape (nx, ny).

    Attributes
    ----------
    rims : found points within 3 pixels of an invalid point.
    spikes : all other found points.
    """

    spikes: Mask
    rims: Mask

    @property
    def points(self) -> Mask:
        """Mask of all found points."""
        return self.spikes | self.rims


def find_spikes(surface: Surface, *, limit: float) -> Spikes:
    """Find spikes, and points next to invalid regions that deviate from their surroundings.

    With the median m and the quantiles h₅ and h₉₅ of the valid heights, the spread above is
    s = max(h₉₅ − m, (h₉₅ − h₅)/10), and that below likewise. A spike is a region of neighbouring points with
    h − m > t/2 that extends over at most 7 pixels along x and along y and has a point of h − m ≥ t, for any
    t ≥ ``limit`` s. Ridges, scratches and grooves are longer and are kept; so are summits, which are wide at half of
    their height.

    A rim consists of the valid points within 3 pixels of an invalid point or a spike. A point of it deviates if it is
    more than 2.5 ``limit`` standard deviations from the mean of the valid points within 15 pixels that belong to no rim
    and lie within ``limit`` spreads of the median; it is kept if these are fewer than 96. Around a point that deviates,
    rim points within 3 pixels deviate from ``limit`` standard deviations on; the points found are invalid for the next
    rim, of up to 3.

    Parameters
    ----------
    limit : limit in units of the spread; 4 is 6.6 standard deviations of Gaussian heights. 0 finds nothing.

    Returns
    -------
    Spikes : the same under a change of unit or offset, a change of sign, and a transposition.

    Notes
    -----
    The quantiles stay useful while less than 5 % of the points are spikes on one side. Cost: O(n log n) in the number
    of points.
    """
    nothing = np.zeros(surface.shape, dtype=bool)
    low, middle, high = np.quantile(surface.heights[surface.valid], [TAIL, 0.5, 1 - TAIL])
    scale = float(high - low)
    if limit == 0 or scale == 0:
        return Spikes(spikes=nothing, rims=nothing)
    heights = np.where(surface.invalid, 0.0, surface.heights - middle)
    spikes, usual = nothing, surface.valid
    for deviation, spread in ((heights, high - middle), (-heights, middle - low)):
        level = limit * max(float(spread), MIN_SPREAD * scale)
        spikes = spikes | _small_regions(deviation, level)
        usual = usual & (deviation < level)
    found = spikes | _deviating_rims(heights, surface.invalid | spikes, usual, limit, MIN_DEVIATION * scale)
    next_to = _near(surface.invalid) if surface.invalid.any() and found.any() else nothing
    return Spikes(spikes=found & ~next_to, rims=found & next_to)


def _near(mask: Mask) -> Mask:
    """Mask of the points within the width of a rim of the points of a mask, shape (nx, ny)."""
    return np.asarray(scipy.ndimage.maximum_filter(mask, size=2 * RIM_PIXELS + 1, mode="constant", cval=0))


def _small_regions(deviation: Array, level: float) -> Mask:
    """Mask of the small regions above half of a level with a point on it, for all levels from the given one."""
    found = np.zeros(deviation.shape, dtype=bool)
    places = np.argwhere(deviation > level / 2)
    values = deviation[deviation > level / 2]
    if not values.size or values.max() < level:
        return found
    first, second = _neighbours(places, deviation.shape)
    higher = values[values >= level]
    while higher.size:
        level = float(higher.min())
        above = values > level / 2
        joined = above[first] & above[second]
        links = scipy.sparse.coo_array(
            (np.ones(int(joined.sum()), dtype=np.int8), (first[joined], second[joined])), shape=(values.size,) * 2
        )
        count, region = scipy.sparse.csgraph.connected_components(links, directed=False)
        small = np.zeros(count, dtype=bool)
        small[region[values >= level]] = True
        for index in places.T:
            least, most = np.full(count, deviation.size), np.zeros(count, dtype=np.intp)
            np.minimum.at(least, region, index)
            np.maximum.at(most, region, index)
            small &= most - least < SPIKE_PIXELS
        found[tuple(places[above & small[region]].T)] = True
        higher = higher[higher >= 2 * level]
    return found


def _neighbours(places: NDArray[np.intp], shape: tuple[int, ...]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Numbers of the pairs of places that are among the eight neighbours of each other; places in row-major order."""
    width = shape[1] + 1  # a column that no place has, so that the ends of two rows are no neighbours
    keys = places[:, 0] * width + places[:, 1]
    pairs = []
    for step in (1, width - 1, width, width + 1):
        number = np.minimum(np.searchsorted(keys, keys + step), keys.size - 1)
        here = np.flatnonzero(keys[number] == keys + step)
        pairs.append((here, number[here]))
    first, second = (np.concatenate(ends) for ends in zip(*pairs, strict=True))
    return first, second


def _deviating_rims(heights: Array, absent: Mask, usual: Mask, limit: float, least: float) -> Mask:
    """Mask of the rim points that deviate, and of their deviating neighbours, in deviations of their surroundings."""
    found = np.zeros(heights.shape, dtype=bool)
    for _ in range(MAX_RIMS if absent.any() else 0):
        near = _near(absent | found)
        places = np.nonzero(near & ~absent & ~found)
        counted = usual & ~near
        mean, deviation = _surroundings(np.where(counted, heights, 0.0), counted, places)
        relative = np.abs(heights[places] - mean) / np.maximum(deviation, least)
        found_before = found.copy()
        if not found.any():
            found[places] = relative > RIM_FACTOR * limit
        if not found.any():
            break
        found[places] |= (relative > limit) & _near(found)[places]
        if np.array_equal(found, found_before):
            break
    return found


def _surroundings(heights: Array, counted: Mask, places: tuple[NDArray[np.intp], ...]) -> tuple[Array, Array]:
    """Mean and standard deviation of the counted points around each place; infinite if they are too few."""
    corners = [
        (np.maximum(index - SURROUNDINGS_PIXELS, 0), np.minimum(index + SURROUNDINGS_PIXELS + 1, count))
        for index, count in zip(places, heights.shape, strict=True)
    ]
    (x0, x1), (y0, y1) = corners

    def total(values: Array | Mask) -> Array:
        sums = np.zeros((values.shape[0] + 1, values.shape[1] + 1), np.result_type(values, np.int32))
        np.cumsum(values, axis=1, out=sums[1:, 1:])
        np.cumsum(sums, axis=0, out=sums)
        return np.asarray(sums[x1, y1] - sums[x0, y1] - sums[x1, y0] + sums[x0, y0], dtype=np.float64)

    number = total(counted)
    enough = number >= MIN_SURROUNDINGS
    number = np.maximum(number, 1.0)
    mean = total(heights) / number
    variance = np.maximum(total(heights**2) / number - mean**2, 0.0)
    return mean, np.where(enough, np.sqrt(variance), np.inf)
