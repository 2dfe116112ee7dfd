"""Temperatures of a series of films in words: outside of the range of the lubricant, and the input behind them."""

from collections.abc import Sequence
from typing import Protocol

from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.leading import leading_in_series
from roughfilm.words.numbers import digits
from roughfilm.words.stribeck import speed_scale


class HeatedPoint(Protocol):
    """A film at a speed under a load."""

    @property
    def pressure(self) -> float:
        """The load over the nominal area, Pa."""
        ...

    @property
    def speed(self) -> float:
        """The sliding speed, m/s."""
        ...

    @property
    def temperature(self) -> float | None:
        """The temperature of the film, °C; None of a lubricant without one."""
        ...

    @property
    def estimated_heat_transfer(self) -> float | None:
        """The heat transfer to the surroundings that is estimated, W/K."""
        ...

    @property
    def leading(self) -> str:
        """The input on which the temperature depends most, in words; "" if there is none."""
        ...


def heat_warnings(scene: Bearing, points: Sequence[HeatedPoint], places: str) -> list[str]:
    """Warnings about films too hot for the law of the viscosity, heat left out, and the inputs that lead.

    Of the points whose heat transfer is known, or is not needed, that nearest to the speed of the scene is named.

    Parameters
    ----------
    places : the points in words, such as "speeds".
    """
    degrees = [point.temperature for point in points if point.temperature is not None]
    lubricant, scale, own = scene.lubricant, speed_scale(scene), abs(scene.motion.speed)
    if not degrees:
        return lubricant.left_out_heat
    transfers = [point.estimated_heat_transfer or 0.0 for point in points]
    leading = [
        (f"at {digits(scale.factor * one.speed)} {scale.unit} under {one.pressure / 1e6:.4g} MPa", one.leading)
        for one in sorted(points, key=lambda point: abs(point.speed - own))
        if not one.estimated_heat_transfer
    ]
    return [*lubricant.hot(max(degrees) + ZERO_CELSIUS), *leading_in_series(transfers, places, leading)]
