"""Flow factors over the mean gap: points, and what lies between and beyond them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

SMOOTH = np.array([1.0, 1, 0, 1, 0, 1, 0])
"""What :func:`relative_row` tells of a smooth film."""


@dataclass(frozen=True, kw_only=True)
class Point:
    """Flow factors at one separation.

    Attributes
    ----------
    separation : of the mean planes of the undeformed walls, m: how the rigid bodies lie.
    contact : the part of the surface that is closed.
    factors, uncertainty, unsolved, iterations, residual : of :class:`rom.homogenization.flow_factors.Estimated`.
    cpu_s : what it cost, s.
    load : what presses the walls together, Pa over the nominal area; 0 of walls that nothing deforms.
    area_fraction, plastic_fraction : of a pressed surface, as :class:`contact.mechanics.contact.Contact` has them.
    separation_uncertainty : by how much the grid may have the separation at the load off, m.
    missed, separation_missed : what interpolation was off by here, or next to here, before the point was there: of the
        factors, in the measure of the tolerance of :func:`rom.homogenization.table.tabulate.tabulate`, and of the
        separation at the load, over the rms height.
    """

    separation: float
    contact: float
    factors: FlowFactors
    uncertainty: FlowFactors
    unsolved: float
    iterations: int
    residual: float
    cpu_s: float
    load: float = 0.0
    area_fraction: float = 0.0
    plastic_fraction: float = 0.0
    separation_uncertainty: float = 0.0
    missed: float = 0.0
    separation_missed: float = 0.0

    @property
    def mean_gap(self) -> float:
        """ĥ, m."""
        return self.factors.mean_gap


@dataclass(frozen=True, kw_only=True)
class FactorTable:
    """Points in order of their mean gaps ĥ, with monotone cubic interpolation (Fritsch and Carlson) over ln ĥ.

    Interpolated are ∛A₁₁/ĥ, ∛A₂₂/ĥ, A₁₂/√(A₁₁A₂₂), B/ĥ, d ĥ and e ĥ, so that A stays positive semidefinite and has no
    extremes but those of the points. The friction of streamers is taken as d − e, exact for ridges along and across.
    Beyond the widest gap what roughness does falls with ĥ², as perturbation theory has it.

    Attributes
    ----------
    points : two or more.
    peak : the highest point of the roughness above its mean, m.
    rms : of its heights, m.
    scale : all lengths across the film are multiplied by it: the table of the surface with its heights multiplied.
    """

    points: Sequence[Point]
    peak: float
    rms: float
    scale: float = 1.0

    def scaled(self, factor: float) -> Self:
        """Of the surface with its heights multiplied."""
        return replace(self, scale=self.scale * factor)

    @property
    def narrowest(self) -> float:
        """ĥ of the first point, m."""
        return self.scale * self.points[0].mean_gap

    @property
    def widest(self) -> float:
        """ĥ of the last point, m."""
        return self.scale * self.points[-1].mean_gap

    @property
    def interpolation_error(self) -> float:
        """The largest seen half-way between points: of A and B, and of d and e where nothing touches."""
        return max(point.missed for point in self.points)

    @property
    def doubt(self) -> float:
        """By which part A₁₁, A₂₂ and B₁ may be off: what interpolation was seen to be, and the worst point's grid."""
        return self.doubt_above(0.0)

    def doubt_above(self, mean_gap: float) -> float:
        """The same where no mean gap is below this, m."""
        above = [point for point in self.points if self.scale * point.mean_gap >= mean_gap]
        below = self.points[: len(self.points) - len(above)][-1:]
        worst, near = 0.0, (*below, *above)
        for point in near:
            a, b = point.factors.pressure, point.factors.shear
            doubt = point.uncertainty
            pairs = ((a[0, 0], doubt.pressure[0, 0]), (a[1, 1], doubt.pressure[1, 1]), (b[0], doubt.shear[0]))
            worst = max([worst, *(float(unsure / abs(value)) for value, unsure in pairs if value != 0)])
        return max(point.missed for point in near) + worst

    def friction_doubt(self, mean_gap: float) -> float:
        """By which part d + 3e may be off at a mean gap, m, as the grid has it; 1 at most."""
        own, unsure = (
            np.array([part.couette + 3 * part.shear_couette for part in parts])
            for parts in zip(*((point.factors, point.uncertainty) for point in self.points), strict=True)
        )
        gaps = [self.scale * point.mean_gap for point in self.points]
        doubts = np.divide(np.minimum(unsure, own), own, out=np.ones_like(own), where=own > 0)
        return float(np.interp(mean_gap, gaps, doubts))

    def __call__(self, mean_gap: Array, /) -> GapFactors:
        """The factors at mean gaps, m, of any shape.

        Raises
        ------
        InputError
            Below the narrowest gap, unless the film is sealed there already, in both directions: then A = B = 0.
        """
        h = np.asarray(mean_gap, dtype=np.float64)
        if h.size and h.min() < self.narrowest * (1 - 1e-12) and not all(self.points[0].factors.sealed):
            raise InputError(
                f"mean gap: got {h.min():.4g} m, below the narrowest in the table, {self.narrowest:.4g} m; "
                "make a table that reaches further"
            )
        inside = np.clip(h, self.narrowest, self.widest)
        share = np.minimum(self.widest / np.maximum(h, self.widest), 1.0) ** 2
        between = self._between(np.log(inside / self.scale))
        far = SMOOTH + (self._last - SMOOTH) * share[..., None]
        row = np.where((h > self.widest)[..., None], far, _uncubed(between))
        along, across, cross, drag, drag_across, couette, shear_couette = np.moveaxis(row, -1, 0)
        return GapFactors(
            along=along * h**3,
            across=across * h**3,
            cross=cross * h**3,
            drag=drag * h,
            drag_across=drag_across * h,
            couette=couette / h,
            shear_couette=shear_couette / h,
            streaming=(couette - shear_couette) / h,
            least=np.maximum(h - self.scale * self.peak, 0.0),
        )

    @cached_property
    def _last(self) -> Array:
        return relative_row(self.points[-1].factors)

    @cached_property
    def _between(self) -> "scipy.interpolate.PchipInterpolator":
        gaps = np.log([point.mean_gap for point in self.points])
        rows = np.array([_cubed(relative_row(point.factors)) for point in self.points])
        known = np.flatnonzero(np.isfinite(rows[:, 2]))
        for row in np.flatnonzero(np.isnan(rows[:, 2])):
            rows[row, 2] = rows[known[np.abs(known - row).argmin()], 2] if known.size else 0.0
        return scipy.interpolate.PchipInterpolator(gaps, rows, axis=0)


def relative_row(factors: FlowFactors) -> Array:
    """A₁₁/ĥ³, A₂₂/ĥ³, A₁₂/ĥ³, B₁/ĥ, B₂/ĥ, d ĥ, e ĥ."""
    own = factors.relative
    a = own.pressure
    return np.array([a[0, 0], a[1, 1], a[0, 1], *own.shear, own.couette, own.shear_couette])


def told_rows(factors: FactorsOverGap, mean_gap: Array) -> Array:
    """The same of what a table or a closed form tells at mean gaps, m, shape (n,): shape (n, 7)."""
    told, h = factors(mean_gap), mean_gap
    columns = (told.along, told.across, told.cross, told.drag, told.drag_across, told.couette, told.shear_couette)
    powers = (3, 3, 3, 1, 1, -1, -1)
    return np.stack([column / h**power for column, power in zip(columns, powers, strict=True)], axis=-1)


def _cubed(row: Array) -> Array:
    """The row with ∛A₁₁/ĥ, ∛A₂₂/ĥ and A₁₂/√(A₁₁A₂₂) in the place of A; the last NaN where nothing tells it."""
    mean = np.sqrt(row[0] * row[1])
    return np.array([np.cbrt(row[0]), np.cbrt(row[1]), row[2] / mean if mean > 0 else np.nan, *row[3:]])


def _uncubed(rows: Array) -> Array:
    """Back from :func:`_cubed`, shape (..., 7)."""
    first, second = rows[..., :1] ** 3, rows[..., 1:2] ** 3
    return np.concatenate([first, second, rows[..., 2:3] * np.sqrt(first * second), rows[..., 3:]], axis=-1)
