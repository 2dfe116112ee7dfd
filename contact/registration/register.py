"""Registration of two measurements of one place: the shift between them with its uncertainty."""

from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.preparation.filters import l_filter
from roughfilm.contact.registration.correlation import Peak, best_lag
from roughfilm.contact.registration.grids import Sampler, overlap
from roughfilm.contact.surfaces.surface import Surface

FALSE_PROBABILITY = 1e-3
"""Probability of a peak of unrelated surfaces above which a registration is not trusted."""

AMBIGUITY = 0.8
"""Second peak of the correlation, over the first, above which the shift is ambiguous."""

LONG_WAVES = 0.5
"""Nesting index of the L-filter before the correlation, in units of the shorter side."""

CLIPPED = 3.0
"""Heights beyond this many robust standard deviations are clipped before the correlation."""

COARSE_PIXELS = 1024
"""Largest side of the grid on which all lags are compared, pixels."""

TUKEY = 4.685
"""Residual, in robust standard deviations, from which on a point has no weight (Tukey's biweight)."""

MIN_SLOPE = 0.2
"""Smallest mean derivative of the weighted residuals that the uncertainty is computed with."""

NOISE_FILTER = 0.8
"""Standard deviation of the Gaussian filter before the fit, pixels, which limits errors of the interpolation."""

SHIFT_TOLERANCE = 1e-5
"""Change of the shift at which the fit ends, pixels."""

MAX_ITERATIONS = 60
"""Largest number of steps of the fit."""

MAX_DRIFT = 4.0
"""Largest distance of the fitted shift from the peak of the correlation, pixels."""

FLOOR = 0.005
"""Smallest uncertainty of the shift, pixels: errors of the interpolation and by the edges of worn places."""

MARGIN = 4
"""Pixels at the sides of each surface that the fit leaves out, as the filter reaches beyond the side there."""

MIN_FIT_PIXELS = 16
"""Smallest number of common pixels along a side with which the shift is fitted."""

HOLE_POWER = 8
"""Power of the filtered mask of valid points that weighs points beside invalid ones."""

FORM_ORDER = 2
"""Degree of the polynomial by which both surfaces may differ."""

BLOCKS = 8
"""Number of blocks along each side over which the residuals are summed for the uncertainty."""


@dataclass(frozen=True, kw_only=True)
class Registration:
    """The shift of a second surface against a first one.

    Attributes
    ----------
    shift : position of the first pixel of the second surface on the first one, pixels along x and y.
    uncertainty : half widths of the intervals that contain the shift in 95 of 100 cases, pixels; None where the fit did
        not converge, and for a given shift.
    peak : the peak of the cross-correlation from which the fit started; None for a given shift.
    warnings : reasons why the shift may be wrong, one sentence each.
    """

    shift: tuple[float, float]
    uncertainty: tuple[float, float] | None
    peak: Peak | None
    warnings: tuple[str, ...]


def register(first: Surface, second: Surface) -> Registration:
    """The shift at which two surfaces on pixels of one spacing match best, to a fraction of a pixel.

    1. Waves longer than half of the shorter side are removed by an L-filter, and heights beyond three robust standard
       deviations clipped, so that a scar or a spike does not decide.
    2. The normalised cross-correlation over the common valid points is compared at all lags (`best_lag`); surfaces of
       more than 1024 pixels a side are averaged over blocks of pixels for this.
    3. The shift t minimises Σ w (a(x) − b(x − t) − p(x))² over the common points, with b interpolated by cubic splines,
       p a polynomial of second degree for the drift of the instrument, and Tukey's weights w, which leave out worn
       places (Gauss-Newton).

    The uncertainty is that of a weighted least-squares fit with correlated residuals: the scores are summed over 64
    blocks, whose scatter gives their covariance. It contains neither rotation nor a difference in magnification.

    Parameters
    ----------
    first, second : surfaces of one spacing; shapes may differ.

    Raises
    ------
    InputError
        If a surface is constant, or the surfaces overlap by fewer than 8 pixels.
    ConvergenceError
        If the filling of invalid points does not converge.

    References
    ----------
    D. Padfield, IEEE Trans. Image Process. 21 (2012) 2706 (correlation over valid points); B. D. Lucas and T. Kanade,
    Proc. IJCAI 1981, 674 (least squares).
    """
    index = LONG_WAVES * min(*first.size, *second.size)
    one, two = (l_filter(surface.with_heights(surface.heights, periodic=False), index) for surface in (first, second))
    factor = -(-max(*one.shape, *two.shape) // COARSE_PIXELS)
    one, two = (_averaged(surface, factor) for surface in (one, two))
    peak = best_lag(_clipped(one), one.valid, _clipped(two), two.valid)
    place = (float(peak.lag[0]), float(peak.lag[1]))
    place, uncertainty = _fitted(_averaged(first, factor), _averaged(second, factor), place)
    if factor > 1:
        place, uncertainty = _fitted(first, second, (place[0] * factor, place[1] * factor))
    lags = [(lag[0] * factor, lag[1] * factor) for lag in (peak.lag, peak.other_lag)]
    warnings = []
    if peak.false_probability > FALSE_PROBABILITY:
        warnings.append(
            f"the correlation of {peak.coefficient:.2f} is too low to register the surfaces: unrelated ones reach it "
            f"with a probability of up to {peak.false_probability:.2g} (limit {FALSE_PROBABILITY:g}); measure more of "
            "the same place, or give the shift"
        )
    elif peak.other > AMBIGUITY * peak.coefficient:
        away = " x ".join(f"{abs(a - b) * step * 1e6:.4g}" for a, b, step in zip(*lags, first.spacing, strict=True))
        warnings.append(
            f"the shift is ambiguous: {away} µm away the correlation is {peak.other:.2f}, here {peak.coefficient:.2f}; "
            "the texture repeats itself; give the shift if it is known"
        )
    if uncertainty is None:
        warnings.append("the fit of the shift did not converge, so that it is known to a few pixels; give the shift")
    return Registration(shift=place, uncertainty=uncertainty, peak=peak, warnings=tuple(warnings))


def _averaged(surface: Surface, factor: int) -> Surface:
    """The surface on blocks of ``factor`` x ``factor`` pixels; a block without a valid pixel is invalid."""
    if factor == 1:
        return surface
    (nx, ny), (dx, dy) = (n // factor for n in surface.shape), surface.spacing
    sums, counts = (
        field[: nx * factor, : ny * factor].reshape(nx, factor, ny, factor).sum(axis=(1, 3))
        for field in (np.where(surface.invalid, 0.0, surface.heights), surface.valid)
    )
    return Surface(heights=sums / np.maximum(counts, 1), spacing=(dx * factor, dy * factor), invalid=counts == 0)


def _clipped(surface: Surface) -> Array:
    heights = surface.heights[surface.valid]
    middle = np.median(heights)
    limit = CLIPPED * robust_deviation(heights - middle)
    return np.clip(surface.heights, middle - limit, middle + limit) if limit > 0 else surface.heights


def robust_deviation(values: Array) -> float:
    """The standard deviation of values about 0 from their median size, which outliers do not change."""
    return float(np.median(np.abs(values))) / 0.6745


def _fitted(
    first: Surface, second: Surface, start: tuple[float, float]
) -> tuple[tuple[float, float], tuple[float, float] | None]:
    """The fitted shift and its uncertainty, pixels; the start and None if the fit does not converge near it."""
    scale = float(first.heights[first.valid].std())
    (one, near_one), (two, near_two) = (_without_noise(surface, scale) for surface in (first, second))
    samplers, shift = (Sampler(two), Sampler(two.with_heights(near_two))), np.array(start)
    for _ in range(MAX_ITERATIONS):
        common = overlap(first.shape, second.shape, (float(shift[0]), float(shift[1])))
        if min(pixels.stop - pixels.start for pixels in common) < MIN_FIT_PIXELS or not near_one[common].any():
            break
        step, covariance = _step(one, near_one, samplers, common, (float(shift[0]), float(shift[1])))
        longest = float(np.abs(step).max())
        shift = shift + step / max(longest, 1.0)
        if np.abs(shift - start).max() > MAX_DRIFT:
            break
        if longest < SHIFT_TOLERANCE:
            quantile = scipy.stats.t.ppf(0.975, BLOCKS**2 - len(covariance))
            width_x, width_y = (float(np.hypot(FLOOR, quantile * covariance[k, k] ** 0.5)) for k in (0, 1))
            return (float(shift[0]), float(shift[1])), (width_x, width_y)
    return start, None


def _without_noise(surface: Surface, scale: float) -> tuple[Surface, Array]:
    """The surface after a short Gaussian filter, in units of ``scale``, and weights that fall beside invalid points."""
    valid = surface.valid.astype(np.float64)
    sums, weights = (
        scipy.ndimage.gaussian_filter(field, NOISE_FILTER, mode="constant")
        for field in (surface.heights * valid, valid)
    )
    heights = np.where(surface.valid, sums / np.where(surface.valid, weights * scale, 1.0), 0.0)
    inside = np.s_[MARGIN:-MARGIN, MARGIN:-MARGIN]
    near = np.zeros_like(valid)
    near[inside] = (valid * weights**HOLE_POWER)[inside]
    return surface.with_heights(heights), near


def _step(
    first: Surface,
    near: Array,
    samplers: tuple[Sampler, Sampler],
    common: tuple[slice, slice],
    shift: tuple[float, float],
) -> tuple[Array, Array]:
    """A step of the Gauss-Newton iteration, pixels, and the covariance of shift and polynomial."""
    shape = (common[0].stop - common[0].start, common[1].stop - common[1].start)
    place = (common[0].start - shift[0], common[1].start - shift[1])
    (other, valid), (other_near, _) = (sampler(place, shape) for sampler in samplers)
    heights, valid = first.heights[common], valid & first.valid[common]
    prior = np.clip(other_near * near[common], 0.0, 1.0)[valid]
    x, y = (np.linspace(-1, 1, n) for n in shape)
    slopes = np.gradient(other)
    form = [np.multiply.outer(x**i, y**j) for i in range(FORM_ORDER + 1) for j in range(FORM_ORDER + 1 - i)]
    columns = [*slopes, *(-term for term in form)]
    design = np.stack([column[valid] for column in columns], axis=-1)
    difference = (heights - other)[valid]
    weights = prior
    solution = np.zeros(len(columns))
    for _ in range(3):
        solution = _solved(design, weights, difference)
        residual = difference + design @ solution
        scale = TUKEY * max(robust_deviation(residual), 1e-12 * float(np.abs(difference).max(initial=0.0)), 1e-300)
        square = np.minimum((residual / scale) ** 2, 1.0)
        weights = prior * (1 - square) ** 2
    normal = design.T @ (design * weights[:, None])
    scores = _block_sums(valid, design * (weights * residual)[:, None], shape)
    slope = (prior * (1 - square) * (1 - 5 * square)).sum() / max(weights.sum(), 1e-300)  # of w r against r, over w
    inverse = np.linalg.pinv(normal, hermitian=True) / max(float(slope), MIN_SLOPE)
    covariance = inverse @ (scores.T @ scores) @ inverse * BLOCKS**2 / (BLOCKS**2 - len(columns))
    return solution[:2], covariance


def _solved(design: Array, weights: Array, difference: Array) -> Array:
    weighted = design * weights[:, None]
    return np.asarray(np.linalg.lstsq(weighted.T @ design, -weighted.T @ difference, rcond=1e-12)[0])


def _block_sums(valid: Mask, values: Array, shape: tuple[int, int]) -> Array:
    """Sums of the values of the valid points over each of the blocks, shape (blocks, columns)."""
    blocks = block_numbers(shape)[valid]
    return np.stack([np.bincount(blocks, weights=column, minlength=BLOCKS**2) for column in values.T], axis=-1)


def block_numbers(shape: tuple[int, int]) -> Array:
    """The number of the block of each pixel, shape (nx, ny)."""
    along_x, along_y = (np.arange(n) * BLOCKS // n for n in shape)
    return np.asarray(along_x[:, None] * BLOCKS + along_y)
