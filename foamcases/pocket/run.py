"""Run the case of a pocket: check its mesh, iterate its flow, and verify its fields."""

import time
from dataclasses import dataclass
from pathlib import Path

from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.iterate import Try
from roughfilm.foamcases.openfoam.kept import release_of, wall_time
from roughfilm.foamcases.openfoam.program import Ended
from roughfilm.foamcases.openfoam.run import (
    CaseRun,
    Checked,
    check_mesh,
    converge,
    kept_flow,
    kept_mesh,
    ready,
    remarks,
)
from roughfilm.foamcases.pocket.card import Card
from roughfilm.rom.ladder.model import Progress, silent


@dataclass(frozen=True, kw_only=True)
class Run(CaseRun):
    """A successful run of one flow.

    Attributes
    ----------
    residual : largest initial residual of velocity and pressure that a new process computes from the fields on disk.
    tries : the one or two tries of the run, of which the last converged.
    """

    residual: float
    tries: tuple[Try, ...]


def run_case(directory: Path, progress: Progress = silent) -> Run:
    """Check the mesh, run :func:`roughfilm.foamcases.openfoam.iterate.iterate`, and verify the fields on disk.

    Raises
    ------
    InputError
        If the directory holds no pocket case of this version, or one for another dialect of OpenFOAM.
    UnavailableError
        If OpenFOAM is not on this machine, or mpirun is not and the case needs several processes.
    ConvergenceError
        If the mesh check fails, simpleFoam stops in error or without convergence, or the fields on disk do not
        satisfy the equations; with the outcome of the run and the last lines of its log.
    """
    card = read_card(directory, Card)
    version = ready(directory, card.dialect, card.processes)
    wall = time.perf_counter()
    mesh = check_mesh(directory)
    checked = converge(directory, card, card.criteria, progress, card.settled(directory))
    return _run(mesh, checked, time.perf_counter() - wall, version)


def kept_run(directory: Path) -> Run:
    """Read the run of a case that its script ``Allrun`` ran; errors as those of :func:`run_case`, save OpenFOAM's."""
    card = read_card(directory, Card)
    version = release_of(directory, card.dialect)
    mesh = kept_mesh(directory)
    checked = kept_flow(directory, card, card.criteria, card.settled(directory))
    return _run(mesh, checked, wall_time(directory), version)


def _run(mesh: Ended, checked: Checked, wall_s: float, version: str) -> Run:
    return Run(
        residual=checked.residual,
        cpu_s=mesh.cpu_s + checked.cpu_s,
        wall_s=wall_s,
        version=version,
        tries=checked.tries,
        warnings=remarks(mesh),
    )
