"""The temperature and the viscosity of a liquid over its heat, interpolated for the nodes of a film."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.rom.lubricants.liquid import Liquid

SPACING = 0.2
"""Distance of the points of a table, K; the relative error of the viscosity is about 1e-10."""

MARGIN = 0.3
"""Range of a table above the heat that it must contain, over the range of this heat."""

LEAST_MARGIN = 2.0
"""Smallest range of a table above this heat, and its range below, K."""


@dataclass(frozen=True, kw_only=True)
class OverHeat:
    """Cubic Hermite polynomials over the heat e of a volume, J/m³, above that at the supply temperature.

    Attributes
    ----------
    lowest, step : the first point and the distance of the points, J/m³.
    points : T, K, dT/de, η, Pa s, and dη/de at the points, shape (n, 4).
    """

    lowest: float
    step: float
    points: Array

    def contains(self, heat: Array) -> bool:
        """Whether all values lie in the table."""
        return bool(heat.min() >= self.lowest and heat.max() <= self.lowest + self.step * (len(self.points) - 1))

    def __call__(self, heat: Array) -> tuple[Array, Array, Array, Array]:
        """T, dT/de, η and dη/de, each of the shape of ``heat``."""
        temperature, warming, viscosity, thinning = (np.empty_like(heat) for _ in range(4))
        outputs = (one.reshape(-1) for one in (temperature, warming, viscosity, thinning))
        interpolate(heat.reshape(-1), self.lowest, self.step, self.points, *outputs)
        return temperature, warming, viscosity, thinning


def over_heat(liquid: Liquid, heat: Array) -> OverHeat:
    """The table of a liquid that contains given values of the heat, with a margin for those of the next iterations."""
    low, high = float(heat.min()), float(heat.max())
    at_supply = float(liquid.heat(np.array([liquid.temperature]))[1][0])
    least = LEAST_MARGIN * at_supply
    low, high = low - least, high + max(least, MARGIN * (high - low))
    places, step = np.linspace(low, high, 1 + int(np.ceil((high - low) / (SPACING * at_supply))), retstep=True)
    temperature = liquid.temperature_of(places)
    capacity = liquid.heat(temperature)[1]
    viscosity, slope = liquid.viscosity(temperature)
    points = np.column_stack([temperature, 1 / capacity, viscosity, slope / capacity])
    return OverHeat(lowest=low, step=float(step), points=np.ascontiguousarray(points))


@compiled
def interpolate(heat, lowest, step, points, temperature, warming, viscosity, thinning):  # type: ignore[no-untyped-def]
    """Write T, dT/de, η and dη/de of all values."""
    last = points.shape[0] - 2
    for n in range(heat.size):
        place = (heat[n] - lowest) / step
        k = min(max(int(place), 0), last)
        t = place - k
        for column in range(0, 4, 2):
            start, rise = points[k, column], points[k + 1, column] - points[k, column]
            first, second = step * points[k, column + 1], step * points[k + 1, column + 1]
            square, cube = 3.0 * rise - 2.0 * first - second, first + second - 2.0 * rise
            value = start + t * (first + t * (square + t * cube))
            slope = (first + t * (2.0 * square + 3.0 * t * cube)) / step
            if column == 0:
                temperature[n], warming[n] = value, slope
            else:
                viscosity[n], thinning[n] = value, slope
