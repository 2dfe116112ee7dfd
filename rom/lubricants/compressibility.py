"""Compressibility laws: θ = ρ/ρc over p, the pressure above cavitation pressure."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, PositiveNumber
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.lubricants.law import LubricantLaw

Pressure = Annotated[float, InUnit("Pa")]


class Incompressible(LubricantLaw):
    """The law θ = 1."""

    law: Literal["incompressible"] = "incompressible"

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """The compression ϑ = θ - 1 and dθ/dp, 1/Pa, at p >= 0; shape of ``pressure``."""
        nothing = np.zeros_like(pressure)
        return nothing, nothing

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1; InputError for θ > 1."""
        if theta > 1:
            raise InputError(f"theta: got {theta!r} for an incompressible lubricant; give a pressure instead")
        return 0.0


class ConstantBulkModulus(LubricantLaw):
    """The law p = β ln θ, for pressures below about β/10, Pa. Source: Vijayaraghavan and Keith 1989.

    Attributes
    ----------
    bulk_modulus : bulk modulus β, Pa.
    """

    law: Literal["constant_bulk_modulus"]
    bulk_modulus: Pressure

    @property
    def valid_to(self) -> float:
        """The pressure β/10, Pa."""
        return self.bulk_modulus / 10

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """The compression ϑ = θ - 1 and dθ/dp, 1/Pa, at p >= 0; shape of ``pressure``."""
        excess = np.expm1(pressure / self.bulk_modulus)
        return excess, (1 + excess) / self.bulk_modulus

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1."""
        return self.bulk_modulus * float(np.log(theta))


class DowsonHigginson(LubricantLaw):
    """The law θ = (C1 + C2 p)/(C1 + p), C1 in Pa; the default is Dowson and Higginson's mineral oil (1966).

    Another oil has C1 = 2.22 GPa and C2 = 1.66 (Sahlin 2008, Paper B).

    Attributes
    ----------
    c1 : constant C1, Pa.
    c2 : constant C2, the density ratio at high pressure.
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
        """The compression ϑ = θ - 1 and dθ/dp, 1/Pa, at p >= 0; shape of ``pressure``."""
        below = self.c1 + pressure
        rise = (self.c2 - 1) / below
        return rise * pressure, rise * self.c1 / below

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1; InputError for θ >= C2, the limit of high pressure."""
        if theta >= self.c2:
            raise InputError(f"theta: got {theta!r}; the lubricant cannot be denser than c2 = {self.c2!r}")
        return self.c1 * (theta - 1) / (self.c2 - theta)
