"""Speeds and friction of Stribeck curves in words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from roughfilm.rom.bearing.flash import FlashTemperature, flash_warnings
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve, StribeckPoint
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.average import rounded
from roughfilm.words.numbers import with_error
from roughfilm.words.outside import outside_in_words, outside_of_series


@dataclass(frozen=True, kw_only=True)
class SpeedScale:
    """The unit in which speeds are shown, and the factor from m/s."""

    unit: str
    factor: float


def speed_scale(scene: Bearing) -> SpeedScale:
    """The scale of speeds of a bearing: rpm where something turns, else m/s."""
    radius = scene.turning_radius
    if radius is None:
        return SpeedScale(unit="m/s", factor=1.0)
    return SpeedScale(unit="rpm", factor=60 / (2 * math.pi * radius))


def lift_off(curve: StribeckCurve, scale: SpeedScale, *, named: bool = True) -> str:
    """The speed above which the film carries the whole load, with its uncertainty and, if ``named``, its unit."""
    speed, uncertainty = scale.factor * curve.lift_off.speed, scale.factor * curve.lift_off.uncertainty
    if math.isnan(speed):
        return "not reached"
    text = with_error(speed, uncertainty)
    if named and curve.lift_off.scatter is not None:
        text += f" ± {lift_off_scatter(curve, scale)} (windows)"
    return f"{text} {scale.unit}" if named else text


def own_point(scene: Bearing, curve: StribeckCurve) -> StribeckPoint | None:
    """The point of a curve at the speed of the scene; None if the curve does not have it."""
    speed = abs(scene.motion.speed)
    return next((point for point in curve.points if math.isclose(point.speed, speed, rel_tol=1e-9)), None)


def number_of(point: StribeckPoint, name: str, factor: float = 1.0, *, lines: bool = False) -> str:
    """A number of a point times a factor, with its uncertainty, which may be unknown.

    The scatter of a mean over windows, which may be unknown too, stands behind it; with ``lines`` on the next line.
    """
    text = with_error(factor * getattr(point, name), factor * point.uncertainty.get(name, math.inf))
    if point.scatter:
        scatter = scatter_of(point, name, factor)
        text += f"\n± {scatter}" if lines else f" ± {scatter} (windows)"
    return text.replace("-", "−")


def scatter_of(point: StribeckPoint, name: str, factor: float = 1.0) -> str:
    """The scatter of a number of a point over windows times a factor; "?" if it is unknown."""
    scatter = point.scatter.get(name)
    return rounded(None if scatter is None else factor * scatter, factor * getattr(point, name))


def lift_off_scatter(curve: StribeckCurve, scale: SpeedScale) -> str:
    """The scatter of the lift-off speed over windows, without its unit; "?" if it is unknown."""
    scatter = curve.lift_off.scatter
    return rounded(None if scatter is None else scale.factor * scatter, scale.factor * curve.lift_off.speed)


def hottest_spots(points: Sequence[StribeckPoint]) -> tuple[StribeckPoint, FlashTemperature] | None:
    """The point with the greatest flash temperature, and that; None of points without an estimate of it."""
    some = [(point, flash) for point in points if (flash := point.flash) is not None]
    return max(some, key=lambda one: one[1].mean, default=None)


def flash_of(point: StribeckPoint) -> str:
    """The flash temperature of a point, K above the walls, and its range below it; "–" without contact, 0 at rest."""
    flash = point.flash
    if flash is None or flash.high == 0:
        return "–" if flash is None else "0"
    return f"{flash.mean:.3g}\n{flash.low:.3g} to {flash.high:.3g}"


def flash_words(curve: StribeckCurve) -> str:
    """The greatest flash temperature of a curve, K above the walls, with its range; "" without an estimate."""
    found = hottest_spots(curve.points)
    return "" if found is None else f"{found[1].mean:.3g} ({found[1].low:.3g} to {found[1].high:.3g})"


def flash_warnings_of(scene: Bearing, points: Sequence[StribeckPoint]) -> list[str]:
    """Warnings about flash temperatures out of range, at the hottest spots and at the largest contact pressure."""
    some = [point for point in points if point.flash_temperature]
    chosen = [hottest_spots(some), hottest_spots(sorted(some, key=lambda point: point.contact_pressure_max)[-1:])]
    found = [flash_warnings(scene, one[0].contact_pressure_max, one[1]) for one in chosen if one is not None]
    return list(dict.fromkeys(warning for warnings in found for warning in warnings))


def outside_warnings(scene: Bearing, curves: Sequence[StribeckCurve]) -> list[str]:
    """A warning for each load with points outside the range of the model."""
    scale = speed_scale(scene)
    found = {
        curve.pressure: outside_of_series(
            [(f"{scale.factor * point.speed:.4g} {scale.unit}", point.outside) for point in curve.points]
        )
        for curve in curves
    }
    return [f"{pressure / 1e6:g} MPa: {words}" for pressure, words in found.items() if words]


def at_own_speed(scene: Bearing, curves: Sequence[StribeckCurve]) -> list[str]:
    """The friction coefficient at the speed of the scene, under each load whose curve has it."""
    scale, found = speed_scale(scene), {curve.pressure: own_point(scene, curve) for curve in curves}
    return [
        f"{(beyond := outside_in_words(point.outside)) and f'{beyond}; '}"
        f"friction coefficient {number_of(point, 'friction_coefficient')} at {scale.factor * point.speed:.4g} "
        f"{scale.unit} under {pressure / 1e6:.4g} MPa"
        for pressure, point in found.items()
        if point is not None
    ]
