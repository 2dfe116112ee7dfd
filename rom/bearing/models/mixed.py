"""The homogenized Reynolds equation with cavitation, with asperities that touch and deform."""

from roughfilm.rom.bearing.film import averaging_applies
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.bearing.mixed.quantities import MIXED_OUTPUTS
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Whether the scene describes the contact of its walls and its roughness can be averaged."""
    if scene.asperities is None:
        return Applicability(applies=False, reason="the scene has no table asperities with the solids of the walls")
    return averaging_applies(scene)


MODEL = bearing_model(
    name="mixed",
    summary="homogenized Reynolds equation with mass-conserving cavitation, and asperities that touch and deform",
    keeps=frozenset(
        {
            Effect.SIDE_FLOW,
            Effect.CAVITATION,
            Effect.PRESSURE_DEPENDENCE,
            Effect.ROUGHNESS,
            Effect.DEFORMATION,
            Effect.PLASTICITY,
        }
    ),
    sources=(*SOURCES, "Sahlin 2008, Paper E"),
    applies=applies,
    film=lambda scene: mixed_problem(scene, asperities_of(scene)),
    outputs=MIXED_OUTPUTS,
    in_plane=6e-6,
)
