"""The Reynolds equation with cavitation over every wave of the roughness."""

from roughfilm.rom.bearing.film import follows, rough_film, rough_resolutions
from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.ladder.model import Effect

MODEL = bearing_model(
    name="direct",
    summary="Reynolds equation with mass-conserving cavitation over every wave of the roughness",
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
    applies=follows,
    film=rough_film,
    resolutions=rough_resolutions,
    in_plane=2e-5,
)
