"""Closed forms for surfaces of known spectrum: spectral moments, autocorrelations and rms slopes."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError


def self_affine_moment(order: int, *, hurst: float, roll_off: float, cut_off: float) -> float:
    """Spectral moment ∫ q^(k + 1) C(q) dq from 0 to qs, with C = 1 up to qr and C = (q/qr)^(-2 - 2H) up to qs.

    It equals qr^(k + 2) [1/(k + 2) + (s^(k - 2H) - 1)/(k - 2H)] with s = qs/qr; ln s replaces the fraction if k = 2H.

    Parameters
    ----------
    order : k: 0 for heights, 2 for slopes, 4 for curvatures.
    hurst : H, above 0 and at most 1.
    roll_off, cut_off : wavelengths 2π/qr and 2π/qs, m, with cut_off <= roll_off.

    Returns
    -------
    float : 1/m^(k + 2), per unit of C. The second over the zeroth moment is the mean square slope over the mean square
        height of a surface whose period holds many roll-off lengths.

    Raises
    ------
    InputError
        If H, the order or the lengths are out of range.

    Notes
    -----
    Source: Persson et al., J. Phys. Condens. Matter 17 (2005) R1, doi:10.1088/0953-8984/17/1/R01.

    Examples
    --------
    >>> self_affine_moment(2, hurst=1.0, roll_off=2 * math.pi, cut_off=2 * math.pi / math.e)
    1.25
    """
    if not (0 < hurst <= 1 and 0 < cut_off <= roll_off < math.inf and order in (0, 2, 4)):
        raise InputError(
            f"self_affine_moment: got order {order!r}, hurst {hurst!r}, roll_off {roll_off!r} m, cut_off {cut_off!r} m;"
            " write 0, 2 or 4, 0 < hurst <= 1, and a cut-off up to the roll-off"
        )
    exponent, ratio = order - 2 * hurst, roll_off / cut_off
    tail = math.log(ratio) if exponent == 0 else (ratio**exponent - 1) / exponent
    return (2 * math.pi / roll_off) ** (order + 2) * (1 / (order + 2) + tail)


def rms_slope_over_height(*, hurst: float, roll_off: float, cut_off: float) -> float:
    """Rms slope over rms height, sqrt(<|∇h|²>/<h²>), 1/m, of a self-affine surface, from `self_affine_moment`."""
    second, zeroth = (self_affine_moment(order, hurst=hurst, roll_off=roll_off, cut_off=cut_off) for order in (2, 0))
    return math.sqrt(second / zeroth)


def autocorrelation(distance: Array, correlation_length: float, *, exponent: float = 2.0) -> Array:
    """Autocorrelation R = 0.2^((t/λ)^exponent): Gaussian for exponent 2, exponential for exponent 1.

    Parameters
    ----------
    distance : t >= 0, m, any shape.
    correlation_length : distance λ at which R = 0.2, m.
    exponent : above 0 and at most 2.

    Returns
    -------
    Array : R, same shape as ``distance``.

    Raises
    ------
    InputError
        If the correlation length or the exponent is out of range.
    """
    if not (correlation_length > 0 and 0 < exponent <= 2):
        raise InputError(
            f"autocorrelation: got correlation length {correlation_length!r} m, exponent {exponent!r}; write a length "
            "above zero and an exponent above 0 and at most 2"
        )
    return np.asarray(0.2 ** ((np.asarray(distance, dtype=float) / correlation_length) ** exponent))


def gaussian_rms_slope(rms_height: float, along: float, across: float) -> float:
    """The rms slope σ sqrt(2 ln 5 (1/along² + 1/across²)) of a surface with the autocorrelation R = 0.2^(ρ²).

    Parameters
    ----------
    rms_height : σ, m.
    along, across : correlation lengths at which R = 0.2, m.

    Raises
    ------
    InputError
        If a correlation length is not above zero.
    """
    if not min(along, across) > 0:
        raise InputError(f"gaussian_rms_slope: got lengths {along!r} and {across!r} m; write two above zero")
    return rms_height * math.sqrt(2 * math.log(5) * (1 / along**2 + 1 / across**2))
