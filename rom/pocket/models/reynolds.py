"""The Reynolds equation: viscous film flow, no inertia, lowest order in slope."""

from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.pocket.quadrature import quadrature_model
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """Always; says how much inertia and slope it leaves out."""
    return Applicability(
        applies=True,
        reason=f"leaves out inertia (Re Ly/w = {scene.reduced_reynolds_number:.3g}) and slope (mean {scene.slope:.3g})",
    )


MODEL = quadrature_model(
    name="reynolds",
    summary="Reynolds equation, exact quadrature: the plainest film",
    keeps=frozenset(),
    sources=("10.1098/rstl.1886.0005",),
    applies=applies,
)
