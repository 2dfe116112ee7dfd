"""Closed forms of the contact of a doubly sinusoidal surface at its two limits (Johnson, Greenwood, Higginson)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import finite, positive_fields


@dataclass(frozen=True, kw_only=True)
class EggBox:
    """Frictionless elastic contact of z = D cos(2πx/L) cos(2πy/L) with a rigid plane, at its two limits.

    One period, L by L, has two crests and two troughs, with 2D from trough to crest. There is no closed form between
    the two limits.

    Attributes
    ----------
    amplitude : D, m.
    wavelength : L, m, along x and y; the surface consists of plane waves of length L/√2 along the diagonals.
    composite_modulus : E*, Pa.

    Raises
    ------
    InputError
        If a number is not finite and above 0.

    Notes
    -----
    Each limit is exact for small slopes.

    Source: Johnson, Greenwood and Higginson, Int. J. Mech. Sci. 27 (1985) 383, doi:10.1016/0020-7403(85)90029-3.

    Examples
    --------
    >>> box = EggBox(amplitude=1e-6, wavelength=1e-3, composite_modulus=1e11)
    >>> round(box.full_contact_load / 1e8, 6)  # √2 π
    4.442883
    """

    amplitude: float
    wavelength: float
    composite_modulus: float

    def __post_init__(self) -> None:
        positive_fields("egg_box", self)

    @property
    def full_contact_load(self) -> float:
        """The smallest load of full contact, p* = √2 πE*D/L, Pa."""
        return math.sqrt(2) * math.pi * self.composite_modulus * self.amplitude / self.wavelength

    @property
    def crest_radius(self) -> float:
        """Radius of curvature of the crests, R = L²/(4π²D), m, in every direction."""
        return self.wavelength**2 / (4 * math.pi**2 * self.amplitude)

    def full_contact_pressure(self, x: ArrayLike, y: ArrayLike, load: float) -> Array:
        """Pressure in full contact, P + p* cos(2πx/L) cos(2πy/L), Pa, for P >= p*.

        Parameters
        ----------
        x, y : distances from a crest, m, shapes that broadcast.
        load : P, mean pressure, Pa.

        Raises
        ------
        InputError
            If the load is below p*.
        """
        if not self.full_contact_load * (1 - 1e-12) <= load < math.inf:
            raise InputError(f"egg_box.load: got {load!r} Pa; contact is complete from {self.full_contact_load:.6g} on")
        turn = 2 * np.pi / self.wavelength
        wave = np.cos(turn * finite("egg_box.x", x)) * np.cos(turn * finite("egg_box.y", y))
        return np.asarray(load + self.full_contact_load * wave)

    def light_load_area_fraction(self, load: ArrayLike) -> Array:
        """Area fraction A/A0 = π (3P/(8πp*))^(2/3) at light load, with a separate Hertzian contact on each crest.

        Parameters
        ----------
        load : P, mean pressure, Pa, any shape, with P << p*; numerical solutions have 3 % more area at P/p* = 0.01,
            6 % at 0.03 and 16 % at 0.1.

        Returns
        -------
        Array : A/A0, same shape as ``load``.
        """
        return np.asarray(np.pi * np.cbrt(3 * self._ratio(load) / (8 * np.pi)) ** 2)

    def nearly_full_area_fraction(self, load: ArrayLike) -> Array:
        """Area fraction A/A0 = 1 − (3/(2π)) (1 − P/p*) near full contact, with a penny-shaped crack in each trough.

        The stress intensity of the crack is 0 under the tension (p* − P) − 2π²p* r²/L² that full contact would need;
        its radius b is given by b² = 3L² (1 − P/p*)/(4π²).

        Parameters
        ----------
        load : P, mean pressure, Pa, any shape, with 1 − P/p* << 1.

        Returns
        -------
        Array : A/A0, same shape as ``load``; 1 from p* on, and 0.0016 too large at P/p* = 0.9.
        """
        return np.asarray(1 - 1.5 / np.pi * np.maximum(1 - self._ratio(load), 0.0))

    def _ratio(self, load: ArrayLike) -> Array:
        pressure = finite("egg_box.load", load)
        if (pressure < 0).any():
            raise InputError(f"egg_box.load: got {pressure.min():.6g} Pa; give 0 or above")
        return pressure / self.full_contact_load
