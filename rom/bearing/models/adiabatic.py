"""The film whose temperature varies over its plane, as the mean across it, between walls that take no heat."""

from dataclasses import replace

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.model import ISOTHERMAL_EFFECTS, SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.applies import adiabatic_applies
from roughfilm.rom.ladder.model import Effect

FILMS, COARSE_S = 2.0, 0.01
"""CPU time on the finest grid over that of an isothermal film, and that on the coarse grids, s."""

_MODEL = bearing_model(
    name="adiabatic",
    summary="adds the temperature over the film, walls take no heat",
    keeps=ISOTHERMAL_EFFECTS | {Effect.SHEAR_THINNING, Effect.HEATING, Effect.TEMPERATURE_FIELD},
    sources=(*SOURCES, "10.1016/S0020-7403(62)80038-1"),
    applies=adiabatic_applies,
    in_plane=4e-6,
)


def cost(scene: Bearing, cells: int) -> float:
    """The expected CPU seconds: those of the film and of its temperatures."""
    return COARSE_S + FILMS * _MODEL.cost(scene, cells)


MODEL = replace(_MODEL, cost=cost, compute=deferred("rom.bearing.thermal.field.adiabatic", "solve_adiabatic"))
