"""The effects that a bearing does not have, whatever a model of it keeps."""

from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Effect


def absent_effects(scene: Bearing) -> frozenset[Effect]:
    """The effects among those of models for several scenes that this one does not have.

    Roughness needs a rough wall, deformation and plasticity asperities that touch, shear thinning and heating a
    lubricant whose viscosity changes with the shear rate and the temperature.
    """
    found: set[Effect] = set()
    if scene.roughness is None:
        found |= {Effect.ROUGHNESS, Effect.FINITE_WAVES}
    if scene.asperities is None:
        found |= {Effect.DEFORMATION, Effect.PLASTICITY}
    if scene.lubricant.shear_thinning is None:
        found.add(Effect.SHEAR_THINNING)
    if scene.lubricant.lacking:
        found |= {Effect.HEATING, Effect.TEMPERATURE_FIELD, Effect.TEMPERATURE_ACROSS}
    return frozenset(found)
