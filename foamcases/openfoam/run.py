"""Run a case: check its mesh, iterate its flow, and verify the fields on disk."""

import math
from dataclasses import dataclass, replace
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError, Outcome, UnavailableError
from roughfilm.foamcases.openfoam.dialect import dialect_named
from roughfilm.foamcases.openfoam.installation import installation
from roughfilm.foamcases.openfoam.iterate import Asked, Settled, Try, iterate
from roughfilm.foamcases.openfoam.kept import ended, kept_tries, latest_iteration
from roughfilm.foamcases.openfoam.program import Ended, failure, succeed, succeeded
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals
from roughfilm.rom.ladder.model import Progress

HARMLESS = ("High aspect ratio cells",)
"""Words of remarks of checkMesh that are no faults: long cells of a thin film, whose error falls with their size."""

REMEDIES = {
    Outcome.DIVERGED: "lower the Reynolds number or change the resolution",
    Outcome.UNSTEADY: "lower the Reynolds number, change the resolution or take the scheme upwind",
    Outcome.STALLED: "loosen the tolerance, or take a model without slope where the wall is nearly flat",
    Outcome.UNFINISHED: "loosen the tolerance or change the resolution",
}


@dataclass(frozen=True, kw_only=True)
class CaseRun:
    """A successful run: its CPU and wall-clock time, s, the version of OpenFOAM, and the warnings of the mesh check."""

    cpu_s: float
    wall_s: float
    version: str
    warnings: tuple[str, ...]


def ready(directory: Path, dialect: str, processes: int) -> str:
    """The version of OpenFOAM that can run a case.

    Parameters
    ----------
    directory : the directory of the case.
    dialect : name of the dialect in which the case is written.
    processes : number of processes.

    Raises
    ------
    InputError
        If the case is written in another dialect than that of the OpenFOAM of this machine.
    UnavailableError
        If OpenFOAM is missing, or if mpirun is and there are several processes.
    """
    here = installation()
    if here.release is None:
        raise UnavailableError(here.detail)
    if dialect != here.release.dialect.name:
        raise InputError(
            f"{directory}: is written for {dialect_named(dialect).releases}, and here is {here.release}; "
            f"write the case again in the dialect {here.release.dialect.name}"
        )
    if processes > 1 and not here.has("mpirun"):
        raise UnavailableError("no mpirun on the PATH; take one process, or: sudo apt-get install openmpi-bin")
    return here.detail


def check_mesh(
    directory: Path, *, tolerated: tuple[str, ...] = (), remedy: str = "change the resolution or the shape of the walls"
) -> Ended:
    """Run checkMesh and return its log.

    Parameters
    ----------
    directory : the directory of the case.
    tolerated : words of faults that are accepted besides those in ``HARMLESS``.
    remedy : the advice in the message of the error.

    Raises
    ------
    ConvergenceError
        If checkMesh reports a fault with none of the words in ``tolerated``.
    """
    return sound(succeed(directory, ["checkMesh"], "log.checkMesh"), tolerated=tolerated, remedy=remedy)


def kept_mesh(
    directory: Path, *, tolerated: tuple[str, ...] = (), remedy: str = "change the resolution or the shape of the walls"
) -> Ended:
    """The log of the mesh check that ``Allrun`` ran; parameters and errors as those of :func:`check_mesh`."""
    return sound(succeeded(ended(directory, "log.checkMesh"), "checkMesh"), tolerated=tolerated, remedy=remedy)


def sound(mesh: Ended, *, tolerated: tuple[str, ...], remedy: str) -> Ended:
    """The log of a mesh check; ConvergenceError if it has a fault without words in ``tolerated`` or ``HARMLESS``."""
    faults = [line for line in mesh.log.splitlines() if line.lstrip().startswith("***")]
    accepted = bool(faults) and all(any(words in fault for words in (*HARMLESS, *tolerated)) for fault in faults)
    if "Mesh OK" not in mesh.log and not accepted:
        raise failure(f"the mesh check found faults; {remedy}", mesh.log)
    return mesh


def remarks(mesh: Ended) -> tuple[str, ...]:
    """The lines of the mesh check's log that begin with an asterisk: warnings, and faults that were tolerated."""
    return tuple(line.strip(" *") for line in mesh.log.splitlines() if line.strip().startswith("*"))


@dataclass(frozen=True, kw_only=True)
class Checked:
    """A converged flow: the residual that a new process computes from the fields on disk, CPU time, s, and tries."""

    residual: float
    cpu_s: float
    tries: tuple[Try, ...]


def converge(
    directory: Path, asked: Asked, judged: Judged, progress: Progress, settled: Settled | None = None
) -> Checked:
    """Iterate a flow, and verify the fields on disk by one more iteration in a new process.

    The verified residual may be at most twice ``judged.slack`` times the tolerance.

    Raises
    ------
    ConvergenceError
        If no try converges or the verified residual is too large; with the last lines of the log.
    """
    from foamlib import FoamFile  # slow to import

    tries = converged(iterate(directory, asked, judged, progress, settled))
    cpu = 0.0
    if asked.processes > 1:
        cpu = succeed(directory, ["reconstructPar", "-latestTime"], "log.reconstructPar").cpu_s

    control = FoamFile(directory / "system" / "controlDict")
    end_time = control["endTime"]
    control["endTime"] = tries[-1].iterations + 1
    verified = succeed(directory, ["simpleFoam"], "log.verify")
    control["endTime"] = end_time
    return checked(directory, asked, judged, tries, replace(verified, cpu_s=verified.cpu_s + cpu))


def kept_flow(directory: Path, asked: Asked, judged: Judged, settled: Settled | None = None) -> Checked:
    """A flow that ``Allrun`` ran and verified; parameters and errors as those of :func:`converge`."""
    tries = converged(kept_tries(directory, asked, judged, settled))
    if latest_iteration(directory) < tries[-1].iterations:
        raise failure(
            f"{directory}: the fields of iteration {tries[-1].iterations} are missing; run the case again", ""
        )
    return checked(directory, asked, judged, tries, succeeded(ended(directory, "log.verify"), "simpleFoam"))


def converged(tries: tuple[Try, ...]) -> tuple[Try, ...]:
    """The tries of a flow; ConvergenceError with the outcome of each and a remedy if the last did not converge."""
    last = tries[-1]
    if last.outcome is not Outcome.CONVERGED:
        message = "; ".join([*map(str, tries), REMEDIES[last.outcome]])
        raise failure(message, last.log, outcome=last.outcome, iterations=last.iterations)
    return tries


def checked(directory: Path, asked: Asked, judged: Judged, tries: tuple[Try, ...], verified: Ended) -> Checked:
    """The flow that converged in the last of its tries, if the process ``verified`` finds a small enough residual.

    Raises
    ------
    ConvergenceError
        If the residual in ``log.verify`` is larger than twice ``judged.slack`` times the tolerance.
    """
    found_residuals = Residuals(directory / "log.verify", judged)
    found_residuals.read()
    residual = max(found_residuals.greatest, default=math.inf)
    allowed = judged.slack * asked.tolerance
    if not residual <= 2 * allowed:
        raise failure(
            f"the fields on disk leave a residual of {residual:.1e}, not {allowed:.0e}; run again",
            verified.log,
        )
    return Checked(residual=residual, cpu_s=sum(one.cpu_s for one in tries) + verified.cpu_s, tries=tries)
