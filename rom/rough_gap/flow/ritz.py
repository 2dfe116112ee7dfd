"""Stokes flow in a small cell of a gap between smooth walls by Ritz' method, without a mesh."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.walls import Walls

FACTOR_TOLERANCE = 1e-4
"""Default tolerance of A, B and friction over those of a smooth film."""

FIRST_BASIS = (2, 2)
"""Numbers of waves in a side and of functions across the gap in the first basis."""

MAX_FUNCTIONS = 2500
"""Largest number of functions; more take above a minute."""

BasisFlow = tuple[Array, Array, Array]
"""A flow û, its gradient along the film, of shape (2, 3, points), and ∂û/∂s, at points of one s."""


def ritz_flow(walls: Walls, *, tolerance: float = FACTOR_TOLERANCE) -> RoughGapFactors:
    """Compute the factors of a gap in Stokes flow from the least dissipation in bases that grow until convergence.

    On the strip 0 < s < 1, which z = z₁ + s h maps to the gap, divergence-free flows û are uniform ones,
    (∂_yψ, -∂_xψ, 0) with ψ = e^{iq·x} s(1-s) P_n(s), and (f'∂_xφ, f'∂_yφ, -f∇²φ) with φ = e^{iq·x} and
    f = s²(1-s)² P_n(s). In the gap u = û_x/h, v = û_y/h, w = û_s + (∇z₁ + s∇h)·(u, v) is also divergence-free and zero
    on the walls. Errors are quadratic in that of the flow; A converges from below (as a quadratic form), friction from
    above.

    Parameters
    ----------
    walls : smooth walls, m, with a few waves in a side, for trigonometric interpolation. A basis with waves up to m in
        a side and n functions across has 8 m (m + 1) n functions.
    tolerance : largest change of A/h̄³, B/h̄ and f h̄ by one more wave and function.

    Raises
    ------
    InputError
        If the walls touch, or the tolerance is not above 0.
    ConvergenceError
        If 2500 functions do not meet the tolerance.
    """
    if not tolerance > 0:
        raise InputError(f"tolerance: got {tolerance!r}; it must be above 0")
    if not walls.gap.min() > 0:
        raise InputError("walls: they touch; give walls apart, as this basis does not represent contact")
    mean, (dx, dy) = walls.mean_gap, walls.spacing
    unit = Walls(lower=walls.lower / mean, upper=walls.upper / mean, spacing=(dx / mean, dy / mean))
    before, change, functions = None, np.inf, 0
    for waves, heights in _sizes():
        form = _least_dissipation(unit, waves, heights)
        functions = _functions(waves, heights)
        pressure = np.asarray(12 * np.linalg.inv(form[:2, :2]), dtype=np.float64)
        shear, friction = np.full(2, np.nan), np.nan
        if walls.slides:
            shear = -pressure @ form[:2, 2] / 6
            friction = float(form[2, 2] - 3 * shear @ np.linalg.solve(pressure, shear))
        now = np.array([*pressure.ravel(), *shear, friction])
        if before is not None:
            change = float(np.nanmax(np.abs(now - before)))
            if change < tolerance:
                return RoughGapFactors(mean_gap=1.0, pressure=pressure, shear=shear, friction=friction).scaled(mean)
        before = now
    raise ConvergenceError(
        f"ritz flow: factors still change by {change:.1e} with {functions} functions; "
        "loosen the tolerance, or take a smaller or smoother cell",
        outcome=Outcome.UNFINISHED,
    )


def _functions(waves: int, heights: int) -> int:
    return ((2 * waves + 1) ** 2 - 1) * 2 * heights + 2 * heights


def _sizes() -> Iterator[tuple[int, int]]:
    waves, heights = FIRST_BASIS
    while _functions(waves, heights) <= MAX_FUNCTIONS:
        yield waves, heights
        waves, heights = waves + 1, heights + 1


def _least_dissipation(walls: Walls, waves: int, heights: int) -> Array:
    """The least dissipation over η, for flow along x, along y and a sliding wall, shape (3, 3) or (2, 2)."""
    surface = _surface(walls, waves)
    points, weights = scipy.special.roots_legendre(heights + 4)
    drives = 3 if walls.slides else 2
    functions = drives + _functions(waves, heights)
    total = np.zeros((functions, functions))
    for s, weight in zip((points + 1) / 2, weights / 2, strict=True):
        flows = (*surface.driven(s, drives), *surface.basis(s, heights))
        matrix = np.array([surface.gradient(s, flow) for flow in flows])
        total += (matrix * (weight / surface.gap.size)) @ matrix.T
    size = np.sqrt(np.diag(total))[drives:]
    inner = total[drives:, drives:] / np.outer(size, size)
    outer = total[drives:, :drives] / size[:, None]
    return np.asarray(total[:drives, :drives] - outer.T @ scipy.linalg.cho_solve(scipy.linalg.cho_factor(inner), outer))


@dataclass(frozen=True, kw_only=True)
class _Surface:
    """The gap, ∇z₁ and ∇h with their gradients, and the waves, at evenly spaced points of the cell.

    ``lower`` and ``rise`` have the shape (2, points), ``lower_x`` and ``rise_x`` (2, 2, points). Each of ``waves`` has
    its value, gradient, second derivatives and squared wave number.
    """

    gap: Array
    lower: Array
    rise: Array
    lower_x: Array
    rise_x: Array
    waves: tuple[tuple[Array, Array, Array, float], ...]

    def driven(self, s: float, drives: int) -> Iterator[BasisFlow]:
        """The flows of unit flux along x and along y, and that without flux under a wall that slides at 1."""
        yield from _uniform(6 * s * (1 - s), 6 - 12 * s, self.gap.size)
        if drives > 2:
            none, part, area = np.zeros_like(self.gap), 3 * s**2 - 2 * s, s**3 - s**2
            along = np.array([[self.rise[k] * part, none, -self.rise_x[k, 0] * area] for k in range(2)])
            up = np.array([self.gap * (6 * s - 2), none, -self.rise[0] * part])
            yield np.array([self.gap * part, none, -self.rise[0] * area]), along, up

    def basis(self, s: float, heights: int) -> Iterator[BasisFlow]:
        """The flows without mean flux that are zero on the walls."""
        none = np.zeros_like(self.gap)
        for n in range(heights):
            g, g_s, _ = _shape(n, 1, s)
            f, f_s, f_ss = _shape(n, 2, s)
            yield from _uniform(*_shape(n + 1, 1, s)[:2], self.gap.size)
            for value, (x, y), bend, square in self.waves:
                twisted = np.array([[bend[k, 1], -bend[k, 0], none] for k in range(2)])
                yield np.array([y, -x, none]) * g, twisted * g, np.array([y, -x, none]) * g_s
                along = np.array([[bend[k, 0] * f_s, bend[k, 1] * f_s, square * (x, y)[k] * f] for k in range(2)])
                lifted = np.array([x * f_ss, y * f_ss, square * value * f_s])
                yield np.array([x * f_s, y * f_s, square * value * f]), along, lifted

    def gradient(self, s: float, flow: BasisFlow) -> Array:
        """The velocity gradient in the gap times √h, all components concatenated."""
        own, along, up = flow
        h, tilt, tilt_x = self.gap, self.lower + s * self.rise, self.lower_x + s * self.rise_x
        u, u_s = own[:2] / h, up[:2] / h
        u_x = along[:, :2] / h - self.rise[:, None] * u / h
        w_x = along[:, 2] + (tilt_x * u).sum(axis=1) + (tilt * u_x).sum(axis=1)
        w_s = up[2] + (self.rise * u + tilt * u_s).sum(axis=0)
        steep = np.array([*u_s, w_s]) / h
        level = np.concatenate([u_x, w_x[:, None]], axis=1) - tilt[:, None] * steep
        return np.asarray((np.concatenate([level.reshape(6, -1), steep]) * np.sqrt(h)).ravel())


def _surface(walls: Walls, waves: int) -> _Surface:
    size = walls.size
    counts = [2 * (2 * waves + min(n // 2, 4) + 2) for n in walls.lower.shape]
    x, y = np.meshgrid(*(np.arange(n) / n * side for n, side in zip(counts, size, strict=True)), indexing="ij")
    place = np.array([x.ravel(), y.ravel()])
    below, gap = _derivatives(walls.lower, size, place), _derivatives(walls.gap, size, place)
    made = []
    for p in range(waves + 1):
        for r in range(-waves, waves + 1):
            if (p, r) <= (0, 0):
                continue
            q = 2 * np.pi * np.array([p / size[0], r / size[1]])
            phase = q @ place
            for value, slope in ((np.cos(phase), -np.sin(phase)), (np.sin(phase), np.cos(phase))):
                made.append((value, q[:, None] * slope, np.multiply.outer(np.outer(q, q), -value), float(q @ q)))
    return _Surface(gap=gap[0], lower=below[1], lower_x=below[2], rise=gap[1], rise_x=gap[2], waves=tuple(made))


def _uniform(value: float, slope: float, places: int) -> Iterator[BasisFlow]:
    """The flows along x and along y that are uniform along the film."""
    for direction in np.eye(3)[:2, :, None]:
        constant = np.broadcast_to(direction, (3, places))
        yield constant * value, np.zeros((2, 3, places)), constant * slope


def _shape(n: int, power: int, s: float) -> tuple[float, float, float]:
    """(s(1-s))^power P_n(s) and its first two derivatives, with P_n the Jacobi polynomial for (s(1-s))^power."""
    bump = np.polynomial.Polynomial([0, 1, -1]) ** power
    t = 2 * s - 1
    values = [
        np.prod(n + 2 * power + 1 + np.arange(k)) * scipy.special.eval_jacobi(n - k, power + k, power + k, t)
        if n >= k
        else 0.0
        for k in range(3)
    ]
    b = [bump.deriv(k)(s) if k else bump(s) for k in range(3)]
    return (
        b[0] * values[0],
        b[1] * values[0] + b[0] * values[1],
        b[2] * values[0] + 2 * b[1] * values[1] + b[0] * values[2],
    )


def _derivatives(heights: Array, size: tuple[float, float], place: Array) -> tuple[Array, Array, Array]:
    """The value, gradient and second derivatives of the trigonometric interpolant at some places."""
    parts = np.fft.fft2(heights, norm="forward")
    present = np.argwhere(np.abs(parts) > 1e-15 * np.abs(parts).max())
    whole = np.array([np.fft.fftfreq(n, 1 / n) for n in heights.shape], dtype=object)
    q = 2 * np.pi * np.array([[whole[i][place[i]] / size[i] for i in range(2)] for place in present])
    waves = np.exp(1j * q @ place) * parts[present[:, 0], present[:, 1]][:, None]
    gradient = np.array([(1j * q[:, i] @ waves).real for i in range(2)])
    second = np.array([[-(q[:, i] * q[:, j]) @ waves for j in range(2)] for i in range(2)]).real
    return waves.sum(axis=0).real, gradient, second
