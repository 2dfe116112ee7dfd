"""Step 4 of the preparation: the S-filter removes short waves, the L-filter removes long ones (ISO 25178-3)."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface

ALPHA_SQUARED = np.log(2) / np.pi
"""α² of ISO 16610-61, with which a wave of the length of the nesting index keeps half of its amplitude."""

TRUNCATION = 1.6
"""Distance, in nesting indices, at which the weights are truncated: the sum of those beyond is below 1e-16."""

MIN_S_PIXELS = 3.0
"""Smallest nesting index of an S-filter, pixels, that ISO 25178-3 admits for optical instruments."""


def s_filter(surface: Surface, index: float) -> Surface:
    """Remove the waves that are shorter than the nesting index: the weighted mean of the heights around each point.

    z'(x, y) = Σ s v z / Σ s v over all points, with v = 1 where a point is valid, otherwise 0, and the areal Gaussian
    weights s(r) = exp(-π r²/(α λ)²)/(α λ)², α² = ln 2/π, where r is the distance from (x, y) and λ the nesting index. A
    wave of wavelength L in any direction keeps the fraction exp(-π (α λ/L)²) of its amplitude: half of it at L = λ.

    Parameters
    ----------
    surface : heights, m; pixels need not be square. Invalid points have no weight and stay invalid.
    index : nesting index λ, m, from the larger pixel spacing to the shorter side.

    Returns
    -------
    Surface : the weighted mean. Holes and edges cause no offset: a constant height stays, to rounding.

    Raises
    ------
    InputError
        If the nesting index is out of range.

    Notes
    -----
    Near the sides of a surface that is not periodic, and near holes, the weights of the missing points are left out and
    the others divided by their sum (retention of the moment of order zero, ISO 16610-28). There the transmission
    differs from the equation within about λ/2, and a slope is not kept exactly. The weights are truncated at 1.6 λ,
    beyond which they sum to less than 1e-16. A periodic surface without invalid points is filtered exactly, by the
    transmission of each of its Fourier components.

    References
    ----------
    ISO 16610-61:2015 (areal Gaussian filter); ISO 16610-28:2016 (end effects); ISO 25178-3:2012 (nesting indices).

    Examples
    --------
    >>> wave = 1e-6 * np.cos(2 * np.pi * np.arange(40) / 40)
    >>> surface = Surface(heights=np.tile(wave, (20, 1)), spacing=(1e-6, 1e-6), periodic=True)
    >>> round(float(np.ptp(s_filter(surface, 20e-6).heights) / np.ptp(surface.heights)), 6)  # 2 ** -0.25
    0.840896
    """
    if index > min(surface.size) * (1 + 1e-9):
        raise InputError(
            f"s_filter: got a nesting index of {index:.4g} m, longer than the shorter side of the surface, "
            f"{min(surface.size):.4g} m; give one from {max(surface.spacing):.4g} m to that side"
        )
    return surface.with_heights(np.where(surface.invalid, 0.0, _mean_heights(surface, index, "s_filter")))


def l_filter(surface: Surface, index: float) -> Surface:
    """Remove the waves that are longer than the nesting index: the heights minus their weighted mean.

    z'(x, y) = z − Σ s v z / Σ s v with the weights of :func:`s_filter`: a wave of wavelength L keeps the fraction
    1 − exp(-π (α λ/L)²) of its amplitude.

    Parameters
    ----------
    surface : heights, m. Invalid points have no weight and stay invalid.
    index : nesting index λ, m, at least the larger pixel spacing.

    Raises
    ------
    InputError
        If the nesting index is out of range.

    References
    ----------
    ISO 16610-61:2015; ISO 16610-28:2016; ISO 25178-3:2012.
    """
    mean = _mean_heights(surface, index, "l_filter")
    return surface.with_heights(np.where(surface.invalid, 0.0, surface.heights - mean))


def mean_line(heights: Array, length: float) -> Array:
    """The weighted mean of the heights of a profile around each point, of the nesting index in pixels.

    The Gaussian weights are those of :func:`s_filter` along one line (ISO 16610-21); beyond the ends they are left out.

    Parameters
    ----------
    heights : shape (n,), m.
    length : nesting index over the distance of the points, 1 or more.
    """
    kernel, level = _truncated(heights.size, length), heights.mean()
    return np.asarray(level + _along(heights - level, kernel) / _along(np.ones(heights.size), kernel))


def nesting_warnings(surface: Surface, s_index: float | None, l_index: float | None) -> tuple[str, ...]:
    """The warnings about nesting indices, m, that the pixels or the side of a surface do not support."""
    warnings = []
    spacing, side = max(surface.spacing), min(surface.size)
    if s_index is not None and s_index < MIN_S_PIXELS * spacing * (1 - 1e-9):
        warnings.append(
            f"s_filter: the nesting index {s_index * 1e6:.4g} µm is below {MIN_S_PIXELS:.0f} pixels, "
            f"{MIN_S_PIXELS * spacing * 1e6:.4g} µm, the least of ISO 25178-3 for optical instruments (5 pixels for "
            "stylus instruments); the pixels limit the short waves, not the filter; take a larger one"
        )
    if l_index is not None and l_index > side * (1 + 1e-9):
        warnings.append(
            f"l_filter: the nesting index {l_index * 1e6:.4g} µm is above the shorter side of the measurement, "
            f"{side * 1e6:.4g} µm, which contains no such wave; take a smaller one, or leave the filter out"
        )
    return tuple(warnings)


def _mean_heights(surface: Surface, index: float, step: str) -> Array:
    """The weighted mean of the valid heights around each point, shape (nx, ny), m."""
    spacing = max(surface.spacing)
    if not index >= spacing * (1 - 1e-9):
        raise InputError(
            f"{step}: got a nesting index of {index:.4g} m, shorter than the pixel spacing of {spacing:.4g} m; give "
            f"{MIN_S_PIXELS:.0f} pixels and more"
        )
    lengths = [index / step for step in surface.spacing]
    valid = surface.valid.astype(np.float64)
    level = float(surface.heights[surface.valid].mean())
    heights = np.where(surface.invalid, 0.0, surface.heights - level)
    if surface.periodic:
        kernels = [_periodic(count, length) for count, length in zip(surface.shape, lengths, strict=True)]
    else:
        kernels = [_truncated(count, length) for count, length in zip(surface.shape, lengths, strict=True)]
    sums = _convolved(heights, kernels)
    if surface.invalid.any():
        weights = _convolved(valid, kernels)
    else:
        along_x, along_y = (
            _along(np.ones(count), kernel) for count, kernel in zip(surface.shape, kernels, strict=True)
        )
        weights = np.outer(along_x, along_y)
    mean: Array = level + sums / np.where(surface.invalid, 1.0, weights)
    return mean


def _periodic(count: int, length: float) -> Array:
    """Transmission of the waves of a periodic line of ``count`` points; the nesting index is in pixels."""
    return np.asarray(np.exp(-np.pi * ALPHA_SQUARED * (length * np.fft.fftfreq(count)) ** 2))


def _truncated(count: int, length: float) -> Array:
    """Discrete Fourier transform of the weights, padded so that they do not reach around a line of ``count`` points."""
    reach = min(int(np.ceil(TRUNCATION * length)), count - 1)
    padded = scipy.fft.next_fast_len(count + reach)
    distance = np.arange(reach + 1)
    half = np.exp(-np.pi * distance**2 / (ALPHA_SQUARED * length**2))
    weights = np.zeros(padded)
    weights[: reach + 1] = half
    weights[padded - reach :] = half[:0:-1]
    return np.asarray(scipy.fft.fft(weights / (2 * half.sum() - half[0])).real)


def _convolved(field: Array, kernels: list[Array]) -> Array:
    """A field, 0 outside of its points, convolved with weights whose transforms along x and y are given."""
    (px, py), (nx, ny) = (kernel.size for kernel in kernels), field.shape
    waves = scipy.fft.rfft(field, n=py, axis=1)
    waves *= kernels[1][: py // 2 + 1]
    lines = scipy.fft.irfft(waves, n=py, axis=1)[:, :ny]
    waves = scipy.fft.rfft(lines, n=px, axis=0)
    waves *= kernels[0][: px // 2 + 1, None]
    return np.asarray(scipy.fft.irfft(waves, n=px, axis=0)[:nx])


def _along(line: Array, kernel: Array) -> Array:
    return np.asarray(
        scipy.fft.irfft(scipy.fft.rfft(line, n=kernel.size) * kernel[: kernel.size // 2 + 1], n=kernel.size)[
            : line.size
        ]
    )
