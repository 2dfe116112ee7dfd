"""A seal: a rough surface pressed on a flat one, and a liquid that is pressed through between them."""

from typing import Annotated, Literal

from roughfilm.contact.foundation.entries import InUnit, Length, Part
from roughfilm.rom.parts.pressed_surface import RoughContact
from roughfilm.rom.parts.solids import Pressure


class Liquid(Part):
    """Density, kg/m³, and viscosity, Pa s; both constant."""

    density: Annotated[float, InUnit("kg/m^3")]
    viscosity: Annotated[float, InUnit("Pa*s")]


class Drive(Part):
    """What drives the liquid: a pressure drop, Pa, over a length, m, along x or y of the surface."""

    pressure_drop: Pressure
    length: Length
    direction: Literal["x", "y"] = "x"


class Seal(RoughContact):
    """A seal whose liquid does not move the solids: its pressure is far below that of the contact.

    All models give ``gap_edges``, m, (n+1,), and ``gap_share``, (n,): how much of the nominal area has gaps in a bin.
    Models that resolve the surface give the fields ``gap``, m, and ``flow``, the size of the flow per width, m²/s, both
    of shape (nx, ny).
    """

    kind: Literal["seal"]
    liquid: Liquid
    flow: Drive

    @property
    def axis(self) -> int:
        """Of the flow: 0 for x, 1 for y."""
        return "xy".index(self.flow.direction)
