"""What a statistical model tells of a rough contact under one load, and how far to trust it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Contact under one load, from statistics of the surface instead of its shape.

    Attributes
    ----------
    load : P, mean pressure over the nominal area, Pa.
    area_fraction : A/A0, real over nominal area.
    plastic_fraction : part of the nominal area at the hardness; 0 without a hardness.
    mean_gap : m, from the mean height of the surface under load to the plane; None where the model has none.
    pressure_density : f(p), 1/Pa, of shape to shape: the part of the nominal area with pressures p ... p + dp is f dp.
        Its integral is the area that is not plastic. None where no area is.
    trusted : whether this load and surface lie in the range of validity.
    range_of_validity : in words.
    cannot_say : what the model leaves out or does not know, in words.
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
        """P A0/A, mean pressure where there is contact, Pa; inf if there is none to double precision."""
        return self.load / self.area_fraction if self.area_fraction else np.inf

    @property
    def plasticity_index(self) -> float:
        """Plastic over real area; 0 without contact."""
        return self.plastic_fraction / self.area_fraction if self.area_fraction else 0.0
