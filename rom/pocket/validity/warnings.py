"""Warnings where a pocket leaves the range of validity of a model."""

from roughfilm.rom.parts.surroundings import rupture_warnings
from roughfilm.rom.pocket.scene import Pocket

TURBULENT = 1440.0
"""Re of the film at which plane shear flow becomes turbulent: 360 in terms of half the speed and half the gap.

Source: Tillmark and Alfredsson 1992, doi:10.1017/S0022112092001046.
"""


def cautions(scene: Pocket) -> tuple[str, ...]:
    """The warnings for every model."""
    warnings = []
    if scene.reynolds_number > TURBULENT:
        warnings.append(
            f"Re = {scene.reynolds_number:.4g} is above {TURBULENT:.0f}, where shear flow becomes turbulent; "
            "all models assume laminar, steady flow"
        )
    return tuple(warnings)


def ruptures(scene: Pocket, lowest: float) -> tuple[str, ...]:
    """A warning if the film would cavitate; ``lowest`` is its lowest pressure above ambient over η u / Ly."""
    return rupture_warnings(
        lowest * scene.pressure_unit,
        scene.cavitation_pressure,
        scene.boundary.ambient_pressure,
        kind="pocket",
        remedy="solve it as a bearing by reynolds_cavitating, lower the speed, or raise boundary.ambient_pressure",
    )
