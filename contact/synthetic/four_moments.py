"""Heights with given mean deviation, rms, skewness and kurtosis, or with given extremes."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.checks import length, number_between, whole_between

POLYNOMIAL_ORDER = 6
"""Order of the polynomial by which the distribution departs from the normal one."""

MIN_COUNT, MAX_COUNT = 32, 1_000_000
"""Range of the number of heights."""

MOMENT_TOLERANCE = 1e-8
"""Largest relative error of each condition; for the skewness the absolute error."""


@dataclass(frozen=True, kw_only=True)
class FourMoments:
    """Prescribed height parameters: Ra, Rq, Rsk, Rku of a profile, or Sa, Sq, Ssk, Sku of a surface.

    Attributes
    ----------
    average : Ra, m; mean absolute deviation.
    rms : Rq, m.
    skewness : Rsk, -10 to 10.
    kurtosis : Rku, 1 + Rsk² to 200; 3 for normal heights.
    peak : Rp, m, largest height above the mean; None leaves it free.

    Raises
    ------
    InputError
        If a number is out of range, Ra > Rq, or Rku < 1 + Rsk².
    """

    average: float
    rms: float
    skewness: float
    kurtosis: float
    peak: float | None = None

    def __post_init__(self) -> None:
        length("heights.rms", self.rms)
        number_between("heights.average", self.average, 1e-15, self.rms, "it must be above 0 m and at most the rms")
        number_between("heights.skewness", self.skewness, -10, 10, "it must be -10 to 10")
        least = 1 + self.skewness**2
        number_between("heights.kurtosis", self.kurtosis, least, 200, f"it must be {least:.6g}, 1 + Rsk², to 200")
        if self.peak is not None:
            length("heights.peak", self.peak)


def heights_with(moments: FourMoments, count: int) -> Array:
    """Increasing heights of mean 0 with the given moments, whose distribution is as near to the normal one as possible.

    The heights are z(x) at the normal quantiles x = Φ⁻¹((k + ½)/n), with dz/dx = c exp(Σ b_j T_j(x/x_max)) > 0,
    j = 1 ... 6. The coefficients b minimise Σ (j b_j)² under the conditions; normal heights have b = 0.

    Parameters
    ----------
    moments : parameters of the n heights themselves.
    count : n, 32 to 1 000 000.

    Returns
    -------
    Array : shape (n,), m; the moments are met to 1e-8.

    Raises
    ------
    InputError
        If no such b exists, for example for moments of a two-level distribution.

    Examples
    --------
    >>> z = heights_with(FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-1.0, kurtosis=4.4), 512)
    >>> round(1e6 * float(np.abs(z).mean()), 6), round(1e6 * float(z.std()), 6), bool((np.diff(z) > 0).all())
    (0.93, 1.2, True)
    """

    def errors(z: Array) -> Array:
        average, kurtosis = np.abs(z).mean() * moments.rms / moments.average - 1, np.mean(z**4) / moments.kurtosis - 1
        highest = [] if moments.peak is None else [z[-1] * moments.rms / moments.peak - 1]
        return np.array([average, np.mean(z**3) - moments.skewness, kurtosis, *highest])

    z, error = smoothest(count, errors)
    if not error < MOMENT_TOLERANCE:
        highest = "" if moments.peak is None else f", Rp/Rq {moments.peak / moments.rms:.4g}"
        raise InputError(
            f"heights: got Ra/Rq {moments.average / moments.rms:.4g}, Rsk {moments.skewness:.4g}, Rku "
            f"{moments.kurtosis:.4g}{highest}, which no smooth distribution has; normal heights have 0.798, 0, 3"
        )
    return np.asarray(moments.rms * z)


def heights_within(*, average: float, rms: float, peak: float, valley: float, count: int) -> Array:
    """Increasing heights of mean 0 with given Sa, Sq, Sp and Sv, constructed as by :func:`heights_with`.

    Parameters
    ----------
    average, rms : Sa and Sq, m.
    peak, valley : Sp and Sv, m, both above 0.
    count : n, 32 to 1 000 000.

    Returns
    -------
    Array : shape (n,), m; all four parameters are met to 1e-8.

    Raises
    ------
    InputError
        If no such heights exist: Sa > Sq, or extremes too close to the mean.
    """
    length("heights.rms", rms)
    number_between("heights.average", average, 1e-15, rms, "it must be above 0 m and at most the rms")
    length("heights.peak", peak)
    length("heights.valley", valley)

    def errors(z: Array) -> Array:
        return np.array([np.abs(z).mean() * rms / average, z[-1] * rms / peak, -z[0] * rms / valley]) - 1

    z, error = smoothest(count, errors)
    if not error < MOMENT_TOLERANCE:
        raise InputError(
            f"heights: got Sa/Sq {average / rms:.4g}, Sp/Sq {peak / rms:.4g}, Sv/Sq {valley / rms:.4g}, which no "
            f"smooth distribution of {count} heights has; those of {count} normal heights are 0.798 and both "
            f"{scipy.special.ndtri(1 - 0.5 / count):.3g}"
        )
    return np.asarray(rms * z)


def smoothest(count: int, errors: Callable[[Array], Array]) -> tuple[Array, float]:
    """Increasing heights of mean 0 and rms 1 nearest to normal ones under conditions, and the largest error of these.

    Parameters
    ----------
    count : n, 32 to 1 000 000.
    errors : errors of the conditions, shape (conditions,), for heights of shape (n,).

    Returns
    -------
    heights : shape (n,), in units of the rms.
    error : largest absolute error; infinite if the heights do not increase.
    """
    whole_between("heights.count", count, MIN_COUNT, MAX_COUNT)
    x = scipy.special.ndtri((np.arange(count) + 0.5) / count)
    departures = chebyshev.chebvander((x[1:] + x[:-1]) / (2 * x[-1]), POLYNOMIAL_ORDER)[:, 1:]
    weights = np.arange(1.0, POLYNOMIAL_ORDER + 1) ** 2

    def scaled(b: Array) -> Array:
        growth = departures @ b
        z = np.concatenate([[0.0], np.cumsum(np.diff(x) * np.exp(growth - growth.max()))])
        z -= z.mean()
        return np.asarray(z / z.std())

    coefficients = scipy.optimize.minimize(
        lambda b: float(weights @ b**2),
        np.zeros(POLYNOMIAL_ORDER),
        jac=lambda b: 2 * weights * b,
        constraints={"type": "eq", "fun": lambda b: errors(scaled(b))},
        method="SLSQP",
        options={"maxiter": 500, "ftol": 1e-12},
    ).x
    z = scaled(coefficients)
    return z, float(np.abs(errors(z)).max()) if (np.diff(z) > 0).all() else np.inf
