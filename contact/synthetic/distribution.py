"""Another distribution of heights for a surface whose spectrum is kept as far as it can be."""

from collections.abc import Callable

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import LARGEST_LENGTH, Array, Surface
from roughfilm.contact.synthetic.checks import number_between, whole_between

LARGEST_SKEWNESS = 4.0
NEARLY_GAUSSIAN = 3e-3
"""A skewness below which Pearson's quantiles are expanded in it, to 1e-8: there P⁻¹ is good to 1e-3 only."""

IMPROVEMENT = 0.01
"""A relative decrease of the spectral error below which the iteration stops."""


def with_heights_of(surface: Surface, quantile: Callable[[Array], Array], *, iterations: int = 100) -> Surface:
    """A surface whose sorted heights are exactly quantile((k + 1/2)/n), k = 0 ... n - 1, and whose spectrum is near.

    By turns the waves get the amplitudes of the given surface, keeping their phases, and the heights are replaced, rank
    by rank, by the quantiles; the latter comes last. It ends when a turn brings the spectrum less than 1 % nearer.

    Parameters
    ----------
    surface : periodic, without invalid pixels, not flat.
    quantile : heights, m, of cumulated probabilities between 0 and 1; shape to shape, growing.
    iterations : at most so many turns, up to 10 000; 0 only replaces the heights.

    Returns
    -------
    The surface; ``source["distribution"]`` tells Ssk and Sku of the heights, the spectral error
    sqrt(Σ(|a'| - |a|)²/Σ|a|²) over all waves, and how many turns were taken.

    Raises
    ------
    InputError
        If the surface is not periodic, not whole or flat, or the quantiles are not finite, equal, or decrease.

    Notes
    -----
    Not every pair of spectrum and distribution exists, least where few waves make the surface: look at the spectral
    error. The ranks of pixels depend on all of them, so that a finer grid does not hold quite the same surface.

    Source: Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635, doi:10.1103/PhysRevLett.77.635.
    """
    if not surface.periodic or surface.invalid.any():
        found = "invalid pixels" if surface.periodic else "a surface that is not periodic"
        raise InputError(f"distribution: got {found}; give a whole, periodic surface")
    if not surface.heights.std() > 0:
        raise InputError("distribution: got a flat surface; its heights have no order to keep")
    whole_between("distribution.iterations", iterations, 0, 10_000)
    count = surface.heights.size
    wanted = np.asarray(quantile((np.arange(count) + 0.5) / count), dtype=float)
    if wanted.shape != (count,) or not (np.abs(wanted) <= LARGEST_LENGTH).all() or (np.diff(wanted) < 0).any():
        raise InputError("distribution: got quantiles that are not finite or decrease; give a growing function")
    if wanted[0] == wanted[-1] or not wanted.std() > 0:
        raise InputError("distribution: got quantiles that are all equal; give a growing function")
    amplitudes = np.abs(scipy.fft.rfft2(surface.heights))
    heights = _ranked(surface.heights, wanted)
    waves, error = _compared(heights, amplitudes)
    turns, bettered = 0, True
    while bettered and turns < iterations:
        lengths = np.abs(waves)
        turned = np.divide(waves, lengths, out=np.zeros_like(waves), where=lengths > 0) * amplitudes
        nearer = _ranked(scipy.fft.irfft2(turned, s=surface.shape), wanted)
        waves, next_error = _compared(nearer, amplitudes)
        bettered = next_error < error * (1 - IMPROVEMENT)
        if next_error < error:
            heights, error = nearer, next_error
        turns += 1
    scaled = (wanted - wanted.mean()) / wanted.std()
    told = {
        "skewness": float(np.mean(scaled**3)),
        "kurtosis": float(np.mean(scaled**4)),
        "spectral_error": error,
        "iterations": turns,
    }
    return surface.with_heights(heights, source={**surface.source, "distribution": told})


def with_skewness(surface: Surface, skewness: float, *, iterations: int = 100) -> Surface:
    """A surface with the same mean, rms height and, nearly, spectrum, whose Ssk is the one given.

    Heights follow Pearson's distribution of type III, a shifted gamma distribution, for which Sku = 3 + 3/2 Ssk²:
    bounded below for Ssk > 0, above for Ssk < 0, at 2/|Ssk| rms heights from the mean.

    Parameters
    ----------
    surface : periodic, without invalid pixels, not flat.
    skewness : Ssk, -4 to 4; met within 1 % from 10 000 points on, where the last of the n quantiles ends the tail. What
        came of it is in ``source["distribution"]``.
    iterations : as in ``with_heights_of``.

    Raises
    ------
    InputError
        If the skewness is beyond its range; else as ``with_heights_of``.
    """
    number_between("distribution.skewness", skewness, -LARGEST_SKEWNESS, LARGEST_SKEWNESS, "it must be -4 to 4")

    def quantile(probability: Array) -> Array:
        shape = pearson_quantile(probability, skewness)
        scaled: Array = surface.heights.mean() + surface.heights.std() * (shape - shape.mean()) / shape.std()
        return scaled

    return with_heights_of(surface, quantile, iterations=iterations)


def pearson_quantile(probability: Array, skewness: float) -> Array:
    """Quantiles of Pearson's type III of mean 0, rms 1: (P⁻¹(a, p) - a)/sqrt(a), a = 4/Ssk², mirrored for Ssk < 0.

    P is the regularised lower incomplete gamma function; ``probability`` lies between 0 and 1.
    """
    if abs(skewness) < NEARLY_GAUSSIAN:
        normal = scipy.special.ndtri(probability)
        return np.asarray(normal + (normal**2 - 1) * skewness / 6 + (normal**3 - 7 * normal) * skewness**2 / 144)
    shape = 4 / skewness**2
    inverse = scipy.special.gammaincinv if skewness > 0 else scipy.special.gammainccinv
    return np.asarray(np.sign(skewness) * (inverse(shape, probability) - shape) / np.sqrt(shape))


def rms_slope(surface: Surface) -> float:
    """sqrt(<|∇h|²>) = sqrt(Σ q² |a|²) of the waves through a periodic surface, down to those of two pixels."""
    power = _weights(surface.shape) * np.abs(scipy.fft.rfft2(surface.heights, norm="forward")) ** 2
    qx = 2 * np.pi * scipy.fft.fftfreq(surface.shape[0], surface.spacing[0])[:, None]
    qy = 2 * np.pi * scipy.fft.rfftfreq(surface.shape[1], surface.spacing[1])[None, :]
    return float(np.sqrt(np.sum((qx**2 + qy**2) * power)))


def _ranked(heights: Array, wanted: Array) -> Array:
    """The wanted heights, sorted, in the order of others; ties in the order of pixels."""
    ranked = np.empty(heights.size)
    ranked[np.argsort(heights, axis=None, kind="stable")] = wanted
    return ranked.reshape(heights.shape)


def _compared(heights: Array, amplitudes: Array) -> tuple[NDArray[np.complex128], float]:
    """The waves of heights and how far their amplitudes are from others; the mean is none of them."""
    waves = scipy.fft.rfft2(heights)
    weights = _weights(heights.shape)
    off = weights * (np.abs(waves) - amplitudes) ** 2
    total = weights * amplitudes**2
    return waves, float(np.sqrt((off.sum() - off[0, 0]) / (total.sum() - total[0, 0])))


def _weights(shape: tuple[int, ...]) -> Array:
    """How often each column of a real transform counts: twice where its mirror image is left out."""
    weights = np.full(shape[1] // 2 + 1, 2.0)
    weights[0] = 1.0
    if shape[1] % 2 == 0:
        weights[-1] = 1.0
    return weights
