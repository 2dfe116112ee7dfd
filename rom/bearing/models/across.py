"""The film whose temperature varies over its plane and across it, between the walls of the table [heat]."""

from dataclasses import replace

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.model import ISOTHERMAL_EFFECTS, SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.applies import across_applies
from roughfilm.rom.ladder.model import Effect

FILMS = 10.0
"""CPU time over that of an isothermal film."""

_MODEL = bearing_model(
    name="across",
    summary="adds the temperature across the film, and walls that take heat",
    keeps=ISOTHERMAL_EFFECTS
    | {Effect.SHEAR_THINNING, Effect.HEATING, Effect.TEMPERATURE_FIELD, Effect.TEMPERATURE_ACROSS},
    sources=(*SOURCES, "10.1016/S0020-7403(62)80038-1"),
    applies=across_applies,
    in_plane=4e-6,
)


def cost(scene: Bearing, cells: int) -> float:
    """The expected CPU seconds: those of the film and of its temperatures."""
    return FILMS * _MODEL.cost(scene, cells)


MODEL = replace(_MODEL, cost=cost, compute=deferred("rom.bearing.thermal.field.across", "solve_across"))
