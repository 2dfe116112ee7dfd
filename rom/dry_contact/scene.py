"""A dry contact: a rough surface pressed on a flat one."""

from typing import Literal

from roughfilm.rom.parts.pressed_surface import RoughContact


class DryContact(RoughContact):
    """A rough surface pressed on a flat one.

    Models that resolve the surface give the fields ``pressure`` (Pa) and ``gap`` (m), shape (nx, ny). All that know
    pressures give ``bin_edges`` (n+1,), Pa, and ``pressure_density`` (n,), 1/Pa: the part of the nominal area with
    pressures in a bin, over its width; what is at the hardness is not in it.
    """

    kind: Literal["dry_contact"]
