"""Laws of viscosity over pressure as data: η0/η, which is 1 at the pressure of cavitation."""

from typing import Annotated, Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, PositiveNumber
from roughfilm.rom.lubricants.law import Law

PressureCoefficient = Annotated[float, InUnit("Pa^-1")]
LOG_VISCOSITY, ROELANDS_PRESSURE = 9.67, 1 / 5.1e-9
"""Roelands' constants: η = exp(-9.67) Pa s where all isotherms meet, at -0.196 GPa."""


class ConstantViscosity(Law):
    """η = η0."""

    law: Literal["constant"] = "constant"

    def fluidity(self, pressure: Array, viscosity: float) -> tuple[Array, Array]:  # noqa: ARG002
        """η0/η and its derivative, 1/Pa; shape of ``pressure``."""
        return np.ones_like(pressure), np.zeros_like(pressure)


class Barus(Law):
    """η = η0 exp(α p), with α in 1/Pa; below about 0.1 GPa. Source: Barus 1893."""

    law: Literal["barus"]
    pressure_coefficient: PressureCoefficient

    @property
    def valid_to(self) -> float:
        """0.1 GPa."""
        return 1e8

    def fluidity(self, pressure: Array, viscosity: float) -> tuple[Array, Array]:  # noqa: ARG002
        """η0/η and its derivative, 1/Pa; shape of ``pressure``."""
        found = np.exp(-self.pressure_coefficient * pressure)
        return found, -self.pressure_coefficient * found


class Roelands(Law):
    """η = η0 exp((ln η0 + 9.67) ((1 + p/0.196 GPa)^Z - 1)), η0 in Pa s; to about 1 GPa. Source: Roelands 1966."""

    law: Literal["roelands"]
    index: PositiveNumber

    @property
    def valid_to(self) -> float:
        """1 GPa."""
        return 1e9

    def fluidity(self, pressure: Array, viscosity: float) -> tuple[Array, Array]:
        """η0/η and its derivative, 1/Pa; shape of ``pressure``."""
        depth = np.log(viscosity) + LOG_VISCOSITY
        base = 1 + pressure / ROELANDS_PRESSURE
        found = np.exp(-depth * (base**self.index - 1))
        return found, -found * depth * self.index * base ** (self.index - 1) / ROELANDS_PRESSURE
