"""The thin-film Navier-Stokes equations of an infinitely wide pad: all of inertia, lowest order in slope."""

from roughfilm.rom.bearing.wide_pad.model import wide_pad_model
from roughfilm.rom.ladder.model import Effect

MODEL = wide_pad_model(
    name="film",
    summary="thin-film Navier-Stokes of a wide pad: inertia",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.INERTIA}),
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    left_out="keeps all of inertia; leaves out slope and cavitation",
)
