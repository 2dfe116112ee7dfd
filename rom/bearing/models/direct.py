"""The Reynolds equation with cavitation, all waves of the roughness resolved."""

from roughfilm.rom.bearing.film import direct_applies, rough_film, rough_films, rough_resolutions
from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.ladder.model import Effect

MODEL = bearing_model(
    name="direct",
    summary="adds roughness with every wave resolved",
    keeps=frozenset(
        {
            Effect.SIDE_FLOW,
            Effect.CAVITATION,
            Effect.PRESSURE_DEPENDENCE,
            Effect.ROUGHNESS,
            Effect.FINITE_WAVES,
        }
    ),
    sources=SOURCES,
    applies=direct_applies,
    film=rough_film,
    searched=rough_films,
    resolutions=rough_resolutions,
    in_plane=6e-6,
)
