"""The uncertainty of the direction in which a shaft in lobes stands, from that of its place."""

import math
from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.shapes import AnyShape

ASIDE = 0.25
"""Least uncertainty of the direction, rad, over that of the place over the distance from the middle.

The place is a vector, of which the grids may agree in one component by chance.
"""


def with_directions(
    geometry: AnyShape, quantities: Mapping[str, Quantity], uncertainty: Mapping[str, float]
) -> dict[str, float]:
    """The uncertainties with at least ``ASIDE`` δe/e of the attitude angle and of the place of the least film.

    A shaft at the eccentricity e has the uncertainty δe, the length of that of both components. Shapes other than lobes
    have no such place.
    """
    if not isinstance(geometry, Lobes) or "eccentricity_x" not in uncertainty:
        return dict(uncertainty)
    away = quantities["eccentricity"].value
    moved = math.hypot(uncertainty["eccentricity_x"], uncertainty["eccentricity_y"])
    turned = min(ASIDE * moved / away, math.pi) if away > 0 else math.pi
    least = {"attitude_angle": math.degrees(turned)}
    if geometry.lobes == 1 and not any(geometry.misalignment):
        least |= {"film_min_angle": math.degrees(turned), "film_min_x": geometry.radius * turned}
    return {
        name: max(one, least.get(name, 0.0)) if uncertainty["eccentricity_x"] > 0 else one
        for name, one in uncertainty.items()
    }
