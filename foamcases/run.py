"""One run of a case, believed only after it was checked."""

import math
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

from foamlib import FoamFile

from contact.errors import Outcome, UnavailableError
from foamcases.case import read_card
from foamcases.openfoam import availability
from foamcases.program import failure, succeed
from foamcases.residuals import Residuals
from foamcases.tries import Try, iterate
from rom.ladder import Progress, silent

REMEDIES = {
    Outcome.DIVERGED: "lower the Reynolds number or change the resolution",
    Outcome.UNSTEADY: "lower the Reynolds number, change the resolution or take --scheme upwind",
    Outcome.STALLED: "loosen --tolerance, or take a model without slope where the wall is nearly flat",
    Outcome.UNFINISHED: "loosen --tolerance or change the resolution",
}


@dataclass(frozen=True, kw_only=True)
class Run:
    """What a successful run says of itself.

    ``residual`` is the largest initial residual of velocity and pressure that a new process finds in the fields on
    disk; ``warnings`` are the mesh check's remarks; the last of the ``tries`` converged.
    """

    residual: float
    cpu_s: float
    wall_s: float
    version: str
    tries: tuple[Try, ...]
    warnings: tuple[str, ...]


def run_case(directory: Path, *, progress: Progress = silent) -> Run:
    """Check the mesh, run simpleFoam as :func:`foamcases.tries.iterate` does, and verify the fields it left.

    Raises
    ------
    UnavailableError
        If OpenFOAM is not here, or mpirun where the case asks for several processes.
    ConvergenceError
        If the mesh check fails, simpleFoam stops in error or without convergence, or the fields on disk do not
        satisfy the equations; with its outcome and the last lines of the log.
    """
    found = availability()
    if not found.available:
        raise UnavailableError(found.detail)
    card = read_card(directory)
    if card.processes > 1 and shutil.which("mpirun") is None:
        raise UnavailableError("no mpirun on the PATH; leave --processes out, or: sudo apt-get install openmpi-bin")
    wall = time.perf_counter()
    mesh = succeed(directory, ["checkMesh"], "log.checkMesh")
    if "Mesh OK" not in mesh.log:
        raise failure("the mesh check found faults; change the resolution or the groove's shape", mesh.log)

    tries = iterate(directory, card, progress)
    last = tries[-1]
    if last.outcome is not Outcome.CONVERGED:
        told = "; ".join([*map(str, tries), REMEDIES[last.outcome]])
        raise failure(told, last.log, outcome=last.outcome, iterations=last.iterations)
    cpu = mesh.cpu_s + sum(one.cpu_s for one in tries)
    if card.processes > 1:
        cpu += succeed(directory, ["reconstructPar", "-latestTime"], "log.reconstructPar").cpu_s

    control = FoamFile(directory / "system" / "controlDict")
    end_time = control["endTime"]
    control["endTime"] = last.iterations + 1
    verified = succeed(directory, ["simpleFoam"], "log.verify")
    control["endTime"] = end_time
    found_residuals = Residuals(directory / "log.verify")
    found_residuals.read()
    residual = max(found_residuals.greatest, default=math.inf)
    if not residual <= 2 * card.tolerance:
        raise failure(
            f"the fields on disk leave a residual of {residual:.1e}, not {card.tolerance:.0e}; run again", verified.log
        )
    return Run(
        residual=residual,
        cpu_s=cpu + verified.cpu_s,
        wall_s=time.perf_counter() - wall,
        version=found.detail,
        tries=tries,
        warnings=tuple(line.strip(" *") for line in mesh.log.splitlines() if line.strip().startswith("*")),
    )
