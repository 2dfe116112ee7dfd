"""The thin-film Navier-Stokes equations with slope to second order."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.error_law import ErrorLaw
from roughfilm.rom.pocket.model import film_model
from roughfilm.rom.pocket.scene import Pocket

LAW = ErrorLaw(powers={"slope": 1}, thresholds={0.01: 0.46, 0.02: 0.75, 0.05: 1.25})


def applies(scene: Pocket) -> Applicability:
    """The expected load error; the model applies to every pocket."""
    return LAW.applicability(scene, "keeps all of inertia, and slope to second order")


MODEL = film_model(
    name="film_slope",
    summary="adds slope to second order to film",
    keeps=frozenset({Effect.INERTIA, Effect.SLOPE}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
    law=LAW,
)
