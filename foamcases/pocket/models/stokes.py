"""The Stokes equations in OpenFOAM: all of the shape, no inertia."""

from roughfilm.foamcases.openfoam.model import creeping, openfoam_model
from roughfilm.foamcases.pocket.model import CASES, SOURCES
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """Always; says how much inertia it leaves out."""
    return Applicability(applies=True, reason=f"leaves out inertia (Re Ly/w = {scene.reduced_reynolds_number:.3g})")


MODEL = openfoam_model(
    CASES,
    name="stokes",
    summary="adds slope: the whole film resolved, inertia negligible",
    keeps=frozenset({Effect.SLOPE}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=creeping,
)
