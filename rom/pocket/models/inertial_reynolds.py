"""The Reynolds equation with first-order inertia by a weighted residual."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.model import quadrature_model
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """The effects that the model keeps and leaves out; it applies to every pocket."""
    return Applicability(
        applies=True, reason=f"keeps inertia to first order, leaves out slope (2d/w = {scene.slope:.3g})"
    )


MODEL = quadrature_model(
    name="inertial_reynolds",
    summary="adds inertia to first order in the Reynolds number",
    keeps=frozenset({Effect.INERTIA}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
