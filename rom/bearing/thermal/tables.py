"""The table [heat] of a scene: what the walls and the surroundings of a film do with its heat."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.entries import InUnit, Length, Part, plain_number

Temperature = Annotated[float, InUnit("K")]
HeatTransfer = Annotated[float, InUnit("W/(m^2*K)")]
Conductivity = Annotated[float, InUnit("W/(m*K)")]
HeatCapacity = Annotated[float, InUnit("J/(kg*K)")]
Density = Annotated[float, InUnit("kg/m^3")]
Area = Annotated[float, InUnit("m^2")]
Time = Annotated[float, InUnit("s")]
Share = Annotated[float, BeforeValidator(plain_number), Field(ge=0, le=1)]


class Adiabatic(Part):
    """A wall that takes no heat."""

    kind: Literal["adiabatic"] = "adiabatic"


class GivenTemperature(Part):
    """A wall at a given temperature.

    Attributes
    ----------
    temperature : temperature of the wall, K.
    """

    kind: Literal["temperature"]
    temperature: Temperature


class Conducting(Part):
    """A wall that conducts heat through its thickness to surroundings, q = (T - T_a)/(d/k + 1/α).

    Attributes
    ----------
    thickness : thickness d, m; 0 by default, if there is a heat transfer coefficient.
    conductivity : conductivity k, W/(m K), needed with a thickness.
    heat_transfer : heat transfer coefficient α behind it, W/(m² K); without it that side is at ``surroundings``.
    surroundings : temperature T_a of the surroundings, K; by default that of the supplied lubricant.
    """

    kind: Literal["conducting"]
    thickness: Length | None = None
    conductivity: Conductivity | None = None
    heat_transfer: HeatTransfer | None = None
    surroundings: Temperature | None = None

    @model_validator(mode="after")
    def _has_a_resistance(self) -> Self:
        if (self.thickness is None) != (self.conductivity is None):
            missing, given = ("thickness", "conductivity") if self.thickness is None else ("conductivity", "thickness")
            raise ValueError(f"{missing}: is missing beside {given}; give both, or leave both out")
        if self.thickness is None and self.heat_transfer is None:
            raise ValueError(
                "got a conducting wall without a thermal resistance; give thickness and conductivity, heat_transfer, "
                "or all of them"
            )
        return self


class Turning(Part):
    """A shaft that turns: each point passes the whole film, so that its temperature is uniform around it.

    By default no heat leaves along the shaft, and its temperature is the one at which the film gives it none in sum.

    Attributes
    ----------
    temperature : temperature of the shaft, K, if it is given.
    """

    kind: Literal["turning"]
    temperature: Temperature | None = None


class HalfSpace(Part):
    """A wall that slides past the film, thick against the depth that heat reaches meanwhile.

    The wall comes in at ``temperature``; the heat flux q into it raises its temperature by
    ∫ q(x') dx'/√(π k ρ c u (x - x')). Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids.

    Attributes
    ----------
    conductivity : thermal conductivity k of the wall, W/(m K).
    density : density ρ of the wall, kg/m³.
    heat_capacity : specific heat capacity c of the wall, J/(kg K).
    temperature : temperature at which the wall comes in, K; by default that of the supplied lubricant.
    """

    kind: Literal["half_space"]
    conductivity: Conductivity
    density: Density
    heat_capacity: HeatCapacity
    temperature: Temperature | None = None


WALLS: dict[str, type[Part]] = {
    "adiabatic": Adiabatic,
    "temperature": GivenTemperature,
    "conducting": Conducting,
    "turning": Turning,
    "half_space": HalfSpace,
}


def _kind(entries: Any) -> Any:
    """The table of a wall; a wall without parameters may be given by its kind alone."""
    return {"kind": entries} if isinstance(entries, str) else entries


FixedWall = Annotated[Adiabatic | GivenTemperature | Conducting, Field(discriminator="kind"), BeforeValidator(_kind)]
SlidingWall = Annotated[
    Adiabatic | GivenTemperature | Conducting | Turning | HalfSpace, Field(discriminator="kind"), BeforeValidator(_kind)
]


class Heat(Part):
    """The heat of a film: its walls, its surroundings, and how supplied and hot lubricant mix.

    Attributes
    ----------
    fixed_wall, sliding_wall : the walls, for the model ``across``; adiabatic by default. If neither takes heat, the
        fixed wall gives it to the surroundings by ``heat_transfer``, where that is given.
    carried_over : part of the hot lubricant at the end of a film that enters the next one behind a gap or groove, as
        far as the flow there allows; the rest is new lubricant.
    heat_transfer : heat transfer coefficient from the bearing to the surroundings, W/(m² K).
    area : surface of the bearing that gives off this heat, m².
    surroundings : temperature of the surroundings, K; by default that of the supplied lubricant.
    time_constant : time constant of the temperature of the walls, s, for a march.
    """

    fixed_wall: FixedWall = Field(default_factory=Adiabatic)
    sliding_wall: SlidingWall = Field(default_factory=Adiabatic)
    carried_over: Share = 1.0
    heat_transfer: HeatTransfer | None = None
    area: Area | None = None
    surroundings: Temperature | None = None
    time_constant: Time | None = None

    @property
    def insulated(self) -> bool:
        """Whether neither wall takes heat in sum."""
        turning = isinstance(self.sliding_wall, Turning) and self.sliding_wall.temperature is None
        return isinstance(self.fixed_wall, Adiabatic) and (turning or isinstance(self.sliding_wall, Adiabatic))

    @model_validator(mode="after")
    def _gives_off_heat_through_an_area(self) -> Self:
        if (self.heat_transfer is None) != (self.area is None):
            missing, given = ("heat_transfer", "area") if self.heat_transfer is None else ("area", "heat_transfer")
            raise ValueError(f"{missing}: is missing beside heat.{given}; give both, or leave both out")
        if self.surroundings is not None and self.area is None:
            raise ValueError(
                "surroundings: got a temperature without heat_transfer and area, by which heat leaves to them; give "
                "both, or leave it out"
            )
        return self
