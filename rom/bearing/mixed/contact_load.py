"""The load of the asperities of a bearing where its walls touch."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.cavitation.grid import Grid
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

    Quarters lie inside cells, so that steps at nodes are exact. Forces are second-order accurate where α is smooth.

    Raises
    ------
    InputError
        If the walls are closer than the asperities are known for.
    """
    force, highest, area = np.zeros(grid.shape), 0.0, 0.0
    for separation, quarter in quarters(shape, grid):
        near = separation < asperities.touching
        if near.any():
            pressure = asperities.contact_pressure(separation[near])
            force[near] += quarter[near] * pressure
            highest = max(highest, float(pressure.max()))
            area += float((quarter[near] * asperities.area_fraction(separation[near])).sum())
    return AsperityLoad(force=force, pressure_max=highest, area_fraction=area / float(grid.areas.sum()))


def quarters(shape: Shape, grid: Grid) -> Iterator[tuple[Array, Array]]:
    """The separation at the centres of the quarters of the control volumes, m, and their areas.

    Control volumes of an infinitely wide film are divided into halves.
    """
    for x, length_x in _halves(grid.x, grid.spacing_x):
        for y, length_y in [(grid.y, grid.volume_y)] if shape.wide else _halves(grid.y, grid.spacing_y):
            area = length_x[:, None] * length_y * (y if shape.polar else 1.0)
            yield shape.thickness(*np.broadcast_arrays(x[:, None], y)), np.broadcast_to(area, grid.shape)


def _halves(places: Array, spacing: Array) -> Iterator[tuple[Array, Array]]:
    """The centres and lengths of the halves of the control volumes before and behind the nodes."""
    before = np.append(spacing[-1], spacing[:-1])
    yield places - before / 4, before / 2
    yield places + spacing / 4, spacing / 2
