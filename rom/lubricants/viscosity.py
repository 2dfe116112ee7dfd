"""Viscosity laws: η0/η over p, the pressure above cavitation pressure."""

from typing import Annotated, Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, PositiveNumber
from roughfilm.rom.lubricants.law import LubricantLaw

PressureCoefficient = Annotated[float, InUnit("Pa^-1")]
LOG_VISCOSITY = 9.67
"""Roelands' constant: all isotherms meet at η = exp(-9.67) Pa s."""

ROELANDS_PRESSURE = 1 / 5.1e-9
"""Roelands' constant: all isotherms meet at -0.196 GPa, here in Pa with positive sign."""


class ConstantViscosity(LubricantLaw):
    """The law η = η0."""

    law: Literal["constant"] = "constant"

    def fluidity(self, pressure: Array, viscosity: float | Array) -> tuple[Array, Array]:  # noqa: ARG002
        """The fluidity η0/η and its derivative, 1/Pa; shape of ``pressure``, of which η0, Pa s, may be too."""
        return np.ones_like(pressure), np.zeros_like(pressure)


class Barus(LubricantLaw):
    """The law η = η0 exp(α p), α in 1/Pa, for pressures below about 0.1 GPa. Source: Barus 1893.

    Attributes
    ----------
    pressure_coefficient : coefficient α, 1/Pa.
    """

    law: Literal["barus"]
    pressure_coefficient: PressureCoefficient

    @property
    def valid_to(self) -> float:
        """The pressure 0.1 GPa, in Pa."""
        return 1e8

    def fluidity(self, pressure: Array, viscosity: float | Array) -> tuple[Array, Array]:  # noqa: ARG002
        """The fluidity η0/η and its derivative, 1/Pa; shape of ``pressure``, of which η0, Pa s, may be too."""
        fluidity = np.exp(-self.pressure_coefficient * pressure)
        return fluidity, -self.pressure_coefficient * fluidity


class Roelands(LubricantLaw):
    """The law η = η0 exp((ln η0 + 9.67) ((1 + p/0.196 GPa)^Z - 1)), η0 in Pa s, to 1 GPa. Source: Roelands 1966.

    Attributes
    ----------
    index : index Z, 0.4 to 0.8 for mineral oils.
    """

    law: Literal["roelands"]
    index: PositiveNumber

    @property
    def valid_to(self) -> float:
        """The pressure 1 GPa, in Pa."""
        return 1e9

    def fluidity(self, pressure: Array, viscosity: float | Array) -> tuple[Array, Array]:
        """The fluidity η0/η and its derivative, 1/Pa; shape of ``pressure``, of which η0, Pa s, may be too."""
        depth = np.log(viscosity) + LOG_VISCOSITY
        base = 1 + pressure / ROELANDS_PRESSURE
        fluidity = np.exp(-depth * (base**self.index - 1))
        return fluidity, -fluidity * depth * self.index * base ** (self.index - 1) / ROELANDS_PRESSURE
