"""The gap of a contact on a grid coarse enough to be drawn."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact

MOST_POINTS = 256
"""Points along a side; of a finer surface every second, third ... point is kept."""


@dataclass(frozen=True, kw_only=True)
class GapMap:
    """The gap of a contact at some of its points.

    Attributes
    ----------
    gap : shape (nx, ny), m.
    spacing : (dx, dy) of these points, m.
    relief : from the lowest to the highest point of the undeformed surface, m; 1 for a flat one.
    load : mean pressure, Pa.
    area_fraction : contact area over the nominal area.
    """

    gap: Array
    spacing: tuple[float, float]
    relief: float
    load: float
    area_fraction: float


def gap_map(contact: Contact) -> GapMap:
    """The gap of a contact with at most ``MOST_POINTS`` points along a side."""
    step = max(1, -(-max(contact.gap.shape) // MOST_POINTS))
    dx, dy = contact.spacing
    return GapMap(
        gap=contact.gap[::step, ::step].copy(),
        spacing=(step * dx, step * dy),
        relief=float(np.ptp(contact.heights)) or 1.0,
        load=contact.load,
        area_fraction=contact.area_fraction,
    )
