"""The worn part of a difference of two measurements: its volume and largest depth, against the unworn part."""

from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.registration.register import BLOCKS, block_numbers, robust_deviation

SEED, BORDER = 4.5, 2.0
"""Filtered differences, in robust standard deviations of the unworn part: a worn place is a connected region beyond the
second that somewhere exceeds the first, which noise alone hardly does."""

FIT_PIXELS, SMALLER_FIT = 4, 2
"""Half sides of the square of pixels whose quadratic fit gives the largest depth, and of a smaller one."""

FILTER = 2.0
"""Standard deviation of the Gaussian filter of the difference before worn points are sought, pixels."""

MARGIN = 6
"""Distance, in pixels, within which the points around a worn one are left out of the fit."""

MIN_UNWORN = 0.1
"""Smallest fraction of unworn points with which the level is fitted to them."""

MAX_ITERATIONS = 30
"""Largest number of fits."""


@dataclass(frozen=True, kw_only=True)
class Wear:
    """The difference before − after above its unworn level, and what follows from it.

    Attributes
    ----------
    depth : difference less its level, shape (nx, ny), m, 0 where invalid; positive where material is gone.
    worn : mask of the points that differ from the unworn level by more than noise.
    volume : mean depth over the valid points, m: the net volume that is gone per area.
    volume_uncertainty : half width of the interval that contains it in 95 of 100 cases, m; None where the plane is
        fitted to all points, so that the volume is zero by definition.
    largest : largest depth of the difference after a Gaussian filter of two pixels, m.
    largest_uncertainty : half width of its interval, m.
    noise : standard deviation of the difference over the unworn points, m.
    worn_fraction : part of the valid points that are worn and lower than before.
    warnings : reasons why the level or the volume may be wrong.
    """

    depth: Array
    worn: Mask
    volume: float
    volume_uncertainty: float | None
    largest: float
    largest_uncertainty: float
    noise: float
    worn_fraction: float
    warnings: tuple[str, ...]


def wear_of(difference: Array, valid: Mask, *, rounding: float = 0.0, unworn_only: bool = True) -> Wear:
    """Volume and depth of a difference of two registered measurements.

    The level of the difference is a plane c₀ + c₁ x + c₂ y that is fitted to the unworn points: those that belong to no
    worn place, nor lie within six pixels of one. A worn place is a connected region where the difference, filtered by a
    Gaussian of two pixels, exceeds two robust standard deviations, and somewhere 4.5. Fit and choice are repeated until
    the choice stays.

    The volume per area is V = ⟨d⟩, the mean of the difference less its level; invalid points have the filtered
    difference. Its uncertainty is that of the level and of the noise in the worn part: with the influence u of each
    point on V, Var V = v Σ u². Here v = n Var ⟨d⟩ₙ follows from the means of the unworn points over 64 blocks of n
    pixels, so that it contains the correlation of the noise over lengths below a block.

    The largest depth is that of the quadratic polynomial that fits 9 x 9 pixels best around the deepest filtered point;
    its uncertainty is three standard deviations of such fits in the unworn part, plus the change on 5 x 5 pixels.

    Parameters
    ----------
    difference : before − after, shape (nx, ny), m.
    valid : mask of the points that both measurements have.
    rounding : distance from the median, m, up to which a difference is rounding and counts as none.
    unworn_only : whether the plane is fitted to unworn points only, or to all.

    Raises
    ------
    InputError
        If fewer than 100 points are valid.
    """
    if valid.sum() < 100:
        raise InputError(f"difference: {int(valid.sum())} common points are valid; 100 are needed")
    difference = difference - np.median(difference[valid])
    difference[np.abs(difference) <= rounding] = 0.0
    x, y = (np.linspace(-1, 1, n) for n in difference.shape)
    plane = [np.ones(valid.shape), np.broadcast_to(x[:, None], valid.shape), np.broadcast_to(y, valid.shape)]
    design = np.stack([column[valid] for column in plane], axis=-1)
    weights = _filtered(valid.astype(np.float64))
    start = 0.0 if unworn_only else difference[valid].mean()
    smooth = _filtered(np.where(valid, difference - start, 0.0)) / np.maximum(weights, 1e-12) + start
    unworn, worn, warnings = valid.copy(), np.zeros_like(valid), []
    for _ in range(MAX_ITERATIONS):
        chosen = unworn[valid]
        level = np.linalg.lstsq(design[chosen], difference[valid][chosen], rcond=None)[0]
        surface = sum(c * column for c, column in zip(level, plane, strict=True))
        away = smooth - surface
        worn = _worn(away, valid, unworn)
        kept = valid & ~_widened(worn)
        if not unworn_only:
            break
        if kept.sum() < MIN_UNWORN * valid.sum():
            warnings.append(
                f"less than {100 * MIN_UNWORN:.0f} % of the common points are unworn, so that the level of the "
                "difference is uncertain; measure more of the unworn surface around"
            )
            break
        if np.array_equal(kept, unworn):
            break
        unworn = kept
    levelled = unworn_only and worn.any()
    if not levelled:
        cause = "no place differs by more than noise" if unworn_only else "the level is that of all points"
        warnings.append(
            f"{cause}, so that the worn volume is zero by definition; even wear of the whole field is not detected"
        )
    depth = np.where(valid, difference - surface, 0.0)
    noise, variance = _noise(depth, unworn)
    chosen = unworn[valid]
    influence = np.full(chosen.size, 1 / chosen.size)
    inverse = np.linalg.inv(design[chosen].T @ design[chosen])
    influence[chosen] -= design[chosen] @ (inverse @ design.mean(axis=0))
    quantile = float(scipy.stats.t.ppf(0.975, max(_blocks_of(unworn).size - 3, 1)))
    filled = np.where(valid, difference, smooth) - surface
    fitted, closer = (_quadratic_fit(filled, reach) for reach in (FIT_PIXELS, SMALLER_FIT))
    deepest = np.unravel_index(int(np.argmax(np.where(valid, smooth - surface, -np.inf))), valid.shape)
    return Wear(
        depth=depth,
        worn=worn,
        volume=float(filled.mean()) if levelled else 0.0,
        volume_uncertainty=quantile * float(np.sqrt(variance * (influence**2).sum())) if levelled else None,
        largest=float(fitted[deepest]),
        largest_uncertainty=3 * float(fitted[unworn].std()) + abs(float(fitted[deepest] - closer[deepest])),
        noise=noise,
        worn_fraction=float((worn & (depth > 0)).sum() / valid.sum()),
        warnings=tuple(warnings),
    )


def _worn(away: Array, valid: Mask, unworn: Mask) -> Mask:
    """Mask of the worn places of a filtered difference."""
    middle = np.median(away[unworn])
    size = np.abs(away - middle) / max(robust_deviation(away[unworn] - middle), 1e-300)
    labels = scipy.ndimage.label(valid & (size > BORDER))[0]
    seeds = np.unique(labels[valid & (size > SEED)])
    return np.asarray(np.isin(labels, seeds[seeds > 0]))


def _filtered(field: Array) -> Array:
    return np.asarray(scipy.ndimage.gaussian_filter(field, FILTER, mode="constant"))


def _quadratic_fit(field: Array, reach: int) -> Array:
    """The value at each pixel of the quadratic polynomial that fits the square of pixels around it best."""
    k = np.arange(-reach, reach + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(k, k, indexing="ij"))
    terms = np.stack([np.ones(x.size), x, y, x * x, x * y, y * y], axis=-1)
    weights = np.linalg.pinv(terms)[0].reshape(k.size, k.size)
    return np.asarray(scipy.ndimage.correlate(field, weights, mode="nearest"))


def _widened(worn: Mask) -> Mask:
    return np.asarray(scipy.ndimage.maximum_filter(worn, size=2 * MARGIN + 1))


def _blocks_of(unworn: Mask) -> Array:
    """The numbers of the blocks of which half or more is unworn."""
    blocks = block_numbers(unworn.shape)
    fraction = np.bincount(blocks[unworn], minlength=BLOCKS**2) / np.bincount(blocks.ravel(), minlength=BLOCKS**2)
    return np.asarray(np.flatnonzero(fraction >= 0.5))


def _noise(depth: Array, unworn: Mask) -> tuple[float, float]:
    """Standard deviation of the unworn points, m, and the variance of their block means times the points of a block."""
    blocks, chosen = block_numbers(depth.shape), _blocks_of(unworn)
    sums, counts = (
        np.bincount(blocks[unworn], weights=values, minlength=BLOCKS**2) for values in (depth[unworn], None)
    )
    means = (sums / np.maximum(counts, 1))[chosen]
    noise = float(depth[unworn].std())
    if chosen.size <= 3:
        return noise, noise**2
    return noise, float((means**2 * counts[chosen]).sum() / (chosen.size - 3))
