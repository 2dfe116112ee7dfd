"""The Reynolds equation with cavitation, averaged over a roughness whose asperities reach through the film."""

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.model import SOURCES, Reading, bearing_model
from roughfilm.rom.ladder.model import Effect

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
    applies=deferred("rom.bearing.mixed.reading", "touches"),
    film=deferred("rom.bearing.mixed.reading", "touching_film"),
    reading=Reading(
        quantities=deferred("rom.bearing.mixed.reading", "mixed_quantities"),
        doubt=deferred("rom.bearing.mixed.reading", "mixed_doubt"),
        fields=deferred("rom.bearing.mixed.reading", "mixed_fields"),
    ),
    in_plane=6e-6,
)
