"""Where results of rough gaps leave what may be assumed: cautions, in words."""

from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls

TURBULENT = 1300.0
"""Re = ρq/η at which flow between parallel walls turns turbulent: 1000 for half the gap and the speed in its middle.

Source: Carlson, Widnall and Peeters 1982, doi:10.1017/S0022112082002006.
"""


def cautions(scene: RoughGap, walls: Walls) -> tuple[str, ...]:
    """What a reader must know before believing any model of the scene on these walls."""
    told = []
    if scene.reynolds_number > TURBULENT:
        told.append(
            f"Re = {scene.reynolds_number:.4g} is above {TURBULENT:.0f}, where flow between parallel walls turns "
            "turbulent; every model here takes it as laminar and steady"
        )
    if walls.slides and (walls.gap == 0).any():
        told.append("friction and what it is made of have no limit where walls touch: they grow as nodes get finer")
    rough = [scene.geometry, *([scene.geometry.upper] if scene.geometry.upper else [])]
    for wall in rough:
        mismatch = 0.0 if wall.described else periodicity_mismatch(wall.read())
        if mismatch > MISMATCH_THRESHOLD:
            told.append(
                f"{wall.name} meets itself badly at its joints (mismatch {mismatch:.2g}), which may throttle the flow"
            )
    return tuple(told)
