"""The homogenized Reynolds equation with cavitation, with asperities that touch and deform."""

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.film import averaging_applies
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
    summary="adds asperities that touch and deform",
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
    film=deferred("rom.bearing.mixed.quantities", "film_of_scene"),
    searched=deferred("rom.bearing.mixed.quantities", "searched_films"),
    solve=deferred("rom.bearing.mixed.quantities", "solve_mixed"),
    in_plane=6e-6,
)
