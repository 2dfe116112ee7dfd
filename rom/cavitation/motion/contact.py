"""The contact of the walls of a film that moves, by a law of the contact pressure over their separation."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughfilm.contact.foundation.arrays import Array

DIFFERENCE = 1e-5
"""Change of the separation over the approach from first contact, for the derivative of the contact pressure."""


class ContactLaw(Protocol):
    """The contact pressure of two rough walls over their separation."""

    @property
    def touching(self) -> float:
        """The separation at first contact, m."""
        ...

    @property
    def closest(self) -> float:
        """The smallest known separation, m."""
        ...

    def contact_pressure(self, separation: Array) -> Array:
        """The contact pressure, Pa: 0 without contact, strictly falling in contact."""
        ...

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap, m: the volume between the walls over the area."""
        ...


@dataclass(frozen=True, kw_only=True)
class ContactForce:
    """The forces of a contact on the coordinates of a wall.

    Attributes
    ----------
    force : ∫ p_c ∂h/∂q dA of each coordinate, N (N m of an angle; per width if infinitely wide).
    stiffness : -∂F/∂q, shape (coordinates, coordinates), N/m.
    sizes : ∫ p_c |∂h/∂q| dA of each coordinate.
    """

    force: Array
    stiffness: Array
    sizes: Array


def contact_force(law: ContactLaw, separation: Array, modes: Array, weights: Array) -> ContactForce:
    """The forces of the contact pressure at points, and their derivatives by the coordinates.

    Parameters
    ----------
    separation : separation at each point, m.
    modes : its derivative by each coordinate, shape (points, coordinates).
    weights : force on each coordinate by a pressure at each point, m², of the same shape.

    Raises
    ------
    InputError
        If a separation is below the smallest known one.
    """
    near = separation < law.touching
    alpha, n, weight = separation[near], modes[near], weights[near]
    pressure = law.contact_pressure(alpha)
    step = DIFFERENCE * (law.touching - alpha)
    below, above = np.maximum(alpha - step, law.closest), alpha + step
    slope = (law.contact_pressure(below) - law.contact_pressure(above)) / (above - below)
    return ContactForce(
        force=pressure @ weight, stiffness=weight.T @ (slope[:, None] * n), sizes=pressure @ np.abs(weight)
    )
