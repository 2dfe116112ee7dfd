"""The Reynolds equation with first-order inertia by a weighted residual."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.error_law import ErrorLaw
from roughfilm.rom.pocket.model import quadrature_model
from roughfilm.rom.pocket.scene import Pocket

LAW = ErrorLaw(powers={"reynolds_number": 1, "aspect": 1}, thresholds={0.02: 1.2, 0.05: 3.0, 0.10: 5.3})


def applies(scene: Pocket) -> Applicability:
    """The expected load error; the model applies to every pocket."""
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
