"""Elastic contact of the surface itself."""

from roughfilm.rom.dry_contact.pressed import pressed_model
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: DryContact) -> Applicability:
    """Always; says by which numbers plasticity is left out."""
    if scene.solid.hardness is None:
        return Applicability(applies=True, reason="leaves nothing out of an elastic contact")
    ratio, index = scene.load.pressure / scene.hardness, scene.pressure_unit / scene.hardness
    told = f"leaves out plasticity: P/H = {ratio:.3g}, plasticity index E* g'/H = {index:.3g}"
    return Applicability(applies=True, reason=f"{told}; how much of the area is plastic cannot be known unsolved")


MODEL = pressed_model(
    name="elastic",
    summary="the surface itself pressed into an elastic half-space: all of interaction",
    keeps=frozenset({Effect.DEFORMATION}),
    sources=("10.1016/S0043-1648(99)00113-1",),
    applies=applies,
)
