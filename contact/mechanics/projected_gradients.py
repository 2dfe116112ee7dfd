"""Projected conjugate gradients, preconditioned by |q|, for pressures between 0 and H with a given sum.

The method minimises ½ p·K p + p·h under 0 ≤ p ≤ H and Σp = N W. On the free nodes, whose pressure may change, the
residual r = h + K p − g00 must vanish. Each iteration extends r to the other nodes nearly as the half-space deforms
there, computes z = |q| r, makes d = −z + b s conjugate to the last step s, sets s = clip(p + α d + λ) − p with λ such
that the sum stays, and minimises along p + t s. K s is the only displacement computed: it serves the line search, the
update of the gap and the next b, so that an iteration costs two pairs of transforms. If s is not a descent direction, a
gradient step of the length of Barzilai and Borwein replaces it.

Without the extension, r = 0 off the free nodes, the condition number grows with the distance of the patches of contact
over the spacing, and the iterations with the number of nodes.

The steps and the errors of their images shrink together, so that transforms in single precision suffice if the gap is
recomputed in double precision from time to time.

Source: I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206, doi:10.1016/S0043-1648(99)00113-1, for the projection in
elastic contact without an upper bound.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics import kernels
from roughfilm.contact.mechanics.extension import Extension
from roughfilm.contact.mechanics.half_space import HalfSpace
from roughfilm.contact.mechanics.loop_ranges import Pieces

REFRESH_FACTOR = 1e-4
"""Reduction of the violation after which the gap is recomputed in double precision."""

WHOLE_STEP_FRACTION = 0.6
"""Fraction of a clipped step beyond which the minimum must lie for the whole step to be taken."""

MAX_FRACTION = 100.0
"""Largest multiple of a step; a larger one multiplies a step that is rounding, and with it the error of the sum."""

SUM_TOLERANCE = 1e-14
"""Relative tolerance of the sum of pressures in every step."""

IMPROVEMENT_FACTOR, STALL_ITERATIONS = 0.9, 500
"""Required reduction of the smallest violation, and the iterations without it after which the search has stalled."""

GRADIENT_ITERATIONS = 10
"""Iterations without improvement after which gradient and conjugate steps alternate in blocks of this length."""

GROWTH = 125
"""Size of new lists of free nodes over the number that may be free, percent."""

MIN_TRIAL_LENGTH, MAX_TRIAL_LENGTH = 0.2, 3.0
"""Range of the trial length α; 1 is exact where every node is in contact."""


def plane_of(pressure: Array, gap: Array, hardness: float) -> float:
    """The plane g00: mean gap where 0 < p < H, or without such nodes the middle between nodes at H and nodes at 0."""
    out = np.empty(4)
    kernels.levels(pressure.reshape(-1), gap.reshape(-1), hardness, out)
    total, count, most, least = (float(number) for number in out)
    return total / count if count else _middle(most, least)


def _middle(most: float, least: float) -> float:
    """The middle between the largest gap of the nodes at H and the smallest of those at 0; ±∞ where there are none."""
    if math.isinf(most) or math.isinf(least):
        return least if math.isinf(most) else most
    return (most + least) / 2


def violation_of(pressure: Array, gap: Array, plane: float, hardness: float) -> float:
    """The largest of |g − g00| where 0 < p < H, g00 − g where p = 0 and g − g00 where p = H."""
    out = np.empty(1)
    kernels.violation(pressure.reshape(-1), gap.reshape(-1), plane, hardness, out)
    return float(out[0])


def _single(size: int) -> NDArray[Any]:
    return np.empty(size, dtype=np.float32)


class _Search:
    """State of one minimisation, and the steps of an iteration."""

    def __init__(
        self, half_space: HalfSpace, heights: Array, unit: float, pressure: Array, hardness: float, team: Team
    ) -> None:
        self.half_space, self.hardness = half_space, hardness
        self.heights = (heights, float(heights.mean()), unit)
        self.columns, size = half_space.shape[1], half_space.source.size
        self.pieces = Pieces(half_space.shape, team)
        self.extension = Extension(half_space.shape, half_space.spacing, self.pieces)
        self.gap = np.full(size, np.inf, dtype=np.float32)
        self.state = (pressure > 0).astype(np.uint8) + (pressure >= hardness)
        self.touched = np.zeros(-(-size // kernels.WORD) * kernels.WORD, dtype=np.uint8)
        self.sum = float(pressure.sum())
        self._list(pressure)
        half_space.image[:] = 0
        self.length = 1.0
        self.slide = 0.0
        self.fraction = 0.0
        self.curvature = 0.0
        self.square = 0.0
        self.refresh()

    def _list(self, pressure: Array) -> None:
        """List the nodes with 0 < p < H."""
        pieces = self.pieces
        nodes = [low + np.flatnonzero(self.state[low:high] == kernels.INSIDE) for low, high in pieces.nodes]
        counts = [len(listed) for listed in nodes]
        self._allocate(max(counts))
        pieces.set_counts(counts)
        for first, listed in zip(pieces.firsts, nodes, strict=True):
            self.index[first : first + len(listed)] = listed
            self.held[first : first + len(listed)] = pressure[listed]
            self.state[listed] |= kernels.LISTED
        self.taken[:] = 0

    def _allocate(self, capacity: int) -> None:
        """Make lists for a number of free nodes in each range."""
        self.pieces.reserve(capacity)
        size = capacity * len(self.pieces.firsts)
        self.index: NDArray[Any] = np.empty(size, dtype=np.int32)
        self.residual, self.move, self.move_image = (_single(size) for _ in range(3))
        self.held, self.taken = np.empty(size), _single(size)
        self.spare = np.empty(size), _single(size)

    def _spread(self) -> Array:
        """The grid in double precision, set to the pressure."""
        half_space, pieces = self.half_space, self.pieces
        pieces.over_rows(kernels.load, self.state.reshape(half_space.shape), self.hardness, half_space.grid)
        pieces.over_free(kernels.spread, self.index, self.held, self.columns, half_space.grid)
        return half_space.grid

    def refresh(self) -> None:
        """Recompute the gap over its plane from the pressure in double precision and store it in single precision."""
        shape, pieces, grid = self.half_space.shape, self.pieces, self._spread()
        self.half_space.convolve()
        state, gap = self.state.reshape(shape), self.gap.reshape(shape)
        totals, counts, most, least, *_ = pieces.over_rows(
            kernels.deformed_levels, state, *self.heights, grid, out=True
        )
        plane = sum(totals) / sum(counts) if any(counts) else _middle(max(most), min(least))
        pieces.over_rows(kernels.open_gap, plane, *self.heights, grid, gap)
        self.plane = self.fraction = 0.0

    def free_nodes(self) -> float:
        """Update the gap, list the free nodes and their residuals, and return the largest absolute residual."""
        half_space, pieces = self.half_space, self.pieces
        image = half_space.image
        numbers = pieces.over_nodes(
            kernels.advance, self.fraction, image, self.gap, self.plane, self.state, self.touched, out=True
        )
        before, old = pieces.firsts, (self.held, self.taken)
        largest = int(max(numbers[0]))
        if largest > pieces.capacity:
            self._allocate(largest * GROWTH // 100)
        else:
            (self.held, self.taken), self.spare = self.spare, old
        numbers = pieces.over(
            [(*nodes, *firsts) for *firsts, nodes in zip(before, pieces.firsts, pieces.nodes, strict=True)],
            kernels.gather,
            *(self.touched.view(np.uint64), self.gap, self.plane, image, self.state, self.hardness, *old),
            *(self.index, self.residual, self.held, self.taken, self.move_image),
            out=True,
        )
        pieces.set_counts([int(count) for count in numbers[0]])
        self.free = int(sum(numbers[0]))
        if self.free:
            worst = max(numbers[2])
            self.mean = sum(numbers[1]) / self.free
            pieces.over_free(kernels.centre, self.mean, self.residual)
            return worst
        return 0.0

    def conjugate(self, iteration: int) -> bool:
        """Set ``move`` along z = |q| r made conjugate to the last step; false if this is not a descent direction."""
        half_space, pieces = self.half_space, self.pieces
        self.extension.extend(self.index, self.residual, half_space.source, iteration=iteration)
        half_space.precondition()
        numbers = pieces.over_free(
            kernels.products,
            *(half_space.image, self.index, self.residual, self.taken, self.move_image, self.move),
            out=True,
        )
        z, s, k, zk, zr, sr = map(sum, numbers)
        z_mean, s_mean = z / self.free, s / self.free
        b = (zk - z_mean * k) / self.curvature if self.curvature > 0 else 0.0
        if b * sr >= zr:
            b = 0.0
        pieces.over_free(kernels.direct, self.length, z_mean, b, s_mean, self.move, self.taken)
        return bool(zr > 0)

    def descend(self) -> None:
        """Set ``move`` down the gradient, by the length of Barzilai and Borwein."""
        length = self.square / self.curvature if self.curvature > 0 else 1.0
        self.length = 1.0
        self.pieces.over_free(kernels.descend, length, self.residual, self.move)

    def step(self) -> bool:
        """Compute the step along ``move`` within the bounds that keeps the sum; true if the energy decreases."""
        self.slide, self.cut = self._shift()
        numbers = self.pieces.over_free(
            kernels.displace, *(self.slide, self.held, self.hardness, self.move, self.residual, self.taken), out=True
        )
        self.slope, self.room = sum(numbers[0]), min(numbers[1])
        return self.slope < 0

    def search(self) -> None:
        """Minimise the energy along the step and update the pressure."""
        half_space, pieces = self.half_space, self.pieces
        pieces.scatter_alone(self.index, self.taken, half_space.source)
        half_space.displace()
        numbers = pieces.over_free(
            kernels.curvature, half_space.image, self.index, self.taken, self.move_image, out=True
        )
        self.curvature, self.square = map(sum, numbers[:2])
        best = -self.slope / self.curvature if self.curvature > 0 else 1.0
        if self.cut:
            self.fraction = 1.0 if best > WHOLE_STEP_FRACTION else best
            best = min(max(best, 0.5), 1.5)
        else:
            self.fraction = min(best, self.room, MAX_FRACTION)
        self.length = min(max(self.length * best, MIN_TRIAL_LENGTH), MAX_TRIAL_LENGTH)
        numbers = pieces.over_free(
            kernels.press_on,
            *(self.fraction, self.slide, self.held, self.hardness, self.index, self.move, self.residual),
            *(self.move_image, self.state),
            out=True,
        )
        total, inside = map(sum, numbers[:2])
        if inside:
            self.plane += self.mean + total / inside
        else:
            self.refresh()

    def pressure(self) -> Array:
        """The pressure at the nodes of the surface, shape (nx, ny)."""
        nx, ny = self.heights[0].shape
        return self._spread()[:nx, :ny].copy()

    def _shift(self) -> tuple[float, bool]:
        """The shift λ with Σ clip(p + move + λ) = Σp over the free nodes, and whether a node is clipped.

        The sum is increasing and piecewise linear in λ, so that Newton's method within a bracket ends at the exact root
        or at the number nearest to it. Where every node is clipped, it goes on from the nearest node that is released.
        """
        shift, low, high = 0.0, -math.inf, math.inf
        while True:
            numbers = self.pieces.over_free(kernels.excess, shift, self.held, self.hardness, self.move, out=True)
            excess, within = sum(numbers[0]), int(sum(numbers[1]))
            cut = within < self.free
            if abs(excess) <= SUM_TOLERANCE * self.sum:
                return (shift if cut else shift - excess / within), cut
            if excess > 0:
                high = shift
            else:
                low = shift
            if within:
                new = shift - excess / within
            else:
                nearest = self.pieces.over_free(kernels.beyond, shift, self.held, self.hardness, self.move, out=True)
                over, under = min(nearest[1]) - self.hardness, max(nearest[0])
                new = shift - (over if excess > 0 else under) - excess
            if not math.isfinite(new):
                return shift, cut
            if not low < new < high:
                new = (low + high) / 2
            if new in (low, high):
                return shift, cut
            shift = new


def minimise(
    half_space: HalfSpace,
    heights: Array,
    unit: float,
    start: Array,
    hardness: float,
    *,
    tolerance: float,
    most_iterations: int,
    team: Team,
) -> tuple[Array, int]:
    """The pressure that minimises the energy, from a start within the bounds that has the prescribed sum.

    Parameters
    ----------
    half_space : K, for E* = 1.
    heights : z of the surface, shape (nx, ny), m, of the whole grid or of a corner of it.
    unit : the unit of length, m, in which h = (z̄ − z)/unit is the gap of the undeformed surface.
    start : initial pressure on the whole grid, flat, for E* = 1; 0 outside the surface.
    hardness : H, for E* = 1.
    tolerance : largest violation, in the unit of length.
    most_iterations : largest number of iterations.
    team : threads that share the loops.

    Returns
    -------
    pressure : shape (nx, ny), for E* = 1.
    iterations : number of iterations.

    Raises
    ------
    ConvergenceError
        If the violation stays above the tolerance; the message gives the smallest violation.
    """
    search = _Search(half_space, heights, unit, start, hardness, team)
    del start
    violation = refreshed = best = search.free_nodes()
    since = 0
    outcome = Outcome.UNFINISHED
    for iteration in range(most_iterations + 1):
        if violation <= max(tolerance, REFRESH_FACTOR * refreshed):
            search.refresh()
            violation = refreshed = search.free_nodes()
            if violation <= tolerance:
                return search.pressure(), iteration
        if violation < IMPROVEMENT_FACTOR * best:
            best, since = violation, iteration
        if iteration - since > STALL_ITERATIONS:
            outcome = Outcome.STALLED
            break
        gradient = (iteration - since) // GRADIENT_ITERATIONS % 2 == 1
        if gradient or not (search.conjugate(iteration) and search.step()):
            search.descend()
            if not search.step():
                outcome = Outcome.STALLED
                break
        search.search()
        violation = search.free_nodes()
    raise ConvergenceError(
        f"contact: {outcome} after {iteration} iterations with the conditions of contact broken by {best:.2g} "
        f"of the rms height, above {tolerance:.2g}; ask for a looser tolerance or resolve the surface better",
        outcome=outcome,
        iterations=iteration,
    )
