"""The Reynolds equation: viscous film flow, no inertia, lowest order in slope."""

from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.pocket.model import quadrature_model
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """The neglected inertia and slope; the model applies to every pocket."""
    effects = f"leaves out inertia (Re Ly/w = {scene.reduced_reynolds_number:.3g}) and slope (mean {scene.slope:.3g})"
    return Applicability(applies=True, reason=effects)


MODEL = quadrature_model(
    name="reynolds",
    summary="Reynolds equation: the simplest film",
    keeps=frozenset(),
    sources=("10.1098/rstl.1886.0005",),
    applies=applies,
)
