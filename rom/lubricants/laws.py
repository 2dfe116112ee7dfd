"""The laws of density and viscosity over pressure and of viscosity over temperature that a scene may name."""

from roughfilm.contact.foundation.entries import Part
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson, Incompressible
from roughfilm.rom.lubricants.tabulated import Tabulated
from roughfilm.rom.lubricants.thermal.tabulated import TabulatedViscosity
from roughfilm.rom.lubricants.thermal.viscosity import ExponentialViscosity, RoelandsTemperature, Vogel
from roughfilm.rom.lubricants.thermal.walther import IsoGrade, Walther
from roughfilm.rom.lubricants.viscosity import Barus, ConstantViscosity, Roelands

Compressibility = Incompressible | ConstantBulkModulus | DowsonHigginson | Tabulated
Piezoviscosity = ConstantViscosity | Barus | Roelands
Thermoviscosity = ExponentialViscosity | RoelandsTemperature | Vogel | Walther | IsoGrade | TabulatedViscosity
LAWS: dict[str, type[Part]] = {
    "incompressible": Incompressible,
    "constant_bulk_modulus": ConstantBulkModulus,
    "dowson_higginson": DowsonHigginson,
    "tabulated": Tabulated,
    "constant": ConstantViscosity,
    "barus": Barus,
    "roelands": Roelands,
}
THERMAL_LAWS: dict[str, type[Part]] = {
    "exponential": ExponentialViscosity,
    "roelands": RoelandsTemperature,
    "vogel": Vogel,
    "walther": Walther,
    "iso_vg": IsoGrade,
    "tabulated": TabulatedViscosity,
}
