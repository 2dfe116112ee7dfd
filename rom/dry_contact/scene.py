"""The scene of a dry contact: a rough surface pressed on a flat one."""

from typing import Literal

from roughfilm.rom.parts.pressed_surface import RoughContact


class DryContact(RoughContact):
    """A rough surface pressed on a flat one.

    The fields of a result are ``bin_edges`` (n+1,), Pa, and ``pressure_density`` (n,), 1/Pa, the fraction of the
    nominal area with pressures in a bin over its width, without the area at the hardness. Models that resolve the
    surface add ``pressure``, Pa, and ``gap``, m, shape (nx, ny).
    """

    kind: Literal["dry_contact"]
