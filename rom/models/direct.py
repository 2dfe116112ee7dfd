"""The Reynolds equation with cavitation over every wave of the roughness."""

from rom.bearing_rung import bearing_model
from rom.ladder import Effect
from rom.rough_film import follows, rough_film, rough_resolutions

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
    applies=follows,
    film=rough_film,
    resolutions=rough_resolutions,
    in_plane=2e-5,
)
