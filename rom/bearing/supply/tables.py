"""The tables [[supply]] of a scene: grooves, holes and pockets in the still wall that are fed with lubricant."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.entries import Angle, Coordinate, InUnit, Length, Part, PositiveNumber
from roughfilm.rom.bearing.thermal.tables import Temperature
from roughfilm.rom.parts.surroundings import GaugePressure

FlowRate = Annotated[float, InUnit("m^3/s")]

MAX_SUPPLIES = 24
"""Largest number of supplies of one piece of a bearing."""


class Capillary(Part):
    """A capillary between the supply and the film: Q = π d⁴ Δp/(128 η l) in laminar flow.

    Attributes
    ----------
    diameter : diameter d of the capillary, m.
    length : length l of the capillary, m.
    """

    diameter: Length
    length: Length


class Orifice(Part):
    """An orifice between the supply and the film: Q = C (π d²/4) √(2Δp/ρ).

    Attributes
    ----------
    diameter : diameter d of the orifice, m.
    coefficient : discharge coefficient C, at most 1.
    """

    diameter: Length
    coefficient: Annotated[PositiveNumber, Field(le=1)] = 0.6


class Supply(Part):
    """A part of the film in which the pressure is uniform, because lubricant is supplied there.

    Attributes
    ----------
    kind : "groove", "hole" or "pocket".
    x : position of the middle along the sliding, of a pad, m.
    angle : angle of the middle: of a journal from the widest place, of lobes from the x axis, of a sector or a washer
        from its inlet, rad.
    y : position of the middle across the sliding from the low side, m; by default the middle of the width.
    radius : radius of the middle in a sector or a washer, m; by default the mean radius.
    pressure : pressure of the supply above ambient, Pa.
    flow : given flow, m³/s, in place of a pressure.
    capillary : capillary between the supply and the film.
    orifice : orifice between the supply and the film.
    depth : depth below the wall around it, m, for the friction inside; without it there is none.
    temperature : temperature of what it supplies, K, ahead of its restrictor; by default that of the lubricant.
    """

    kind: str
    x: Coordinate | None = None
    angle: Angle | None = None
    y: Coordinate | None = None
    radius: Length | None = None
    pressure: GaugePressure | None = None
    flow: FlowRate | None = None
    capillary: Capillary | None = None
    orifice: Orifice | None = None
    depth: Length | None = None
    temperature: Temperature | None = None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if (self.pressure is None) == (self.flow is None):
            got = (
                "is missing; give it, or a flow"
                if self.pressure is None
                else "got both a pressure and a flow; give one"
            )
            raise ValueError(f"pressure: {got}")
        restrictors = [name for name in ("capillary", "orifice") if getattr(self, name) is not None]
        if len(restrictors) > 1:
            raise ValueError("orifice: got an orifice and a capillary; give one of them")
        if restrictors and self.flow is not None:
            raise ValueError(f"{restrictors[0]}: got one for a given flow, which it does not change; leave it out")
        return self

    @property
    def restricted(self) -> bool:
        """Whether the pressure in the film differs from that of the supply."""
        return self.flow is not None or self.capillary is not None or self.orifice is not None

    @property
    def sides(self) -> tuple[float | None, float | None]:
        """The lengths along and across the sliding, m; None for the whole film."""
        raise NotImplementedError


class Groove(Supply):
    """A groove along the axis, along the sliding, or over a rectangle.

    Attributes
    ----------
    length : length along the sliding, m, 0 for a line; without it the whole circumference.
    extent : length across the sliding, m; without it the whole width of an infinitely wide film.
    """

    kind: Literal["groove"]
    length: Coordinate | None = None
    extent: Length | None = None

    @model_validator(mode="after")
    def _is_part(self) -> Self:
        if self.length is not None and self.length < 0:
            raise ValueError(f"length: got {self.length!r} m; it must be 0 or more")
        if self.length is None and self.extent is None:
            raise ValueError("length: is missing, and extent too; the groove would cover the film, give one of them")
        return self

    @property
    def sides(self) -> tuple[float | None, float | None]:
        """The lengths along and across the sliding, m; None for the whole film."""
        return self.length, self.extent


HOLE_SIDE = 0.5 / 0.5901702995080481
"""Side of the square that feeds a film as a round hole of diameter 1: both have the same logarithmic capacity."""


class Hole(Supply):
    """A round hole.

    It is solved as the square whose logarithmic capacity is that of the circle, Γ(1/4)²/(4 π^(3/2)) a = d/2: far from
    it the pressures in a film of uniform thickness are those of the hole to (d/r)⁴.

    Attributes
    ----------
    diameter : diameter d of the hole, m.

    Source: Pólya and Szegő 1951, Isoperimetric Inequalities in Mathematical Physics, for the capacity of the square.
    """

    kind: Literal["hole"]
    diameter: Length

    @property
    def sides(self) -> tuple[float | None, float | None]:
        """The lengths along and across the sliding, m; None for the whole film."""
        side = HOLE_SIDE * self.diameter
        return side, side


class Pocket(Supply):
    """A rectangular recess, whose friction is that of a closed one, 4ηu over the film thickness plus the depth.

    Attributes
    ----------
    length : length along the sliding, m.
    extent : length across the sliding, m; without it the whole width of an infinitely wide film.
    depth : depth below the wall around it, m.
    """

    kind: Literal["pocket"]
    length: Length
    extent: Length | None = None
    depth: Length

    @property
    def sides(self) -> tuple[float | None, float | None]:
        """The lengths along and across the sliding, m; None for the whole film."""
        return self.length, self.extent


SUPPLIES: dict[str, type[Supply]] = {"groove": Groove, "hole": Hole, "pocket": Pocket}


def _names_a_kind(entries: Any) -> Any:
    named = entries.get("kind") if isinstance(entries, dict) else None
    if isinstance(entries, dict) and not (isinstance(named, str) and named in SUPPLIES):
        got = f"got {named!r:.60}" if "kind" in entries else "is missing"
        raise ValueError(f"kind: {got}; it must be {', '.join(map(repr, SUPPLIES))}")
    return entries


AnySupply = Annotated[Annotated[Groove | Hole | Pocket, Field(discriminator="kind")], BeforeValidator(_names_a_kind)]
