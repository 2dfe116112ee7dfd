"""The laws of compressibility and viscosity that a scene may name."""

from roughfilm.contact.foundation.entries import Part
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson, Incompressible
from roughfilm.rom.lubricants.tabulated import Tabulated
from roughfilm.rom.lubricants.viscosity import Barus, ConstantViscosity, Roelands

Compressibility = Incompressible | ConstantBulkModulus | DowsonHigginson | Tabulated
Piezoviscosity = ConstantViscosity | Barus | Roelands
LAWS: dict[str, type[Part]] = {
    "incompressible": Incompressible,
    "constant_bulk_modulus": ConstantBulkModulus,
    "dowson_higginson": DowsonHigginson,
    "tabulated": Tabulated,
    "constant": ConstantViscosity,
    "barus": Barus,
    "roelands": Roelands,
}
