"""How often intervals from few windows contain the truth of a surface whose statistics are known."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.windows.scatter import Scatter, scatter


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """The fraction of intervals that contain the truth.

    Attributes
    ----------
    rate : that fraction; NaN if no interval is given.
    error : its standard error.
    given : fraction of the tries in which an interval is given.
    half_width : median of the half widths of the intervals over the truth.
    needed : half width over the truth that would contain it in 95 of 100 tries, from the errors themselves.
    """

    rate: float
    error: float
    given: float
    half_width: float
    needed: float


def coverage_of(
    hits: Sequence[float], tries: int, widths: Sequence[float], errors: Sequence[float], independent: float
) -> Coverage:
    """The coverage from the hits of each interval that was given.

    Parameters
    ----------
    hits : 1 or 0 for each interval, or the fraction of further values inside it.
    tries : number of tries, also those without an interval.
    widths : half width of each interval over the truth.
    errors : signed errors over the truth.
    independent : number of independent tries, for the standard error.
    """
    if not hits:
        return Coverage(rate=np.nan, error=np.nan, given=0.0, half_width=np.nan, needed=np.nan)
    rate = float(np.mean(hits))
    return Coverage(
        rate=rate,
        error=float(np.sqrt(max(rate * (1 - rate), 0.0) / max(independent, 1.0))),
        given=len(hits) / tries,
        half_width=float(np.median(widths)),
        needed=float(np.quantile(np.abs(errors), 0.95)),
    )


def of_subsets(values: Array, count: int, draws: int, rng: np.random.Generator) -> tuple[Coverage, Coverage]:
    """The coverage of the mean and of a further window, by random subsets of many independent windows.

    A subset of n of N windows has a mean whose error from that of all is smaller than from the true one by √(1 − n/N)
    (sampling without replacement), by which the error is divided. Further windows are those outside of the subset.

    Parameters
    ----------
    values : a positive quantity of all windows, shape (N,).
    count : n, size of a subset.
    draws : number of subsets.
    """
    mean = float(values.mean())
    correction = np.sqrt(1 - count / values.size)
    means, further = _Tries(), _Tries()
    for _ in range(draws):
        order = rng.permutation(values.size)
        found = scatter(values[order[:count]], positive=True)
        means.mean(found, found.mean - (found.mean - mean) / correction)
        further.further(found, values[order[count:]], mean)
    return means.coverage(draws, values.size / count), further.coverage(draws, values.size / count)


def of_measurements(values: Array, independent: Array) -> tuple[Coverage, Coverage]:
    """The coverage of the mean and of a further window, by the windows of many measurements.

    The true mean is that of all windows of all measurements. Further windows are those of the next measurement.

    Parameters
    ----------
    values : a positive quantity of each window, shape (measurements, windows).
    independent : effective number of independent windows of each measurement, shape (measurements,).
    """
    mean, tries = float(values.mean()), len(values)
    means, further = _Tries(), _Tries()
    for own, other, worth in zip(values, np.roll(values, -1, axis=0), independent, strict=True):
        found = scatter(own, float(worth), positive=True)
        means.mean(found, mean)
        further.further(found, other, mean)
    return means.coverage(tries, tries), further.coverage(tries, tries)


class _Tries:
    """Hits, widths and errors of the intervals that were given."""

    def __init__(self) -> None:
        self.hits: list[float] = []
        self.widths: list[float] = []
        self.errors: list[float] = []

    def mean(self, found: Scatter, truth: float) -> None:
        """Count the confidence interval of a mean."""
        if found.mean_interval is not None:
            low, high = found.mean_interval
            self._add(float(low <= truth <= high), 0.5 * (high - low) / truth, [found.mean / truth - 1])

    def further(self, found: Scatter, others: Array, truth: float) -> None:
        """Count the prediction interval of one further window."""
        if found.interval is not None:
            low, high = found.interval
            inside = float(((others >= low) & (others <= high)).mean())
            self._add(inside, 0.5 * (high - low) / truth, list(others / truth - found.mean / truth))

    def _add(self, hit: float, width: float, errors: list[float]) -> None:
        self.hits.append(hit)
        self.widths.append(width)
        self.errors.extend(errors)

    def coverage(self, tries: int, independent: float) -> Coverage:
        """The coverage of all tries."""
        return coverage_of(self.hits, tries, self.widths, self.errors, independent)
