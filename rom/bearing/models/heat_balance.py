"""The film of the isothermal models at the one temperature at which its heat is balanced."""

from dataclasses import replace

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.model import ISOTHERMAL_EFFECTS, SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.applies import heat_balance_applies
from roughfilm.rom.ladder.model import Effect

FILMS, SEARCH_S = 2.0, 0.04
"""CPU time on the finest grid over that of the film, and that of the search for the temperature on a coarse one, s."""

_MODEL = bearing_model(
    name="heat_balance",
    summary="adds heating: one temperature of the film by its heat balance",
    keeps=ISOTHERMAL_EFFECTS | {Effect.SHEAR_THINNING, Effect.HEATING},
    sources=(*SOURCES, "DIN 31652-1", "ISO 7902-1"),
    applies=heat_balance_applies,
    in_plane=4e-6,
)


def cost(scene: Bearing, cells: int) -> float:
    """The expected CPU seconds: those of the search for the temperature, and of the film at two of them."""
    return SEARCH_S + FILMS * _MODEL.cost(scene, cells)


MODEL = replace(_MODEL, cost=cost, compute=deferred("rom.bearing.thermal.heat_balance", "solve_heat_balance"))
