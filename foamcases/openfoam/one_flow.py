"""Write a case of one flow, and run it: check its mesh, iterate its flow, and verify its fields."""

import time
from collections.abc import Callable
from dataclasses import Field, dataclass
from pathlib import Path
from typing import Any, ClassVar, Protocol

from roughfilm.foamcases.openfoam.allrun import allrun
from roughfilm.foamcases.openfoam.case_directory import write_papers, write_whole, written_for
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import write_second_try
from roughfilm.foamcases.openfoam.iterate import Asked, Settled, Try
from roughfilm.foamcases.openfoam.kept import release_of, wall_time
from roughfilm.foamcases.openfoam.program import Ended
from roughfilm.foamcases.openfoam.residuals import Judged
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
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.result import Numerics, SolverRun


class Written(Asked, Protocol):
    """The options with which a case was written, a dataclass."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def dialect(self) -> str: ...  # noqa: D102
    @property
    def resolution(self) -> int: ...  # noqa: D102
    @property
    def reynolds_number(self) -> float: ...  # noqa: D102
    @property
    def relaxation(self) -> float: ...  # noqa: D102


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


def write_flow(
    directory: Path,
    fill: Callable[[Path], None],
    card: Written,
    judged: Judged,
    dialect: Dialect,
    *,
    readme: str,
    run: bool,
    settles: bool = False,
) -> None:
    """Write a case completely or not at all, with a README and a script to run it by hand.

    Parameters
    ----------
    directory : the directory of the case, which is made; it may exist if it is empty.
    fill : fill(place), which writes mesh and dictionaries into a temporary directory.
    card : the options of the case.
    judged : the criteria of convergence.
    dialect : the dialect of OpenFOAM in which the case is written.
    readme : the README, to which the releases of OpenFOAM for which it is written are added.
    run : whether the case is to be run by this library at once, which needs no dictionaries of a second try.
    settles : whether a run may end when its mean velocity no longer changes.

    Raises
    ------
    InputError
        If the path contains a blank, the directory is not empty, or it cannot be written.
    """
    script = allrun({".": judged}, tolerance=card.tolerance, processes=card.processes, dialect=dialect, settles=settles)

    def whole(place: Path) -> None:
        fill(place)
        if not run:
            write_second_try(place, scheme=card.scheme, tolerance=card.tolerance)
        write_papers(place, readme=readme + written_for(dialect), allrun=script, card=card)

    write_whole(directory, whole)


def run_flow(directory: Path, card: Written, judged: Judged, progress: Progress, settled: Settled | None = None) -> Run:
    """Check the mesh, run :func:`roughfilm.foamcases.openfoam.iterate.iterate`, and verify the fields on disk.

    Residuals end the run, or the test ``settled`` if there is one.

    Raises
    ------
    InputError
        If the case is written for another dialect of OpenFOAM.
    UnavailableError
        If OpenFOAM is not on this machine, or mpirun is not and the case needs several processes.
    ConvergenceError
        If the mesh check fails, simpleFoam stops in error or without convergence, or the fields on disk do not
        satisfy the equations; with the outcome of the run and the last lines of its log.
    """
    version = ready(directory, card.dialect, card.processes)
    wall = time.perf_counter()
    mesh = check_mesh(directory)
    checked = converge(directory, card, judged, progress, settled)
    return _run(mesh, checked, time.perf_counter() - wall, version)


def kept_flow_run(directory: Path, card: Written, judged: Judged, settled: Settled | None = None) -> Run:
    """Read the run of a case that its script ``Allrun`` ran; errors as those of :func:`run_flow`, save OpenFOAM's."""
    version = release_of(directory, card.dialect)
    mesh = kept_mesh(directory)
    checked = kept_flow(directory, card, judged, settled)
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


def numerics_of(
    card: Written, run: Run, *, unknowns: int, details: dict[str, float], imbalance: float | None = None
) -> Numerics:
    """The numerics of the result of a run.

    Parameters
    ----------
    card : the options with which the case was written.
    unknowns : number of unknowns.
    details : further numbers; the relaxation of velocity and the Reynolds number of the case are added.
    imbalance : imbalance of the forces on the liquid over the force that drives it; None if it was not computed.
    """
    return Numerics(
        residual=run.residual,
        iterations=run.tries[-1].iterations,
        cpu_s=run.cpu_s,
        wall_s=run.wall_s,
        degrees_of_freedom=unknowns,
        resolution=card.resolution,
        tolerance=card.tolerance,
        scheme=card.scheme,
        processes=card.processes,
        runs=tuple(
            SolverRun(
                outcome=str(t.outcome),
                iterations=t.iterations,
                recipe=t.recipe,
                imbalance=imbalance if t is run.tries[-1] else None,
            )
            for t in run.tries
        ),
        details={"velocity_relaxation": card.relaxation, "reynolds_number": card.reynolds_number, **details},
    )
