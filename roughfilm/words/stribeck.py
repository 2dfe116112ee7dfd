"""Speeds of Stribeck curves in their unit."""

import math
from dataclasses import dataclass

from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.numbers import with_error


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
    return f"{with_error(speed, uncertainty)} {scale.unit}" if named else with_error(speed, uncertainty)
