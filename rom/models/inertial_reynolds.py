"""The Reynolds equation with first-order inertia by a weighted residual."""

from rom.ladder import Applicability, Effect
from rom.quadrature import quadrature_model
from rom.scene import Scene


def applies(scene: Scene) -> Applicability:
    """Always; says how far from small the reduced Reynolds number is."""
    return Applicability(
        applies=True,
        reason=f"keeps inertia to first order in Re Ly/w = {scene.reduced_reynolds_number:.3g}, "
        f"leaves out slope (mean {scene.slope:.3g})",
    )


MODEL = quadrature_model(
    name="inertial_reynolds",
    summary="adds inertia to first order in the Reynolds number",
    keeps=frozenset({Effect.INERTIA}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
