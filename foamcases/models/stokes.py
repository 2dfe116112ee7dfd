"""The Stokes equations in OpenFOAM: all of the shape, no inertia."""

from foamcases import pocket
from foamcases.case import RESOLUTION
from foamcases.openfoam import availability
from rom.ladder import Applicability, Effect, Model
from rom.scene import Scene

NAME = "stokes"
KEEPS = frozenset({Effect.SLOPE})

CREEPING = 1e-6
"""The Reynolds number of the run: advection is then a millionth of viscous stress (there is no scheme "none")."""


def applies(scene: Scene) -> Applicability:
    """Always; says how much inertia it leaves out."""
    reduced = scene.reynolds_number * scene.geometry.film / scene.geometry.width
    return Applicability(applies=True, reason=f"leaves out inertia (Re Ly/w = {reduced:.3g})")


SOLVE, WRITE = pocket.composed(NAME, KEEPS, CREEPING)

MODEL = Model(
    name=NAME,
    summary="adds slope: the whole film resolved, inertia negligible",
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
