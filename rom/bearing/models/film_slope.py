"""The thin-film Navier-Stokes equations of an infinitely wide pad with slope to second order."""

from roughfilm.rom.bearing.wide_pad.model import wide_pad_model
from roughfilm.rom.ladder.model import Effect

MODEL = wide_pad_model(
    name="film_slope",
    summary="adds slope to second order to film",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.INERTIA, Effect.SLOPE}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    left_out="keeps all of inertia, and slope to second order; leaves out cavitation",
)
