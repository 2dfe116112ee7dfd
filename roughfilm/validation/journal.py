"""The full journal bearing of the published tables: a scene with a small clearance, solved with cavitation."""

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find
from roughfilm.rom.bearing.model import incompressible_film
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import solve
from roughfilm.rom.cavitation.problem import Problem
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

    def of(self, eccentricity: float) -> int:
        """The cells along and across of the film at an eccentricity."""
        return self.close if eccentricity >= CLOSE else self.wide


APPROACH = RADIUS * CLEARANCE_RATIO
"""Velocity of a shaft that moves straight at the bore, c ε' with ε' = 1/s, m/s."""

TURNING = {"speed": f"{SPEED!r} m/s"}
"""Entries of the motion of a shaft that turns."""

APPROACHING = {"speed": "0 m/s", "approach": f"{APPROACH!r} m/s"}
"""Entries of the motion of a shaft that moves straight at the bore."""

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
    scene = read_scene(entries(eccentricity, width_over_diameter, TURNING))
    return find("bearing", "reynolds_incompressible").solve(scene, Request(resolution=grids.of(eccentricity)))


def entries(eccentricity: float, width_over_diameter: float, motion: dict[str, str]) -> dict[str, Any]:
    """The scene of a full journal bearing with a motion, such as ``TURNING``."""
    return {
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
        "motion": motion,
    }


def squeezed_journal(eccentricity: float, width_over_diameter: float, cells: int) -> Result:
    """The film of a full journal bearing that moves straight at the bore with ε' = 1/s and does not turn.

    A negative eccentricity is that of a shaft that comes from the far side: it leaves its narrowest place.
    """
    away = eccentricity < 0
    motion = APPROACHING | {"approach": f"{-APPROACH!r} m/s"} if away else APPROACHING
    scene = read_scene(entries(abs(eccentricity), width_over_diameter, motion))
    model = find("bearing", "reynolds_incompressible")
    if away:
        model = replace(model, compute=partial(solve, film=_unrolled_from_the_narrowest, ruptures=True))
    return model.solve(scene, Request(resolution=cells))


def _unrolled_from_the_narrowest(scene: Bearing) -> Problem:
    """The film of a journal from its narrowest place, where it opens; its supply is then not where it closes."""
    problem = incompressible_film(scene)
    thickness, opening, half = problem.shape.thickness, problem.opening, problem.shape.length / 2
    assert opening is not None
    return replace(
        problem,
        shape=replace(problem.shape, thickness=lambda x, y: thickness(x + half, y)),
        opening=lambda x, y: opening(x + half, y),
    )


def scaled(quantity: Quantity, factor: float) -> Quantity:
    """A quantity in another unit, as a number."""
    bar = quantity.uncertainty
    return Quantity(
        value=quantity.value * factor, unit="1", uncertainty=None if bar is None or math.isinf(bar) else bar * factor
    )


def extrapolated(coarse: Quantity, fine: Quantity) -> Quantity:
    """A quantity of second order in the cells from that on a grid and on one of half as large cells.

    The uncertainty is the difference from the finer grid.
    """
    change = (fine.value - coarse.value) / 3
    return Quantity(value=fine.value + change, unit=fine.unit, uncertainty=abs(change))


def sommerfeld_of_din(result: Result, width_over_diameter: float, rate: float = SPEED / RADIUS) -> Quantity:
    """So = F ψ²/(B D η ω), with the load F, the clearance ratio ψ and, for ω, a rate, 1/s."""
    area = (2 * RADIUS) ** 2 * width_over_diameter
    return scaled(result["load"], CLEARANCE_RATIO**2 / (area * VISCOSITY * rate))


def side_flow_of_din(result: Result, rate: float = SPEED / RADIUS) -> Quantity:
    """Q = (flow out of both ends)/(R³ ψ ω), with, for ω, a rate, 1/s."""
    return scaled(result["side_leakage"], 1 / (RADIUS**3 * CLEARANCE_RATIO * rate))
