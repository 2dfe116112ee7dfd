"""Projected conjugate gradients, preconditioned by |q|, for pressures between 0 and H with a given sum.

The method minimises ½ p·K p + p·h under 0 ≤ p ≤ H and Σp = N W. On the free nodes, whose pressure may change, the
residual r = h + K p − g00 must vanish. Each iteration computes z = |q| r, makes d = −z + b s conjugate to the last step
s, sets s = clip(p + α d + λ) − p with λ such that the sum stays, and minimises along p + t s. K s is the only
displacement computed: it serves the line search, the update of the gap and the next b, so that an iteration costs two
pairs of transforms. If s is not a descent direction, a gradient step of the length of Barzilai and Borwein replaces it.

The steps and the errors of their images shrink together, so that transforms in single precision suffice if the gap is
recomputed in double precision from time to time.

Source: I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206, doi:10.1016/S0043-1648(99)00113-1, for the projection in
elastic contact without an upper bound.
"""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.mechanics import kernels
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

MIN_TRIAL_LENGTH, MAX_TRIAL_LENGTH = 0.2, 3.0
"""Range of the trial length α; 1 is exact where every node is in contact."""


def plane_of(pressure: Array, gap: Array, hardness: float) -> float:
    """The plane g00: mean gap where 0 < p < H, or without such nodes the middle between nodes at H and nodes at 0."""
    inside = (pressure > 0) & (pressure < hardness)
    if inside.any():
        return float(gap[inside].mean())
    at_hardness, off = gap[pressure >= hardness], gap[pressure <= 0]
    if at_hardness.size == 0 or off.size == 0:
        return float(at_hardness.max() if at_hardness.size else off.min())
    return float(at_hardness.max() + off.min()) / 2


def violation_of(pressure: Array, gap: Array, plane: float, hardness: float) -> float:
    """The largest of |g − g00| where 0 < p < H, g00 − g where p = 0 and g − g00 where p = H."""
    difference = gap - plane
    worst = np.max(-difference, where=pressure < hardness, initial=0.0)
    return float(max(worst, np.max(difference, where=pressure > 0, initial=0.0)))


class _Search:
    """State of one minimisation, and the steps of an iteration."""

    def __init__(self, half_space: HalfSpace, heights: Array, pressure: Array, hardness: float, pieces: Pieces) -> None:
        self.half_space, self.heights, self.pressure, self.hardness = half_space, heights, pressure, hardness
        self.pieces = pieces
        self.gap = np.empty(heights.size, dtype=np.float32)
        self.index = np.empty(heights.size, dtype=np.int32)
        self.residual = np.empty(heights.size, dtype=np.float32)
        self.move = np.empty(heights.size, dtype=np.float32)
        self.taken, self.was_taken = (np.empty(heights.size, dtype=np.float32) for _ in range(2))
        self.move_image = np.empty(heights.size, dtype=np.float32)
        self.held, self.was_held = np.empty(heights.size), np.empty(heights.size)
        self.state = np.where(pressure > 0, np.where(pressure < hardness, kernels.INSIDE, kernels.HARD), kernels.OFF)
        self.state = self.state.astype(np.uint8)
        self.touched = np.zeros(-(-heights.size // kernels.WORD) * kernels.WORD, dtype=np.uint8)
        half_space.step[:] = half_space.source[:] = 0
        self.sum = float(pressure.sum())
        self.length = 1.0
        self.slide = 0.0
        self.fraction = 0.0
        self.curvature = 0.0
        self.square = 0.0
        self.refresh()

    def refresh(self) -> None:
        """Recompute the gap over its plane from the pressure in double precision and store it in single precision."""
        self.pieces.over_free(kernels.spread, self.index, self.held, self.pressure)
        displacement = self.half_space.displacement(self.pressure.reshape(self.half_space.shape)).reshape(-1)
        displacement += self.heights
        plane = plane_of(self.pressure, displacement, self.hardness)
        np.subtract(displacement, plane, out=self.gap, casting="same_kind")
        self.plane = self.fraction = 0.0

    def free_nodes(self) -> float:
        """Update the gap, list the free nodes and their residuals, and return the largest absolute residual."""
        half_space, pieces = self.half_space, self.pieces
        image, source, step = half_space.image, half_space.source, half_space.step
        self.held, self.was_held = self.was_held, self.held
        self.taken, self.was_taken = self.was_taken, self.taken
        pieces.over_all(kernels.advance, self.fraction, image, self.gap, self.plane, self.state, self.touched)
        numbers = pieces.over_all(
            kernels.gather,
            *(self.touched.view(np.uint64), self.gap, self.plane, image, self.state, self.pressure, source, step),
            *(self.was_held, self.was_taken, self.index, self.residual, self.held, self.taken, self.move_image),
            out=True,
        )
        pieces.ends = [int(end) for end in numbers[:, 0]]
        self.free = sum(end - low for end, (low, _) in zip(pieces.ends, pieces.ranges, strict=True))
        worst = float(numbers[:, 2].max())
        if self.free:
            self.mean = float(numbers[:, 1].sum()) / self.free
            pieces.over_free(kernels.centre, self.mean, half_space.source, self.index, self.residual)
        return worst

    def conjugate(self) -> bool:
        """Set ``move`` along z = |q| r made conjugate to the last step; false if this is not a descent direction."""
        half_space, pieces = self.half_space, self.pieces
        half_space.precondition()
        z, s, k, zk, zr, sr = pieces.over_free(
            kernels.products,
            *(half_space.image, self.index, self.residual, self.taken, self.move_image, self.move),
            out=True,
        ).sum(axis=0)
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
        half_space = self.half_space
        self.slide, self.cut = self._shift()
        numbers = self.pieces.over_free(
            kernels.displace,
            *(self.slide, self.held, self.hardness, self.index, self.move, self.residual, self.taken, half_space.step),
            out=True,
        )
        self.slope, self.room = float(numbers[:, 0].sum()), float(numbers[:, 1].min())
        return self.slope < 0

    def search(self) -> None:
        """Minimise the energy along the step and update the pressure."""
        half_space, pieces = self.half_space, self.pieces
        half_space.displace()
        numbers = pieces.over_free(
            kernels.curvature, half_space.image, self.index, self.taken, self.move_image, out=True
        )
        self.curvature, self.square = (float(total) for total in numbers[:, :2].sum(axis=0))
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
        total, inside = numbers[:, :2].sum(axis=0)
        if inside:
            self.plane += self.mean + float(total / inside)
        else:
            self.refresh()

    def _shift(self) -> tuple[float, bool]:
        """The shift λ with Σ clip(p + move + λ) = Σp over the free nodes, and whether a node is clipped.

        The sum is increasing and piecewise linear in λ, so that Newton's method within a bracket ends at the exact root
        or at the number nearest to it. Where every node is clipped, it goes on from the nearest node that is released.
        """
        shift, low, high = 0.0, -math.inf, math.inf
        while True:
            numbers = self.pieces.over_free(kernels.excess, shift, self.held, self.hardness, self.move, out=True)
            excess, within = float(numbers[:, 0].sum()), int(numbers[:, 1].sum())
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
                over, under = float(nearest[:, 1].min()) - self.hardness, float(nearest[:, 0].max())
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
    start: Array,
    hardness: float,
    *,
    tolerance: float,
    most_iterations: int,
    pieces: Pieces,
) -> tuple[Array, int]:
    """The pressure that minimises the energy, from a start within the bounds that has the prescribed sum.

    Parameters
    ----------
    half_space : K, for E* = 1.
    heights : h, gap of the undeformed surface, flat; infinite outside the surface.
    start : initial pressure, flat, for E* = 1; overwritten with the result.
    hardness : H, for E* = 1.
    tolerance : largest violation, in the unit of h, the rms height.
    most_iterations : largest number of iterations.
    pieces : ranges of nodes for the threads.

    Returns
    -------
    pressure : flat, for E* = 1.
    iterations : number of iterations.

    Raises
    ------
    ConvergenceError
        If the violation stays above the tolerance; the message gives the smallest violation.
    """
    search = _Search(half_space, heights, start, hardness, pieces)
    violation = refreshed = best = search.free_nodes()
    since = 0
    outcome = Outcome.UNFINISHED
    for iteration in range(most_iterations + 1):
        if violation <= max(tolerance, REFRESH_FACTOR * refreshed):
            search.refresh()
            violation = refreshed = search.free_nodes()
            if violation <= tolerance:
                return search.pressure, iteration
        if violation < IMPROVEMENT_FACTOR * best:
            best, since = violation, iteration
        if iteration - since > STALL_ITERATIONS:
            outcome = Outcome.STALLED
            break
        gradient = (iteration - since) // GRADIENT_ITERATIONS % 2 == 1
        if gradient or not (search.conjugate() and search.step()):
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
