"""The thin-film Navier-Stokes equations with slope to second order."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.model import film_model
from roughfilm.rom.pocket.scene import Pocket


def applies(_scene: Pocket) -> Applicability:
    """The effects that the model keeps; it applies to every pocket."""
    return Applicability(applies=True, reason="keeps all of inertia, and slope to second order")


MODEL = film_model(
    name="film_slope",
    summary="adds slope to second order to film",
    keeps=frozenset({Effect.INERTIA, Effect.SLOPE}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
