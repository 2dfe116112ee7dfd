"""Accurate Stokes flow between walls that vary along one direction alone, a reference for simpler models."""

from collections.abc import Iterator
from dataclasses import astuple, dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome

FACTOR_TOLERANCE = 1e-8
"""Default relative tolerance of each factor."""

FIRST_WAVES = 8
"""Number of functions along the period in the first basis."""

FIRST_HEIGHTS = 5
"""Number of functions across the gap in the first basis."""

BASIS_GROWTH = 1.4
"""Ratio of both numbers of functions from one basis to the next."""

EVENNESS_ROUNDOFF = 1e-13
"""Largest difference of an even wall from its mirror image, over the mean gap."""

MAX_UNKNOWNS = 2000
"""Largest number of unknowns; more take above ten seconds."""


@dataclass(frozen=True, kw_only=True)
class RidgeFlow:
    """Factors of a gap between ridges, over those of a smooth film of the mean gap h̄.

    Attributes
    ----------
    across, along : A/h̄³ across the ridges and along them.
    drag, drag_along : B/h̄ for sliding across the ridges and along them; NaN unless the upper wall is flat.
    friction, friction_along : τh̄/(ηu) on the upper wall for the same sliding, without a mean pressure gradient.
    """

    across: float
    along: float
    drag: float
    drag_along: float
    friction: float
    friction_along: float


def sinusoidal_ridge_flow(amplitude: float, wavelength: float, *, tolerance: float = FACTOR_TOLERANCE) -> RidgeFlow:
    """Compute Stokes flow in a gap h/h̄ = 1 + a cos(2πx/L) between a flat wall and ridges.

    Parameters
    ----------
    amplitude : a over the mean gap, 0 <= a < 1.
    wavelength : L over the mean gap.
    tolerance : tolerance of :func:`ridge_flow`, whose errors are raised.

    Examples
    --------
    Ratios to Reynolds' (1 - a²)^(5/2)/(1 + a²/2) for wavelengths of 20, 5 and 2.5 mean gaps:

    >>> thin = (1 - 0.3**2) ** 2.5 / (1 + 0.3**2 / 2)
    >>> [round(sinusoidal_ridge_flow(0.3, length).across / thin, 5) for length in (20, 5, 2.5)]
    [0.99692, 0.95383, 0.84935]
    """
    if not (0 <= amplitude < 1 and 0 < wavelength < np.inf):
        raise InputError(
            f"ridges: got amplitude {amplitude!r}, wavelength {wavelength!r}, in mean gaps; "
            "give 0 to below 1, and above 0"
        )
    return ridge_flow(amplitude * np.array([-1, 0, 1, 0]), np.ones(4), wavelength, tolerance=tolerance)


def ridge_flow(
    lower: ArrayLike,
    upper: ArrayLike,
    period: float,
    *,
    tolerance: float = FACTOR_TOLERANCE,
    max_unknowns: int = MAX_UNKNOWNS,
) -> RidgeFlow:
    """Compute Stokes flow between two walls z₁(x) < z₂(x) by Ritz' method on bases that grow until convergence.

    Across the ridges the stream function minimises the dissipation ∫(∇²ψ)² at the flow q, with the upper wall at rest
    or sliding at u. With s = (z - z₁)/h,

        ψ = q (3s² - 2s³) + u h (s³ - s²) + Σ c_mn s²(1-s)² P_n(s) e^{2πi m x/L}.

    Along the ridges the velocity minimises the dissipation ∫|∇v|². Errors of the factors are quadratic in that of the
    flow and decrease exponentially with the size of the basis for smooth walls; A converges from below, friction from
    above.

    Parameters
    ----------
    lower, upper : heights at nodes x_i = i L/n of one period, shape (n,), for trigonometric interpolation.
    period : L, in the same unit.
    tolerance : largest relative change of any factor by the last increase of the basis by 1.4.
    max_unknowns : largest number of unknowns of a basis.

    Raises
    ------
    InputError
        If the walls are not profiles, touch or cross, or the tolerance is not above 0.
    ConvergenceError
        If the tolerance is not met with the largest basis. With 2000 unknowns sinusoids on one wall meet 1e-8 down to
        wavelengths of 0.5, 1 and 1.5 mean gaps at amplitudes of 0.05, 0.3 and 0.8, and 1e-5 down to 0.5, 0.8 and 1 at
        0.1, 0.3 and 0.8.
    """
    one, two = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
    if one.ndim != 1 or one.shape != two.shape or one.size < 2 or not np.isfinite(one + two).all():
        raise InputError(f"walls: got shapes {one.shape} and {two.shape}; give two profiles of as many finite heights")
    if not (0 < period < np.inf and tolerance > 0):
        raise InputError(f"period: got {period!r}, tolerance {tolerance!r}; both must be above 0")
    mean = float((two - one).mean())
    places = np.arange(8 * one.size, dtype=np.float64)[:, None] * (period / (8 * one.size))
    least = float(_derivatives(two - one, places, period)[0].min())
    if not least > 0:
        raise InputError(f"walls: the least gap is {least:.3g}; they must not touch")
    middle = float((two + one).mean()) / 2
    walls = ((one - middle) / mean, (two - middle) / mean)
    before, change, unknowns = None, np.inf, 0
    for waves, heights in _sizes(1 if _even(*walls) else 2, max_unknowns):
        strip = _strip(walls, period / mean, waves, heights)
        unknowns = len(strip.waves) * heights
        factors = _factors(strip, heights, slides=bool(np.ptp(two) == 0))
        if before is not None:
            change = float(np.nanmax(np.abs(np.array(astuple(factors)) / np.array(astuple(before)) - 1)))
            if change < tolerance:
                return factors
        before = factors
    raise ConvergenceError(
        f"ridge flow: factors still change by {change:.1e} with {unknowns} functions; "
        "loosen the tolerance, or take longer or lower waves",
        outcome=Outcome.UNFINISHED,
    )


@dataclass(frozen=True, kw_only=True)
class _Strip:
    """Quadrature points of a gap, with arrays of shape (along, across), and the functions along it.

    ``below``, ``thickness`` and ``waves`` are the lower wall, the gap and functions of x, each with two derivatives;
    ``root`` is the square root of the weight of a point in a mean along x.
    """

    height: Array
    below: tuple[Array, ...]
    thickness: tuple[Array, ...]
    waves: tuple[tuple[Array, Array, Array], ...]
    root: Array


def _sizes(parities: int, limit: int) -> Iterator[tuple[int, int]]:
    """The numbers of waves along and functions across of bases of one or both parities, up to a limit of unknowns."""
    waves, heights = float(FIRST_WAVES), float(FIRST_HEIGHTS)
    while parities * waves * heights < limit:
        yield round(waves), round(heights)
        waves, heights = BASIS_GROWTH * waves, BASIS_GROWTH * heights


def _even(*walls: Array) -> bool:
    return all(np.abs(wall[1:] - wall[:0:-1]).max() < EVENNESS_ROUNDOFF for wall in walls)


def _strip(walls: tuple[Array, Array], length: float, waves: int, heights: int) -> _Strip:
    even = _even(*walls)
    count = 2 * (3 * waves + walls[0].size + 8)
    x = (np.arange(count // 2 if even else count, dtype=np.float64)[:, None] + 0.5) * (length / count)
    s, weights = (np.asarray(values, dtype=np.float64) for values in scipy.special.roots_legendre(heights + 8))
    below, above = (_derivatives(wall, x, length) for wall in walls)
    thickness = tuple(two - one for one, two in zip(below, above, strict=True))
    functions = []
    for number in range(waves + 1):
        q = 2 * np.pi * number / length
        cosine, sine = np.cos(q * x), np.sin(q * x)
        functions.append((cosine, -q * sine, -q * q * cosine))
        if number and not even:
            functions.append((sine, q * cosine, -q * q * sine))
    return _Strip(
        height=(s[None, :] + 1) / 2,
        below=below,
        thickness=thickness,
        waves=tuple(functions),
        root=np.sqrt(weights / 2 * thickness[0] / len(x)),
    )


def _derivatives(wall: Array, x: Array, length: float) -> tuple[Array, ...]:
    """The trigonometric interpolant of a wall and its first two derivatives at x."""
    parts = np.fft.rfft(wall, norm="forward")
    q = 2 * np.pi * np.arange(parts.size) / length
    parts[1 : (wall.size + 1) // 2] *= 2
    waves = np.exp(1j * q * x)
    return tuple((waves @ (parts * (1j * q) ** order)).real[:, None] for order in range(3))


def _factors(strip: _Strip, heights: int, *, slides: bool) -> RidgeFlow:
    s, one = strip.height, np.ones_like(strip.root)
    bump = (s * (1 - s), 1 - 2 * s, -2 * one)
    bumps = [_product(bump, _jacobi(n, 2, s)) for n in range(heights)]
    twice = [_product(_product(bump, bump), _jacobi(n, 4, s)) for n in range(heights)]
    still = (one, 0 * one, 0 * one)

    across = _columns([_curl(strip, wave, shape) for shape in twice for wave in strip.waves])
    flow = _curl(strip, still, (3 * s**2 - 2 * s**3, 6 * s * (1 - s), 6 - 12 * s))
    slide = _curl(strip, strip.thickness, (s**3 - s**2, 3 * s**2 - 2 * s, 6 * s - 2))
    remainder = _projection_error(across, np.array([flow, slide]).T)
    least = remainder.T @ remainder
    pressure = 12 / least[0, 0]
    drag = -pressure * least[0, 1] / 6

    along = _columns([_gradient(strip, wave, shape) for shape in bumps for wave in strip.waves])
    z = strip.below[0] + s * strip.thickness[0]
    sheared = _gradient(strip, still, (s, one, 0 * one))
    push = np.concatenate([0 * strip.root.ravel(), (-z * strip.root).ravel()])
    rest = _projection_error(along, np.array([push, sheared]).T)
    driven = push - rest[:, 0]
    mean_of_sheared = float((s * strip.root**2).sum())
    return RidgeFlow(
        across=float(pressure),
        along=float(12 * driven @ driven),
        drag=float(drag) if slides else np.nan,
        drag_along=float(2 * (mean_of_sheared - driven @ sheared)) if slides else np.nan,
        friction=float(least[1, 1] - 3 * drag**2 / pressure) if slides else np.nan,
        friction_along=float(rest[:, 1] @ rest[:, 1]) if slides else np.nan,
    )


def _jacobi(n: int, exponent: int, s: Array) -> tuple[Array, Array, Array]:
    """P_n^(e,e)(2s - 1) and its first two derivatives in s."""
    t, a = 2 * s - 1, 2 * exponent
    first = (n + a + 1) * scipy.special.eval_jacobi(n - 1, exponent + 1, exponent + 1, t) if n > 0 else 0 * s
    second = (
        (n + a + 1) * (n + a + 2) * scipy.special.eval_jacobi(n - 2, exponent + 2, exponent + 2, t) if n > 1 else 0 * s
    )
    return scipy.special.eval_jacobi(n, exponent, exponent, t), first, second


def _product(one: tuple[Array, ...], two: tuple[Array, ...]) -> tuple[Array, Array, Array]:
    return one[0] * two[0], one[1] * two[0] + one[0] * two[1], one[2] * two[0] + 2 * one[1] * two[1] + one[0] * two[2]


def _curl(strip: _Strip, wave: tuple[Array, ...], shape: tuple[Array, ...]) -> Array:
    """The Laplacian of wave(x) shape(s), times the roots of the weights."""
    s, h = strip.height, strip.thickness
    fall = -(strip.below[1] + s * h[1]) / h[0]
    bend = -(strip.below[2] + s * h[2] + 2 * fall * h[1]) / h[0]
    value = wave[2] * shape[0] + 2 * wave[1] * shape[1] * fall + wave[0] * (shape[2] * fall**2 + shape[1] * bend)
    return np.asarray(((value + wave[0] * shape[2] / h[0] ** 2) * strip.root).ravel())


def _gradient(strip: _Strip, wave: tuple[Array, ...], shape: tuple[Array, ...]) -> Array:
    """The derivatives ∂/∂x and ∂/∂z of wave(x) shape(s), times the roots of the weights, concatenated."""
    s, h = strip.height, strip.thickness
    fall = -(strip.below[1] + s * h[1]) / h[0]
    x, z = wave[1] * shape[0] + wave[0] * shape[1] * fall, wave[0] * shape[1] / h[0]
    return np.concatenate([(x * strip.root).ravel(), (z * strip.root).ravel()])


def _columns(vectors: list[Array]) -> Array:
    return np.array([vector / np.linalg.norm(vector) for vector in vectors]).T


def _projection_error(basis: Array, values: Array) -> Array:
    """The columns of ``values`` minus their orthogonal projections on the basis."""
    coefficients, *_ = scipy.linalg.lstsq(basis, values, cond=1e-14)
    return np.asarray(values - basis @ coefficients)
