"""The full journal bearing of the published tables: a scene with a small clearance, solved with cavitation."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene

RADIUS, CLEARANCE_RATIO, VISCOSITY, SPEED = 0.05, 1e-3, 0.02, 1.0
"""Radius, m, clearance over radius, viscosity, Pa s, and speed, m/s: the results in dimensionless form need none."""

CLOSE = 0.9
"""Eccentricity from which on the film is so thin and short that it needs the fine grid."""


@dataclass(frozen=True, kw_only=True)
class Grids:
    """Cells along and across of the film, and of one with an eccentricity of ``CLOSE`` and above."""

    wide: int
    close: int


USUAL = Grids(wide=160, close=320)
THOROUGH = Grids(wide=320, close=640)


def method(grids: Grids) -> str:
    """The model and its grids, in words."""
    return (
        f"reynolds_incompressible on {grids.wide} × {grids.wide} cells, from ε = {CLOSE:g} on "
        f"{grids.close} × {grids.close}"
    )


def journal(eccentricity: float, width_over_diameter: float, grids: Grids) -> Result:
    """The film of a full journal bearing that turns, full at the widest gap, with pressures of at least ambient."""
    scene = read_scene(
        {
            "name": "journal",
            "kind": "bearing",
            "geometry": {
                "shape": "journal",
                "radius": f"{RADIUS!r} m",
                "clearance": f"{RADIUS * CLEARANCE_RATIO!r} m",
                "eccentricity": eccentricity,
                "width": f"{2 * RADIUS * width_over_diameter!r} m",
            },
            "lubricant": {"viscosity": f"{VISCOSITY!r} Pa*s"},
            "motion": {"speed": f"{SPEED!r} m/s"},
        }
    )
    cells = grids.close if eccentricity >= CLOSE else grids.wide
    return find("bearing", "reynolds_incompressible").solve(scene, Request(resolution=cells))


def scaled(quantity: Quantity, factor: float) -> Quantity:
    """A quantity in another unit, as a number."""
    bar = quantity.uncertainty
    return Quantity(
        value=quantity.value * factor, unit="1", uncertainty=None if bar is None or math.isinf(bar) else bar * factor
    )


def sommerfeld_of_din(result: Result, width_over_diameter: float) -> Quantity:
    """So = F ψ²/(B D η ω), with the load F and the clearance ratio ψ."""
    area = (2 * RADIUS) ** 2 * width_over_diameter
    return scaled(result["load"], CLEARANCE_RATIO**2 / (area * VISCOSITY * SPEED / RADIUS))
