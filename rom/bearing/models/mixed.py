"""The Reynolds equation with cavitation, averaged over a roughness whose asperities reach through the film."""

from roughfilm.rom.bearing.mixed.reading import mixed_doubt, mixed_fields, mixed_quantities, touches, touching_film
from roughfilm.rom.bearing.solve import SOURCES, Reading, bearing_model
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
    applies=touches,
    film=touching_film,
    reading=Reading(quantities=mixed_quantities, doubt=mixed_doubt, fields=mixed_fields),
    in_plane=6e-6,
)
