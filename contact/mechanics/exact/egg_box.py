"""An egg-box in contact: what is known in closed form of crests in a square array (Johnson, Greenwood, Higginson)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import finite, positive


@dataclass(frozen=True, kw_only=True)
class EggBox:
    """Frictionless elastic contact of z = D cos(2πx/L) cos(2πy/L) with a rigid plane, at its two limits.

    The period is L along x and along y, and has two crests and two troughs; crest to trough is 2D. In between the two
    limits there is no closed form.

    Attributes
    ----------
    amplitude : D, m.
    wavelength : L, m, along x and y: it is made of plane waves of length L/√2 along the diagonals.
    composite_modulus : E*, Pa.

    Raises
    ------
    InputError
        If a number is not finite and above 0.

    Notes
    -----
    Exact for small slopes, as far as each limit goes.

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
        positive("egg_box.amplitude", self.amplitude)
        positive("egg_box.wavelength", self.wavelength)
        positive("egg_box.composite_modulus", self.composite_modulus)

    @property
    def full_contact_load(self) -> float:
        """p* = √2 πE*D/L, Pa: the least load at which contact is complete."""
        return math.sqrt(2) * math.pi * self.composite_modulus * self.amplitude / self.wavelength

    @property
    def crest_radius(self) -> float:
        """R = L²/(4π²D), m, of curvature, in every direction."""
        return self.wavelength**2 / (4 * math.pi**2 * self.amplitude)

    def full_contact_pressure(self, x: ArrayLike, y: ArrayLike, load: float) -> Array:
        """Pressure P + p* cos(2πx/L) cos(2πy/L), Pa, for P >= p*; x, y from a crest, m, shapes that broadcast.

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
        """A/A0 = π (3P/(8πp*))^(2/3): two crests in a period, each a Hertzian contact of its own.

        Parameters
        ----------
        load : P, mean pressure, any shape, Pa, for P << p*: solved contacts have 3 % more area at P/p* = 0.01,
            6 % at 0.03 and 16 % at 0.1.

        Returns
        -------
        Same shape.
        """
        return np.asarray(np.pi * np.cbrt(3 * self._ratio(load) / (8 * np.pi)) ** 2)

    def nearly_full_area_fraction(self, load: ArrayLike) -> Array:
        """A/A0 = 1 − (3/(2π)) (1 − P/p*): two troughs in a period, each open as a penny-shaped crack, and closing.

        The crack has the radius b at which its stress intensity is 0 under the tension (p* − P) − 2π²p* r²/L² that
        full contact would need there, b² = 3L² (1 − P/p*)/(4π²).

        Parameters
        ----------
        load : P, mean pressure, any shape, Pa, for 1 − P/p* << 1: to first order in it, 0.0016 too much at P/p* = 0.9;
            1 from p* on.

        Returns
        -------
        Same shape.
        """
        return np.asarray(1 - 1.5 / np.pi * np.maximum(1 - self._ratio(load), 0.0))

    def _ratio(self, load: ArrayLike) -> Array:
        pressure = finite("egg_box.load", load)
        if (pressure < 0).any():
            raise InputError(f"egg_box.load: got {pressure.min():.6g} Pa; give 0 or above")
        return pressure / self.full_contact_load
