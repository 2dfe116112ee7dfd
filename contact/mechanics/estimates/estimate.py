"""The result of a statistical contact model at one load, with its range of validity."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Contact at one load, estimated from statistics of the surface.

    Attributes
    ----------
    load : P, mean pressure over the nominal area, Pa.
    area_fraction : A/A0, real over nominal contact area.
    plastic_fraction : plastic over nominal area; 0 without a hardness.
    mean_gap : distance from the mean height of the loaded surface to the plane, m; None if the model does not give it.
    pressure_density : function f(p), 1/Pa, for p, Pa, of any shape: the fraction f dp of the nominal area has pressures
        p ... p + dp. Its integral is the elastic area fraction. None if all contact is plastic.
    trusted : whether load and surface lie in the range of validity.
    range_of_validity : description of the range.
    cannot_say : description of the effects and quantities that the model omits.
    """

    load: float
    area_fraction: float
    plastic_fraction: float
    mean_gap: float | None
    pressure_density: Callable[[ArrayLike], Array] | None
    trusted: bool
    range_of_validity: str
    cannot_say: str

    @property
    def mean_contact_pressure(self) -> float:
        """Mean pressure in contact, P A0/A, Pa; infinite if the area fraction underflows to 0."""
        return self.load / self.area_fraction if self.area_fraction else np.inf

    @property
    def plasticity_index(self) -> float:
        """Plastic over real contact area; 0 without contact."""
        return self.plastic_fraction / self.area_fraction if self.area_fraction else 0.0
