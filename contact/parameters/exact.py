"""Closed forms of roughness parameters: for Gaussian heights, sinusoids and simple autocorrelations."""

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.autocorrelation import DECAY_THRESHOLD
from roughfilm.contact.parameters.bearing_curve import CORE_WINDOW, Core
from roughfilm.contact.parameters.heights import HeightStatistics


def gaussian_average(rms: float) -> float:
    """Sa of Gaussian heights, Sq √(2/π), m."""
    return rms * math.sqrt(2 / math.pi)


def gaussian_bearing_curve(ratio: ArrayLike, rms: float) -> Array:
    """Bearing curve of Gaussian heights, −Sq Φ⁻¹(m), m, at the material ratios m, 0 to 1, of any shape."""
    height: Array = -rms * scipy.special.ndtri(np.asarray(ratio, dtype=np.float64))
    return height


def gaussian_core(rms: float) -> Core:
    """Core parameters of Gaussian heights with mean 0 and root mean square Sq = ``rms``, m.

    The flattest window is the middle one, |z| < a Sq with Φ(a) = 0.7 for the width w = 0.4. The line fitted to it has
    Sk = Sq (12/w³) (erf(a)/(2√π) − w φ(a)) = 2.57396 Sq. (Its secant would give 2a/w = 2.622 Sq, 1.9 % more.)
    The fraction Q = 1 − Φ(u/Sq) lies above u = Sk/2, on average by φ(u/Sq) Sq/Q − u, and Spk is twice this average.

    Examples
    --------
    >>> core = gaussian_core(1.0)
    >>> round(core.height, 5), round(core.peak_ratio, 5)
    (2.57396, 0.09905)
    """
    w = CORE_WINDOW
    a = float(scipy.special.ndtri((1 + w) / 2))
    upper = 6 / w**3 * (math.erf(a) / (2 * math.sqrt(math.pi)) - w * _normal(a))
    part = float(scipy.special.ndtr(-upper))
    peak = 2 * (_normal(upper) / part - upper)
    return Core(
        upper=upper * rms,
        lower=-upper * rms,
        peak=peak * rms,
        valley=peak * rms,
        peak_ratio=part,
        valley_ratio=1 - part,
    )


def gaussian_material_volume(ratio: float, rms: float) -> float:
    """Material volume Vm(p) of Gaussian heights, Sq (φ(u) − u p) with the height u = Φ⁻¹(1 − p) over Sq, m³/m²."""
    u = -float(scipy.special.ndtri(ratio))
    return rms * (_normal(u) - u * ratio)


def gaussian_void_volume(ratio: float, rms: float) -> float:
    """Void volume Vv(p) of Gaussian heights, the material volume Vm(1 − p) of the inverted surface, m³/m²."""
    return gaussian_material_volume(1 - ratio, rms)


def sinusoid_material_volume(ratio: float, amplitude: float) -> float:
    """Material volume Vm(p) of a sinusoid with the amplitude A, A (sin(πp)/π − p cos(πp)), m³/m²."""
    return amplitude * (math.sin(math.pi * ratio) / math.pi - ratio * math.cos(math.pi * ratio))


def sinusoid_void_volume(ratio: float, amplitude: float) -> float:
    """Void volume Vv(p) of a sinusoid, the material volume Vm(1 − p) of the inverted surface, m³/m²."""
    return sinusoid_material_volume(1 - ratio, amplitude)


def summit_density(second_moment: float, fourth_moment: float) -> float:
    """Density of all local maxima of an isotropic Gaussian surface, m4/(6π√3 m2), 1/m².

    Parameters
    ----------
    second_moment : m2, the mean square slope along a line.
    fourth_moment : m4, the mean square second derivative along a line, 1/m².

    References
    ----------
    P. R. Nayak, Random process model of rough surfaces, J. Lubr. Technol. 93 (1971) 398, doi:10.1115/1.3451608.
    """
    return fourth_moment / (6 * math.pi * math.sqrt(3) * second_moment)


def sinusoid_statistics(amplitude: float) -> HeightStatistics:
    """Height statistics of z = A sin x: Sa = 2A/π, Sq = A/√2, Sp = Sv = A, Ssk = 0, Sku = 3/2; A in m."""
    return HeightStatistics(
        mean=0.0,
        average=2 * amplitude / math.pi,
        rms=amplitude / math.sqrt(2),
        peak=amplitude,
        valley=amplitude,
        skewness=0.0,
        kurtosis=1.5,
    )


def sinusoid_bearing_curve(ratio: ArrayLike, amplitude: float) -> Array:
    """Bearing curve of a sinusoid, A cos πm, m, at the material ratios m, 0 to 1, of any shape."""
    height: Array = amplitude * np.cos(np.pi * np.asarray(ratio, dtype=np.float64))
    return height


def sinusoid_core(amplitude: float) -> Core:
    """Core parameters of a sinusoid with mean 0 and amplitude A, m.

    The bearing curve A cos πm is flattest at both ends; the first counts, 0 < m < w = 0.4. The line fitted there has
    Sk = A (12/w³) ((1 − cos πw)/π² − w sin(πw)/(2π)) and the height A sin(πw)/(πw) at m = w/2. It begins above the
    crests, so that Spk = 0, and ends at −A cos πb; the fraction b of the heights lies below this end, on average by
    A (sin(πb)/(πb) − cos πb), and Svk is twice this average.

    Examples
    --------
    >>> core = sinusoid_core(1.0)
    >>> round(core.height, 4), round(core.valley, 4), round(core.valley_ratio, 4)
    (1.7747, 0.4439, 0.7307)
    """
    w = CORE_WINDOW
    turn = math.pi * w
    height = 12 / w**3 * ((1 - math.cos(turn)) / math.pi**2 - w * math.sin(turn) / (2 * math.pi))
    upper = math.sin(turn) / turn + height * w / 2
    lower = upper - height
    half = math.acos(-lower)
    return Core(
        upper=upper * amplitude,
        lower=lower * amplitude,
        peak=0.0,
        valley=2 * (math.sin(half) / half + lower) * amplitude,
        peak_ratio=0.0,
        valley_ratio=1 - half / math.pi,
    )


def decay_length(correlation_length: float, exponent: float = 2.0) -> float:
    """Decay length Sal = λ (ln 5)^(1/n), m, of the autocorrelation exp(−(t/λ)ⁿ).

    For n = 2 and λx ≠ λy along perpendicular axes, Sal follows from the shorter length and Str is their ratio.
    """
    return correlation_length * math.pow(math.log(1 / DECAY_THRESHOLD), 1 / exponent)


def _normal(x: float) -> float:
    return math.exp(-x * x / 2) / math.sqrt(2 * math.pi)
