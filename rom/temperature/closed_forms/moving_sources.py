"""Temperatures of a half-space under a uniform source of heat on its surface that rests or moves."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import k0e, k1e

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class SourceTemperature:
    """The temperature rises of a half-space under a source: the greatest one and the mean over the source, K."""

    greatest: float
    mean: float


def resting_circle(*, radius: float, flux: float, conductivity: float) -> SourceTemperature:
    """The temperature rises under a circular source of uniform flux that rests: q a/k and 8 q a/(3 π k), K.

    Parameters
    ----------
    radius : radius a of the source, m.
    flux : heat flux q into the half-space, W/m².
    conductivity : thermal conductivity k of the half-space, W/(m K).

    Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids, section 10.5.

    Examples
    --------
    >>> round(resting_circle(radius=10e-6, flux=46e6, conductivity=46.0).greatest, 3)
    10.0
    """
    unit = flux * radius / conductivity
    return SourceTemperature(greatest=unit, mean=8 * unit / (3 * math.pi))


def fast_circle(
    *, radius: float, flux: float, speed: float, conductivity: float, heat_per_volume: float
) -> SourceTemperature:
    """The temperature rises under a circular source that moves so fast that heat flows only into the depth, K.

    Each chord is a band of its length: the rise at its end is 2 q √(2 a/(π k ρ c u)) at most, and the mean is
    1.7259 q √(a/(π k ρ c u)), with the factor 4 √8 B(1/2, 7/4)/(3 π). For a large Péclet number ρ c u a/(2 k): at 10
    the greatest rise is 6 % too large and the mean 2 %, at 100 1 % and 0.2 %.

    Parameters
    ----------
    radius : radius a of the source, m.
    flux : heat flux q into the half-space, W/m².
    speed : speed u of the source over the half-space, m/s.
    conductivity : thermal conductivity k of the half-space, W/(m K).
    heat_per_volume : heat capacity ρ c of a volume of it, J/(m³ K).

    Source: Jaeger 1942, Journal and Proceedings of the Royal Society of New South Wales 76, 203-224.

    Examples
    --------
    >>> fast = fast_circle(radius=10e-6, flux=46e6, speed=1000.0, conductivity=46.0, heat_per_volume=3.6e6)
    >>> round(fast.greatest, 3), round(fast.mean, 3)
    (0.57, 0.348)
    """
    unit = flux * math.sqrt(radius / (math.pi * conductivity * heat_per_volume * speed))
    beta = math.gamma(0.5) * math.gamma(1.75) / math.gamma(2.25)
    return SourceTemperature(greatest=math.sqrt(8) * unit, mean=4 * math.sqrt(8) * beta / (3 * math.pi) * unit)


def moving_circle(
    *, radius: float, flux: float, speed: float, conductivity: float, heat_per_volume: float
) -> SourceTemperature:
    """The temperature rises under a circular source of uniform flux at any speed, by an interpolation, K.

    2 q a/(k √(π (1.273 + P))) and 1.22 q a/(k √(π (0.6575 + P))) with the Péclet number P = ρ c u a/(2 k): those of the
    resting and of the fast source in the limits. They deviate by at most 2.5 % and 4 % from the integral of moving
    point sources, most at P = 1.

    Parameters
    ----------
    radius : radius a of the source, m.
    flux : heat flux q into the half-space, W/m².
    speed : speed u of the source over the half-space, m/s, at least 0.
    conductivity : thermal conductivity k of the half-space, W/(m K).
    heat_per_volume : heat capacity ρ c of a volume of it, J/(m³ K).

    Source: Tian and Kennedy 1994, Journal of Tribology 116, 167-174.

    Examples
    --------
    >>> steel = {"conductivity": 46.0, "heat_per_volume": 3.6e6}
    >>> moving = moving_circle(radius=10e-6, flux=46e6, speed=2.0, **steel)
    >>> round(moving.greatest, 3), round(moving.mean, 3)
    (7.87, 5.736)
    """
    peclet = heat_per_volume * speed * radius / (2 * conductivity)
    unit = flux * radius / (conductivity * math.sqrt(math.pi))
    return SourceTemperature(
        greatest=2 * unit / math.sqrt(1.273 + peclet), mean=1.22 * unit / math.sqrt(0.6575 + peclet)
    )


def moving_band(
    position: Array, *, length: float, flux: float, speed: float, conductivity: float, heat_per_volume: float
) -> Array:
    """The temperature rise of the surface under an infinitely wide band of uniform flux that moves over it, K.

    ΔT = 2 q κ/(π k u) ∫ exp(t) K0(|t|) dt between t = u (x - L)/(2 κ) and u x/(2 κ), where x is the distance behind the
    leading edge and 0 < x < L under the band. From 0 to ξ > 0 the integral is ξ exp(ξ) (K0(ξ) + K1(ξ)) - 1, and from 0
    to -ξ it is ξ exp(-ξ) (K1(ξ) - K0(ξ)) - 1. For a large Péclet number u L/(2 κ) the rise tends to
    2 q √(x/(π k ρ c u)); for a small one it grows like its logarithm, as no steady state exists under a resting band.

    Parameters
    ----------
    position : distances x behind the leading edge, m, of any shape.
    length : length L of the band along the motion, m.
    flux : heat flux q into the half-space, W/m².
    speed : speed u of the band over the half-space, m/s, above 0.
    conductivity : thermal conductivity k of the half-space, W/(m K).
    heat_per_volume : heat capacity ρ c of a volume of it, J/(m³ K).

    Returns
    -------
    array of the shape of ``position``.

    Source: Jaeger 1942, Journal and Proceedings of the Royal Society of New South Wales 76, 203-224; Abramowitz and
    Stegun 1964, 11.3.15.

    Examples
    --------
    >>> import numpy as np
    >>> steel = {"conductivity": 46.0, "heat_per_volume": 3.6e6}
    >>> band = moving_band(np.array([0.0, 10e-6, 20e-6]), length=20e-6, flux=46e6, speed=2.0, **steel)
    >>> band.round(3).tolist()
    [3.992, 9.793, 9.615]
    """
    x = np.asarray(position, dtype=float)
    unit = 2 * flux / (math.pi * heat_per_volume * speed)
    scale = heat_per_volume * speed / (2 * conductivity)
    return np.asarray(unit * (_primitive(scale * x) - _primitive(scale * (x - length))))


def _primitive(xi: Array) -> Array:
    """∫ exp(t) K0(|t|) dt from 0 to ξ."""
    size = np.where(xi == 0, 1.0, np.abs(xi))
    behind = size * (k0e(size) + k1e(size)) - 1
    before = size * np.exp(-2 * size) * (k1e(size) - k0e(size)) - 1
    return np.where(xi == 0, 0.0, np.where(xi > 0, behind, before))
