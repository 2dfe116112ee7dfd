"""The scatter of a quantity between windows: intervals for their mean and for one further window."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError

COVERAGE = 0.95
"""Probability with which an interval contains what it is given for."""

MIN_INDEPENDENT = 3.0
"""Effective number of independent windows below which no interval is given."""

MAX_LOG = 600.0
"""Greatest half width of an interval of logarithms; its exponential is a finite number."""


TINY = float(np.finfo(float).tiny)
"""Smallest variance of which a logarithm is taken."""


SAME = 1e-12
"""Range of values over the largest below which they differ by rounding alone."""


class Distribution(StrEnum):
    """The distribution of the values of windows, by what of them is normal."""

    NORMAL = "normal values"
    LOGARITHMS = "normal logarithms"
    CUBE_ROOTS = "normal cube roots"


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """The scatter of a quantity between windows of one size.

    Attributes
    ----------
    values : one value for each window, shape (n,), in the unit of the quantity.
    mean : arithmetic mean.
    deviation : standard deviation of one window, corrected for overlap.
    independent : effective number of independent windows.
    mean_interval : 95 % confidence interval of the mean; None if the windows are too few.
    interval : 95 % prediction interval for one further window; None if the windows are too few.
    positive : whether the quantity is 0 or more.
    distribution : what is taken as normal: the values, their logarithms or their cube roots.
    zeros : fraction of the windows whose value is 0, such as sealed ones.
    zeros_interval : 95 % confidence interval of that fraction.
    """

    values: Array
    mean: float
    deviation: float
    independent: float
    mean_interval: tuple[float, float] | None
    interval: tuple[float, float] | None
    positive: bool
    distribution: Distribution
    zeros: float
    zeros_interval: tuple[float, float]

    __repr__ = brief

    @property
    def mean_uncertainty(self) -> float | None:
        """The half width of the 95 % confidence interval of the mean, at its longer side; None if it is unknown."""
        if self.mean_interval is None:
            return None
        return max(self.mean - self.mean_interval[0], self.mean_interval[1] - self.mean)

    @property
    def relative(self) -> float | None:
        """The uncertainty of the mean over the mean; None if it is unknown or the mean is 0."""
        half = self.mean_uncertainty
        return None if half is None or self.mean == 0 else half / abs(self.mean)


def scatter(values: Sequence[float] | Array, independent: float | None = None, positive: bool = False) -> Scatter:
    """Estimate the scatter of a quantity from its values in windows of one size.

    With the mean x̄, the effective number nₑ of independent windows and s² = Σ(xᵢ − x̄)²/(n (1 − 1/nₑ)), the confidence
    interval of the mean is x̄ ± t s/√nₑ and the prediction interval for one further window x̄ ± t s √(1 + 1/nₑ), where t
    is the 0.975 quantile of Student's distribution with nₑ − 1 degrees of freedom.

    For a positive quantity, the logarithms or the cube roots are normal, whichever is more likely: the flow through a
    gap is proportional to its cube. The prediction interval is that of these, transformed back. The confidence interval
    of the mean is x̄ exp(± t √w) with w = s²/(x̄² nₑ); for logarithms of the variance v, w is v/nₑ + v²/(2 (nₑ − 1)) if
    that is more. Values of 0 are a fraction q of their own, with the binomial interval of Clopper and Pearson. They are
    left out of the logarithms or roots, and q/((1 − q) nₑ) is added to w of the logarithms. The prediction interval
    then begins at 0 and ends at the quantile of 1 − 0.025/(1 − q) of the others.

    Parameters
    ----------
    values : shape (n,), n >= 1.
    independent : effective number of independent windows, 1 to n; by default n.
    positive : whether the quantity is 0 or more, and varies by factors rather than by differences.

    Raises
    ------
    InputError
        If there are no values, a value is not finite, a value of a positive quantity is below 0, or ``independent`` is
        out of range.

    Notes
    -----
    Below three independent windows there is no interval. For lognormal quantities with a standard deviation of the
    logarithms of up to 1, and cubes of normal ones with a coefficient of variation of up to 0.5, 90 to 96 % of the
    confidence intervals from 6 to 40 windows contain the mean, and 94 to 96 % of the prediction intervals the value of
    a further window. Sources: U. Olsson, J. Statistics Education 13 (2005), doi:10.1080/10691898.2005.11910638 (mean of
    a lognormal quantity); G. E. P. Box, D. R. Cox, J. R. Stat. Soc. B 26 (1964) 211 (likelihood of a transformation).

    Examples
    --------
    >>> found = scatter([2.0, 2.2, 1.9, 2.1, 1.8])
    >>> round(found.mean, 3), [round(end, 2) for end in found.interval]
    (2.0, [1.52, 2.48])
    """
    x = unmasked("values", values).astype(float)
    count = x.size
    if x.ndim != 1 or count == 0:
        raise InputError(f"values: got an array of shape {x.shape}; give one value for each window")
    if not np.isfinite(x).all():
        raise InputError(f"values: {int((~np.isfinite(x)).sum())} of {count} are not finite; leave such windows out")
    if positive and x.min() < 0:
        raise InputError(f"values: the least is {x.min():.6g}; a positive quantity is 0 or more")
    worth = float(count) if independent is None else float(independent)
    if not 1 <= worth <= count * (1 + 1e-9):
        raise InputError(f"independent: got {independent!r}; it must be 1 to the number of windows, {count}")
    if np.ptp(x) <= SAME * np.abs(x).max():
        x = np.full(count, x[0])
    mean, deviation = float(x[0]) if np.ptp(x) == 0 else float(x.mean()), _deviation(x, worth)
    zeros = float((x == 0).mean())
    known = worth >= MIN_INDEPENDENT  # a positive quantity that is 0 in all windows has no interval either
    inside = further = None
    distribution = Distribution.LOGARITHMS if positive else Distribution.NORMAL
    if known and deviation == 0 and not (positive and mean == 0):
        inside = further = (mean, mean)
    elif known and positive and mean > 0:
        inside, further, distribution = _of_positive(x, mean, deviation, worth, zeros)
    elif known and not positive:
        half = _student(worth) * deviation
        inside = (mean - half / math.sqrt(worth), mean + half / math.sqrt(worth))
        wide = half * math.sqrt(1 + 1 / worth)
        further = (mean - wide, mean + wide)
    return Scatter(
        values=x,
        mean=mean,
        deviation=deviation,
        independent=worth,
        mean_interval=inside,
        interval=further,
        positive=positive,
        distribution=distribution,
        zeros=zeros,
        zeros_interval=binomial_interval(zeros, worth),
    )


def _of_positive(
    x: Array, mean: float, deviation: float, worth: float, zeros: float
) -> tuple[tuple[float, float] | None, tuple[float, float] | None, Distribution]:
    """The confidence interval of the mean, the prediction interval and the distribution of a positive quantity."""
    some, some_worth = x[x > 0], worth * (1 - zeros)
    if some_worth < MIN_INDEPENDENT:
        return None, None, Distribution.LOGARITHMS
    logarithmic = _is_lognormal(some)
    y = np.log(some) if logarithmic else np.cbrt(some)
    middle, spread = float(y.mean()), _deviation(y, some_worth)
    w = (deviation / mean) ** 2 / worth
    if logarithmic:
        v = spread**2
        w = max(w, v / some_worth + v**2 / (2 * (some_worth - 1)) + zeros / ((1 - zeros) * worth))
    factor = math.exp(min(_student(some_worth) * math.sqrt(w), MAX_LOG))
    wide = spread * math.sqrt(1 + 1 / some_worth)
    low = middle - _student(some_worth) * wide
    high = middle + _student(some_worth, 0.5 * (1 - COVERAGE) / (1 - zeros)) * wide
    if logarithmic:
        low, high = math.exp(max(low, -MAX_LOG)), math.exp(min(high, MAX_LOG))
    else:
        low, high = max(low, 0.0) ** 3, high**3
    found = Distribution.LOGARITHMS if logarithmic else Distribution.CUBE_ROOTS
    return (mean / factor, mean * factor), (0.0 if zeros > 0 else low, high), found


def _is_lognormal(x: Array) -> bool:
    """Whether normal logarithms of values above 0 are at least as likely as normal cube roots (Box and Cox, 1964)."""
    logarithms = np.log(x)
    of_logarithms, of_roots = (np.log(max(y.var(), TINY)) for y in (logarithms, 3 * np.cbrt(x)))
    return bool(of_logarithms <= of_roots - 2 / 3 * float(logarithms.mean()))


def _deviation(x: Array, worth: float) -> float:
    """The standard deviation of one window; 0 if there is one independent window only."""
    if worth <= 1 or np.ptp(x) == 0:
        return 0.0
    return float(np.sqrt(np.mean((x - x.mean()) ** 2) / (1 - 1 / worth)))


def _student(worth: float, tail: float = 0.5 * (1 - COVERAGE)) -> float:
    """The quantile of Student's distribution with ``worth`` - 1 degrees of freedom that leaves a tail above it."""
    return float(scipy.special.stdtrit(worth - 1, 1 - tail))


def binomial_interval(fraction: float, trials: float) -> tuple[float, float]:
    """The 95 % confidence interval of Clopper and Pearson for a probability from an observed fraction.

    Parameters
    ----------
    fraction : fraction of the trials with the property, 0 to 1.
    trials : effective number of independent trials, which need not be an integer.

    Examples
    --------
    >>> [round(end, 3) for end in binomial_interval(0.0, 10)]
    [0.0, 0.308]
    """
    tail, hits = 0.5 * (1 - COVERAGE), fraction * trials
    low = float(scipy.special.betaincinv(hits, trials - hits + 1, tail)) if hits > 0 else 0.0
    high = float(scipy.special.betaincinv(hits + 1, trials - hits, 1 - tail)) if hits < trials else 1.0
    return low, high


def windows_needed(found: Scatter, tolerance: float) -> int | None:
    """The number of independent windows that determine the mean to a relative tolerance with a probability of 95 %.

    It is the least n with t s/√n <= ε x̄, where t depends on n; for a positive quantity the half width is that of its
    confidence interval, exp(t √w) − 1, as in `scatter`.

    Parameters
    ----------
    found : the scatter of the windows at hand.
    tolerance : ε, above 0 and below 1.

    Returns
    -------
    int : at least 3; None if the scatter is unknown, or the mean is 0 within its uncertainty and of either sign.
    """
    if not 0 < tolerance < 1:
        raise InputError(f"tolerance: got {tolerance!r}; it must be above 0 and below 1")
    half = found.mean_uncertainty
    if half is None or found.mean == 0 or (half >= abs(found.mean) and not found.positive):
        return None
    if half == 0:
        return math.ceil(MIN_INDEPENDENT)
    spread = math.log1p(half / found.mean) if found.positive else half / abs(found.mean)
    allowed = math.log1p(tolerance) if found.positive else tolerance
    worth = found.independent * (1 - found.zeros) if found.positive else found.independent
    of_one = spread / _student(worth) * math.sqrt(found.independent)
    n = max((1.96 * of_one / allowed) ** 2, MIN_INDEPENDENT)
    for _ in range(100):
        more = max((_student(max(n, MIN_INDEPENDENT)) * of_one / allowed) ** 2, MIN_INDEPENDENT)
        if abs(more - n) < 1e-3 * n:
            break
        n = 0.5 * (n + more)
    return math.ceil(n - 1e-3)
