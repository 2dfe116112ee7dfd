"""Elastic contact of the surface itself."""

from roughfilm.rom.dry_contact.pressed import pressed_model
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: DryContact) -> Applicability:
    """The neglected plasticity; the model applies to every dry contact."""
    if scene.solid.hardness is None:
        return Applicability(applies=True, reason="leaves nothing out of an elastic contact")
    ratio, index = scene.load.pressure / scene.hardness, scene.pressure_unit / scene.hardness
    reason = f"leaves out plasticity: P/H = {ratio:.3g}, plasticity index E* g'/H = {index:.3g}"
    return Applicability(applies=True, reason=f"{reason}; the plastic area is unknown before the solution")


MODEL = pressed_model(
    name="elastic",
    summary="the surface itself on an elastic half-space, with full interaction",
    keeps=frozenset({Effect.DEFORMATION}),
    sources=("10.1016/S0043-1648(99)00113-1",),
    applies=applies,
)
