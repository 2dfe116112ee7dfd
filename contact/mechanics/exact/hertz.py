"""Hertzian contact of a sphere and of a cylinder with a plane."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.checks import finite, positive_fields


@dataclass(frozen=True, kw_only=True)
class HertzSphere:
    """Frictionless elastic contact of a sphere, or of a paraboloid r²/(2R), with a plane: a³ = 3FR/(4E*).

    Attributes
    ----------
    radius : R, m; for two spheres 1/R = 1/R1 + 1/R2.
    composite_modulus : E*, Pa.
    force : F, N.

    Raises
    ------
    InputError
        If a number is not finite and above 0.

    Notes
    -----
    Exact for the paraboloid on a half-space; for a sphere with an error of relative order (a/R)².

    Source: Johnson, Contact Mechanics (1985), 3.4 and 4.2, doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> ball = HertzSphere(radius=1e-2, composite_modulus=1e11, force=40 / 3)
    >>> round(1e6 * ball.contact_radius, 9), round(1e9 * ball.approach, 9)
    (100.0, 1000.0)
    """

    radius: float
    composite_modulus: float
    force: float

    def __post_init__(self) -> None:
        positive_fields("hertz", self)

    @property
    def contact_radius(self) -> float:
        """Contact radius a = (3FR/(4E*))^(1/3), m."""
        return math.cbrt(0.75 * self.force * self.radius / self.composite_modulus)

    @property
    def largest_pressure(self) -> float:
        """Largest pressure p0 = 3F/(2πa²) = 2E*a/(πR), Pa, in the middle."""
        return 2 * self.composite_modulus * self.contact_radius / (math.pi * self.radius)

    @property
    def approach(self) -> float:
        """Approach δ = a²/R of distant points, m."""
        return self.contact_radius**2 / self.radius

    def pressure(self, r: ArrayLike) -> Array:
        """Pressure p0 sqrt(1 − r²/a²) in contact, 0 outside, Pa, at distances r from the axis, m, any shape."""
        ratio = finite("hertz.r", r) / self.contact_radius
        return np.asarray(self.largest_pressure * np.sqrt(np.maximum(1 - ratio**2, 0.0)))

    def displacement(self, r: ArrayLike) -> Array:
        """Displacement u of the surface into the solid, 0 at infinity, m.

        u = δ − r²/(2R) for r <= a, and ((2a² − r²) arcsin(a/r) + a sqrt(r² − a²))/(πR) outside.

        Parameters
        ----------
        r : distance from the axis, m, any shape.

        Returns
        -------
        Array : u, m, same shape as ``r``.
        """
        a, distance = self.contact_radius, np.abs(finite("hertz.r", r))
        far = np.maximum(distance, a)
        outside = (2 * a**2 - far**2) * np.arcsin(a / far) + a * np.sqrt((far - a) * (far + a))
        inside = self.approach - distance**2 / (2 * self.radius)
        return np.where(distance <= a, inside, outside / (np.pi * self.radius))

    def gap(self, r: ArrayLike) -> Array:
        """Gap r²/(2R) + u − δ outside contact, 0 inside, m, at distances r from the axis, m, any shape."""
        distance = np.maximum(np.abs(finite("hertz.r", r)), self.contact_radius)
        return np.asarray(distance**2 / (2 * self.radius) + self.displacement(distance) - self.approach)


@dataclass(frozen=True, kw_only=True)
class HertzCylinder:
    """Frictionless plane strain contact of a cylinder, or of a parabola x²/(2R), with a plane: a² = 4fR/(πE*).

    There is no approach: in plane strain the displacement of a half-space grows without bound, as ln x.

    Attributes
    ----------
    radius : R, m; for two cylinders 1/R = 1/R1 + 1/R2.
    composite_modulus : E*, Pa.
    force_per_length : f, N/m.

    Raises
    ------
    InputError
        If a number is not finite and above 0.

    Notes
    -----
    Exact for the parabola on a half-space; for a cylinder with an error of relative order (a/R)².

    Source: Johnson, Contact Mechanics (1985), 4.2(c), doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> roller = HertzCylinder(radius=1e-2, composite_modulus=1e11, force_per_length=math.pi * 2.5e4)
    >>> round(1e6 * roller.half_width, 9), round(1e-6 * roller.largest_pressure, 9)
    (100.0, 500.0)
    """

    radius: float
    composite_modulus: float
    force_per_length: float

    def __post_init__(self) -> None:
        positive_fields("hertz", self)

    @property
    def half_width(self) -> float:
        """Half-width of contact a = sqrt(4fR/(πE*)), m."""
        return math.sqrt(4 * self.force_per_length * self.radius / (math.pi * self.composite_modulus))

    @property
    def largest_pressure(self) -> float:
        """Largest pressure p0 = 2f/(πa) = E*a/(2R), Pa, in the middle."""
        return self.composite_modulus * self.half_width / (2 * self.radius)

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure p0 sqrt(1 − x²/a²) in contact, 0 outside, Pa, at distances x from the middle, m, any shape."""
        ratio = finite("hertz.x", x) / self.half_width
        return np.asarray(self.largest_pressure * np.sqrt(np.maximum(1 - ratio**2, 0.0)))

    def gap(self, x: ArrayLike) -> Array:
        """Gap (x r − a² arsinh(r/a))/(2R), r = sqrt(x² − a²), outside contact, 0 inside, m, for x of any shape."""
        a = self.half_width
        distance = np.maximum(np.abs(finite("hertz.x", x)), a)
        r = np.sqrt((distance - a) * (distance + a))
        return np.asarray((distance * r - a**2 * np.arcsinh(r / a)) / (2 * self.radius))

    def displacement(self, x: ArrayLike) -> Array:
        """Displacement into the solid minus that of the middle, g − x²/(2R), m, for x of any shape."""
        return np.asarray(self.gap(x) - finite("hertz.x", x) ** 2 / (2 * self.radius))
