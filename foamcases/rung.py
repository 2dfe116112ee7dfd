"""What every rung that runs OpenFOAM does: a case written, run and read in a directory that is removed afterwards."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from contact.errors import UnavailableError
from foamcases.openfoam import availability
from rom.ladder import Progress, Write, silent
from rom.result import Result


def solve(
    scene: Any,
    *,
    model: str,
    write: Write,
    run: Callable[..., Any],
    read: Callable[[Any, Path, Any], Result],
    resolution: int | None = None,
    tolerance: float | None = None,
    scheme: str | None = None,
    processes: int = 1,
    progress: Progress = silent,
) -> Result:
    """Write, run and read; raises what the three raise, and UnavailableError where OpenFOAM is not here.

    Parameters
    ----------
    run : run(directory, progress=...): what a run says of itself, a dataclass with ``cpu_s`` and ``wall_s``, to which
        the time that this process spends on the case is added.
    read : read(scene, directory, what the run says).
    """
    found = availability()
    if not found.available:
        raise UnavailableError(f"{model}: {found.detail}")
    wall, cpu = time.perf_counter(), time.thread_time()
    with tempfile.TemporaryDirectory(prefix="roughfilm-") as place:
        directory = Path(place) / model
        write(scene, directory, resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
        ran = run(directory, progress=progress)
        spent = time.thread_time() - cpu
        whole = replace(ran, cpu_s=ran.cpu_s + spent, wall_s=time.perf_counter() - wall)
        return read(scene, directory, whole)
