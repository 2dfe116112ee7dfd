"""Step 6 of the preparation: cut a window, given or chosen so that its opposite edges match."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface

COARSE_POSITIONS = 48
"""Number of edge positions along each direction in the first search."""

BAND_DIVISOR = 32
"""Size of the smallest window over the number of lines compared at each edge."""


@dataclass(frozen=True, kw_only=True)
class Window:
    """A rectangle of pixels: index of the first pixel and number of pixels along x and y."""

    start: tuple[int, int]
    shape: tuple[int, int]

    @property
    def slices(self) -> tuple[slice, slice]:
        """Slices that select the window from an array."""
        (i, j), (nx, ny) = self.start, self.shape
        return slice(i, i + nx), slice(j, j + ny)


def cut_window(surface: Surface, window: Window) -> Surface:
    """The surface cut to a window; raises InputError if the window is not inside the surface."""
    for axis, (first, count, most) in enumerate(zip(window.start, window.shape, surface.shape, strict=True)):
        if not (first >= 0 and count >= 2 and first + count <= most):
            raise InputError(
                f"window: got {count} pixels from pixel {first} along {'xy'[axis]}, where the surface has {most}; "
                "choose a window inside it"
            )
    whole = window.shape == surface.shape
    return surface.with_heights(
        surface.heights[window.slices],
        invalid=surface.invalid[window.slices],
        periodic=surface.periodic and whole,
    )


def best_window(surface: Surface, least: tuple[int, int], guessed: Mask) -> Window:
    """The window of at least ``least`` pixels whose opposite edges match best.

    The window, of the pixels x₀ … x₁ − 1 and y₀ … y₁ − 1, minimises
    ⟨(h(x₁ + k, y) − h(x₀ + k, y))²⟩ + ⟨(h(x, y₁ + k) − h(x, y₀ + k))²⟩ + 4 Sq² g, with means over the edges and a band
    of lines k. The fraction g of filled points is penalised, since smooth fills match too well; its weight is the
    mismatch of uncorrelated edges. All windows on at most 48 positions along each direction are compared, then the
    neighbours of the best with step sizes halved down to one pixel. The result is deterministic and independent of
    scale, but may be a local minimum.

    Parameters
    ----------
    surface : without invalid pixels.
    least : smallest number of pixels along x and y.
    guessed : mask of the points that were invalid and filled, shape (nx, ny).

    Raises
    ------
    InputError
        If the surface does not exceed the smallest window by the compared band, or pixels are invalid.
    """
    if surface.invalid.any():
        raise InputError(f"window: {surface.invalid.sum()} pixels are invalid; fill them first")
    bands = [max(1, count // BAND_DIVISOR) for count in least]
    for axis, (count, band, most) in enumerate(zip(least, bands, surface.shape, strict=True)):
        if not (count >= 2 and count + band <= most):
            raise InputError(
                f"window: got at least {count} pixels along {'xy'[axis]}, where the surface has {most}; "
                f"ask for at most {most * BAND_DIVISOR // (BAND_DIVISOR + 1)}, so that its edges can be compared"
            )
    mismatch = _Mismatch(surface.heights, bands, guessed)
    last = [most - band for most, band in zip(surface.shape, bands, strict=True)]
    steps = [max(1, -(-most // COARSE_POSITIONS)) for most in surface.shape]
    pairs = [
        [(a, b) for a in range(0, n, s) for b in range(n, a, -s) if b - a >= count]
        for n, s, count in zip(last, steps, least, strict=True)
    ]
    best = mismatch.least(*pairs)
    while True:
        near = [_near(edges, step, n, count) for edges, step, n, count in zip(best, steps, last, least, strict=True)]
        better = mismatch.least(*near)
        if better == best and max(steps) == 1:
            (x0, x1), (y0, y1) = best
            return Window(start=(x0, y0), shape=(x1 - x0, y1 - y0))
        if better == best:
            steps = [max(1, step // 2) for step in steps]
        best = better


Pair = tuple[int, int]


def _near(edges: Pair, step: int, last: int, least: int) -> list[Pair]:
    (a, b), moves = edges, (0, -step, step)
    return [(a + i, b + j) for i, j in product(moves, moves) if a + i >= 0 and b + j <= last and b + j - a - i >= least]


class _Mismatch:
    """Mismatch of windows from running sums along the edges, computed once for each pair of edges."""

    def __init__(self, heights: Array, bands: list[int], guessed: Mask) -> None:
        self.lines = (heights, heights.T)
        self.bands = bands
        self.variance = float(heights[~guessed].var())
        self.guessed = np.pad(guessed.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        self.known: tuple[dict[Pair, Array], dict[Pair, Array]] = ({}, {})

    def sums(self, axis: int, edges: Pair) -> Array:
        """Running sums of the mean square difference of the two bands along the edge, starting at 0."""
        if edges not in self.known[axis]:
            (a, b), band, lines = edges, self.bands[axis], self.lines[axis]
            squares = np.mean((lines[b : b + band] - lines[a : a + band]) ** 2, axis=0)
            self.known[axis][edges] = np.concatenate([[0.0], np.cumsum(squares)])
        return self.known[axis][edges]

    def least(self, along_x: list[Pair], along_y: list[Pair]) -> tuple[Pair, Pair]:
        """The pairs of edges along x and y with the smallest mismatch, the first of equals."""
        (x0, x1), (y0, y1) = np.transpose(along_x), np.transpose(along_y)
        at_x = np.stack([self.sums(0, pair)[[*y0, *y1]] for pair in along_x]).reshape(len(along_x), 2, len(along_y))
        at_y = np.stack([self.sums(1, pair)[[*x0, *x1]] for pair in along_y]).reshape(len(along_y), 2, len(along_x))
        total = (at_x[:, 1] - at_x[:, 0]) / (y1 - y0) + ((at_y[:, 1] - at_y[:, 0]) / (x1 - x0)).T
        counts = self.guessed[np.ix_(x1, y1)] - self.guessed[np.ix_(x0, y1)]
        counts = counts - self.guessed[np.ix_(x1, y0)] + self.guessed[np.ix_(x0, y0)]
        total += 4 * self.variance * counts / np.outer(x1 - x0, y1 - y0)
        i, j = np.unravel_index(int(np.argmin(total)), total.shape)
        return along_x[int(i)], along_y[int(j)]
