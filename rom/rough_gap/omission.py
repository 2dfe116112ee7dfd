"""The effect of cavitation, which all models of a rough gap leave out."""

from math import inf

from roughfilm.rom.ladder.kind import Omission
from roughfilm.rom.rough_gap.scene import RoughGap

OF_SLIDING = frozenset({"B1", "B2", "friction"})
"""The quantities of the flow under sliding."""


def rupture_omitted(scene: RoughGap, quantity: str) -> Omission | None:
    """The unknown, thus infinite change of a quantity of sliding if the film ruptures; None if it does not.

    A gradient alone ruptures no thin film: the pressure in it is nowhere lower than at the outlet.
    """
    from roughfilm.rom.homogenization.flow_factors import flow_factors  # numba is slow to import
    from roughfilm.rom.rough_gap.flow.suction import suction
    from roughfilm.rom.rough_gap.validity import lowest_under_sliding, ruptures

    walls = scene.walls(max(scene.surface().shape))
    if quantity not in OF_SLIDING or not walls.slides:
        return None
    corrector = flow_factors(walls.gap, walls.spacing).correctors[2]
    warnings = ruptures(scene, lowest_under_sliding(scene, suction(walls.gap, corrector)), "under sliding")
    return Omission(part=inf, reason=warnings[0]) if warnings else None
