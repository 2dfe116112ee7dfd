"""The steady Navier-Stokes equations in OpenFOAM, which keep slope and inertia in full."""

from roughfilm.foamcases.openfoam.model import openfoam_model
from roughfilm.foamcases.pocket.model import CASES, SOURCES
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.pocket.scene import Pocket


def applies(scene: Pocket) -> Applicability:
    """The model applies to every scene; the reason states that the flow is taken as laminar and steady."""
    return Applicability(
        applies=True, reason=f"leaves nothing out of a steady laminar flow (Re = {scene.reynolds_number:.3g})"
    )


MODEL = openfoam_model(
    CASES,
    name="navier_stokes",
    summary="adds slope and inertia in full",
    keeps=frozenset({Effect.SLOPE, Effect.INERTIA}),
    sources=SOURCES,
    applies=applies,
    reynolds_number=lambda scene: scene.reynolds_number,
    schemes=("linear_upwind", "upwind"),
)
