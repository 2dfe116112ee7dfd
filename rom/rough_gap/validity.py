"""Warnings where a rough gap leaves the range of validity of the models."""

from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.rom.parts.surroundings import rupture_warnings
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls

TURBULENT = 1300.0
"""Re = ρq/η at which flow between parallel walls becomes turbulent: 1000 with half the gap and the centre speed.

Source: Carlson, Widnall and Peeters 1982, doi:10.1017/S0022112082002006.
"""


def cautions(scene: RoughGap, walls: Walls) -> tuple[str, ...]:
    """The warnings for all models of a scene on these walls."""
    warnings = []
    if scene.reynolds_number > TURBULENT:
        warnings.append(
            f"Re = {scene.reynolds_number:.4g} is above {TURBULENT:.0f}, where flow between parallel walls becomes "
            "turbulent; all models assume laminar, steady flow"
        )
    if walls.slides and (walls.gap == 0).any():
        warnings.append("friction does not converge where the walls touch: it grows as the grid is refined")
    rough = [scene.geometry, *([scene.geometry.upper] if scene.geometry.upper else [])]
    for wall in rough:
        mismatch = 0.0 if wall.described else periodicity_mismatch(wall.read())
        if mismatch > MISMATCH_THRESHOLD:
            warnings.append(f"{wall.name} is not periodic (edge mismatch {mismatch:.2g}), which may reduce the flow")
    return tuple(warnings)


def ruptures(scene: RoughGap, lowest: float, cause: str) -> tuple[str, ...]:
    """A warning if the film would cavitate; ``lowest`` is its lowest pressure above ambient, Pa, and ``cause`` why."""
    return rupture_warnings(
        lowest,
        scene.cavitation_pressure,
        scene.boundary.ambient_pressure,
        kind="rough gap",
        cause=cause,
        remedy="lower the drive, or raise boundary.ambient_pressure",
    )


def lowest_under_sliding(scene: RoughGap, suction: float) -> float:
    """The lowest pressure above ambient under sliding, Pa; ``suction`` is the mean less the lowest over 6ηu, 1/m."""
    return -6 * scene.viscosity * scene.sliding_speed * suction
