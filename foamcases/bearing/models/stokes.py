"""The Stokes equations of an infinitely wide pad in OpenFOAM, which keep slope in full and leave inertia out."""

from roughfilm.foamcases.bearing.model import CASES, SOURCES, pad_applies
from roughfilm.foamcases.openfoam.model import creeping, openfoam_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Whether the scene is an infinitely wide pad that has a mesh."""
    return pad_applies(scene, left_out="leaves out cavitation, inertia and side flow")


MODEL = openfoam_model(
    CASES,
    name="stokes",
    summary="wide pad with the whole film resolved, creeping",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.SLOPE}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=creeping,
)
