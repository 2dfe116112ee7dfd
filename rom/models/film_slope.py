"""The thin-film Navier-Stokes equations with slope to second order."""

from rom.film import film_model
from rom.ladder import Applicability, Effect
from rom.scene import Scene


def applies(scene: Scene) -> Applicability:
    """Always; says how far from small the slope is."""
    return Applicability(
        applies=True, reason=f"keeps all of inertia, and slope to second order (mean {scene.slope:.3g})"
    )


MODEL = film_model(
    name="film_slope",
    summary="adds slope to second order to film",
    keeps=frozenset({Effect.INERTIA, Effect.SLOPE}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
