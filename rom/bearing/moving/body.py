"""The body that moves on a film: its mass, its unbalance, and where it starts."""

from typing import Annotated

from pydantic import BeforeValidator, Field

from roughfilm.contact.foundation.entries import Angle, InUnit, Length, Part, plain_number

Number = Annotated[float, BeforeValidator(plain_number)]
Velocity = Annotated[float, InUnit("m/s", any_sign=True)]
Inertia = Annotated[float, InUnit("kg*m^2")]


def _about_both_axes(given: object) -> object:
    """The moments of inertia about the axes along x and y; a single one is that about both."""
    return given if isinstance(given, list | tuple) else [given, given]


class Start(Part):
    """Where a march begins; by default in equilibrium with the first load, at rest.

    Attributes
    ----------
    eccentricity : position of a shaft along x and y over the clearance.
    film : least film thickness of other bearings, m.
    slopes : slopes along and across the sliding of a pad about a pivot, rad; 0 beside a film.
    velocity : velocity of the shaft along x and y, or at which the walls part, m/s.
    temperature : temperature of the film, K, with ``heat.time_constant``; by default that of the supplied lubricant.
    """

    eccentricity: tuple[Number, Number] | None = None
    film: Length | None = None
    slopes: tuple[Angle, Angle] | None = None
    velocity: Annotated[tuple[Velocity, ...], Field(min_length=1, max_length=2)] | None = None
    temperature: Annotated[float, InUnit("K")] | None = None


class Body(Part):
    """The body that the film carries: M q̈ = F + W(t), with the load W, which includes its weight.

    Attributes
    ----------
    mass : mass that the bearing carries, kg; without it the forces balance at all times.
    unbalance : mass times its distance from the axis, of a shaft, kg m; at the first time it lies along x.
    inertia : moments of inertia of a pad about the axes along x and y through its pivot, kg m²; a single one is that
        about both. Without them the moments balance at all times.
    start : where a march begins.
    """

    mass: Annotated[float, InUnit("kg")] | None = None
    unbalance: Annotated[float, InUnit("kg*m")] | None = None
    inertia: Annotated[tuple[Inertia, Inertia], BeforeValidator(_about_both_axes)] | None = None
    start: Start | None = None
