"""One run of a case, believed only after it was checked."""

import math
import re
import resource
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from foamlib import FoamFile

from contact.errors import ConvergenceError, UnavailableError
from foamcases.case import read_card
from foamcases.openfoam import availability, environment
from rom.ladder import Progress, silent

LOG_TAIL = 12
POLL_S = 0.1

_RESIDUAL = re.compile(r"Solving for (\w+), Initial residual = ([^,\s]+)")


@dataclass(frozen=True, kw_only=True)
class Run:
    """What a successful run says of itself.

    ``residual`` is the largest initial residual of velocity and pressure that a new process finds in the fields on
    disk; ``warnings`` are the mesh check's remarks.
    """

    residual: float
    iterations: int
    cpu_s: float
    wall_s: float
    version: str
    warnings: tuple[str, ...]


def run_case(directory: Path, *, progress: Progress = silent) -> Run:
    """Check the mesh, run simpleFoam, and verify the fields it left.

    Raises
    ------
    UnavailableError
        If OpenFOAM is not here.
    ConvergenceError
        If the mesh check fails, simpleFoam stops in error or without convergence, or the fields on disk do not
        satisfy the equations; with the last lines of the log.
    """
    found = availability()
    if not found.available:
        raise UnavailableError(found.detail)
    card = read_card(directory)
    tolerance = card.tolerance
    wall, cpu = time.perf_counter(), _children_cpu()

    mesh_log = _execute(directory, ["checkMesh"], "log.checkMesh")
    if "Mesh OK" not in mesh_log:
        raise _failure("the mesh check found faults; change the resolution or the groove's shape", mesh_log)

    def watch(log: str) -> None:
        residuals = _last_residuals(log)
        if residuals and max(residuals) > 0:
            done = math.log(max(residuals)) / math.log(tolerance)
            progress(min(max(done, 0.0), 1.0), f"simpleFoam, residual {max(residuals):.0e}")

    if card.processes > 1:
        _execute(directory, ["decomposePar"], "log.decomposePar")
        log = _execute(
            directory, ["mpirun", "-np", str(card.processes), "simpleFoam", "-parallel"], "log.simpleFoam", watch
        )
        _execute(directory, ["reconstructPar", "-latestTime"], "log.reconstructPar")
    else:
        log = _execute(directory, ["simpleFoam"], "log.simpleFoam", watch)
    converged = re.search(r"SIMPLE solution converged in (\d+) iterations", log)
    if converged is None:
        raise _failure(
            f"simpleFoam made {log.count(chr(10) + 'Time = ')} iterations and did not converge to {tolerance:.0e}; "
            "lower the Reynolds number, change the resolution or loosen --tolerance (nearly flat: take reynolds)",
            log,
        )

    control = FoamFile(directory / "system" / "controlDict")
    end_time = control["endTime"]
    control["endTime"] = int(converged[1]) + 1
    again = _execute(directory, ["simpleFoam"], "log.verify")
    control["endTime"] = end_time
    residual = max(_last_residuals(again), default=math.inf)
    if not residual <= 2 * tolerance:
        raise _failure(f"the fields on disk leave a residual of {residual:.1e}, not {tolerance:.0e}; run again", again)

    return Run(
        residual=residual,
        iterations=int(converged[1]),
        cpu_s=_children_cpu() - cpu,
        wall_s=time.perf_counter() - wall,
        version=found.detail,
        warnings=tuple(line.strip(" *") for line in mesh_log.splitlines() if line.strip().startswith("*")),
    )


def _execute(directory: Path, command: list[str], log_name: str, watch: Callable[[str], None] | None = None) -> str:
    """Run a program of OpenFOAM to its end and return its log; ConvergenceError if it stops in error."""
    path = directory / log_name
    with path.open("w", encoding="utf-8") as log:
        process = subprocess.Popen(
            command, cwd=directory, env=environment(), stdin=subprocess.DEVNULL, stdout=log, stderr=log
        )
        try:
            while True:
                try:
                    process.wait(timeout=POLL_S)
                    break
                except subprocess.TimeoutExpired:
                    if watch is not None:
                        watch(_tail(path))
        finally:
            process.kill()
            process.wait()
    text = path.read_text(encoding="utf-8", errors="replace")
    if process.returncode != 0:
        raise _failure(f"{command[0]} stopped with code {process.returncode}; look into the log below", text)
    return text


def _tail(path: Path, size: int = 4000) -> str:
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - size))
        return file.read().decode("utf-8", errors="replace")


def _last_residuals(log: str) -> list[float]:
    """The initial residuals of velocity and pressure in the last whole iteration of a log."""
    iterations = log.split("\nTime = ")
    for iteration in reversed(iterations):
        found = _RESIDUAL.findall(iteration)
        if {name for name, _ in found} >= {"Ux", "Uy", "p"}:
            return [float(value) for _, value in found]
    return []


def _failure(reason: str, log: str) -> ConvergenceError:
    tail = [line for line in log.splitlines() if line.strip()][-LOG_TAIL:]
    error = ConvergenceError(f"OpenFOAM: {reason}")
    if tail:
        error.add_note("\n".join(tail))
    return error


def _children_cpu() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
