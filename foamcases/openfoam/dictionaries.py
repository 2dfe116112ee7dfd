"""The dictionaries of OpenFOAM cases, with numbers from a scene but no text from it.

OpenFOAM runs code in a dictionary (``#calc``, ``#codeStream``), so no text of a user is written into one.
"""

import math
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.foamcases.openfoam.block_mesh import Patch
from roughfilm.foamcases.openfoam.dialect import Dialect

Dictionary = tuple[str, Mapping[str, Any]]
"""The class and the entries of a file of OpenFOAM."""

ITERATIONS = 5000
"""Largest number of iterations."""

LINEAR_TOLERANCE = 1e-5
"""Residual at which a linear solver stops, over the tolerance of the flow."""

MOST_SWEEPS = 100
"""Largest number of iterations of one solution for the pressure: on flat cells its residual ends at round-off."""

ROUND_OFF = 1e-15
"""Least residual that a linear solver can reach."""

START_SCHEME = "upwind"
"""Advection scheme with which a second try starts."""

START_TOLERANCE = 1e-2
"""Residual up to which a second try runs with ``START_SCHEME``."""

SECOND_TRY = "second_try"
"""Directory of a case with the dictionaries of a second try: ``start`` is run first, then ``rest``."""

ADVECTION = {
    "linear_upwind": ("bounded", "Gauss", "linearUpwind", "grad(U)"),
    "upwind": ("bounded", "Gauss", "upwind"),
    "": ("bounded", "Gauss", "linearUpwind", "grad(U)"),
}
"""The entry of each advection scheme: ``linear_upwind`` is of second order, and ``upwind`` is of first order, as hybrid
schemes are on coarse cells; "" is for flows that do not depend on the scheme."""

SIDES = (
    Patch(name="inlet", entries={"type": "cyclic", "neighbourPatch": "outlet"}),
    Patch(name="outlet", entries={"type": "cyclic", "neighbourPatch": "inlet"}),
    Patch(name="lower", entries={"type": "wall"}),
    Patch(name="upper", entries={"type": "wall"}),
    Patch(name="back", entries={"type": "empty"}),
    Patch(name="front", entries={"type": "empty"}),
)
"""The patches of a channel at x-, x+, y-, y+, z-, z+."""


def write_dictionaries(
    directory: Path,
    *,
    dialect: Dialect,
    viscosity: float,
    tolerance: float,
    scheme: str,
    parts: tuple[int, int],
    relaxation: float,
    sides: tuple[Patch, ...] = SIDES,
    functions: Mapping[str, Any] | None = None,
) -> None:
    """Write the files in ``system``, ``constant`` and ``0`` of a channel whose upper wall slides at speed 1.

    Parameters
    ----------
    dialect
        The dialect of OpenFOAM in which the case is written.
    viscosity
        Kinematic viscosity over film thickness times sliding speed: 1 / Re.
    tolerance
        The initial residual of velocity and pressure at which the iteration stops.
    scheme
        A key of ``ADVECTION``.
    parts
        The numbers of parts along x and y into which a parallel run divides the mesh.
    relaxation
        The relaxation of velocity in SIMPLEC.
    sides
        The patches of the mesh; "lower" is the wall at rest and "upper" the one that slides.
    functions
        The functions of ``system/controlDict`` that end the run, by their names; None if residuals end it.
    """
    from foamlib import DimensionSet  # slow to import

    kind, entries = control(ITERATIONS)
    walls: dict[str, Any] = {
        "lower": {"type": "noSlip"},
        "upper": {"type": "fixedValue", "value": [1.0, 0.0, 0.0]},
    }
    files: dict[str, Dictionary] = {
        "system/controlDict": (kind, entries if functions is None else {**entries, "functions": functions}),
        "system/fvSchemes": schemes(scheme),
        "system/fvSolution": solution(
            dialect=dialect,
            tolerance=tolerance,
            linear=LINEAR_TOLERANCE,
            relaxation=relaxation,
            coarsest=20,
            velocity_gain=0.01,
            controlled=None if functions is None else {},
        ),
        "system/decomposeParDict": (
            "dictionary",
            {
                "numberOfSubdomains": parts[0] * parts[1],
                "method": "simple",
                "simpleCoeffs": {"n": [*parts, 1], "delta": 0.001},
            },
        ),
        **liquid(viscosity),
        "0/U": (
            "volVectorField",
            {
                "dimensions": DimensionSet(length=1, time=-1),
                "internalField": [0.5, 0.0, 0.0],
                "boundaryField": {p.name: walls.get(p.name, {"type": p.entries["type"]}) for p in sides},
            },
        ),
        "0/p": (
            "volScalarField",
            {
                "dimensions": DimensionSet(length=2, time=-2),
                "internalField": 0.0,
                "boundaryField": {
                    p.name: {"type": "zeroGradient" if p.name in walls else p.entries["type"]} for p in sides
                },
            },
        ),
    }
    write_files(directory, files)


def parts_of(processes: int, size: tuple[float, float]) -> tuple[int, int]:
    """The numbers of parts along x and y into which a period is divided, so that the parts are as square as possible.

    Parameters
    ----------
    processes : number of parts.
    size : length and width of the period, in any one unit.
    """
    pairs = [(n, processes // n) for n in range(1, processes + 1) if processes % n == 0]
    return min(pairs, key=lambda pair: abs(math.log(size[0] / pair[0] * pair[1] / size[1])))


def write_files(directory: Path, files: Mapping[str, Dictionary]) -> None:
    """Write dictionaries and fields as files below ``directory``; files with arrays are binary, the others ASCII.

    Parameters
    ----------
    directory : the directory of the case.
    files : class and entries of each file, by its path below ``directory``.
    """
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
    """Change the advection scheme (a key of ``ADVECTION``) and the tolerance of a case that was written."""
    from foamlib import FoamFile  # slow to import

    FoamFile(directory / "system" / "fvSchemes")["divSchemes", "div(phi,U)"] = ADVECTION[scheme]
    with FoamFile(directory / "system" / "fvSolution") as solution:
        controlled = solution["SIMPLE", "residualControl"]
        assert isinstance(controlled, FoamFile.SubDict)
        solution["SIMPLE", "residualControl"] = dict.fromkeys([*controlled], tolerance)


def strengthen(directory: Path) -> None:
    """Change a case so that each iteration corrects the pressure for skewed cells and solves velocity to round-off."""
    from foamlib import FoamFile  # slow to import

    with FoamFile(directory / "system" / "fvSolution") as solution:
        solution["SIMPLE", "nNonOrthogonalCorrectors"] = 1
        solution["solvers", "U", "tolerance"] = ROUND_OFF


def write_second_try(directory: Path, *, scheme: str, tolerance: float) -> None:
    """Write the dictionaries of a second try of a case that was written, for its script ``Allrun``.

    Parameters
    ----------
    directory : the directory of the case.
    scheme : its advection scheme, a key of ``ADVECTION``.
    tolerance : the residual at which it ends.
    """
    for stage, by, until in (("start", START_SCHEME, START_TOLERANCE), ("rest", scheme, tolerance)):
        system = directory / SECOND_TRY / stage / "system"
        system.mkdir(parents=True)
        for name in ("fvSchemes", "fvSolution"):
            shutil.copyfile(directory / "system" / name, system / name)
        strengthen(system.parent)
        change_scheme(system.parent, scheme=by, tolerance=until)


def control(iterations: int) -> Dictionary:
    """The dictionary ``system/controlDict``: simpleFoam starts from the latest fields and writes its last ones.

    The solver is that of ``foamRun``, which is simpleFoam from openfoam.org 11 on. The precision is that of the values
    that functions log; openfoam.org ignores the entry of the same name in a function.
    """
    return (
        "dictionary",
        {
            "application": "simpleFoam",
            "solver": "incompressibleFluid",
            "startFrom": "latestTime",
            "startTime": 0,
            "stopAt": "endTime",
            "endTime": iterations,
            "deltaT": 1,
            "writeControl": "timeStep",
            "writeInterval": iterations,
            "writeFormat": "binary",
            "writePrecision": 12,
            "timeFormat": "general",
            "runTimeModifiable": False,
        },
    )


def schemes(scheme: str) -> Dictionary:
    """The dictionary ``system/fvSchemes`` with a key of ``ADVECTION``; all other schemes are central."""
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
    dialect: Dialect,
    tolerance: float,
    linear: float,
    relaxation: float,
    coarsest: int,
    velocity_gain: float,
    controlled: Mapping[str, float] | None = None,
) -> Dictionary:
    """The dictionary ``system/fvSolution`` for SIMPLEC.

    Parameters
    ----------
    dialect : the dialect of OpenFOAM in which the case is written.
    tolerance : the initial residual at which the iteration stops.
    linear : the residual at which a linear solver stops, over the tolerance.
    relaxation : the relaxation of velocity.
    coarsest : the number of cells on multigrid's coarsest level.
    velocity_gain : the linear solver's last residual of velocity over its first one, at which it may stop.
    controlled : residual that each of some fields must reach to end the run; None for the tolerance of ``p`` and ``U``.
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
                    "maxIter": MOST_SWEEPS,
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
                "residualControl": {"p": tolerance, "U": tolerance} if controlled is None else controlled,
            },
            "relaxationFactors": {
                "fields": {"p": dialect.pressure_relaxation(relaxation)},
                "equations": {"U": relaxation},
            },
        },
    )


def liquid(viscosity: float) -> dict[str, Dictionary]:
    """The dictionaries in ``constant`` of a laminar flow with the given kinematic viscosity, by their paths."""
    return {
        "constant/transportProperties": (
            "dictionary",
            {"transportModel": "Newtonian", "viscosityModel": "constant", "nu": viscosity},
        ),
        "constant/turbulenceProperties": ("dictionary", {"simulationType": "laminar"}),
    }
