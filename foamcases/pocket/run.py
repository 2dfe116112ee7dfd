"""A run of the case of a pocket: its mesh checked, its flow iterated, and its fields verified."""

import time
from dataclasses import dataclass
from pathlib import Path

from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.iterate import Try
from roughfilm.foamcases.openfoam.residuals import Judged
from roughfilm.foamcases.openfoam.run import CaseRun, check_mesh, converge, ready, remarks
from roughfilm.foamcases.pocket.case import Card
from roughfilm.rom.ladder.model import Progress, silent


@dataclass(frozen=True, kw_only=True)
class Run(CaseRun):
    """A successful run of one flow.

    ``residual`` is the largest initial residual of velocity and pressure that a new process finds in the fields on
    disk; the last of the ``tries`` converged.
    """

    residual: float
    tries: tuple[Try, ...]


def run_case(directory: Path, progress: Progress = silent) -> Run:
    """Check the mesh, run simpleFoam as :func:`foamcases.openfoam.iterate.iterate` does, and verify the fields it left.

    Raises
    ------
    UnavailableError
        If OpenFOAM is not here, or mpirun where the case asks for several processes.
    ConvergenceError
        If the mesh check fails, simpleFoam stops in error or without convergence, or the fields on disk do not
        satisfy the equations; with its outcome and the last lines of the log.
    """
    card = read_card(directory, Card)
    version = ready(card.processes)
    wall = time.perf_counter()
    mesh = check_mesh(directory)
    checked = converge(directory, card, Judged(), progress)
    return Run(
        residual=checked.residual,
        cpu_s=mesh.cpu_s + checked.cpu_s,
        wall_s=time.perf_counter() - wall,
        version=version,
        tries=checked.tries,
        warnings=remarks(mesh),
    )
