"""The thin-film Navier-Stokes equations: all of inertia, lowest order in slope."""

from rom.film import film_model
from rom.ladder import Applicability, Effect
from rom.scene import Scene


def applies(scene: Scene) -> Applicability:
    """Always; says how much slope it leaves out."""
    return Applicability(applies=True, reason=f"keeps all of inertia, leaves out slope (mean {scene.slope:.3g})")


MODEL = film_model(
    name="film",
    summary="thin-film Navier-Stokes: inertia in full",
    keeps=frozenset({Effect.INERTIA}),
    complete=True,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
