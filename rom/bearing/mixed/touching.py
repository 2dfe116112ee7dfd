"""What the asperities of a bearing carry where its walls are closer than their highest points."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.shape import Shape


@dataclass(frozen=True, kw_only=True)
class Touching:
    """Contact of a film's walls, over the control volumes of its grid.

    Attributes
    ----------
    force : ∫ p_c(α) dA of every control volume, shape (nx, ny), N (N/m if the film is infinitely wide).
    pressure_max : Pa.
    area_fraction : the part of the film's area that touches.
    """

    force: Array
    pressure_max: float
    area_fraction: float


def touching(shape: Shape, grid: Grid, asperities: Asperities) -> Touching:
    """Contact pressures of the separations in the middles of each volume's quarters.

    Quarters lie inside cells, so that steps at nodes are exact; where α varies smoothly forces are of second order.

    Raises
    ------
    InputError
        Where walls are closer than the asperities are known for.
    """
    force, most, area = np.zeros(grid.shape), 0.0, 0.0
    for separation, quarter in quarters(shape, grid):
        near = separation < asperities.touching
        if near.any():
            pressure = asperities.contact_pressure(separation[near])
            force[near] += quarter[near] * pressure
            most = max(most, float(pressure.max()))
            area += float((quarter[near] * asperities.area_fraction(separation[near])).sum())
    return Touching(force=force, pressure_max=most, area_fraction=area / float(grid.areas.sum()))


def quarters(shape: Shape, grid: Grid) -> Iterator[tuple[Array, Array]]:
    """The separation in the middle of each quarter of the control volumes, m, and its area; halves of a wide film."""
    for x, share_x in _halves(grid.x, grid.spacing_x):
        for y, share_y in [(grid.y, grid.volume_y)] if shape.wide else _halves(grid.y, grid.spacing_y):
            area = share_x[:, None] * share_y * (y if shape.polar else 1.0)
            yield shape.thickness(*np.broadcast_arrays(x[:, None], y)), np.broadcast_to(area, grid.shape)


def _halves(places: Array, spacing: Array) -> Iterator[tuple[Array, Array]]:
    """Middles and lengths of what lies before and behind each node within its control volume."""
    before = np.append(spacing[-1], spacing[:-1])
    yield places - before / 4, before / 2
    yield places + spacing / 4, spacing / 2
