"""The Reynolds equation with cavitation that conserves mass: viscous film flow that ruptures."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.model import cavitating_model
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """The neglected inertia and slope; the model applies to every pocket."""
    effects = f"leaves out inertia (Re Ly/w = {scene.reduced_reynolds_number:.3g}) and slope (mean {scene.slope:.3g})"
    return Applicability(applies=True, reason=effects)


MODEL = cavitating_model(
    name="reynolds_cavitating",
    summary="Reynolds equation with mass-conserving cavitation",
    keeps=frozenset({Effect.CAVITATION}),
    sources=("10.1098/rstl.1886.0005", "10.1115/1.3251669", "10.1016/j.triboint.2007.02.021"),
    applies=applies,
)
