"""Model surface similar to that of Fig. E.4 of Paper E, which is loaded, unloaded, and loaded again."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import Solid, composite_modulus

STEEL = Solid(modulus=210e9, poisson=0.3, hardness=5e9)
LENGTH = 1e-3
POINTS = 512
LOADS = (50e6, 100e6, 400e6, 800e6)
"""Mean pressures, Pa."""

HEIGHT = 80e-6
WAVES = ((1, 0.3, 0.4), (3, 1.0, 0.1), (7, 0.35, 0.62), (16, 0.07, 0.2))
"""Number of waves in the length, amplitude over the largest one, and phase over 2π."""

CONTACT_TOLERANCE = 1e-9


@dataclass(frozen=True, kw_only=True)
class Reloading:
    """The comparison of the first loading with the elastic reloading of the flattened surface under the same load.

    Attributes
    ----------
    load : mean pressure, Pa.
    pressure : largest difference of the pressures, over H.
    heights : largest difference of the loaded surfaces, over the total height of the surface.
    highest : largest pressure of the reloading, over H.
    """

    load: float
    pressure: float
    heights: float
    highest: float


def model_heights(points: int = POINTS) -> Array:
    """Return the heights of the model surface, m, shape (points, 1); the lowest node is at 0."""
    x = np.arange(points) / points
    z = sum(part * np.cos(2 * np.pi * (waves * x - phase)) for waves, part, phase in WAVES)
    z = np.asarray(z)[:, None]
    return np.asarray((z - z.min()) * (HEIGHT / np.ptp(z)))


def load_model(points: int = POINTS, loads: Sequence[float] = LOADS) -> list[Contact]:
    """Return the contacts of the model surface under mean pressures, Pa."""
    z = model_heights(points)
    press = Press(z, (LENGTH / points, LENGTH / points), composite_modulus(STEEL), hardness=STEEL.hardness)
    return [press.at(load, tolerance=CONTACT_TOLERANCE) for load in loads]


def reload(first: Contact) -> Reloading:
    """Press the unloaded surface again under the same load, without a limit of the pressure."""
    press = Press(first.unloaded_heights, first.spacing, composite_modulus(STEEL))
    again = press.at(first.load, tolerance=CONTACT_TOLERANCE)
    return Reloading(
        load=first.load,
        pressure=float(np.abs(again.pressure - first.pressure).max()) / first.hardness,
        heights=float(np.abs(again.loaded_heights - first.loaded_heights).max()) / float(np.ptp(first.heights)),
        highest=float(again.pressure.max()) / first.hardness,
    )
