"""The steady Navier-Stokes equations in OpenFOAM: slope and inertia in full."""

from foamcases import pocket
from foamcases.case import RESOLUTION
from foamcases.openfoam import availability
from rom.ladder import Applicability, Effect, Model
from rom.scene import Scene

NAME = "navier_stokes"
KEEPS = frozenset({Effect.SLOPE, Effect.INERTIA})


def applies(scene: Scene) -> Applicability:
    """Always; says that the flow is taken as laminar and steady."""
    return Applicability(
        applies=True, reason=f"leaves nothing out of a steady laminar flow (Re = {scene.reynolds_number:.3g})"
    )


SOLVE, WRITE = pocket.composed(NAME, KEEPS, None)

MODEL = Model(
    name=NAME,
    summary="adds slope and inertia in full: the best rung",
    keeps=KEEPS,
    sources=pocket.SOURCES,
    resolution=RESOLUTION,
    resolutions=pocket.RESOLUTIONS,
    resolution_meaning=pocket.RESOLUTION_MEANING,
    residual_meaning=pocket.RESIDUAL_MEANING,
    order=2,
    cost=pocket.cost,
    applies=applies,
    solve=SOLVE,
    available=availability,
    write=WRITE,
)
