"""The Stokes equations in OpenFOAM, which keep slope in full and leave inertia out."""

from roughfilm.foamcases.openfoam.model import creeping, openfoam_model
from roughfilm.foamcases.pocket.model import CASES, SOURCES
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """The model applies to every scene; the reason states the reduced Reynolds number, a measure of inertia."""
    return Applicability(applies=True, reason=f"leaves out inertia (Re Ly/w = {scene.reduced_reynolds_number:.3g})")


MODEL = openfoam_model(
    CASES,
    name="stokes",
    summary="adds slope in full; inertia is negligible",
    keeps=frozenset({Effect.SLOPE}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=creeping,
)
