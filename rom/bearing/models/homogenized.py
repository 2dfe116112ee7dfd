"""The homogenized Reynolds equation with cavitation: roughness by its flow factors."""

from roughfilm.rom.bearing.film import averaged_film, averaged_films, homogenized_applies
from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.ladder.model import Effect

MODEL = bearing_model(
    name="homogenized",
    summary="adds roughness by its flow factors",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE, Effect.ROUGHNESS}),
    sources=(*SOURCES, "10.1016/j.jmaa.2005.09.036"),
    applies=homogenized_applies,
    film=averaged_film,
    searched=averaged_films,
    in_plane=4e-6,
    oblique=4.0,
)
