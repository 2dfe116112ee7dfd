"""A bearing: a lubricant film between a shaped still wall and a flat sliding one."""

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, field_validator, model_validator

from roughfilm.contact.foundation.entries import InUnit, Part, PositiveNumber, any_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.bearing.asperity_contact import AsperityContact
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.roughness import AnyRoughness, RoughSurface, Sinusoid, StoredTable
from roughfilm.rom.bearing.shapes import SHAPES, AnyShape, Journal
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.laws import Compressibility, Piezoviscosity
from roughfilm.rom.lubricants.viscosity import LOG_VISCOSITY, ConstantViscosity, Roelands
from roughfilm.rom.parts.pressed_surface import Load

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.discretise import Ends
    from roughfilm.rom.cavitation.problem import Problem

GaugePressure = Annotated[float, InUnit("Pa", any_number)]
Speed = Annotated[float, InUnit("m/s", any_number)]
Viscosity = Annotated[float, InUnit("Pa*s")]
Density = Annotated[float, InUnit("kg/m^3")]


def _law(entries: Any) -> Any:
    """A law may be named alone where it needs no numbers."""
    return {"law": entries} if isinstance(entries, str) else entries


class Lubricant(Part):
    """Viscosity at the pressure of cavitation, Pa s, what pressure does to it and to density, and that pressure, Pa.

    The pressure of cavitation counts from ambient. No rung of a bearing keeps inertia; with a ``density``, kg/m³, the
    Reynolds number is known, and what inertia would add can be estimated.
    """

    viscosity: Viscosity
    density: Density | None = None
    cavitation_pressure: GaugePressure = 0.0
    compressibility: Annotated[Compressibility, Field(discriminator="law"), BeforeValidator(_law)] = Field(
        default_factory=Incompressible
    )
    piezoviscosity: Annotated[Piezoviscosity, Field(discriminator="law"), BeforeValidator(_law)] = Field(
        default_factory=ConstantViscosity
    )


class Motion(Part):
    """Speed of the flat wall, m/s; at the mean radius of a sector. Below zero it slides backwards."""

    speed: Speed


class Inlet(Part):
    """Where sliding brings lubricant from: its pressure above ambient, Pa, or its density θ; ambient by default.

    θ < 1 is starved, θ = 1 flooded at the pressure of cavitation, θ > 1 pressurised as the compressibility says.
    """

    theta: PositiveNumber | None = None
    pressure: GaugePressure | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if self.theta is not None and self.pressure is not None:
            raise ValueError("got both theta and pressure; give one of them")
        return self


class Outlet(Part):
    """Pressure above ambient, Pa; by default ambient, but of a journal that of the inlet, which is the same groove."""

    pressure: GaugePressure = 0.0


class Sides(Part):
    """Pressures above ambient, Pa: at y = 0 (the inner radius) and at the width (the outer one)."""

    low: GaugePressure = 0.0
    high: GaugePressure = 0.0


class Boundary(Part):
    """What holds where the film ends."""

    inlet: Inlet = Field(default_factory=Inlet)
    outlet: Outlet = Field(default_factory=Outlet)
    sides: Sides = Field(default_factory=Sides)


class Bearing(Scene):
    """Steady isothermal flow in a thin film that may rupture; pressures count from ambient.

    Where the still wall is rough, ``film`` and all of the geometry are of the mean gap; where ``asperities`` are told,
    so that the walls may touch, of the separation α of the walls' mean planes as if they were rigid, which is the mean
    gap until they touch. ``load`` says what the bearing is to carry, over the nominal area (of a journal diameter times
    width); rungs take the film as it is given and say what it carries, :mod:`rom.bearing.effects.ablation` finds it
    under the load.

    ``fields`` of its results, of the shape of the grid: ``x``, ``y`` (m, or rad and m), ``film_thickness`` (m),
    ``pressure`` (Pa), ``density_ratio`` θ (1), which below 1 is the part of the gap that liquid fills.
    """

    kind: Literal["bearing"]
    geometry: Annotated[AnyShape, Field(discriminator="shape")]
    lubricant: Lubricant
    motion: Motion
    boundary: Boundary = Field(default_factory=Boundary)
    roughness: AnyRoughness | None = None
    asperities: AsperityContact | None = None
    load: Load | None = None

    @field_validator("geometry", mode="before")
    @classmethod
    def _names_a_shape(cls, entries: Any) -> Any:
        named = entries.get("shape") if isinstance(entries, dict) else None
        if isinstance(entries, dict) and not (isinstance(named, str) and named in SHAPES):
            got = f"got {named!r:.60}" if "shape" in entries else "is missing"
            raise ValueError(f"shape: {got}; it must be {', '.join(map(repr, SHAPES))}")
        return entries

    @model_validator(mode="after")
    def _can_be_solved(self) -> Self:
        lowest = self.lubricant.cavitation_pressure
        places = {"inlet": self.boundary.inlet.pressure, "outlet": self.boundary.outlet.pressure}
        sides = {"sides.low": self.boundary.sides.low, "sides.high": self.boundary.sides.high}
        for place, pressure in (places | (sides if self.wide is False else {})).items():
            found = 0.0 if pressure is None and place == "inlet" and self.boundary.inlet.theta is None else pressure
            if found is not None and found < lowest:
                raise ValueError(
                    f"boundary.{place}.pressure: got {found!r} Pa, below the pressure of cavitation, {lowest!r} Pa; "
                    "no liquid has it, raise it"
                )
        theta = self.boundary.inlet.theta
        if theta is not None and theta > 1:
            try:
                self.lubricant.compressibility.pressure_at(theta)
            except InputError as error:
                raise ValueError(f"boundary.inlet.{error}") from None
        if isinstance(self.geometry, Ring) and self.geometry.endless:
            self._can_be_joined()
        if self.wide and self.boundary.sides != Sides():
            raise ValueError("boundary.sides: got pressures for an infinitely wide bearing; leave them or add a width")
        law, least = self.lubricant.piezoviscosity, math.exp(-LOG_VISCOSITY)
        if isinstance(law, Roelands) and self.lubricant.viscosity <= least:
            raise ValueError(
                f"lubricant.piezoviscosity: got roelands for {self.lubricant.viscosity!r} Pa s; by that law liquids of "
                f"less than {least:.2g} Pa s grow thinner under pressure, take barus or constant"
            )
        if self.asperities is not None:
            self._can_touch(self.asperities)
        if isinstance(self.roughness, Sinusoid) and self.roughness.amplitude >= self.geometry.film:
            raise ValueError(
                f"roughness.amplitude: got {self.roughness.amplitude!r} m; it must be below film, "
                f"{self.geometry.film!r} m, or the walls would touch"
            )
        self.geometry.film_shape()
        return self

    def _can_touch(self, asperities: AsperityContact) -> None:
        if not isinstance(self.roughness, RoughSurface | StoredTable):
            got = "smooth walls" if self.roughness is None else "sinusoidal ridges"
            raise ValueError(f"asperities: got them for {got}; give a surface or a table as roughness")
        if isinstance(self.roughness, RoughSurface) and asperities.solid is None:
            raise ValueError("asperities.solid: is missing; say of what the rough wall is")
        if isinstance(self.roughness, StoredTable) and asperities.solid is not None:
            raise ValueError("asperities.solid: got one, but the table was made for its own; leave it out")

    def _can_be_joined(self) -> None:
        boundary, lowest = self.boundary, self.lubricant.cavitation_pressure
        if boundary.inlet != Inlet() or boundary.outlet != Outlet():
            raise ValueError("boundary: got an inlet or outlet for joined pads, which have none; leave it out")
        if max(boundary.sides.low, boundary.sides.high) <= lowest:
            raise ValueError(
                f"boundary.sides: got no pressure above that of cavitation, {lowest!r} Pa, for joined pads; nothing "
                "would feed the ring, raise one of them"
            )

    @property
    def wide(self) -> bool:
        """Whether the bearing is infinitely wide."""
        return self.geometry.width is None

    @property
    def turning_radius(self) -> float | None:
        """Radius at which the speed of a turning wall is given, m; None if nothing turns."""
        return self.geometry.radius if isinstance(self.geometry, Journal | Ring) else None

    @property
    def ends(self) -> "Ends":
        """What holds at the ends, above the pressure of cavitation."""
        from roughfilm.rom.cavitation.discretise import Ends  # slow to import

        lowest, boundary = self.lubricant.cavitation_pressure, self.boundary
        theta = boundary.inlet.theta
        if theta is None:
            inlet: float | None = (boundary.inlet.pressure or 0.0) - lowest
        else:
            inlet = self.lubricant.compressibility.pressure_at(theta) if theta > 1 else None
        sides = (boundary.sides.low - lowest, boundary.sides.high - lowest)
        outlet = boundary.outlet
        if isinstance(self.geometry, Journal) and outlet == Outlet() and boundary.inlet.pressure is not None:
            outlet = Outlet.model_validate({"pressure": with_unit(boundary.inlet.pressure, "Pa")})
        return Ends(
            inlet=inlet,
            theta=1.0 if theta is None else min(theta, 1.0),
            outlet=outlet.pressure - lowest,
            sides=None if self.wide else sides,
        )

    def problem(self) -> "Problem":
        """The film to be solved, without roughness."""
        from roughfilm.rom.cavitation.problem import Problem  # slow to import

        geometry, lubricant = self.geometry, self.lubricant
        radius = geometry.radius if isinstance(geometry, Ring) else 1.0
        return Problem(
            shape=geometry.film_shape(),
            ends=self.ends,
            speed=self.motion.speed / radius,
            viscosity=lubricant.viscosity,
            compressibility=lubricant.compressibility,
            piezoviscosity=lubricant.piezoviscosity,
        )

    @property
    def pressure_unit(self) -> float:
        """6 η u L / h², Pa, with the least film thickness: the size of the pressures that sliding makes."""
        geometry = self.geometry
        return 6 * self.lubricant.viscosity * abs(self.motion.speed) * geometry.length / geometry.film**2

    @property
    def revolutions(self) -> float:
        """Of a shaft, 1/s."""
        assert isinstance(self.geometry, Journal)
        return abs(self.motion.speed) / (2 * math.pi * self.geometry.radius)
