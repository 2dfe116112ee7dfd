"""Elastic and perfectly plastic contact of the surface itself."""

from roughfilm.rom.dry_contact.pressed import pressed_model
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: DryContact) -> Applicability:
    """The treatment of plasticity; the model applies to every dry contact."""
    effects = "without a hardness the same as elastic" if scene.solid.hardness is None else "leaves nothing out"
    return Applicability(applies=True, reason=f"{effects}; plastic heights move to the plane without conserving volume")


MODEL = pressed_model(
    name="elastic_plastic",
    summary="adds plastic flow at the hardness: the most complete model",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY}),
    sources=("10.1016/j.triboint.2005.11.008", "10.1016/S0043-1648(99)00113-1"),
    applies=applies,
)
