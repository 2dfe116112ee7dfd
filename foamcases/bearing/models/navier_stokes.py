"""The steady Navier-Stokes equations of an infinitely wide pad in OpenFOAM, which keep slope and inertia in full."""

from roughfilm.foamcases.bearing.model import CASES, SOURCES, pad_applies
from roughfilm.foamcases.bearing.units import reynolds_number
from roughfilm.foamcases.openfoam.model import openfoam_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.gap import thin_film_obstacle
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Whether the scene is an infinitely wide pad that has a mesh, with a density."""
    if scene.lubricant.density is None:
        return Applicability(applies=False, reason=str(thin_film_obstacle(scene)))
    return pad_applies(scene, left_out="leaves out cavitation and side flow")


MODEL = openfoam_model(
    CASES,
    name="navier_stokes",
    summary="wide pad: slope and inertia in full",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.INERTIA, Effect.SLOPE}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=reynolds_number,
    schemes=("linear_upwind", "upwind"),
)
