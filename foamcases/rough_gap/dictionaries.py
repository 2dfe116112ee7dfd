"""The dictionaries of a rough gap, with numbers and names from this file alone and no text from a scene."""

import math
from dataclasses import dataclass
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.openfoam.block_mesh import Patch
from roughfilm.foamcases.openfoam.dictionaries import Dictionary, control, liquid, schemes, solution
from roughfilm.foamcases.openfoam.iterate import STOP
from roughfilm.foamcases.openfoam.residuals import FIELDS

ITERATIONS = 3000
"""Largest number of iterations."""

STRAIGHT_ITERATIONS = 200
"""Iterations of a creeping straight flow, which settles within 50; no residual ends it, as most are round-off."""

CREEPING = 1.0
"""Reynolds number up to which a flow counts as creeping; above it, straight flows settle later."""

LINEAR_TOLERANCE = 1e-3
"""Residual at which a linear solver stops, in units of the tolerance."""

COARSEST = 20
"""Cells of multigrid's coarsest level."""

VELOCITY_GAIN = 0.1

SLIDING_SPEED = 2.0
"""Speed of the upper wall; a smooth gap then has the flow 1, as under the gradient."""

SIDES = (
    Patch(name="west", entries={"type": "cyclic", "neighbourPatch": "east"}),
    Patch(name="east", entries={"type": "cyclic", "neighbourPatch": "west"}),
    Patch(name="south", entries={"type": "cyclic", "neighbourPatch": "north"}),
    Patch(name="north", entries={"type": "cyclic", "neighbourPatch": "south"}),
    Patch(name="lower", entries={"type": "wall"}),
    Patch(name="upper", entries={"type": "wall"}),
)
"""The patches of a gap at x-, x+, y-, y+, z-, z+."""

CONTACT = Patch(name="contact", entries={"type": "wall"})
"""The patch of the edges of contact."""


MEAN_VELOCITY = "flow"
"""The name of the function that logs the mean velocity of all cells, in each iteration."""

FUNCTIONS = {
    MEAN_VELOCITY: {
        "type": "volFieldValue",
        "libs": ['"libfieldFunctionObjects.so"'],
        "fields": ["U"],
        "operation": "volAverage",
        "regionType": "all",
        "writeFields": False,
        "writePrecision": 12,
        "log": False,
    },
    "stop": {
        "type": "abort",
        "libs": ['"libutilityFunctionObjects.so"'],
        "file": f'"<case>/{STOP}"',
        "action": "writeNow",
    },
}


@dataclass(frozen=True, kw_only=True)
class Drive:
    """The drive of a flow: mean pressure gradients along x and y, and the speed of the upper wall."""

    name: str
    gradient: tuple[float, float] = (0.0, 0.0)
    speed: float = 0.0


DRIVES = (
    Drive(name="along", gradient=(1.0, 0.0)),
    Drive(name="across", gradient=(0.0, 1.0)),
    Drive(name="sliding", speed=SLIDING_SPEED),
)


def relaxation(layers: int, cells: tuple[float, float], *, straight: bool = False) -> float:
    """The relaxation of velocity in SIMPLEC, near the fewest iterations for 4 to 32 layers and cells of 0.05 to 3 gaps.

    SIMPLEC corrects the velocity of each cell by its own pressure, in proportion to 1 less the relaxation; the
    correction should be that of a whole column, so that the relaxation is nearer to 1 the smaller the cells are. The
    converged flow depends on it by 1e-5, and by 1e-4 beside edges of contact; every case on a mesh has the same value.
    A straight flow has no pressure.

    Parameters
    ----------
    cells : length and width of the cells, in mean gaps.
    """
    return 0.999 if straight else 1 - 0.8 / math.sqrt(layers**2 + cells[0] ** -2 + cells[1] ** -2)


def parts_of(processes: int, size: tuple[float, float]) -> tuple[int, int]:
    """The numbers of parts along x and y of a period for so many processes, as square as possible."""
    pairs = [(n, processes // n) for n in range(1, processes + 1) if processes % n == 0]
    return min(pairs, key=lambda pair: abs(math.log(size[0] / pair[0] * pair[1] / size[1])))


def gap_dictionaries(
    drive: Drive,
    *,
    reynolds_number: float,
    tolerance: float,
    scheme: str,
    parts: tuple[int, int],
    relaxation: float,
    velocity: Array,
    pressure: Array,
    patches: tuple[Patch, ...],
    moving: tuple[str, ...] = FIELDS,
) -> dict[str, Dictionary]:
    """``system``, ``constant`` and ``0`` of a gap.

    Lengths are in mean gaps, velocities in the mean velocity V of a smooth one, kinematic pressures in V².

    Parameters
    ----------
    parts : into how many parts along x and y a parallel run is to cut the mesh.
    relaxation : of velocity.
    velocity, pressure : those of the start, shapes (cells, 3) and (cells,).
    patches : of the mesh.
    moving : the fields in which there is anything, as :class:`roughfilm.foamcases.openfoam.residuals.Judged` has them.
    """
    from foamlib import DimensionSet  # slow to import

    viscosity = 1 / reynolds_number
    force = [12 * viscosity * part for part in drive.gradient]
    still = {"type": "noSlip"}
    walls: dict[str, Any] = {
        "lower": still,
        "upper": {"type": "fixedValue", "value": [drive.speed, 0.0, 0.0]},
        "contact": still,
    }
    brief = "p" not in moving and reynolds_number <= CREEPING
    kind, entries = control(STRAIGHT_ITERATIONS if brief else ITERATIONS)
    return {
        "system/controlDict": (kind, {**entries, "functions": FUNCTIONS}),
        "system/fvSchemes": schemes(scheme),
        "system/fvSolution": solution(
            tolerance=tolerance,
            linear=LINEAR_TOLERANCE,
            relaxation=relaxation,
            coarsest=COARSEST,
            velocity_gain=VELOCITY_GAIN,
            controlled=("p", "U") if {*moving} == {*FIELDS} else (),
        ),
        "system/decomposeParDict": (
            "dictionary",
            {
                "numberOfSubdomains": parts[0] * parts[1],
                "method": "hierarchical",
                "hierarchicalCoeffs": {"n": [*parts, 1], "delta": 0.001, "order": "xyz"},
            },
        ),
        **liquid(viscosity),
        "constant/fvOptions": (
            "dictionary",
            {
                "gradient": {
                    "type": "vectorSemiImplicitSource",
                    "active": True,
                    "selectionMode": "all",
                    "volumeMode": "specific",
                    "injectionRateSuSp": {"U": [[*force, 0.0], 0.0]},
                }
            },
        ),
        "0/U": (
            "volVectorField",
            {
                "dimensions": DimensionSet(length=1, time=-1),
                "internalField": velocity,
                "boundaryField": {p.name: walls.get(p.name, {"type": p.entries["type"]}) for p in patches},
            },
        ),
        "0/p": (
            "volScalarField",
            {
                "dimensions": DimensionSet(length=2, time=-2),
                "internalField": pressure,
                "boundaryField": {
                    p.name: {"type": "zeroGradient" if p.name in walls else p.entries["type"]} for p in patches
                },
            },
        ),
    }
