"""The dictionaries of the case of a pad, with numbers from a scene but no text from it."""

from roughfilm.foamcases.openfoam.block_mesh import Patch
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import (
    ITERATIONS,
    LINEAR_TOLERANCE,
    Dictionary,
    control,
    liquid,
    schemes,
    solution,
)
from roughfilm.foamcases.openfoam.settling import functions

SIDES = (
    Patch(name="inlet", entries={"type": "patch"}),
    Patch(name="outlet", entries={"type": "patch"}),
    Patch(name="lower", entries={"type": "wall"}),
    Patch(name="upper", entries={"type": "wall"}),
    Patch(name="back", entries={"type": "empty"}),
    Patch(name="front", entries={"type": "empty"}),
)
"""The patches of a pad at x-, x+, y-, y+, z-, z+; the sliding wall enters at "inlet" and leaves at "outlet"."""

STEPS = Patch(name="steps", entries={"type": "wall"})
"""The patch of the faces towards cells that a wall with steps leaves out."""


def pad_dictionaries(
    *,
    dialect: Dialect,
    viscosity: float,
    speed: float,
    pressure: float,
    stepped: bool,
    settles: bool,
    tolerance: float,
    scheme: str,
    processes: int,
    relaxation: float,
) -> dict[str, Dictionary]:
    """The files in ``system``, ``constant`` and ``0`` of a pad.

    The pressure is uniform over both end sections. The liquid enters and leaves them with ∂u/∂x = 0, and enters without
    a velocity along the section.

    Parameters
    ----------
    dialect : the dialect of OpenFOAM in which the case is written.
    viscosity : kinematic viscosity over film thickness times the unit of velocity.
    speed : speed of the sliding wall, in that unit.
    pressure : pressure at the inlet above that at the outlet, over density times the square of that unit.
    stepped : whether the mesh has the patch ``STEPS``.
    settles : whether the run ends when its mean velocity no longer changes; otherwise residuals end it.
    tolerance : the initial residual at which the iteration stops.
    scheme : a key of ``ADVECTION``.
    processes : the number of parts along the film into which a parallel run divides the mesh.
    relaxation : the relaxation of velocity in SIMPLEC.
    """
    from foamlib import DimensionSet  # slow to import

    patches = [side.name for side in (*SIDES, STEPS)][: None if stepped else -1]
    still, sliding = {"type": "noSlip"}, {"type": "fixedValue", "value": [speed, 0.0, 0.0]}
    end = {"type": "pressureInletOutletVelocity", "value": [0.0, 0.0, 0.0]}
    velocity = {"inlet": end, "outlet": end, "lower": still, "upper": sliding, "steps": still}
    fixed = {
        "inlet": {"type": "fixedValue", "value": pressure},
        "outlet": {"type": "fixedValue", "value": 0.0},
        "back": {"type": "empty"},
        "front": {"type": "empty"},
    }
    kind, entries = control(ITERATIONS)
    return {
        "system/controlDict": (kind, {**entries, "functions": functions(dialect)} if settles else entries),
        "system/fvSchemes": schemes(scheme),
        "system/fvSolution": solution(
            dialect=dialect,
            tolerance=tolerance,
            linear=LINEAR_TOLERANCE,
            relaxation=relaxation,
            coarsest=20,
            velocity_gain=0.01,
            controlled={} if settles else None,
        ),
        "system/decomposeParDict": (
            "dictionary",
            {
                "numberOfSubdomains": processes,
                "method": "simple",
                "simpleCoeffs": {"n": [processes, 1, 1], "delta": 0.001},
            },
        ),
        **liquid(viscosity),
        "0/U": (
            "volVectorField",
            {
                "dimensions": DimensionSet(length=1, time=-1),
                "internalField": [speed / 2, 0.0, 0.0],
                "boundaryField": {name: velocity.get(name, {"type": "empty"}) for name in patches},
            },
        ),
        "0/p": (
            "volScalarField",
            {
                "dimensions": DimensionSet(length=2, time=-2),
                "internalField": 0.0,
                "boundaryField": {name: fixed.get(name, {"type": "zeroGradient"}) for name in patches},
            },
        ),
    }
