"""Places of windows on a measurement, and the number of independent windows that they are worth."""

import itertools
import math
from collections.abc import Sequence

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.autocorrelation import DECAY_THRESHOLD, autocorrelation
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.surface import Surface

MAX_WINDOWS = 10_000
"""Largest number of windows of one measurement."""

STEPS = 8
"""Number of starts of a further window along its side that are tried."""

MAX_OVERLAP = 0.5
"""Largest part of a further window that another one covers."""

MAX_ASPECT = 4.0
"""Largest ratio of the distances of neighbours along x and along y, in units of the window, that is considered."""

COARSE_PIXELS = 512
"""Number of pixels along each axis above which the autocorrelation of a surface is coarsened."""


def window_places(shape: tuple[int, int], window_shape: tuple[int, int], count: int) -> tuple[Window, ...]:
    """Spread windows of one shape evenly over a measurement, without overlap as long as they fit.

    The windows stand in columns along y, which are spread evenly along x; the numbers of windows in two columns differ
    by at most one. Of the numbers of columns within a factor of four of that with equal distances along x and y, in
    units of the window, that with the least total overlap is taken, and of these that with the largest distance between
    neighbours. The result is deterministic.

    Parameters
    ----------
    shape : number of pixels of the measurement along x and y.
    window_shape : number of pixels of each window.
    count : number of windows, 1 to 10 000.

    Raises
    ------
    InputError
        If the window is not inside the measurement, or the count is out of range.

    Examples
    --------
    >>> [window.start for window in window_places((100, 60), (40, 30), 4)]
    [(0, 0), (0, 30), (60, 0), (60, 30)]
    """
    if not 1 <= count <= MAX_WINDOWS:
        raise InputError(f"windows: got {count}; take 1 to {MAX_WINDOWS}")
    for axis, (size, most) in enumerate(zip(window_shape, shape, strict=True)):
        if not 2 <= size <= most:
            raise InputError(f"windows: got {size} pixels along {'xy'[axis]}, where the surface has {most}; take fewer")
    room_x, room_y = (most - size for most, size in zip(shape, window_shape, strict=True))
    alike = math.sqrt(count * (room_x / window_shape[0] + 1) / (room_y / window_shape[1] + 1))
    least, most = max(1, int(alike / MAX_ASPECT)), min(count, math.ceil(MAX_ASPECT * alike))
    layouts = (
        (_even(room_x, columns), [_even(room_y, int(n)) for n in np.diff(_shares(count, columns))])
        for columns in range(min(least, most), most + 1)
    )
    along_x, along_y = min(layouts, key=lambda layout: _crowding(layout[0], layout[1], window_shape))
    return tuple(
        Window(start=(int(x), int(y)), shape=window_shape) for x, ys in zip(along_x, along_y, strict=True) for y in ys
    )


def valid_places(places: Sequence[Window], invalid: Mask, most: float) -> tuple[Window, ...]:
    """The places with few invalid points, and others in place of those with many, as far as there are any.

    Others start at multiples of an eighth of a window, and at the ends of the measurement. That is taken in turn which
    overlaps the taken ones least, and of these that with the fewest invalid points; a place that one of them covers by
    more than half is none.

    Parameters
    ----------
    places : windows of one shape, one or more.
    invalid : mask of the invalid points of the measurement, shape (nx, ny).
    most : largest fraction of invalid points of a window.

    Returns
    -------
    tuple of Window : as many as given, or fewer; those given that stay come first.

    Examples
    --------
    >>> hole = np.zeros((40, 20), dtype=bool)
    >>> hole[:10] = True
    >>> [one.start for one in valid_places(window_places((40, 20), (10, 10), 4), hole, 0.25)]
    [(30, 0), (30, 10), (10, 0), (10, 10)]
    """
    shape = places[0].shape
    taken = [window for window in places if invalid[window.slices].mean() <= most]
    if len(taken) == len(places):
        return tuple(taken)
    along = [
        np.unique(np.append(np.arange(0, count - size, max(1, size // STEPS)), count - size))
        for count, size in zip(invalid.shape, shape, strict=True)
    ]
    sums = np.pad(invalid.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    (x, y), (nx, ny) = np.ix_(*along), shape
    filled = (sums[x + nx, y + ny] - sums[x, y + ny] - sums[x + nx, y] + sums[x, y]) / (nx * ny)
    covered = np.zeros_like(filled)

    def cover(window: Window) -> None:
        parts = (
            np.clip(1 - np.abs(starts - first) / size, 0, None)
            for starts, first, size in zip((x, y), window.start, shape, strict=True)
        )
        np.maximum(covered, math.prod(parts), out=covered)

    for window in taken:
        cover(window)
    allowed = filled <= most
    while len(taken) < len(places):
        rank = np.where(allowed & (covered <= MAX_OVERLAP), covered + filled / invalid.size, np.inf)
        i, j = np.unravel_index(rank.argmin(), rank.shape)
        if np.isinf(rank[i, j]):
            break
        taken.append(Window(start=(int(along[0][i]), int(along[1][j])), shape=shape))
        cover(taken[-1])
    return tuple(taken)


def _shares(count: int, columns: int) -> Array:
    """Number of windows before each column, and of all."""
    return np.rint(np.linspace(0, count, columns + 1)).astype(int)


def _even(room: int, count: int) -> Array:
    """Evenly spread starts from 0 to ``room``; a single one is in the middle."""
    return np.rint(np.linspace(0, room, count)) if count > 1 else np.array([float(room // 2)])


def _crowding(along_x: Array, along_y: Sequence[Array], window: tuple[int, int]) -> tuple[float, float]:
    """The total overlap of all pairs, and minus the least distance of two windows in units of the window.

    Columns of one number of windows have the same places along y, so that pairs of numbers are compared once.
    """
    numbers, kind = np.unique([len(ys) for ys in along_y], return_inverse=True)
    places = [next(ys for ys in along_y if len(ys) == number) / window[1] for number in numbers]
    overlap, apart, inside, between = (np.zeros((len(places),) * 2) for _ in range(4))
    for (k, one), (m, two) in itertools.product(enumerate(places), repeat=2):
        distance = np.abs(one[:, None] - two)
        overlap[k, m], apart[k, m] = np.clip(1 - distance, 0, None).sum(), distance.min()
        if k == m:
            inside[k, k] = overlap[k, k] - len(one)
            between[k, k] = np.diff(one).min() if len(one) > 1 else np.inf
    across = np.abs(along_x[:, None] - along_x) / window[0]
    total = np.clip(1 - across, 0, None) * overlap[kind[:, None], kind]
    np.fill_diagonal(total, np.diagonal(inside)[kind])
    distance = np.maximum(across, apart[kind[:, None], kind])
    np.fill_diagonal(distance, np.diagonal(between)[kind])
    least = float(distance.min())
    return round(float(total.sum()), 9), -round(least, 9) if math.isfinite(least) else 0.0


def independent_windows(windows: Sequence[Window], surface: Surface | None = None) -> float:
    """The effective number of independent windows, nₑ = n² / Σᵢⱼ ρᵢⱼ, by which the variance of a mean is reduced.

    ρᵢⱼ is the correlation of a quantity between two windows, for which that of the mean of a local quantity is taken:
    ρ(d) = ∫Λ(t − d) c(t) dt / ∫Λ(t) c(t) dt with the autocorrelation Λ of a window, the product of two triangles, and
    the autocorrelation c of the local quantity. Without a surface, c is a point, and ρ is the overlap as a fraction of
    a window. With a surface, c = r² in the central lobe of its autocorrelation r, where r exceeds 0.2, which is the
    correlation of the squares of Gaussian heights: windows along a lay count less.

    Parameters
    ----------
    windows : windows of one shape.
    surface : the measurement, m.

    Returns
    -------
    float : 1 to the number of windows.

    Raises
    ------
    InputError
        If there are no windows, or their shapes differ.

    Examples
    --------
    >>> apart = [Window(start=(x, 0), shape=(10, 10)) for x in (0, 10, 20)]
    >>> independent_windows(apart)
    3.0
    >>> same = [Window(start=(0, 0), shape=(10, 10))] * 3
    >>> independent_windows(same)
    1.0
    """
    shapes = {window.shape for window in windows}
    if len(shapes) != 1:
        raise InputError(f"windows: got {len(windows)} windows of {len(shapes)} shapes; give some of one shape")
    (shape,) = shapes
    starts = np.array([window.start for window in windows], dtype=float)
    apart = np.abs(starts[:, None] - starts)
    if surface is None or np.ptp(surface.heights) == 0:
        correlation = np.clip(1 - apart / shape, 0, None).prod(axis=2)
    else:
        correlation = _correlations(surface, shape, starts[:, None] - starts)
    return float(min(max(len(windows) ** 2 / correlation.sum(), 1.0), len(windows)))


def _correlations(surface: Surface, window: tuple[int, int], apart: Array) -> Array:
    """The correlation ρ of the means of a local quantity, at displacements of shape (n, n, 2), pixels."""
    steps = [max(1, count // COARSE_PIXELS) for count in surface.shape]
    middle = [count // step for count, step in zip(surface.shape, steps, strict=True)]
    sums = _squared_lobe(surface)[
        tuple(slice(n % step, None, step) for n, step in zip(surface.shape, steps, strict=True))
    ]
    for axis, (width, step) in enumerate(zip(window, steps, strict=True)):  # the triangle along each axis
        reach = (width - 1) // step
        triangle = 1 - step * np.abs(np.arange(-reach, reach + 1)) / width
        sums = scipy.signal.fftconvolve(sums, np.expand_dims(triangle, 1 - axis), mode="same", axes=axis)
    i, j = (np.rint(apart[..., axis] / steps[axis]).astype(int) + middle[axis] for axis in (0, 1))
    ratio: Array = sums[i, j] / sums[middle[0], middle[1]]
    return np.clip(ratio, 0.0, 1.0)


def _squared_lobe(surface: Surface) -> Array:
    """The square of the autocorrelation in its central lobe, at lags from minus to plus the size of the surface.

    The autocorrelation is known up to half the size; a lobe that reaches there is continued by its last value.
    """
    r = autocorrelation(surface)
    labels, _ = scipy.ndimage.label(r > DECAY_THRESHOLD)
    lobe = np.where(labels == labels[r.shape[0] // 2, r.shape[1] // 2], r, 0.0) ** 2
    more = [(count - size // 2, count - size // 2) for count, size in zip(surface.shape, lobe.shape, strict=True)]
    padded: Array = np.pad(lobe, more, mode="edge")
    return padded
