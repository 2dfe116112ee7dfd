"""The scene of a seal: a rough surface pressed on a flat one, and a liquid that leaks between them."""

from typing import Annotated, Literal

from roughfilm.contact.foundation.entries import InUnit, Length, Part
from roughfilm.rom.parts.pressed_surface import RoughContact
from roughfilm.rom.parts.solids import Pressure


class Liquid(Part):
    """A liquid of constant density, kg/m³, and viscosity, Pa s."""

    density: Annotated[float, InUnit("kg/m^3")]
    viscosity: Annotated[float, InUnit("Pa*s")]


class SealDrive(Part):
    """A pressure drop, Pa, over a length, m, along x or y of the surface.

    ``width`` is the width of the seal across the flow, m, such as the circumference of a ring; None if it is unknown,
    and the leakage of the whole seal with it.
    """

    pressure_drop: Pressure
    length: Length
    width: Length | None = None
    direction: Literal["x", "y"] = "x"


class Seal(RoughContact):
    """A seal whose liquid does not deform the solids, since its pressure is much less than that of the contact.

    The fields of all results are ``gap_edges``, m, (n+1,), and ``gap_share``, (n,), the fraction of the nominal area
    with gaps in each bin. Models that resolve the surface add ``gap``, m, and ``flow``, the magnitude of the flow per
    width, m²/s, of shape (nx, ny).
    """

    kind: Literal["seal"]
    liquid: Liquid
    flow: SealDrive

    @property
    def axis(self) -> int:
        """The axis of the flow: 0 for x, 1 for y."""
        return "xy".index(self.flow.direction)
