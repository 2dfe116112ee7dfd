"""Products of dimensionless numbers that order the errors of a model in a sweep, with thresholds by tolerance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array

CERTAINTY = 0.95
"""Fraction of the cases below a threshold that are within its tolerance."""

MIN_ERROR = 1e-6
"""Lower limit of an error in the fit; the numerical uncertainty of a reference is larger."""


@dataclass(frozen=True, kw_only=True)
class Ordering:
    """The quality with which a product of powers orders errors.

    Attributes
    ----------
    powers : power of each feature.
    rank : Spearman's rank correlation of product and error; 1 for a perfect order, 0 for a constant product.
    thresholds : by tolerance, the largest product up to which the fraction ``CERTAINTY`` of the cases is within the
        tolerance; None if there is none.
    coverage : fraction of the cases at or below the threshold, averaged over the tolerances.
    """

    powers: Mapping[str, float]
    rank: float
    thresholds: Mapping[float, float | None]
    coverage: float


def product(features: Mapping[str, Array], powers: Mapping[str, float]) -> Array:
    """The product Π feature^power, in the shape of the features."""
    return np.asarray(np.exp(sum(power * np.log(features[name]) for name, power in powers.items())))


def fitted_powers(features: Mapping[str, Array], error: Array, *, step: float) -> dict[str, float]:
    """The powers of the product that fits the logarithm of the errors with least squares, as multiples of ``step``.

    The powers are scaled so that the largest magnitude is 1, then rounded; powers of zero are omitted.

    Parameters
    ----------
    features : positive numbers by name, shape (cases,).
    error : errors, shape (cases,); those below ``MIN_ERROR`` are raised to it.
    step : spacing of the rounded powers.
    """
    matrix = np.column_stack([np.ones(error.size), *(np.log(values) for values in features.values())])
    powers = np.linalg.lstsq(matrix, np.log(np.maximum(error, MIN_ERROR)), rcond=None)[0][1:]
    largest = np.abs(powers).max() or 1.0
    rounded = np.round(powers / largest / step) * step
    return {name: float(power) for name, power in zip(features, rounded, strict=True) if power != 0}


def ordering(
    features: Mapping[str, Array],
    powers: Mapping[str, float],
    error: Array,
    tolerances: Sequence[float],
    largest: Array | None = None,
) -> Ordering:
    """The quality with which a product of powers orders errors.

    Parameters
    ----------
    features : positive numbers by name, shape (cases,).
    powers : power of each feature.
    error : errors, shape (cases,).
    tolerances : tolerated errors for which thresholds are computed.
    largest : largest possible errors if the reference is uncertain, shape (cases,), from which the thresholds are
        computed; by default the errors.
    """
    from scipy.stats import spearmanr  # slow to import

    number = product(features, powers)
    thresholds = {
        tolerance: threshold(number, error if largest is None else largest, tolerance) for tolerance in tolerances
    }
    covered = [0.0 if limit is None else float(np.mean(number <= limit)) for limit in thresholds.values()]
    constant = number.max() <= (1 + 1e-9) * number.min()
    rank = 0.0 if constant else float(spearmanr(number, error).statistic)
    return Ordering(powers=powers, rank=rank, thresholds=thresholds, coverage=sum(covered) / len(covered))


def threshold(number: Array, error: Array, tolerance: float) -> float | None:
    """The largest number up to which the fraction ``CERTAINTY`` of the cases has an error within a tolerance.

    ``number`` and ``error`` have the shape (cases,). The result is None if there is no such number.
    """
    order = np.argsort(number, kind="stable")
    ordered = number[order]
    within = np.cumsum(error[order] <= tolerance) / np.arange(1, number.size + 1)
    last_of_equals = np.append(ordered[1:] > ordered[:-1] * (1 + 1e-9), True)
    good = np.flatnonzero((within >= CERTAINTY) & last_of_equals)
    return float(ordered[good[-1]]) if good.size else None
