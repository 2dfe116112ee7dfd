"""Flow factors over the mean gap: points, interpolation between them and extrapolation to thick films."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf, log, nan, sqrt
from typing import Any, Self

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, finite_arithmetic
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.factors import FactorScatter, FlowFactors
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

PLACE = "flow factors"
"""What computes, for the messages of errors."""

SMOOTH_ROW = np.array([1.0, 1, 0, 1, 0, 1, 0])
"""The :func:`relative_row` of a smooth film."""

COEFFICIENTS = (
    "along",
    "across",
    "cross",
    "drag",
    "drag_across",
    "couette",
    "shear_couette",
    "streaming",
    "least",
)
"""The attributes of :class:`GapFactors` in the order of :func:`relative_row`, and the two that follow from them."""

UNKNOWN_SLOPES = np.full(SMOOTH_ROW.size, np.nan)
"""The slopes of a point where they are unknown."""


@dataclass(frozen=True, kw_only=True)
class Point:
    """Flow factors at one separation.

    Attributes
    ----------
    separation : distance of the mean planes of the undeformed walls, m.
    contact : fraction of the surface where the gap is closed.
    factors, uncertainty, unsolved, iterations, residual : those of
        :class:`roughfilm.rom.homogenization.flow_factors.Estimated`.
    cpu_s : CPU time, s.
    load : mean pressure on the nominal area, Pa; 0 for undeformed walls.
    area_fraction, plastic_fraction : those of :class:`roughfilm.contact.mechanics.contact.Contact`.
    peak_pressure : largest contact pressure, Pa; NaN where it is unknown, as in tables of older versions.
    separation_uncertainty : discretisation uncertainty of the separation at the load, m.
    missed, friction_missed : estimated interpolation errors of A and B and of d and e next to here, in the measure of
        the tolerance of :func:`roughfilm.rom.homogenization.table.tabulate.tabulate`.
    separation_missed : that of the separation at the load, over the rms height.
    slopes : derivatives of :func:`relative_row` with respect to ln ĥ, shape (7,); NaN where they are unknown, as under
        load, and for d and e where the gap is closed anywhere.
    scatter : scatter of the factors, if they are means over windows, else None.
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
    peak_pressure: float = nan
    separation_uncertainty: float = 0.0
    missed: float = 0.0
    friction_missed: float = 0.0
    separation_missed: float = 0.0
    slopes: Array = field(default_factory=UNKNOWN_SLOPES.copy)
    scatter: FactorScatter | None = None

    @property
    def mean_gap(self) -> float:
        """ĥ, m."""
        return self.factors.mean_gap


@dataclass(frozen=True, kw_only=True)
class FactorTable:
    """Points in order of their mean gaps ĥ, with piecewise cubic interpolation between them.

    The table interpolates ∛A₁₁ and ∛A₂₂ over ĥ, and A₁₂/√(A₁₁A₂₂), B/ĥ, d ĥ and e ĥ over ln ĥ, by Hermite's cubics
    with the slopes of the points, or those of Fritsch and Carlson where the slopes are unknown. A is positive
    semidefinite, and A₁₁ and A₂₂ have no extrema except at points (slopes are limited as by Fritsch and Carlson). The
    friction of streamers is d − e, exact for ridges along and across the sliding. Above the widest gap the effect of
    roughness decreases as ĥ⁻², the limit of perturbation theory.

    Attributes
    ----------
    points : two or more points.
    peak : highest point of the roughness above its mean, m.
    rms : rms height, m.
    composite_modulus : E* of the solids in contact, Pa; infinite without contact.
    scale : factor that multiplies the heights of the surface and all gaps.
    origin : entries for the provenance of a result; empty for a table that was not made for the result.
    """

    points: Sequence[Point]
    peak: float
    rms: float
    composite_modulus: float = inf
    scale: float = 1.0
    origin: Mapping[str, Any] = field(default_factory=dict, compare=False)

    def scaled(self, factor: float) -> Self:
        """The table of the surface with its heights multiplied by ``factor``."""
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
        """The largest interpolation error between points: of A and B, and without contact of d and e."""
        return max(max(point.missed, 0.0 if point.contact > 0 else point.friction_missed) for point in self.points)

    @property
    def relative_uncertainty(self) -> float:
        """The relative uncertainty of A₁₁, A₂₂ and B₁: interpolation plus discretisation of the worst point."""
        return self.relative_uncertainty_above(0.0)

    def relative_uncertainty_above(self, mean_gap: float) -> float:
        """The relative uncertainty of A₁₁, A₂₂ and B₁ at mean gaps above this one, m."""
        above = [point for point in self.points if self.scale * point.mean_gap >= mean_gap]
        below = self.points[: len(self.points) - len(above)][-1:]
        worst, near = 0.0, (*below, *above)
        for point in near:
            (a, b), (da, db) = ((one.pressure, one.shear) for one in (point.factors, point.uncertainty))
            pairs = ((a[0, 0], da[0, 0]), (a[1, 1], da[1, 1]), (b[0], db[0]))
            worst = max([worst, *(float(uncertainty / abs(value)) for value, uncertainty in pairs if value != 0)])
        return max(point.missed for point in near) + worst

    def scatter_above(self, mean_gap: float) -> float | None:
        """The relative scatter of the mean A₁₁, A₂₂ and B₁ over windows at mean gaps above this one, m.

        It is 0 for a table of one surface, and None if it is unknown at a point.
        """
        worst = 0.0
        for point in self.points:
            if point.scatter is None or self.scale * point.mean_gap < mean_gap:
                continue
            (a, b), (da, db) = ((one.pressure, one.shear) for one in (point.factors, point.scatter.mean))
            pairs = ((a[0, 0], da[0, 0]), (a[1, 1], da[1, 1]), (b[0], db[0]))
            relative = [float(half / abs(value)) for value, half in pairs if value != 0]
            if not np.isfinite(relative).all():
                return None
            worst = max([worst, *relative])
        return worst

    def friction_uncertainty(self, mean_gap: float) -> float:
        """The relative uncertainty of d + 3e at a mean gap, m, interpolation plus discretisation; at most 1."""
        own, uncertainty = (
            np.array([part.couette + 3 * part.shear_couette for part in parts])
            for parts in zip(*((point.factors, point.uncertainty) for point in self.points), strict=True)
        )
        relative = np.divide(uncertainty, own, out=np.ones_like(own), where=own > 0)
        relative += [point.friction_missed for point in self.points]
        return float(np.interp(mean_gap, self.scale * self._knots, np.minimum(relative, 1.0)))

    def __call__(self, mean_gap: Array, /) -> GapFactors:
        """The factors at mean gaps, m, of any shape; A = B = 0 below a narrowest gap that is sealed both ways.

        Raises
        ------
        InputError
            If a mean gap is below the narrowest one, and the surface is not sealed there in both directions.
        """
        h = np.asarray(mean_gap, dtype=np.float64)
        if h.size and h.min() < self.narrowest * (1 - 1e-12) and not all(self.points[0].factors.sealed):
            raise InputError(
                f"mean gap: got {h.min():.4g} m, below the narrowest in the table, {self.narrowest:.4g} m; "
                "make a table that reaches further"
            )
        found = np.empty((len(COEFFICIENTS), h.size))
        knots, roots, others = self._knots, self._roots.c, self._others.c
        _set_factors(h.ravel(), self.scale, self.peak, knots, np.log(knots), roots, others, self._last, found)
        return GapFactors(**{name: one.reshape(h.shape) for name, one in zip(COEFFICIENTS, found, strict=True)})

    @cached_property
    def _last(self) -> Array:
        return relative_row(self.points[-1].factors)

    @cached_property
    def _knots(self) -> Array:
        """The mean gaps, m, shape (n,)."""
        return np.array([point.mean_gap for point in self.points])

    @cached_property
    def _rows(self) -> tuple[Array, Array]:
        """The numbers of :func:`relative_row` and their slopes, shape (n, 7)."""
        with finite_arithmetic(PLACE):
            rows = np.array([relative_row(point.factors) for point in self.points])
        return rows, np.array([point.slopes for point in self.points])

    @cached_property
    def _roots(self) -> "scipy.interpolate.CubicHermiteSpline":
        """∛A₁₁ and ∛A₂₂, m, over ĥ, m."""
        rows, slopes = (part[:, :2] for part in self._rows)
        with finite_arithmetic(PLACE):
            relative = np.divide(slopes, rows, out=np.full(rows.shape, np.nan), where=rows > 0)
            values = self._knots[:, None] * np.cbrt(rows)
            return _hermite(self._knots, values, np.cbrt(rows) * (1 + relative / 3), limited=True)

    @cached_property
    def _others(self) -> "scipy.interpolate.CubicHermiteSpline":
        """A₁₂/√(A₁₁A₂₂), B₁/ĥ, B₂/ĥ, d ĥ and e ĥ over ln ĥ; the first is that of the nearest point where A is 0."""
        rows, slopes = self._rows
        with finite_arithmetic(PLACE):
            values, changes = rows[:, 2:].copy(), slopes[:, 2:].copy()
            mean = np.sqrt(np.maximum(rows[:, 0] * rows[:, 1], 0.0))
            known = np.flatnonzero(mean > 0)
            if known.size:
                nearest = known[np.abs(known - np.arange(mean.size)[:, None]).argmin(axis=1)]
                values[:, 0] = rows[nearest, 2] / mean[nearest]
                relative = (slopes[known, :2] / rows[known, :2]).mean(axis=1)
                changes[known, 0] = slopes[known, 2] / mean[known] - values[known, 0] * relative
            changes[mean == 0, 0] = 0.0
            return _hermite(np.log(self._knots), values, changes, limited=False)


def _hermite(places: Array, values: Array, slopes: Array, *, limited: bool) -> "scipy.interpolate.CubicHermiteSpline":
    """The piecewise cubic of values and slopes, shape (n, m); unknown slopes (NaN) are those of Fritsch and Carlson.

    Limited slopes have the sign of the secants on both sides, and at most three times their size: then the cubic is
    monotone between points (Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246).
    """
    monotone = scipy.interpolate.PchipInterpolator(places, values, axis=0)(places, 1)
    slopes = np.where(np.isfinite(slopes), slopes, monotone)
    if limited:
        secants = np.diff(values, axis=0) / np.diff(places)[:, None]
        before, after = np.vstack([secants[:1], secants]), np.vstack([secants, secants[-1:]])
        bound = np.where(before * after > 0, 3 * np.minimum(np.abs(before), np.abs(after)), 0.0)
        slopes = np.sign(after) * np.clip(np.sign(after) * slopes, 0.0, bound)
    return scipy.interpolate.CubicHermiteSpline(places, values, slopes, axis=0)


def relative_row(factors: FlowFactors) -> Array:
    """The numbers A₁₁/ĥ³, A₂₂/ĥ³, A₁₂/ĥ³, B₁/ĥ, B₂/ĥ, d ĥ, e ĥ of the factors."""
    own = factors.relative
    a = own.pressure
    return np.array([a[0, 0], a[1, 1], a[0, 1], *own.shear, own.couette, own.shear_couette])


def relative_rows(factors: FactorsOverGap, mean_gap: Array) -> Array:
    """The numbers of :func:`relative_row` at mean gaps ĥ, m, shape (n,), of a table or a closed form; shape (n, 7)."""
    own, h = factors(mean_gap), mean_gap
    columns = (own.along, own.across, own.cross, own.drag, own.drag_across, own.couette, own.shear_couette)
    powers = (3, 3, 3, 1, 1, -1, -1)
    return np.stack([column / h**power for column, power in zip(columns, powers, strict=True)], axis=-1)


@compiled
def _set_factors(mean_gap, scale, peak, knots, logs, roots, others, last, found):  # type: ignore[no-untyped-def]
    """The ``COEFFICIENTS`` at mean gaps, shape (9, n), from the cubics of ∛A and of the other numbers."""
    end = knots.size - 1
    for i in range(mean_gap.size):
        h = mean_gap[i]
        x = min(max(h / scale, knots[0]), knots[end])
        low, high = np.int64(0), end
        while high - low > 1:
            middle = (low + high) // 2
            if knots[middle] <= x:
                low = middle
            else:
                high = middle
        step = x - knots[low]
        for k in range(2):
            root = ((roots[0, low, k] * step + roots[1, low, k]) * step + roots[2, low, k]) * step + roots[3, low, k]
            found[k, i] = (root / x) ** 3
        step = log(x) - logs[low]
        for k in range(5):
            found[2 + k, i] = (
                (others[0, low, k] * step + others[1, low, k]) * step + others[2, low, k]
            ) * step + others[3, low, k]
        found[2, i] = min(max(found[2, i], -1.0), 1.0) * sqrt(found[0, i] * found[1, i])
        if h > scale * knots[end]:
            decay = (scale * knots[end] / h) ** 2
            for k in range(7):
                smooth = 1.0 if k < 2 or k == 3 or k == 5 else 0.0
                found[k, i] = smooth + (last[k] - smooth) * decay
        for k in range(3):
            found[k, i] *= h * h * h
        for k in range(3, 5):
            found[k, i] *= h
        for k in range(5, 7):
            found[k, i] /= h
        found[7, i] = found[5, i] - found[6, i]
        found[8, i] = max(h - scale * peak, 0.0)
