"""Where a model leaves the ground on which it was compared or may be assumed: cautions, in words."""

from roughfilm.rom.pocket.error_law import ErrorLaw
from roughfilm.rom.pocket.scene import Pocket

TURBULENT = 1440.0
"""Re of the film at which plane shear flow turns turbulent: 360 for half the speed and half the gap.

Source: Tillmark and Alfredsson 1992, doi:10.1017/S0022112092001046.
"""


def cautions(scene: Pocket, law: ErrorLaw | None = None) -> tuple[str, ...]:
    """What a reader must know before believing a model whose errors follow this law, if one is known."""
    told = []
    if scene.reynolds_number > TURBULENT:
        told.append(
            f"Re = {scene.reynolds_number:.4g} is above {TURBULENT:.0f}, where shear flow turns turbulent; "
            "every model here takes it as laminar and steady"
        )
    if law is not None and law.within(scene) is None:
        told.append(law.told(scene))
    return tuple(told)


NOTHING_COARSER = "there is no coarser grid to compare with; how far off this is cannot be said"
"""A warning: of answers without error bars."""
