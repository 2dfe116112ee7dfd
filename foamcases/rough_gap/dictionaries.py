"""The dictionaries of the cases of a rough gap, with numbers from a scene but no text from it."""

import math
from dataclasses import dataclass
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.openfoam.block_mesh import Patch
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import Dictionary, control, liquid, schemes, solution
from roughfilm.foamcases.openfoam.residuals import FIELDS
from roughfilm.foamcases.openfoam.settling import ALL_CELLS, functions

ITERATIONS = 3000
"""Largest number of iterations."""

STRAIGHT_ITERATIONS = 200
"""Largest number of iterations of a creeping straight flow, which settles within 50.

No residual ends this run, because most of them are round-off.
"""

CREEPING = 1.0
"""Largest Reynolds number of a flow that counts as creeping; above it, straight flows settle later."""

LINEAR_TOLERANCE = 1e-3
"""Residual at which a linear solver stops, over the tolerance of the flow."""

COARSEST = 20
"""Number of cells on multigrid's coarsest level."""

VELOCITY_GAIN = 0.1
"""Last residual of velocity in a linear solver, over its first one, at which the solver may stop."""

SLIDING_SPEED = 2.0
"""Speed of the upper wall, in V; a smooth gap then has the flow 1, as under the gradient 1."""

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


@dataclass(frozen=True, kw_only=True)
class Drive:
    """The drive of a flow: mean pressure gradients along x and y, in G, and speed of the upper wall along x, in V."""

    name: str
    gradient: tuple[float, float] = (0.0, 0.0)
    speed: float = 0.0


DRIVES = (
    Drive(name="along", gradient=(1.0, 0.0)),
    Drive(name="across", gradient=(0.0, 1.0)),
    Drive(name="sliding", speed=SLIDING_SPEED),
)
"""The three drives of a gap, each of which has a case of its own."""


def relaxation(layers: int, cells: tuple[float, float], *, straight: bool = False) -> float:
    """The relaxation of velocity in SIMPLEC: 1 - 0.8 / sqrt(layers² + 1/length² + 1/width²), or 0.999 if ``straight``.

    It needs nearly the fewest iterations for 4 to 32 layers and cells of 0.05 to 3 mean gaps. SIMPLEC corrects the
    velocity of each cell by its own pressure, in proportion to 1 less the relaxation. The correction should be that of
    a whole column, so the relaxation is nearer to 1 for smaller cells. The converged flow depends on the relaxation by
    1e-5, and by 1e-4 beside edges of contact.

    Parameters
    ----------
    layers : number of cells across the gap.
    cells : length and width of the cells, in mean gaps.
    straight : whether the flow is straight, with constant pressure.
    """
    return 0.999 if straight else 1 - 0.8 / math.sqrt(layers**2 + cells[0] ** -2 + cells[1] ** -2)


def gap_dictionaries(
    drive: Drive,
    *,
    dialect: Dialect,
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
    """The files in ``system``, ``constant`` and ``0`` of a gap, by their paths in the case.

    Lengths are in mean gaps, velocities in the mean velocity V of a smooth gap, and kinematic pressures in V².

    Parameters
    ----------
    drive : the mean pressure gradient and the speed of the upper wall.
    dialect : the dialect of OpenFOAM in which the case is written.
    reynolds_number : ρ q/η of a smooth gap with the thickness of the mean gap.
    tolerance : the initial residual at which the iteration stops.
    scheme : a key of ``ADVECTION``.
    parts : the numbers of parts along x and y into which a parallel run divides the mesh.
    relaxation : the relaxation of velocity.
    velocity, pressure : the initial fields, shapes (cells, 3) and (cells,), or their value in all cells.
    patches : the patches of the mesh.
    moving : the fields that are not constant, as ``fields`` of :class:`roughfilm.foamcases.openfoam.residuals.Judged`.
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
        "system/controlDict": (kind, {**entries, "functions": functions(dialect)}),
        "system/fvSchemes": schemes(scheme),
        "system/fvSolution": solution(
            dialect=dialect,
            tolerance=tolerance,
            linear=LINEAR_TOLERANCE,
            relaxation=relaxation,
            coarsest=COARSEST,
            velocity_gain=VELOCITY_GAIN,
            controlled=None if {*moving} == {*FIELDS} else {},
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
                    "type": dialect.source,
                    "active": True,
                    "selectionMode": "all",
                    **ALL_CELLS,
                    "volumeMode": "specific",
                    "injectionRateSuSp": {"U": [[*force, 0.0], 0.0]},
                    "sources": {"U": {"explicit": [*force, 0.0], "implicit": 0.0}},
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
