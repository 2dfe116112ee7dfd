"""Tables of flow factors and contact pressures of a rough surface over the separation of its walls."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.mixed.asperities import SpotPressures
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point

HERTZ_POWER = 1.5
"""Power of the approach with which the load on a single asperity grows."""

INTERPOLATION_SAFETY_FACTOR = 2.0
"""Safety factor of the interpolation error of the separation between loads."""

NO_AREA = 1e-300
"""Area fraction that stands for none."""

SEPARATION_TOLERANCE = 1e-12
"""Tolerated separation below the smallest one, over that of first contact (round-off)."""


@dataclass(frozen=True, kw_only=True)
class AsperityTable:
    """Flow factors and contact pressure over the separation α, from thick films to flattened asperities.

    α is the distance of the mean planes of the two undeformed bodies. It is the mean gap without contact, and Sp − g00
    after an approach g00 from first contact at α = Sp. Under load the mean gap is α plus the mean plastic displacement.
    Monotone cubic interpolation is used for ln p_c over ln g00, with Hertz's power 3/2 between first contact and the
    lightest load, for the mean plastic displacement over g00, and for the flow factors over the mean gap.

    Source: Sahlin 2008, E.37, without its ε (the gap in contact is zero).

    Attributes
    ----------
    factors : table over the mean gap; points with a ``load`` are in contact.

    Raises
    ------
    InputError
        If fewer than two points are in contact.
    """

    factors: FactorTable

    def __post_init__(self) -> None:
        if len(self._pressed) < 2:
            raise InputError(
                f"table: has {len(self._pressed)} points under load; contact pressures need at least 2, make it with "
                "more loads"
            )

    @property
    def origin(self) -> Mapping[str, Any]:
        """The entries for the provenance of a result."""
        return self.factors.origin

    @property
    def touching(self) -> float:
        """α at first contact, Sp, m."""
        return self.factors.peak

    @property
    def closest(self) -> float:
        """α at the largest load, m."""
        return self._pressed[-1].separation

    @property
    def largest_pressure(self) -> float:
        """The largest load, Pa."""
        return self._pressed[-1].load

    def factor_uncertainty(self, separation: float) -> float:
        """The relative uncertainty of A₁₁, A₂₂ and B₁ at separations of at least this, m."""
        return self.factors.relative_uncertainty_above(float(self.mean_gap(np.array(separation))))

    def friction_uncertainty(self, separation: float) -> float:
        """The relative uncertainty of the friction factor d + 3e, which depends on the grid in contact."""
        return self.factors.friction_uncertainty(float(self.mean_gap(np.array(separation))))

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors at separations, m, of any shape; raises InputError below the smallest."""
        return self.factors(self.mean_gap(separation))

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap ĥ, m; raises InputError below the smallest separation."""
        gap = np.array(self._checked(separation))
        near = gap < self.touching
        gap[near] += self._plastic(self.touching - gap[near])
        return np.asarray(np.maximum(gap, self.factors.narrowest))

    def contact_pressure(self, separation: Array) -> Array:
        """The contact pressure p_c over the nominal area, Pa; raises InputError below the smallest separation."""
        return self._over_approach(separation, self._log_pressure, HERTZ_POWER)

    def area_fraction(self, separation: Array) -> Array:
        """The real over the nominal contact area; raises InputError below the smallest separation."""
        return self._over_approach(separation, self._log_area, HERTZ_POWER - 0.5)

    def spot_pressures(self, separation: float) -> SpotPressures:
        """The pressures on the spots in contact: p_c over the area fraction, and the peak between those of the points.

        Raises
        ------
        InputError
            Below the smallest separation.
        """
        alpha = np.array([separation])
        load, area = float(self.contact_pressure(alpha)[0]), float(self.area_fraction(alpha)[0])
        peaks = [point.peak_pressure for point in self._pressed]
        peak = float(np.interp(self.touching - separation, self._approaches, peaks)) if load > 0 else 0.0
        mean = load / area if area > NO_AREA else 0.0
        return SpotPressures(mean=mean, peak=peak, composite_modulus=self.factors.composite_modulus)

    def pressure_uncertainty(self, separation: Array) -> Array:
        """The relative uncertainty of the contact pressure from grid and interpolation.

        It is 0 without contact, and at least 1 between first contact and the lightest load.
        """
        g = self.touching - self._checked(separation)
        inside = np.clip(g, self._approaches[0], None)
        errors = [
            p.separation_uncertainty + INTERPOLATION_SAFETY_FACTOR * p.separation_missed * self.factors.rms
            for p in self._pressed
        ]
        slope = self._log_pressure.derivative()(np.log(inside)) / inside
        error = np.interp(inside, self._approaches, errors)
        relative = np.where(np.isfinite(error), slope * np.where(np.isfinite(error), error, 0.0), np.inf)
        return np.where(g > 0, np.where(g < self._approaches[0], np.maximum(relative, 1.0), relative), 0.0)

    def separation_at(self, pressure: float) -> float:
        """The separation α, m, at a contact pressure, Pa.

        Raises
        ------
        InputError
            If the pressure is not above 0, or above the largest in the table.
        """
        if not 0 < pressure <= self.largest_pressure:
            raise InputError(
                f"contact pressure: got {pressure:.4g} Pa; it must be above 0 and at most "
                f"{self.largest_pressure:.4g} Pa, make a table with larger loads"
            )
        lightest = self._pressed[0].load
        if pressure <= lightest:
            return float(self.touching - self._approaches[0] * (pressure / lightest) ** (1 / HERTZ_POWER))
        between, (low, *_, high) = self._log_pressure, np.log(self._approaches)
        target = np.clip(math.log(pressure), between(low), between(high))
        log_approach: float = scipy.optimize.brentq(lambda log: float(between(log) - target), low, high, xtol=1e-14)
        return self.touching - math.exp(log_approach)

    @cached_property
    def _pressed(self) -> tuple[Point, ...]:
        """The points in contact in order of load, each with a larger approach than the one before."""
        points: list[Point] = []
        for point in sorted(self.factors.points, key=lambda point: point.load):
            nearest = points[-1].separation if points else self.touching
            if point.load > 0 and point.separation < nearest:
                points.append(point)
        return tuple(points)

    @cached_property
    def _approaches(self) -> Array:
        """The approaches g00 in increasing order, m."""
        return np.array([self.touching - point.separation for point in self._pressed])

    @cached_property
    def _log_pressure(self) -> "scipy.interpolate.PchipInterpolator":
        return scipy.interpolate.PchipInterpolator(
            np.log(self._approaches), np.log([point.load for point in self._pressed])
        )

    @cached_property
    def _log_area(self) -> "scipy.interpolate.PchipInterpolator":
        areas = [max(point.area_fraction, NO_AREA) for point in self._pressed]
        return scipy.interpolate.PchipInterpolator(np.log(self._approaches), np.log(areas))

    @cached_property
    def _plastic(self) -> "scipy.interpolate.PchipInterpolator":
        """The mean plastic displacement over the approach, m."""
        displacement = [max(point.mean_gap - point.separation, 0.0) for point in self._pressed]
        return scipy.interpolate.PchipInterpolator(np.append(0.0, self._approaches), np.append(0.0, displacement))

    def _over_approach(self, separation: Array, between: Callable[[Array], Array], power: float) -> Array:
        """The exponential of an interpolant, with a power of the approach below the lightest load."""
        g = self.touching - self._checked(separation)
        first = self._approaches[0]
        inside = np.exp(between(np.log(np.clip(g, first, None))))
        return np.asarray(inside * np.clip(g / first, 0.0, 1.0) ** power)

    def _checked(self, separation: Array) -> Array:
        """The separation limited to the range of the table; raises InputError below it."""
        alpha = np.asarray(separation, dtype=np.float64)
        slack = SEPARATION_TOLERANCE * abs(self.touching)
        if alpha.size and alpha.min() < self.closest - slack:
            raise InputError(
                f"separation: got {alpha.min():.6g} m; it must be at least {self.closest:.6g} m, where the contact "
                f"pressure is {self.largest_pressure:.4g} Pa, make a table with larger loads"
            )
        return np.asarray(np.maximum(alpha, self.closest))
