"""A rough surface between two bodies over how far apart they are: flow factors, and the pressure on its asperities."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point

TIP = 1.5
"""The power of the approach with which the load on a first touching tip grows: Hertz's."""

SAFETY = 2.0
"""Of what interpolation was seen to miss half-way between loads."""

CLOSE = 1e-12
"""The part of it by which a separation may be below the least one, by rounding."""


@dataclass(frozen=True, kw_only=True)
class AsperityTable:
    """Flow factors and the pressure of contact, from thick films to crushed asperities, over the separation α.

    α is the distance of the mean planes of the two bodies as if nothing deformed, Sp − g00 where they touch: the mean
    gap where they do not. It goes on continuously through the first touch at α = Sp. Under load the mean gap is α plus
    the mean plastic displacement. Interpolated are ln p_c over ln g00, monotone cubic, with Hertz's power 3/2 from
    the first touch to the lightest load, the mean plastic displacement over g00, and factors over the mean gap.

    Source: Sahlin 2008, E.37, without its ε: contact is closed.

    Attributes
    ----------
    factors : over the mean gap; points with a ``load`` are pressed.

    Raises
    ------
    InputError
        With fewer than two pressed points.
    """

    factors: FactorTable

    def __post_init__(self) -> None:
        if len(self._pressed) < 2:
            raise InputError(
                f"table: has {len(self._pressed)} points under load, so that it cannot say what asperities carry; make "
                "it from contacts at two loads or more"
            )

    @property
    def touching(self) -> float:
        """α at which the highest point touches, Sp, m."""
        return self.factors.peak

    @property
    def closest(self) -> float:
        """α at the greatest load, m."""
        return self._pressed[-1].separation

    @property
    def largest_pressure(self) -> float:
        """The greatest load, Pa."""
        return self._pressed[-1].load

    @property
    def doubt(self) -> float:
        """By which part A₁₁, A₂₂ and B₁ may be off anywhere."""
        return self.factors.relative_uncertainty

    def doubt_above(self, separation: float) -> float:
        """The same where no separation is below this, m."""
        return self.factors.relative_uncertainty_above(float(self.mean_gap(np.array(separation))))

    def friction_doubt(self, separation: float) -> float:
        """By which part the film's friction factor d + 3e may be off: in contact the grid's nodes have a say in it."""
        return self.factors.friction_uncertainty(float(self.mean_gap(np.array(separation))))

    def __call__(self, separation: Array, /) -> GapFactors:
        """The factors at separations, m, of any shape; InputError below the closest."""
        return self.factors(self.mean_gap(separation))

    def mean_gap(self, separation: Array) -> Array:
        """ĥ, m; InputError below the closest separation."""
        alpha = self._reached(separation)
        approach = np.clip(self.touching - alpha, 0.0, None)
        return np.asarray(np.maximum(alpha + self._sunk(approach), self.factors.narrowest))

    def contact_pressure(self, separation: Array) -> Array:
        """p_c over the nominal area, Pa, growing from 0 at the first touch; InputError below the closest separation."""
        return self._over_approach(separation, self._log_pressure, TIP)

    def area_fraction(self, separation: Array) -> Array:
        """Real over nominal area of contact; InputError below the closest separation."""
        return self._over_approach(separation, self._log_area, TIP - 0.5)

    def pressure_doubt(self, separation: Array) -> Array:
        """By which part the contact pressure may be off, by grid and interpolation; 0 where nothing touches.

        All of it below the lightest load.
        """
        g = self.touching - self._reached(separation)
        inside = np.clip(g, self._approaches[0], None)
        doubts = [p.separation_uncertainty + SAFETY * p.separation_missed * self.factors.rms for p in self._pressed]
        slope = self._log_pressure.derivative()(np.log(inside)) / inside
        missed = np.interp(inside, self._approaches, doubts)
        doubt = np.where(np.isfinite(missed), slope * np.where(np.isfinite(missed), missed, 0.0), np.inf)
        return np.where(g > 0, np.where(g < self._approaches[0], np.maximum(doubt, 1.0), doubt), 0.0)

    def separation_at(self, pressure: float) -> float:
        """α, m, at which asperities carry a pressure, Pa.

        Raises
        ------
        InputError
            For a pressure that is not above 0, or above the largest in the table.
        """
        if not 0 < pressure <= self.largest_pressure:
            raise InputError(
                f"contact pressure: got {pressure:.4g} Pa; the table knows what asperities do above 0 and up to "
                f"{self.largest_pressure:.4g} Pa, make one that reaches further"
            )
        lightest = self._pressed[0].load
        if pressure <= lightest:
            return float(self.touching - self._approaches[0] * (pressure / lightest) ** (1 / TIP))
        between, (low, *_, high) = self._log_pressure, np.log(self._approaches)
        wanted = np.clip(math.log(pressure), between(low), between(high))
        found: float = scipy.optimize.brentq(lambda log: float(between(log) - wanted), low, high, xtol=1e-14)
        return self.touching - math.exp(found)

    @cached_property
    def _pressed(self) -> tuple[Point, ...]:
        """In order of load; approaches and loads grow from each to the next."""
        kept: list[Point] = []
        for point in sorted(self.factors.points, key=lambda point: point.load):
            nearest = kept[-1].separation if kept else self.touching
            if point.load > 0 and point.separation < nearest:
                kept.append(point)
        return tuple(kept)

    @cached_property
    def _approaches(self) -> Array:
        """g00, m, growing."""
        return np.array([self.touching - point.separation for point in self._pressed])

    @cached_property
    def _log_pressure(self) -> "scipy.interpolate.PchipInterpolator":
        return scipy.interpolate.PchipInterpolator(
            np.log(self._approaches), np.log([point.load for point in self._pressed])
        )

    @cached_property
    def _log_area(self) -> "scipy.interpolate.PchipInterpolator":
        least = 1e-300
        areas = [max(point.area_fraction, least) for point in self._pressed]
        return scipy.interpolate.PchipInterpolator(np.log(self._approaches), np.log(areas))

    @cached_property
    def _sunk(self) -> "scipy.interpolate.PchipInterpolator":
        """The mean plastic displacement over the approach, m."""
        sunk = [max(point.mean_gap - point.separation, 0.0) for point in self._pressed]
        return scipy.interpolate.PchipInterpolator(np.append(0.0, self._approaches), np.append(0.0, sunk))

    def _over_approach(self, separation: Array, between: Callable[[Array], Array], power: float) -> Array:
        g = self.touching - self._reached(separation)
        first = self._approaches[0]
        inside = np.exp(between(np.log(np.clip(g, first, None))))
        return np.asarray(inside * np.clip(g / first, 0.0, 1.0) ** power)

    def _reached(self, separation: Array) -> Array:
        alpha = np.asarray(separation, dtype=np.float64)
        slack = CLOSE * abs(self.touching)
        if alpha.size and alpha.min() < self.closest - slack:
            raise InputError(
                f"separation: got {alpha.min():.6g} m, closer than the table reaches, {self.closest:.6g} m under "
                f"{self.largest_pressure:.4g} Pa; make one that reaches greater loads"
            )
        return np.asarray(np.maximum(alpha, self.closest))
