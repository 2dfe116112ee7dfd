"""Heights whose mean distance, rms, skewness and kurtosis, or highest and lowest, are all given."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Array
from roughfilm.contact.synthetic.checks import length, number_between, whole_between

ORDER = 6
"""Of the polynomial by which the distribution departs from the normal one: up to four conditions, and room."""

FEWEST, MOST = 32, 1_000_000
CLOSE = 1e-8
"""How near the conditions have to be met, relatively (skewness: absolutely)."""


@dataclass(frozen=True, kw_only=True)
class FourMoments:
    """What heights are asked to be like; of a profile Ra, Rq, Rsk, Rku, of a surface Sa, Sq, Ssk, Sku.

    Attributes
    ----------
    average : Ra, m, mean distance from the mean.
    rms : Rq, m.
    skewness : Rsk.
    kurtosis : Rku, 3 for normal heights.
    peak : Rp, m, from the mean to the highest; where it is not given, what the others make of it.

    Raises
    ------
    InputError
        If no heights have them: Ra > Rq, or Rku < 1 + Rsk².
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
    """Growing heights with a mean of 0 that have the four moments, as smoothly spread as these allow.

    They are z(x) at the normal quantiles x = Φ⁻¹((k + ½)/n), with dz/dx = c exp(Σ b_j T_j(x/x_max)), j = 1 ... 6, which
    is above 0 whatever the b_j, so that z has a density. Of all b that give the moments it has the least Σ (j b_j)²;
    normal heights have b = 0.

    Parameters
    ----------
    moments : that the n heights themselves have, not only the distribution they come from.
    count : n, 32 to 1 000 000.

    Returns
    -------
    Shape (n,), m; moments are met to 1e-8.

    Raises
    ------
    InputError
        If no such b is found: the moments do not go together, as those of heights of two levels.

    Examples
    --------
    >>> z = heights_with(FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-1.0, kurtosis=4.4), 512)
    >>> round(1e6 * float(np.abs(z).mean()), 6), round(1e6 * float(z.std()), 6), bool((np.diff(z) > 0).all())
    (0.93, 1.2, True)
    """

    def missed(z: Array) -> Array:
        found = np.abs(z).mean() * moments.rms / moments.average - 1, np.mean(z**4) / moments.kurtosis - 1
        highest = [] if moments.peak is None else [z[-1] * moments.rms / moments.peak - 1]
        return np.array([found[0], np.mean(z**3) - moments.skewness, found[1], *highest])

    z, off = smoothest(count, missed)
    if not off < CLOSE:
        highest = "" if moments.peak is None else f", Rp/Rq {moments.peak / moments.rms:.4g}"
        raise InputError(
            f"heights: got Ra/Rq {moments.average / moments.rms:.4g}, Rsk {moments.skewness:.4g}, Rku "
            f"{moments.kurtosis:.4g}{highest}, which no smooth distribution was found for; normal ones have 0.798, 0, 3"
        )
    return np.asarray(moments.rms * z)


def heights_within(*, average: float, rms: float, peak: float, valley: float, count: int) -> Array:
    """Growing heights with a mean of 0 that have Sa, Sq, Sp and Sv, as smoothly spread as these allow.

    Parameters
    ----------
    average, rms : Sa and Sq, m.
    peak, valley : Sp and Sv, from the mean to the highest and to the lowest, m, both above 0.
    count : n, 32 to 1 000 000.

    Returns
    -------
    Shape (n,), m, as :func:`heights_with` makes them; all four are met to 1e-8.

    Raises
    ------
    InputError
        If no such heights are found: Sa > Sq, or a height between two levels that are too near.
    """
    length("heights.rms", rms)
    number_between("heights.average", average, 1e-15, rms, "it must be above 0 m and at most the rms")
    length("heights.peak", peak)
    length("heights.valley", valley)

    def missed(z: Array) -> Array:
        return np.array([np.abs(z).mean() * rms / average, z[-1] * rms / peak, -z[0] * rms / valley]) - 1

    z, off = smoothest(count, missed)
    if not off < CLOSE:
        raise InputError(
            f"heights: got Sa/Sq {average / rms:.4g}, Sp/Sq {peak / rms:.4g}, Sv/Sq {valley / rms:.4g}, which no "
            f"smooth distribution of {count} heights was found for; those of {count} normal ones are 0.798 and both "
            f"{scipy.special.ndtri(1 - 0.5 / count):.3g}"
        )
    return np.asarray(rms * z)


def smoothest(count: int, missed: Callable[[Array], Array]) -> tuple[Array, float]:
    """Growing heights of mean 0 and rms 1 that are nearest to normal ones, and by how much they miss what is asked.

    Parameters
    ----------
    count : n, 32 to 1 000 000.
    missed : of heights, shape (n,): by how much they miss each condition; infinite where they do not grow.
    """
    whole_between("heights.count", count, FEWEST, MOST)
    x = scipy.special.ndtri((np.arange(count) + 0.5) / count)
    departures = chebyshev.chebvander((x[1:] + x[:-1]) / (2 * x[-1]), ORDER)[:, 1:]
    weights = np.arange(1.0, ORDER + 1) ** 2

    def scaled(b: Array) -> Array:
        growth = departures @ b
        z = np.concatenate([[0.0], np.cumsum(np.diff(x) * np.exp(growth - growth.max()))])
        z -= z.mean()
        return np.asarray(z / z.std())

    found = scipy.optimize.minimize(
        lambda b: float(weights @ b**2),
        np.zeros(ORDER),
        jac=lambda b: 2 * weights * b,
        constraints={"type": "eq", "fun": lambda b: missed(scaled(b))},
        method="SLSQP",
        options={"maxiter": 500, "ftol": 1e-12},
    ).x
    z = scaled(found)
    return z, float(np.abs(missed(z)).max()) if (np.diff(z) > 0).all() else np.inf
