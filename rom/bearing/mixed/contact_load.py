"""The load of the asperities of a bearing where its walls touch."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.cavitation.grid import Grid, quarters
from roughfilm.rom.cavitation.shape import Shape


@dataclass(frozen=True, kw_only=True)
class AsperityLoad:
    """The contact of the walls of a film on the control volumes of its grid.

    Attributes
    ----------
    force : ∫ p_c(α) dA of each control volume, shape (nx, ny), N (N/m if infinitely wide).
    pressure_max : maximum contact pressure, Pa.
    area_fraction : fraction of the area of the film in contact.
    """

    force: Array
    pressure_max: float
    area_fraction: float


def asperity_load(shape: Shape, grid: Grid, asperities: Asperities) -> AsperityLoad:
    """Integrate the contact pressure over the control volumes, with one point in each of their quarters.

    Forces are second-order accurate where α is smooth; the points are those of
    :func:`roughfilm.rom.cavitation.grid.quarters`.

    Raises
    ------
    InputError
        If the walls are closer than the asperities are known for.
    """
    force, highest, area = np.zeros(grid.shape), 0.0, 0.0
    for x, y, quarter in quarters(shape, grid):
        separation = shape.thickness(x, y)
        near = separation < asperities.touching
        if shape.idle:
            near &= quarter > 0
        if near.any():
            pressure = asperities.contact_pressure(separation[near])
            force[near] += quarter[near] * pressure
            highest = max(highest, float(pressure.max()))
            area += float((quarter[near] * asperities.area_fraction(separation[near])).sum())
    return AsperityLoad(force=force, pressure_max=highest, area_fraction=area / float(grid.areas.sum()))
