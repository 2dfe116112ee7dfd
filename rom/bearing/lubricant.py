"""The lubricant of a bearing: density and viscosity over pressure and temperature, and its heat."""

import math
from typing import Annotated, Any, Self, cast

import numpy as np
from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    SerializationInfo,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import to_si, with_unit
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.laws import Compressibility, Piezoviscosity, Thermoviscosity
from roughfilm.rom.lubricants.library import EXPANSION, entries_of, found_name
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.lubricants.shear_thinning import ShearThinning
from roughfilm.rom.lubricants.thermal.law import AbsoluteLaw, AnchoredLaw, Supplied, Temperature, at_most, celsius
from roughfilm.rom.lubricants.thermal.tabulated import AnyHeatCapacity
from roughfilm.rom.lubricants.thermal.viscosity import RoelandsTemperature
from roughfilm.rom.lubricants.viscosity import LOG_VISCOSITY, ConstantViscosity
from roughfilm.rom.parts.fluid import Fluid
from roughfilm.rom.parts.surroundings import GaugePressure

Viscosity = Annotated[float, InUnit("Pa*s")]
Density = Annotated[float, InUnit("kg/m^3")]
Expansion = Annotated[float, InUnit("K^-1", any_sign=True), AfterValidator(at_most(0.01, "about 0.0007 1/K"))]
Conductivity = Annotated[float, InUnit("W/(m*K)")]

AGREEMENT = 1e-3
"""Relative difference up to which a given viscosity agrees with that of a law."""

HOTTEST_BEARING = 398.15
"""Highest temperature of a bearing that ISO 7902-3 permits, K: 90 to 125 °C by the kind and amount of its oil."""

MAX_BEYOND = 100.0
"""Temperature beyond the valid range of a law, K, from which on a film is no answer."""


def _law(entries: Any) -> Any:
    """The table of a law; a law without parameters may be given by its name alone."""
    return {"law": entries} if isinstance(entries, str) else entries


class BearingLubricant(Fluid):
    """The lubricant of a bearing.

    Over temperature its density is ρ exp(-α (T - T₀)), and its viscosity that of the law ``thermoviscosity``, at the
    cavitation pressure. Laws that give the viscosity itself determine ``viscosity``, which may then be left out. A name
    in the library (:mod:`roughfilm.rom.lubricants.library`) determines the keys of heat and temperature that are not
    given.

    Attributes
    ----------
    oil : name of the liquid in the library: "ISO VG 7" to "ISO VG 3200", "SAE 10" to "SAE 60", "water",
        "ethylene glycol 50 %" or "propylene glycol 50 %".
    viscosity : viscosity at cavitation pressure, Pa s.
    density : density, kg/m³, needed only for inertia, for a ram pressure, for heat and for a kinematic viscosity.
    cavitation_pressure : cavitation pressure above ambient, Pa.
    temperature : temperature T₀ of the supplied lubricant, at which viscosity and density hold, K.
    heat_capacity : specific heat capacity, J/(kg K), or a table of it over temperature.
    conductivity : thermal conductivity, W/(m K).
    thermal_expansion : coefficient α of the density over temperature, 1/K, at most 0.01 in size; by default 0 or, with
        a law of kinematic viscosities, 0.6278 kg/(m³ K) over the density, that of mineral oils (ASTM D1250).
    compressibility : law of the density over pressure.
    piezoviscosity : law of the viscosity over pressure.
    thermoviscosity : law of the viscosity over temperature; without it there is no temperature.
    shear_thinning : law of the viscosity over the shear rate, which models with shear thinning use.
    """

    oil: str | None = None
    viscosity: Viscosity = cast(float, None)
    density: Density | None = None
    cavitation_pressure: GaugePressure = 0.0
    temperature: Temperature | None = None
    heat_capacity: AnyHeatCapacity | None = None
    conductivity: Conductivity | None = None
    thermal_expansion: Expansion | None = None
    compressibility: Annotated[Compressibility, Field(discriminator="law"), BeforeValidator(_law)] = Field(
        default_factory=Incompressible
    )
    piezoviscosity: Annotated[Piezoviscosity, Field(discriminator="law"), BeforeValidator(_law)] = Field(
        default_factory=ConstantViscosity
    )
    thermoviscosity: Annotated[Thermoviscosity, Field(discriminator="law")] | None = None
    shear_thinning: Annotated[ShearThinning, Field(discriminator="law")] | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_the_library(cls, entries: Any) -> Any:
        """The entries with those of the oil that are not given."""
        if not isinstance(entries, dict) or entries.get("oil") is None:
            return entries
        try:
            name = found_name(entries["oil"])
        except ValueError as error:
            raise ValueError(f"oil: {error}") from None
        if entries.get("temperature") is None:
            raise ValueError(
                'temperature: missing; with oil give the temperature of the supplied lubricant, such as "40 degC"'
            )
        try:
            temperature = to_si(entries["temperature"], "K")
        except ValueError:
            return entries  # its field reports the fault
        given = {key: value for key, value in entries.items() if value is not None}
        return {**entries_of(name, temperature), **given, "oil": name}

    @model_serializer(mode="wrap")
    def _entries(self, handler: SerializerFunctionWrapHandler, info: SerializationInfo) -> dict[str, Any]:
        """The entries; without those that oil, temperature and law determine if the context asks for those given."""
        entries: dict[str, Any] = handler(self)
        if not (info.context or {}).get("given"):
            return entries
        return {key: value for key, value in entries.items() if key not in self._determined}

    @property
    def _determined(self) -> frozenset[str]:
        """The keys whose values are those that oil, temperature and law determine."""
        law = frozenset({"viscosity"} if isinstance(self.thermoviscosity, AbsoluteLaw) else ())
        if self.oil is None or self.temperature is None:
            return law
        alone = type(self).model_validate({"oil": self.oil, "temperature": with_unit(self.temperature, "K")})
        keys = ("thermoviscosity", "density", "thermal_expansion", "heat_capacity", "conductivity")
        return law | {key for key in keys if getattr(self, key) == getattr(alone, key)}

    @model_validator(mode="after")
    def _has_a_viscosity(self) -> Self:
        law, given = self.thermoviscosity, cast(float | None, self.viscosity)
        if law is not None and self.temperature is None:
            raise ValueError(
                "temperature: missing; with thermoviscosity give the temperature of the supplied lubricant, such as "
                '"40 degC"'
            )
        if isinstance(law, AbsoluteLaw):
            self._determine(law.kinematic, given)
        elif given is None:
            anchored = "" if law is None else f", as the law {law.law} needs it"
            raise ValueError(f"viscosity: missing; add it{anchored}")
        if isinstance(law, RoelandsTemperature) and self.viscosity <= math.exp(-LOG_VISCOSITY):
            raise ValueError(
                f"thermoviscosity: got roelands for {self.viscosity!r} Pa s; that law needs more than "
                f"{math.exp(-LOG_VISCOSITY):.2g} Pa s, take another law"
            )
        if isinstance(law, AnchoredLaw):
            try:
                self.viscosity_at(np.array([self.temperature]))
            except InputError as error:
                raise ValueError(str(error).replace("lubricant.thermoviscosity", "temperature", 1)) from None
        return self

    def _determine(self, kinematic: bool, given: float | None) -> None:
        """Fill in the viscosity that a law determines; ValueError if another one is given."""
        if kinematic and self.density is None:
            raise ValueError(
                "density: missing; a law of the kinematic viscosity needs the density at lubricant.temperature"
            )
        assert self.temperature is not None
        try:
            value = float(self.viscosity_at(np.array([self.temperature]))[0][0])
        except InputError as error:
            raise ValueError(str(error).replace("lubricant.thermoviscosity", "temperature", 1)) from None
        if given is not None and not math.isclose(given, value, rel_tol=AGREEMENT):
            assert self.thermoviscosity is not None
            by_name = self.oil is not None and "thermoviscosity" in self._determined
            law, of_law = (self.oil, "oil") if by_name else (f"the law {self.thermoviscosity.law}", "thermoviscosity")
            raise ValueError(
                f"viscosity: got {given:.6g} Pa s, but {law} has {value:.6g} Pa s at {celsius(self.temperature)}; "
                f"leave viscosity out, or give your own law in place of {of_law}"
            )
        self.__dict__["viscosity"] = value

    @property
    def expansion(self) -> float:
        """The coefficient of thermal expansion, 1/K, given or by default."""
        if self.thermal_expansion is not None:
            return self.thermal_expansion
        law = self.thermoviscosity
        kinematic = isinstance(law, AbsoluteLaw) and law.kinematic
        return EXPANSION / self.density if kinematic and self.density is not None else 0.0

    def density_at(self, temperature: Array) -> tuple[Array, Array]:
        """The density ρ, kg/m³, and dρ/dT; shape of ``temperature``, K; InputError without a density."""
        if self.density is None or self.temperature is None:
            missing = "density" if self.density is None else "temperature"
            raise InputError(f"lubricant.{missing}: missing; add it for the density over temperature")
        expansion = self.expansion
        density = self.density * np.exp(-expansion * (temperature - self.temperature))
        return density, -expansion * density

    def viscosity_at(self, temperature: Array) -> tuple[Array, Array]:
        """The viscosity η at cavitation pressure, Pa s, and dη/dT.

        Parameters
        ----------
        temperature : temperatures, K, of any shape, which is that of both results.

        Raises
        ------
        InputError
            If the lubricant has no law of the viscosity over temperature, or a temperature is too low for it.
        """
        law = self.thermoviscosity
        if law is None or self.temperature is None:
            raise InputError(
                "lubricant.thermoviscosity: missing; add a law of the viscosity over temperature, or name an oil"
            )
        if isinstance(law, AnchoredLaw):
            return law.viscosity(temperature, Supplied(temperature=self.temperature, viscosity=self.viscosity))
        viscosity, slope = law.viscosity(temperature)
        if not law.kinematic:
            return viscosity, slope
        density, thinning = self.density_at(temperature)
        return viscosity * density, slope * density + viscosity * thinning

    def heat_at(self, temperature: Array) -> tuple[Array, Array]:
        """∫ ρ c dT from T₀, J/m³, and ρ c, J/(m³ K), of a volume that is measured at T₀, which keeps its mass.

        Raises
        ------
        InputError
            If density, heat capacity or temperature is missing.
        """
        if self.density is None or self.heat_capacity is None or self.temperature is None:
            missing = next(key for key in ("density", "heat_capacity", "temperature") if getattr(self, key) is None)
            raise InputError(f"lubricant.{missing}: missing; add it for models with temperature")
        heat, capacity = self.heat_capacity.heat(temperature, self.temperature)
        return self.density * heat, self.density * capacity

    @property
    def lacking(self) -> tuple[str, ...]:
        """The keys that are missing for the mean energy equation: none if the lubricant has a temperature."""
        keys = ("thermoviscosity", "temperature", "density", "heat_capacity")
        return tuple(key for key in keys if getattr(self, key) is None)

    @property
    def liquid(self) -> Liquid:
        """The liquid of the energy equations; its conductivity is not a number where none is given.

        Raises
        ------
        InputError
            If a key in ``lacking`` is missing.
        """
        if self.lacking:
            first, *others = self.lacking
            also = f" and {', '.join(f'lubricant.{key}' for key in others)}" if others else ""
            raise InputError(f"lubricant.{first}: missing; add it{also} for models with temperature, or name an oil")
        assert self.temperature is not None
        return Liquid(
            temperature=self.temperature,
            viscosity=self.viscosity_at,
            heat=self.heat_at,
            conductivity=math.nan if self.conductivity is None else self.conductivity,
        )

    def at(self, temperature: float) -> Self:
        """The lubricant at another temperature, K: with its viscosity and its density there, and the same laws.

        Raises
        ------
        InputError
            If the lubricant has no law of the viscosity over temperature, or the temperature is too low for it.
        """
        if temperature == self.temperature:
            return self
        place = np.array([temperature])
        viscosity = float(self.viscosity_at(place)[0][0])
        density = None if self.density is None else float(self.density_at(place)[0][0])
        law = self.shear_thinning
        update = {
            "temperature": temperature,
            "viscosity": viscosity,
            "density": density,
            "thermal_expansion": self.expansion,
            "shear_thinning": None if law is None else law.scaled(viscosity / self.viscosity),
        }
        return self.model_copy(update=update)

    @property
    def left_out_heat(self) -> list[str]:
        """A warning that heat is left out of a film whose viscosity depends on temperature, as a key is missing."""
        if self.thermoviscosity is None or not self.lacking:
            return []
        return [
            f"lubricant.{self.lacking[0]}: missing, so that all films have the temperature of the supplied lubricant; "
            "add it for the heat of the film, or name an oil"
        ]

    def beyond(self, lowest: float, highest: float) -> list[str]:
        """The sentence that temperatures, K, lie outside of the valid range of the law of the viscosity; none inside.

        More than ``MAX_BEYOND`` outside of it, it says that the film is no answer.
        """
        law = self.thermoviscosity
        if law is None or self.temperature is None:
            return []
        if isinstance(law, AnchoredLaw):
            low, high = law.valid(Supplied(temperature=self.temperature, viscosity=self.viscosity))
        else:
            low, high = law.valid()
        if low <= lowest and highest <= high:
            return []
        ends = f"{celsius(lowest)}" if lowest == highest else f"{celsius(lowest)} to {celsius(highest)}"
        allowed = f"from {celsius(low)} to {celsius(high)}"
        own = law.ends if law.narrowed(0.0, math.inf) == (0.0, math.inf) else ""
        valid = f"temperature: {ends}; the law {law.law} of the viscosity is valid {allowed}{own}"
        if max(low - lowest, highest - high) <= MAX_BEYOND:
            return [valid]
        return [
            f"{valid}: this is no answer, as it is more than {MAX_BEYOND:g} K beyond; change the scene "
            "so that the film stays within, or give a law that is valid there"
        ]

    def hot(self, highest: float) -> list[str]:
        """A warning if the highest temperature, K, is above that which standards permit for bearings with an oil."""
        if self.oil is None or not self.oil.startswith(("ISO VG", "SAE")) or highest <= HOTTEST_BEARING:
            return []
        return [
            f"temperature: {celsius(highest)}; ISO 7902-3 permits {celsius(HOTTEST_BEARING)} at most in bearings with "
            "mineral oil, as the oil ages and white metal softens"
        ]
