"""An estimate of the scatter between windows from the autocorrelation and the heights of a single one."""

import math

import numpy as np
import scipy

from roughfilm.contact.parameters.autocorrelation import DECAY_THRESHOLD, autocorrelation
from roughfilm.contact.surfaces.surface import Surface

MAX_SKEWNESS = 1.0
"""Largest size of the skewness with an estimate; beyond it, the scatter is that of rare valleys or peaks."""

MAX_SCATTER = 0.2
"""Largest scatter that is estimated to a factor of two; beyond it, the window does not contain the longest waves."""


def rms_height_scatter(surface: Surface) -> float | None:
    """The relative standard deviation of Sq between windows of the size of this one, to a factor of two.

    The variance of the mean square of heights with the autocorrelation r over an area A gives
    σ(Sq)/Sq = √((Sku − 1) ∫r² / A)/2, with the integral over the central lobe, where r exceeds 0.2, and the kurtosis
    Sku of the window. For Gaussian heights Sku is 3, and the result 1/√(2 N) with N = A/∫r² independent patches. For
    periodic grooves, which are not independent, it is an upper bound.

    Parameters
    ----------
    surface : one window or periodic cell, without invalid points.

    Returns
    -------
    float or None : above ``MAX_SCATTER`` a lower bound; None if the heights are all the same or their skewness exceeds
        ``MAX_SKEWNESS``.

    References
    ----------
    J. S. Bendat, A. G. Piersol, Random data, 4th ed., Wiley 2010, section 8.2.2 (variance of a mean square).

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> noise = Surface(heights=rng.standard_normal((32, 32)), spacing=(1.0, 1.0))
    >>> round(rms_height_scatter(noise) * math.sqrt(2 * 32 * 32), 1)
    1.0
    """
    z = surface.heights - surface.heights.mean()
    variance = float(np.mean(z**2))
    if np.ptp(surface.heights) == 0 or abs(float(np.mean(z**3))) > MAX_SKEWNESS * variance**1.5:
        return None
    r = autocorrelation(surface)
    labels, _ = scipy.ndimage.label(r > DECAY_THRESHOLD)
    lobe = r[labels == labels[r.shape[0] // 2, r.shape[1] // 2]]
    kurtosis = float(np.mean(z**4)) / variance**2
    return 0.5 * math.sqrt((kurtosis - 1) * float(np.sum(lobe**2)) / z.size)
