"""The thin-film Navier-Stokes equations: all of inertia, lowest order in slope."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.model import film_model
from roughfilm.rom.pocket.scene import Pocket


def applies(_scene: Pocket) -> Applicability:
    """The effects that the model keeps; it applies to every pocket."""
    return Applicability(applies=True, reason="keeps all of inertia, leaves out slope")


MODEL = film_model(
    name="film",
    summary="thin-film Navier-Stokes: inertia in full",
    keeps=frozenset({Effect.INERTIA}),
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
