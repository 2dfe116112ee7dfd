"""The dictionaries of OpenFOAM cases, with numbers and names from this file alone and no text from a scene.

OpenFOAM runs code in a dictionary (``#calc``, ``#codeStream``), so no text of a user is written into one.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.foamcases.openfoam.block_mesh import Patch

Dictionary = tuple[str, Mapping[str, Any]]
"""A file of OpenFOAM: its class and entries."""

ITERATIONS = 5000

LINEAR_TOLERANCE = 1e-5
"""Residual at which a linear solver stops, in units of the tolerance."""

ROUND_OFF = 1e-15
"""Least residual that a linear solver can reach."""

VELOCITY_RELAXATION = 0.95
"""Relaxation of velocity in SIMPLEC; the result depends slightly on it, so that every case has the same."""

ADVECTION = {
    "linear_upwind": ("bounded", "Gauss", "linearUpwind", "grad(U)"),
    "upwind": ("bounded", "Gauss", "upwind"),
    "": ("bounded", "Gauss", "linearUpwind", "grad(U)"),
}
"""The entry of each advection scheme: ``linear_upwind`` of second order, ``upwind`` of first order as hybrid schemes on
coarse cells, and "" for flows that do not depend on it."""

SIDES = (
    Patch(name="inlet", entries={"type": "cyclic", "neighbourPatch": "outlet"}),
    Patch(name="outlet", entries={"type": "cyclic", "neighbourPatch": "inlet"}),
    Patch(name="lower", entries={"type": "wall"}),
    Patch(name="upper", entries={"type": "wall"}),
    Patch(name="back", entries={"type": "empty"}),
    Patch(name="front", entries={"type": "empty"}),
)
"""The patches of a channel at x-, x+, y-, y+, z-, z+."""


def write_dictionaries(directory: Path, *, viscosity: float, tolerance: float, scheme: str, processes: int) -> None:
    """Write ``system``, ``constant`` and ``0`` of a channel whose upper wall slides at speed 1.

    Parameters
    ----------
    viscosity
        Kinematic viscosity in units of film thickness times sliding speed: 1 / Re.
    tolerance
        The initial residuals at which the iteration stops.
    scheme
        A key of ``ADVECTION``.
    processes
        The number of parts along the film into which a parallel run divides the mesh.
    """
    write_files(directory, _dictionaries(viscosity, tolerance, scheme, processes))


def write_files(directory: Path, files: Mapping[str, Dictionary]) -> None:
    """Write dictionaries and fields, by their names below ``directory``."""
    from foamlib import FoamFile  # slow to import

    for name, (kind, entries) in files.items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with FoamFile(path) as file:
            arrays = any(isinstance(value, np.ndarray) for value in entries.values())
            form = "binary" if arrays else "ascii"
            file["FoamFile"] = {"version": 2.0, "format": form, "class": kind, "object": path.name}
            for key, value in entries.items():
                file[key] = value


def change_scheme(directory: Path, *, scheme: str, tolerance: float) -> None:
    """Change the advection scheme and the tolerance of a case."""
    from foamlib import FoamFile  # slow to import

    FoamFile(directory / "system" / "fvSchemes")["divSchemes", "div(phi,U)"] = ADVECTION[scheme]
    with FoamFile(directory / "system" / "fvSolution") as solution:
        controlled = solution["SIMPLE", "residualControl"]
        assert isinstance(controlled, FoamFile.SubDict)
        solution["SIMPLE", "residualControl"] = dict.fromkeys([*controlled], tolerance)


def strengthen(directory: Path) -> None:
    """Make a case correct the pressure for skewed cells in each iteration, and solve velocity to round-off."""
    from foamlib import FoamFile  # slow to import

    with FoamFile(directory / "system" / "fvSolution") as solution:
        solution["SIMPLE", "nNonOrthogonalCorrectors"] = 1
        solution["solvers", "U", "tolerance"] = ROUND_OFF


def control(iterations: int) -> Dictionary:
    """``system/controlDict`` of a run of simpleFoam that goes on from the latest fields and writes the last."""
    return (
        "dictionary",
        {
            "application": "simpleFoam",
            "startFrom": "latestTime",
            "startTime": 0,
            "stopAt": "endTime",
            "endTime": iterations,
            "deltaT": 1,
            "writeControl": "timeStep",
            "writeInterval": iterations,
            "writeFormat": "binary",
            "timeFormat": "general",
            "runTimeModifiable": False,
        },
    )


def schemes(scheme: str) -> Dictionary:
    """``system/fvSchemes`` with one of ``ADVECTION``; all else is central."""
    linear = ("Gauss", "linear")
    return (
        "dictionary",
        {
            "ddtSchemes": {"default": "steadyState"},
            "gradSchemes": {"default": linear},
            "divSchemes": {
                "default": "none",
                "div(phi,U)": ADVECTION[scheme],
                "div((nuEff*dev2(T(grad(U)))))": linear,
            },
            "laplacianSchemes": {"default": (*linear, "corrected")},
            "interpolationSchemes": {"default": "linear"},
            "snGradSchemes": {"default": "corrected"},
        },
    )


def solution(
    *,
    tolerance: float,
    linear: float,
    relaxation: float,
    coarsest: int,
    velocity_gain: float,
    controlled: tuple[str, ...] = ("p", "U"),
) -> Dictionary:
    """``system/fvSolution`` for SIMPLEC.

    Parameters
    ----------
    tolerance : the initial residuals at which the iteration stops.
    linear : the residual at which a linear solver stops, in units of the tolerance.
    relaxation : the relaxation of velocity.
    coarsest : the number of cells of multigrid's coarsest level.
    velocity_gain : the factor by which the residual of velocity falls in an iteration.
    controlled : the fields whose residuals must meet the tolerance.
    """
    return (
        "dictionary",
        {
            "solvers": {
                "p": {
                    "solver": "GAMG",
                    "smoother": "DICGaussSeidel",
                    "tolerance": tolerance * linear,
                    "relTol": 0.1,
                    "nCellsInCoarsestLevel": coarsest,
                },
                "U": {
                    "solver": "PBiCGStab",
                    "preconditioner": "DILU",
                    "tolerance": tolerance * linear,
                    "relTol": velocity_gain,
                },
            },
            "SIMPLE": {
                "consistent": True,
                "nNonOrthogonalCorrectors": 0,
                "pRefCell": 0,
                "pRefValue": 0,
                "residualControl": dict.fromkeys(controlled, tolerance),
            },
            "relaxationFactors": {"fields": {"p": 1.0}, "equations": {"U": relaxation}},
        },
    )


def liquid(viscosity: float) -> dict[str, Dictionary]:
    """The dictionaries in ``constant`` of a laminar flow of this kinematic viscosity."""
    return {
        "constant/transportProperties": ("dictionary", {"transportModel": "Newtonian", "nu": viscosity}),
        "constant/turbulenceProperties": ("dictionary", {"simulationType": "laminar"}),
    }


def _dictionaries(viscosity: float, tolerance: float, scheme: str, processes: int) -> dict[str, Dictionary]:
    from foamlib import DimensionSet  # slow to import

    return {
        "system/controlDict": control(ITERATIONS),
        "system/fvSchemes": schemes(scheme),
        "system/fvSolution": solution(
            tolerance=tolerance,
            linear=LINEAR_TOLERANCE,
            relaxation=VELOCITY_RELAXATION,
            coarsest=20,
            velocity_gain=0.01,
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
                "internalField": [0.5, 0.0, 0.0],
                "boundaryField": _boundary_field(
                    lower={"type": "noSlip"}, upper={"type": "fixedValue", "value": [1.0, 0.0, 0.0]}
                ),
            },
        ),
        "0/p": (
            "volScalarField",
            {
                "dimensions": DimensionSet(length=2, time=-2),
                "internalField": 0.0,
                "boundaryField": _boundary_field(lower={"type": "zeroGradient"}, upper={"type": "zeroGradient"}),
            },
        ),
    }


def _boundary_field(**walls: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    return {side.name: walls.get(side.name, {"type": side.entries["type"]}) for side in SIDES}
