"""Where a model leaves the ground on which it was compared or may be assumed: cautions, in words."""

from rom.ladder import Effect
from rom.scene import Scene

TURBULENT = 1440.0
"""Re of the film at which plane shear flow turns turbulent: 360 for half the speed and half the gap.

Source: Tillmark and Alfredsson 1992, doi:10.1017/S0022112092001046.
"""

FIRST_ORDER = 16.0
"""Largest Re Ly/w at which first-order inertia was compared with Navier-Stokes.

There its load is 8 % off at d/Ly = 0.25 and 37 % at 0.75.
"""


def cautions(scene: Scene, keeps: frozenset[Effect]) -> tuple[str, ...]:
    """What a reader must know before believing a model that keeps these effects on this scene."""
    words = []
    if scene.reynolds_number > TURBULENT:
        words.append(
            f"Re = {scene.reynolds_number:.4g} is above {TURBULENT:.0f}, where shear flow turns turbulent; "
            "every model here takes it as laminar and steady"
        )
    reduced = scene.reduced_reynolds_number
    if Effect.INERTIA in keeps and Effect.SLOPE not in keeps and reduced > 1.01 * FIRST_ORDER:
        words.append(
            f"Re Ly/w = {reduced:.3g} is above {FIRST_ORDER:.0f}, up to which first-order inertia was compared "
            "with Navier-Stokes; its load may be far too high"
        )
    return tuple(words)
