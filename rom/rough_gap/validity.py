"""Warnings where a rough gap leaves the range of validity of the models."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, joint_mismatch
from roughfilm.rom.parts.surroundings import rupture_warnings
from roughfilm.rom.rough_gap.flow.range_of_validity import (
    MAX_ADDED_DISSIPATION,
    MAX_ROUGHNESS,
    change_by_roughness,
)
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import TOUCHING, Walls

MAX_OMITTED = 0.01
"""Largest relative change of the flow by an omitted effect of the walls without a warning."""


def too_steep(added: Array, limit: float) -> tuple[str, ...]:
    """The warning that slope adds more than ``limit`` of the thin-film dissipation; empty if it does not.

    ``added`` is that of :attr:`roughfilm.rom.rough_gap.flow.corrected.SlopeCorrected.added`.
    """
    most = float(added.max())
    if most <= limit:
        return ()
    remedy = "slope_corrected" if most <= MAX_ADDED_DISSIPATION else "stokes"
    return (f"slope adds {most:.2g} of the thin-film dissipation, above {limit:g}: out of its range, take {remedy}",)


def too_rough(walls: Walls) -> tuple[str, ...]:
    """The warning that roughness changes a coefficient of a smooth gap by above ``MAX_OMITTED``; empty if not."""
    ratio = float(np.hypot(walls.lower.std(), walls.upper.std())) / walls.mean_gap
    if ratio > MAX_ROUGHNESS:
        return (f"Sq/h̄ = {ratio:.2g} is above {MAX_ROUGHNESS:g}: out of its range, take homogenized",)
    change = change_by_roughness(walls)
    if change <= MAX_OMITTED:
        return ()
    return (
        f"roughness changes flow or friction by about {change:.2g}, above {MAX_OMITTED:g}: out of its range, "
        "take homogenized",
    )


def cautions(scene: RoughGap, walls: Walls) -> tuple[str, ...]:
    """The warnings for all models of a scene on these walls."""
    warnings = []
    if walls.slides and walls.touch:
        warnings.append(f"{TOUCHING}, and its error is unknown")
    rough = [scene.geometry, *([scene.geometry.upper] if scene.geometry.upper else [])]
    for wall in rough:
        warnings += wall.warnings()
        mismatch = 0.0 if wall.described else joint_mismatch(wall.read())
        if mismatch > MISMATCH_THRESHOLD:
            warnings.append(f"{wall.name} is not periodic (edge mismatch {mismatch:.2g}), which may reduce the flow")
    return tuple(warnings)


def ruptures(scene: RoughGap, lowest: float, cause: str) -> tuple[str, ...]:
    """A warning if the film would cavitate; ``lowest`` is its lowest pressure above ambient, Pa, and ``cause`` why."""
    return rupture_warnings(
        lowest,
        scene.cavitation_pressure,
        scene.boundary.ambient_pressure,
        left_out_by="no model of a rough gap includes",
        cause=cause,
        remedy="lower the drive, or raise boundary.ambient_pressure",
    )


def lowest_under_sliding(scene: RoughGap, suction: float) -> float:
    """The lowest pressure above ambient under sliding, Pa; ``suction`` is the mean less the lowest over 6ηu, 1/m."""
    return -6 * scene.viscosity * scene.sliding_speed * suction
