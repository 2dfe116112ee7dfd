"""Laws of compressibility as data: θ = ρ/ρc over p, the pressure above that of cavitation."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, PositiveNumber
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.lubricants.law import Law

Pressure = Annotated[float, InUnit("Pa")]


class Incompressible(Law):
    """θ = 1."""

    law: Literal["incompressible"] = "incompressible"

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa, where p >= 0; shape of ``pressure``."""
        nothing = np.zeros_like(pressure)
        return nothing, nothing

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1; InputError for θ > 1."""
        if theta > 1:
            raise InputError(f"theta: got {theta!r} for an incompressible lubricant; give a pressure instead")
        return 0.0


class ConstantBulkModulus(Law):
    """p = β ln θ: for pressures below about a tenth of β, Pa. Source: Vijayaraghavan and Keith 1989."""

    law: Literal["constant_bulk_modulus"]
    bulk_modulus: Pressure

    @property
    def valid_to(self) -> float:
        """A tenth of β, Pa."""
        return self.bulk_modulus / 10

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa, where p >= 0; shape of ``pressure``."""
        excess = np.expm1(pressure / self.bulk_modulus)
        return excess, (1 + excess) / self.bulk_modulus

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1."""
        return self.bulk_modulus * float(np.log(theta))


class DowsonHigginson(Law):
    """θ = (C1 + C2 p)/(C1 + p), with C1 in Pa; by default Dowson and Higginson's mineral oil (1966).

    Paper B of the source fits C1 = 2.22 GPa, C2 = 1.66 to another.
    """

    law: Literal["dowson_higginson"]
    c1: Pressure = 0.59e9
    c2: PositiveNumber = 1.34

    @model_validator(mode="after")
    def _grows(self) -> Self:
        if self.c2 <= 1:
            raise ValueError(f"c2: got {self.c2!r}; it must be above 1, or density would not grow with pressure")
        return self

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """ϑ = θ - 1 and dθ/dp, 1/Pa, where p >= 0; shape of ``pressure``."""
        below = self.c1 + pressure
        rise = (self.c2 - 1) / below
        return rise * pressure, rise * self.c1 / below

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1; InputError from θ = C2 on, which no pressure reaches."""
        if theta >= self.c2:
            raise InputError(f"theta: got {theta!r}; the lubricant cannot be denser than c2 = {self.c2!r}")
        return self.c1 * (theta - 1) / (self.c2 - theta)
