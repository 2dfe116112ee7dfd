"""The isothermal film of a lubricant that thins with shear."""

from dataclasses import replace

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.film import averaging_applies
from roughfilm.rom.bearing.model import ISOTHERMAL_EFFECTS, SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect

FILMS = 4.0
"""CPU time over that of a film of constant viscosity."""


def applies(scene: Bearing) -> Applicability:
    """Whether the lubricant has a law of shear thinning, with what the model assumes."""
    if scene.lubricant.shear_thinning is None:
        return Applicability(applies=False, reason="lubricant.shear_thinning is missing: the lubricant is Newtonian")
    assumed = "shears the lubricant across a straight gap; leaves out inertia and heat"
    if scene.roughness is None:
        return Applicability(applies=True, reason=assumed)
    fits = averaging_applies(scene)
    return replace(fits, reason=f"{assumed}; takes the shear of the mean gap; {fits.reason}")


_MODEL = bearing_model(
    name="shear_thinning",
    summary="adds shear thinning: viscosity that falls with the shear rate",
    keeps=ISOTHERMAL_EFFECTS | {Effect.SHEAR_THINNING},
    sources=(*SOURCES, "10.1016/S0020-7403(62)80038-1"),
    applies=applies,
    in_plane=4e-6,
)


def cost(scene: Bearing, cells: int) -> float:
    """The expected CPU seconds: those of the film, several times."""
    return FILMS * _MODEL.cost(scene, cells)


MODEL = replace(_MODEL, cost=cost, compute=deferred("rom.bearing.shear_thinning", "solve_thinned"))
