"""The body that moves on a film: its mass, its unbalance, and where it starts."""

from typing import Annotated

from pydantic import BeforeValidator, Field

from roughfilm.contact.foundation.entries import InUnit, Length, Part, plain_number

Number = Annotated[float, BeforeValidator(plain_number)]
Velocity = Annotated[float, InUnit("m/s", any_sign=True)]


class Start(Part):
    """Where a march begins; by default in equilibrium with the first load, at rest.

    Attributes
    ----------
    eccentricity : position of a shaft in lobes along x and y over the clearance.
    film : least film thickness of other bearings, m.
    velocity : velocity of the shaft along x and y, or at which the walls part, m/s.
    """

    eccentricity: tuple[Number, Number] | None = None
    film: Length | None = None
    velocity: Annotated[tuple[Velocity, ...], Field(min_length=1, max_length=2)] | None = None


class Body(Part):
    """The body that the film carries: M q̈ = F + W(t), with the load W, which includes its weight.

    Attributes
    ----------
    mass : mass that the bearing carries, kg; without it the forces balance at all times.
    unbalance : mass times its distance from the axis, of a shaft in lobes, kg m; at the first time it lies along x.
    start : where a march begins.
    """

    mass: Annotated[float, InUnit("kg")] | None = None
    unbalance: Annotated[float, InUnit("kg*m")] | None = None
    start: Start | None = None
