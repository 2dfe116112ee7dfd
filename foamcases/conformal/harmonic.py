"""Periodic harmonic functions in a rectangle from their values on its lower and upper side."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array

SAMPLES_PER_LAYER = 4
"""Number of samples along the sides over that of squares of one layer's thickness, if it is below ``MAX_SAMPLES``."""

MIN_SAMPLES, MAX_SAMPLES = 1024, 2**17

STENCIL = np.arange(-2, 4)
"""Samples between which a polynomial of fifth degree interpolates, relative to the sample before the place."""


def samples(height: float, layers: int) -> Array:
    """The places 0 <= ξ < 1 at which the sides are sampled: a power of two of them, evenly spaced."""
    asked = min(max(SAMPLES_PER_LAYER * layers / height, MIN_SAMPLES), MAX_SAMPLES)
    count = 2 ** int(np.ceil(np.log2(asked)))
    return np.asarray(np.arange(count) / count)


def fill(lower: Array, upper: Array, height: float, xi: Array, eta: Array) -> Array:
    """The harmonic function of (ξ, η) with period 1 in ξ that has the given values on both sides of the rectangle.

    Each Fourier coefficient c(k) of a side decays into the rectangle of height H = ``height`` as

        c(k) sinh(2π k H (1 - η)) / sinh(2π k H),   linearly for k = 0.

    Parameters
    ----------
    lower, upper : values at :func:`samples` on the sides η = 0 and η = 1.
    height : height H of the rectangle over its length.
    xi, eta : coordinates of the columns and layers, from 0 to 1.

    Returns
    -------
    Array
        The values, shape (columns, layers).
    """
    decay: Array = np.asarray(2 * np.pi * height * np.arange(lower.size // 2 + 1))
    waves = np.fft.rfft([lower, upper])
    series = _decayed(decay, eta) * waves[0] + _decayed(decay, 1 - eta) * waves[1]
    return _between(np.fft.irfft(series, lower.size), xi).T


def _decayed(decay: Array, distance: Array) -> Array:
    """sinh(d (1 - a)) / sinh(d) of decays d, (modes,), at distances a, (layers,), without overflow; (layers, modes)."""
    a, d = distance[:, None], decay[1:]
    waves = np.exp(-d * a) * np.expm1(-2 * d * (1 - a)) / np.expm1(-2 * d)
    return np.concatenate([1 - a, waves], axis=1)


def _between(values: Array, xi: Array) -> Array:
    """Periodic samples, (layers, samples), interpolated at ξ; shape (layers, columns)."""
    count = values.shape[1]
    place = xi * count
    before = np.floor(place).astype(np.int64)
    ahead = place - before
    found = np.zeros((values.shape[0], xi.size))
    for node in STENCIL:
        others = np.setdiff1d(STENCIL, node)
        weight = np.prod((ahead - others[:, None]) / (node - others)[:, None], axis=0)
        found += weight * values[:, (before + node) % count]
    return found
