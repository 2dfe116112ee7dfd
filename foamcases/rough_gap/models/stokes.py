"""The Stokes equations between rough walls in OpenFOAM: all of their shape, no inertia."""

from roughfilm.foamcases.openfoam.model import creeping, openfoam_model
from roughfilm.foamcases.rough_gap.model import CASES, SOURCES
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.scene import RoughGap


def applies(scene: RoughGap) -> Applicability:
    """Always; says how much inertia it leaves out."""
    measure = scene.reynolds_number * scene.rms_slope
    return Applicability(applies=True, reason=f"leaves out inertia (Re g' = {measure:.3g})")


MODEL = openfoam_model(
    CASES,
    name="stokes",
    summary="adds slope: the whole gap resolved, inertia negligible",
    keeps=frozenset({Effect.ROUGHNESS, Effect.SLOPE}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=creeping,
)
