"""Line contact of a sinusoidal elastic surface with a rigid plane (Westergaard)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.checks import finite, not_negative, positive


@dataclass(frozen=True, kw_only=True)
class Westergaard:
    """Frictionless plane strain contact of z = D cos(2πx/L) with a rigid plane; crests at x = 0, ±L, ...

    With p* = πE*D/L, contact is |x| < a in each period, with sin²ψa = P/p* and ψ = πx/L; it is full for P >= p*.

    Attributes
    ----------
    amplitude : D, m.
    wavelength : L, m.
    composite_modulus : E*, Pa.
    load : P, mean pressure, Pa; 0 for the first touch.

    Raises
    ------
    InputError
        If a number is not finite, or not above 0 (the load may be 0).

    Notes
    -----
    The solution is exact for small slopes, 2πD/L << 1.

    Source: Westergaard, J. Appl. Mech. 6 (1939) A49, doi:10.1115/1.4008919; Johnson, Contact Mechanics (1985), 13.2,
    doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> ridges = Westergaard(amplitude=1e-6, wavelength=1e-3, composite_modulus=1e11, load=0.5 * math.pi * 1e8)
    >>> round(ridges.area_fraction, 12)
    0.5
    """

    amplitude: float
    wavelength: float
    composite_modulus: float
    load: float

    def __post_init__(self) -> None:
        positive("westergaard.amplitude", self.amplitude)
        positive("westergaard.wavelength", self.wavelength)
        positive("westergaard.composite_modulus", self.composite_modulus)
        not_negative("westergaard.load", self.load)

    @property
    def full_contact_load(self) -> float:
        """The smallest load of full contact, p* = πE*D/L, Pa."""
        return math.pi * self.composite_modulus * self.amplitude / self.wavelength

    @property
    def half_width(self) -> float:
        """Half-width a = (L/π) arcsin sqrt(P/p*), m, of the contact at each crest; L/2 in full contact."""
        return self.wavelength / math.pi * math.asin(self._edge)

    @property
    def area_fraction(self) -> float:
        """Area fraction of contact, 2a/L."""
        return 2 * self.half_width / self.wavelength

    @property
    def mean_gap(self) -> float:
        """Mean gap <g> = 2D (½ cos²ψa + sin²ψa ln sin ψa), m."""
        square = self._edge**2
        return 2 * self.amplitude * ((1 - square) / 2 + (square * math.log(self._edge) if square else 0.0))

    @property
    def approach(self) -> float:
        """Approach D − <g>, m: displacement of the plane since first touch, relative to the mean of the surface."""
        return self.amplitude - self.mean_gap

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure 2P cosψ sqrt(sin²ψa − sin²ψ)/sin²ψa in contact, 0 outside; P + p* cos 2ψ in full contact.

        Parameters
        ----------
        x : distance from a crest, m, any shape.

        Returns
        -------
        Array : p, Pa, same shape as ``x``.
        """
        phase = np.pi * finite("westergaard.x", x) / self.wavelength
        if self.load >= self.full_contact_load:
            return np.asarray(self.load + self.full_contact_load * np.cos(2 * phase))
        within = np.maximum(self._edge**2 - np.sin(phase) ** 2, 0.0)
        return np.asarray(2 * self.full_contact_load * np.abs(np.cos(phase)) * np.sqrt(within))

    def gap(self, x: ArrayLike) -> Array:
        """Gap 2D (s r − sin²ψa arsinh(r/sin ψa)), s = |sin ψ|, r = sqrt(s² − sin²ψa), outside; 0 in contact.

        Parameters
        ----------
        x : distance from a crest, m, any shape.

        Returns
        -------
        Array : gap, m, same shape as ``x``; near the contact, where it grows as (x − a)^(3/2), to rounding of D.
        """
        s = np.abs(np.sin(np.pi * finite("westergaard.x", x) / self.wavelength))
        if not self.load:
            return np.asarray(2 * self.amplitude * s**2)
        edge = self._edge
        r = np.sqrt(np.maximum((s - edge) * (s + edge), 0.0))
        return np.asarray(np.maximum(2 * self.amplitude * (s * r - edge**2 * np.arcsinh(r / edge)), 0.0))

    def displacement(self, x: ArrayLike) -> Array:
        """Downward displacement of the surface, D cos(2πx/L) + g − <g>, m, of mean 0, for x of any shape."""
        wave = self.amplitude * np.cos(2 * np.pi * finite("westergaard.x", x) / self.wavelength)
        return np.asarray(wave + self.gap(x) - self.mean_gap)

    @property
    def _edge(self) -> float:
        """Value of sin ψa, from 0 to 1."""
        return math.sqrt(min(self.load / self.full_contact_load, 1.0))
