"""The Reynolds equation with first-order inertia by a weighted residual."""

from rom.error_law import ErrorLaw
from rom.ladder import Applicability, Effect
from rom.quadrature import quadrature_model
from rom.scene import Scene

LAW = ErrorLaw(powers={"reynolds_number": 1, "slope": 1}, thresholds={0.01: 1.0, 0.02: 2.0, 0.05: 4.0, 0.10: 7.0})


def applies(scene: Scene) -> Applicability:
    """Always; says how far its load may be off."""
    return LAW.applicability(scene, f"keeps inertia to first order, leaves out slope (2d/w = {scene.slope:.3g})")


MODEL = quadrature_model(
    name="inertial_reynolds",
    summary="adds inertia to first order in the Reynolds number",
    keeps=frozenset({Effect.INERTIA}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
    law=LAW,
)
