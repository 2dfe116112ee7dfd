"""The Reynolds equation with first-order inertia by a weighted residual."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.model import quadrature_model
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.promise import applicability


def applies(scene: Pocket) -> Applicability:
    """The expected errors; the model applies to every pocket."""
    return applicability(
        scene, "inertial_reynolds", f"keeps inertia to first order, leaves out slope (2d/w = {scene.slope:.3g})"
    )


MODEL = quadrature_model(
    name="inertial_reynolds",
    summary="adds inertia to first order in the Reynolds number",
    keeps=frozenset({Effect.INERTIA}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1115/1.1828067"),
    applies=applies,
)
