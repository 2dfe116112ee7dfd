"""Surfaces with a prescribed height distribution and, as nearly as possible, a given spectrum."""

from collections.abc import Callable

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, Surface
from roughfilm.contact.synthetic.checks import number_between, whole_between

MAX_SKEWNESS = 4.0
"""Largest absolute value of the skewness."""

EXPANSION_SKEWNESS = 3e-3
"""Skewness below which Pearson's quantiles are expanded, to 1e-8; there P⁻¹ is accurate to 1e-3 only."""

MIN_IMPROVEMENT = 0.01
"""Relative decrease of the spectral error below which the iteration stops."""


def with_heights_of(surface: Surface, quantile: Callable[[Array], Array], *, iterations: int = 100) -> Surface:
    """A surface whose sorted heights are quantile((k + 1/2)/n), with nearly the given spectrum.

    The index k runs from 0 to n - 1. Each iteration sets the amplitudes of the waves to those of the given surface,
    keeping their phases, then replaces the heights, rank by rank, by the quantiles. It stops when the spectral error
    falls by less than 1 %.

    Parameters
    ----------
    surface : periodic, without invalid pixels, not flat.
    quantile : increasing function from probabilities between 0 and 1 to heights, m, of the same shape.
    iterations : largest number of iterations, 0 to 10 000; 0 only replaces the heights.

    Returns
    -------
    Surface : ``source["distribution"]`` holds Ssk and Sku of the heights, the spectral error
        sqrt(Σ(|a'| - |a|)²/Σ|a|²) over all waves, and the number of iterations.

    Raises
    ------
    InputError
        If the surface is not periodic, has invalid pixels or is flat, or the quantiles are not finite, are all equal or
        decrease.

    Notes
    -----
    Spectrum and distribution cannot always be met together, especially with few waves; the spectral error measures it.
    Ranks depend on all pixels, so that a finer grid gives a slightly different surface.

    Source: Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635, doi:10.1103/PhysRevLett.77.635.
    """
    if not surface.periodic or surface.invalid.any():
        fault = "invalid pixels" if surface.periodic else "a surface that is not periodic"
        raise InputError(f"distribution: got {fault}; give a whole, periodic surface")
    if not surface.heights.std() > 0:
        raise InputError("distribution: got a flat surface; its heights have no order to keep")
    whole_between("distribution.iterations", iterations, 0, 10_000)
    count = surface.heights.size
    wanted = np.asarray(quantile((np.arange(count) + 0.5) / count), dtype=float)
    if wanted.shape != (count,) or not (np.abs(wanted) <= MAX_LENGTH).all() or (np.diff(wanted) < 0).any():
        raise InputError("distribution: got quantiles that are not finite or decrease; give a growing function")
    if wanted[0] == wanted[-1] or not wanted.std() > 0:
        raise InputError("distribution: got quantiles that are all equal; give a growing function")
    amplitudes = np.abs(scipy.fft.rfft2(surface.heights))
    heights = ranked(surface.heights, wanted)
    waves, error = _compared(heights, amplitudes)
    done, improved = 0, True
    while improved and done < iterations:
        moduli = np.abs(waves)
        rescaled = np.divide(waves, moduli, out=np.zeros_like(waves), where=moduli > 0) * amplitudes
        candidate = ranked(scipy.fft.irfft2(rescaled, s=surface.shape), wanted)
        waves, next_error = _compared(candidate, amplitudes)
        improved = next_error < error * (1 - MIN_IMPROVEMENT)
        if next_error < error:
            heights, error = candidate, next_error
        done += 1
    scaled = (wanted - wanted.mean()) / wanted.std()
    results = {
        "skewness": float(np.mean(scaled**3)),
        "kurtosis": float(np.mean(scaled**4)),
        "spectral_error": error,
        "iterations": done,
    }
    return surface.with_heights(heights, source={**surface.source, "distribution": results})


def with_skewness(surface: Surface, skewness: float, *, iterations: int = 100) -> Surface:
    """A surface with the given skewness, the same mean and rms height and nearly the same spectrum.

    Heights follow Pearson's distribution of type III, a shifted gamma distribution with Sku = 3 + 3/2 Ssk². It is
    bounded below for Ssk > 0 and above for Ssk < 0, at 2/|Ssk| rms heights from the mean.

    Parameters
    ----------
    surface : periodic, without invalid pixels, not flat.
    skewness : Ssk, -4 to 4; met within 1 % for 10 000 points and more. ``source["distribution"]`` holds the achieved
        value.
    iterations : largest number of iterations, as in ``with_heights_of``.

    Raises
    ------
    InputError
        If the skewness is out of range; otherwise as ``with_heights_of``.
    """
    number_between("distribution.skewness", skewness, -MAX_SKEWNESS, MAX_SKEWNESS, "it must be -4 to 4")

    def quantile(probability: Array) -> Array:
        shape = pearson_quantile(probability, skewness)
        return np.asarray(surface.heights.mean() + surface.heights.std() * (shape - shape.mean()) / shape.std())

    return with_heights_of(surface, quantile, iterations=iterations)


def pearson_quantile(probability: Array, skewness: float) -> Array:
    """Quantiles of Pearson's type III distribution with mean 0 and rms 1, at probabilities p of any shape.

    They are (P⁻¹(a, p) - a)/sqrt(a) with a = 4/Ssk², mirrored for Ssk < 0; P is the regularised lower incomplete gamma
    function and 0 < p < 1.
    """
    if abs(skewness) < EXPANSION_SKEWNESS:
        normal = scipy.special.ndtri(probability)
        return np.asarray(normal + (normal**2 - 1) * skewness / 6 + (normal**3 - 7 * normal) * skewness**2 / 144)
    shape = 4 / skewness**2
    inverse = scipy.special.gammaincinv if skewness > 0 else scipy.special.gammainccinv
    return np.asarray(np.sign(skewness) * (inverse(shape, probability) - shape) / np.sqrt(shape))


def rms_slope(surface: Surface) -> float:
    """The rms slope sqrt(<|∇h|²>) = sqrt(Σ q² |a|²) of a periodic surface, over all waves of its grid."""
    power = _weights(surface.shape) * np.abs(scipy.fft.rfft2(surface.heights, norm="forward")) ** 2
    qx = 2 * np.pi * scipy.fft.fftfreq(surface.shape[0], surface.spacing[0])[:, None]
    qy = 2 * np.pi * scipy.fft.rfftfreq(surface.shape[1], surface.spacing[1])[None, :]
    return float(np.sqrt(np.sum((qx**2 + qy**2) * power)))


def ranked(heights: Array, wanted: Array) -> Array:
    """Sorted heights ``wanted``, shape (n,), placed in the rank order of ``heights``; ties in the order of points."""
    result = np.empty(heights.size)
    result[np.argsort(heights, axis=None, kind="stable")] = wanted
    return result.reshape(heights.shape)


def _compared(heights: Array, amplitudes: Array) -> tuple[NDArray[np.complex128], float]:
    """The waves of heights, and the relative deviation of their amplitudes from others, without the mean."""
    waves = scipy.fft.rfft2(heights)
    weights = _weights(heights.shape)
    off = weights * (np.abs(waves) - amplitudes) ** 2
    total = weights * amplitudes**2
    return waves, float(np.sqrt((off.sum() - off[0, 0]) / (total.sum() - total[0, 0])))


def _weights(shape: tuple[int, ...]) -> Array:
    """Multiplicity of each column of a real transform: 2 where the conjugate column is left out, else 1."""
    weights = np.full(shape[1] // 2 + 1, 2.0)
    weights[0] = 1.0
    if shape[1] % 2 == 0:
        weights[-1] = 1.0
    return weights
