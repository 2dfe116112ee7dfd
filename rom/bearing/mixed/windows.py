"""Stribeck curves of a bearing whose roughness is known in several windows: all of them on one wall, and each alone."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.windows.average import WindowAverage, window_average
from roughfilm.rom.bearing.mixed.asperities import Asperities, SpotPressures
from roughfilm.rom.bearing.mixed.curves import Wall, resumed_curves, wall_of
from roughfilm.rom.bearing.mixed.stribeck import TEMPERATURES, UNCERTAIN, LiftOff, StribeckCurve, StribeckPoint
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.ladder.model import silent

TABLE, POINTS = "table.h5", "stribeck.h5"
"""Names of the files of a window: its table of the roughness, and the points of its curves."""


@dataclass(frozen=True, kw_only=True)
class CommonPlane:
    """The asperities of several windows on one wall, whose mean planes are in one plane.

    A window is much smaller than the bearing, and the body bends little under the different contact pressures of
    windows beside each other. At a separation α the contact pressure, the contact area, the mean gap and the flow
    factors are the arithmetic means of those of the windows.

    Attributes
    ----------
    walls : the asperities of each window.
    """

    walls: tuple[Asperities, ...]

    @cached_property
    def touching(self) -> float:
        """α at the first contact of any window, m."""
        return max(wall.touching for wall in self.walls)

    @cached_property
    def closest(self) -> float:
        """The smallest α that is known for all windows, m."""
        return max(wall.closest for wall in self.walls)

    @cached_property
    def largest_pressure(self) -> float:
        """The contact pressure at the smallest α, Pa."""
        return float(self.contact_pressure(np.array(self.closest)))

    def __call__(self, separation: Array, /) -> GapFactors:
        """The mean flow factors at separations, m; ``least`` is the smallest gap of all windows."""
        own = [wall(separation) for wall in self.walls]
        means = {
            entry.name: np.mean([getattr(one, entry.name) for one in own], axis=0)
            for entry in fields(GapFactors)
            if entry.name != "least"
        }
        return GapFactors(**means, least=np.min([one.least for one in own], axis=0))

    def contact_pressure(self, separation: Array) -> Array:
        """The mean contact pressure over the nominal area, Pa."""
        return self._mean(lambda wall: wall.contact_pressure(separation))

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap ĥ, m."""
        return self._mean(lambda wall: wall.mean_gap(separation))

    def area_fraction(self, separation: Array) -> Array:
        """The real over the nominal contact area."""
        return self._mean(lambda wall: wall.area_fraction(separation))

    def spot_pressures(self, separation: float) -> SpotPressures:
        """The largest pressures on the spots of any window at a separation, m."""
        own = [wall.spot_pressures(separation) for wall in self.walls]
        return SpotPressures(
            mean=max(one.mean for one in own),
            peak=float(np.fmax.reduce([one.peak for one in own])),
            composite_modulus=min(one.composite_modulus for one in own),
        )

    def factor_uncertainty(self, separation: float) -> float:
        """The mean relative uncertainty of the flow factors."""
        return float(self._mean(lambda wall: np.asarray(wall.factor_uncertainty(separation))))

    def friction_uncertainty(self, separation: float) -> float:
        """The mean relative uncertainty of the friction factor d + 3e."""
        return float(self._mean(lambda wall: np.asarray(wall.friction_uncertainty(separation))))

    def pressure_uncertainty(self, separation: Array) -> Array:
        """The relative uncertainty of the contact pressure: that of each window, weighted by its pressure."""
        pressures = np.array([wall.contact_pressure(separation) for wall in self.walls])
        relative = np.array([wall.pressure_uncertainty(separation) for wall in self.walls])
        whole = pressures.sum(axis=0)
        absolute = np.where(pressures > 0, pressures * relative, 0.0).sum(axis=0)
        return np.asarray(np.divide(absolute, whole, out=np.zeros_like(whole), where=whole > 0))

    def separation_at(self, pressure: float) -> float:
        """The separation α, m, at a contact pressure, Pa; InputError if it is out of range."""
        if not 0 < pressure <= self.largest_pressure:
            raise InputError(
                f"contact pressure: got {pressure:.4g} Pa; it must be above 0 and at most "
                f"{self.largest_pressure:.4g} Pa, at the end of the table of one of the windows"
            )

        def excess(alpha: float) -> float:
            return float(self.contact_pressure(np.array(alpha))) - pressure

        return float(scipy.optimize.brentq(excess, self.closest, self.touching, xtol=1e-15 * abs(self.touching)))

    def _mean(self, of: Callable[[Asperities], Array]) -> Array:
        return np.asarray(np.mean([of(wall) for wall in self.walls], axis=0))


@dataclass(frozen=True, kw_only=True)
class BearingWindow:
    """The Stribeck curves of a bearing whose whole wall repeats one window.

    Attributes
    ----------
    wall : the asperities of the window; None of a bearing without asperities.
    curves : one curve for each load.
    known : number of points that were known before.
    """

    wall: Wall | None
    curves: tuple[StribeckCurve, ...]
    known: int


def window_curves(
    scene: Bearing, directory: Path, speeds: Sequence[float], loads: Sequence[float], resolution: int
) -> BearingWindow:
    """The Stribeck curves of one window; its table and all finished points are kept in its directory.

    Parameters
    ----------
    scene : the bearing with the surface of the window.
    directory : directory of its files.
    speeds, loads : sliding speeds, m/s, and loads over the nominal area, Pa.
    resolution : number of cells along a side.

    Raises
    ------
    InputError
        If a file cannot be read or written, is damaged, or holds something else; if a load cannot be carried.
    ConvergenceError
        If a film does not converge.
    """
    wall = None
    if scene.asperities is not None:
        wall = wall_of(scene, max(loads), None, directory / TABLE, silent, resolution)
    curves, known = resumed_curves(scene, speeds, loads, wall, directory / POINTS, resolution, silent)
    return BearingWindow(wall=wall, curves=curves, known=known)


def common_wall(windows: Sequence[BearingWindow]) -> Wall | None:
    """All windows on one wall; None of a bearing without asperities."""
    walls = [window.wall for window in windows if window.wall is not None]
    if not walls:
        return None
    return Wall(
        asperities=CommonPlane(walls=tuple(wall.asperities for wall in walls)),
        warnings=tuple(dict.fromkeys(warning for wall in walls for warning in wall.warnings)),
        points=sum(wall.points for wall in walls),
        known_points=sum(wall.known_points for wall in walls),
        source={"tables": [dict(wall.source) for wall in walls]},
    )


def curves_of_windows(
    whole: Sequence[StribeckCurve] | None, windows: Sequence[BearingWindow], independent: float
) -> tuple[StribeckCurve, ...]:
    """The curves of a bearing that is as large as very many windows, with their scatter.

    The values are those of the wall with all windows, on which they have a common separation. Without it, as in a
    bearing without asperities, they are the means of the curves of the windows, each of which carries the same load.
    The scatter is the 95 % confidence interval of these means, extended to the difference of both.
    The lift-off speed is the mean of those of the windows: that of the whole wall is that of its highest asperity, and
    grows with the number of windows.

    Parameters
    ----------
    whole : curves of the wall with all windows.
    windows : curves of each window at the same loads.
    independent : effective number of independent windows.
    """
    curves = []
    for number, own in enumerate(zip(*(window.curves for window in windows), strict=True)):
        by_speed = [{point.speed: point for point in curve.points} for curve in own]
        if whole is None:
            shared = [speed for speed in by_speed[0] if all(speed in points for points in by_speed)]
            points = [_mean_point([points[speed] for points in by_speed], independent) for speed in shared]
        else:
            points = [
                with_scatter(point, [points[point.speed] for points in by_speed], independent)
                for point in whole[number].points
            ]
        lift_off = _mean_lift_off([curve.lift_off for curve in own], independent)
        curves.append(StribeckCurve(pressure=own[0].pressure, points=tuple(points), lift_off=lift_off))
    return tuple(curves)


def with_scatter(point: StribeckPoint, own: Sequence[StribeckPoint], independent: float) -> StribeckPoint:
    """A point of the wall with all windows, with the scatter of the points of the windows."""
    averages = _averages(own, independent)
    scatter, intervals = {}, {}
    for name, average in averages.items():
        shift = abs(getattr(point, name) - average.value)
        if average.scatter is not None:
            scatter[name] = average.scatter + shift
        if average.interval is not None:
            intervals[name] = average.interval
    return replace(point, scatter=scatter, window_interval=intervals)


def _mean_point(own: Sequence[StribeckPoint], independent: float) -> StribeckPoint:
    """The mean of the points of the windows at one load and speed, with their scatter."""
    numbers = [entry.name for entry in fields(StribeckPoint) if entry.type is float]
    means: dict[str, Any] = {name: float(np.mean([getattr(point, name) for point in own])) for name in numbers}
    means |= {name: float(np.mean([getattr(point, name) for point in own])) for name in (*_heated(own), *_cooled(own))}
    averages = _averages(own, independent)
    uncertainty = {name: one.uncertainty for name, one in averages.items() if one.uncertainty is not None}
    outside = tuple(dict.fromkeys(reason for point in own for reason in point.outside))
    mean = StribeckPoint(**means, uncertainty=uncertainty, outside=outside, leading=own[0].leading)
    return with_scatter(mean, own, independent)


def _averages(own: Sequence[StribeckPoint], independent: float) -> dict[str, WindowAverage]:
    return {
        name: _average(
            [float(getattr(point, name)) for point in own], [point.uncertainty.get(name) for point in own], independent
        )
        for name in (*UNCERTAIN, *_heated(own))
    }


def _heated(own: Sequence[StribeckPoint]) -> tuple[str, ...]:
    """The names of the temperatures of points that have them."""
    return TEMPERATURES if all(point.temperature is not None for point in own) else ()


def _cooled(own: Sequence[StribeckPoint]) -> tuple[str, ...]:
    """The name of the heat transfer that is estimated, of points that have a temperature."""
    return ("estimated_heat_transfer",) if _heated(own) else ()


def _average(values: Sequence[float], uncertainties: Sequence[float | None], independent: float) -> WindowAverage:
    """The mean over the windows; by logarithms if all values are 0 or more."""
    return window_average(values, uncertainties, independent=independent, positive=min(values) >= 0)


def _mean_lift_off(own: Sequence[LiftOff], independent: float) -> LiftOff:
    """The mean lift-off speed; unknown if a window does not lift off."""
    if not all(math.isfinite(one.speed) for one in own):
        return LiftOff(speed=math.nan, uncertainty=math.nan)
    found = _average([one.speed for one in own], [one.uncertainty for one in own], independent)
    uncertainty = math.inf if found.uncertainty is None else found.uncertainty
    return LiftOff(speed=found.value, uncertainty=uncertainty, scatter=found.scatter, window_interval=found.interval)
