"""The thin-film Navier-Stokes equations: all of inertia, lowest order in slope."""

from rom.error_law import ErrorLaw
from rom.film import film_model
from rom.ladder import Applicability, Effect
from rom.scene import Scene

LAW = ErrorLaw(powers={"slope": 1}, thresholds={0.01: 0.1, 0.02: 0.2, 0.05: 0.4, 0.10: 0.5})


def applies(scene: Scene) -> Applicability:
    """Always; says how far its load may be off."""
    return LAW.applicability(scene, "keeps all of inertia, leaves out slope")


MODEL = film_model(
    name="film",
    summary="thin-film Navier-Stokes: inertia in full",
    keeps=frozenset({Effect.INERTIA}),
    complete=True,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
    law=LAW,
)
