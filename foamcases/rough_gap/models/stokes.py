"""The Stokes equations between rough walls in OpenFOAM, which keep slope in full and leave inertia out."""

from roughfilm.foamcases.openfoam.model import creeping, openfoam_model
from roughfilm.foamcases.rough_gap.model import CASES, SOURCES
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.scene import RoughGap


def applies(scene: RoughGap) -> Applicability:
    """The model applies to every scene; the reason states Re g', a measure of the inertia that it leaves out."""
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
