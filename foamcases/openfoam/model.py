"""What the rungs that run OpenFOAM share: a case is written, run and read in a directory that is removed afterwards."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.model import Applicability, Effect, Model, Progress, Write, chosen_scheme, silent
from roughfilm.rom.ladder.result import Result

CREEPING = 1e-6
"""The Reynolds number of Stokes flow: advection is then a millionth of viscous stress (there is no scheme "none")."""


@dataclass(frozen=True, kw_only=True)
class Cases:
    """How the cases of one kind of scene are written, run and read, and the numbers of its models.

    Attributes
    ----------
    write : write(scene, directory, reynolds_number=, resolution=, tolerance=, scheme=, processes=).
    write_to_run : the same where the case is run at once and on this machine.
    run : run(directory, progress=): what a run says of itself, a dataclass with ``cpu_s`` and ``wall_s``, to which the
        time that this process spends on the case is added.
    read : read(scene, directory, what the run says, model=, keeps=): the result.
    """

    kind: str
    sources: tuple[str, ...]
    resolution: int | None
    resolutions: tuple[int, ...]
    own_resolutions: Callable[[Any], tuple[int, ...]] | None = None
    resolution_meaning: str
    residual_meaning: str
    cost: Callable[[Any, int], float]
    write: Callable[..., None]
    write_to_run: Callable[..., None]
    run: Callable[..., Any]
    read: Callable[..., Result]


def openfoam_model(
    cases: Cases,
    *,
    name: str,
    summary: str,
    keeps: frozenset[Effect],
    applies: Callable[[Any], Applicability],
    reynolds_number: float | None = None,
    schemes: tuple[str, ...] = (),
) -> Model:
    """A rung that runs OpenFOAM at the given Reynolds number (None: the scene's)."""
    told = partial(write, model=name, schemes=schemes, reynolds_number=reynolds_number)
    return Model(
        name=name,
        kind=cases.kind,
        summary=summary,
        keeps=keeps,
        sources=cases.sources,
        resolution=cases.resolution,
        resolutions=cases.resolutions,
        own_resolutions=cases.own_resolutions,
        resolution_meaning=cases.resolution_meaning,
        residual_meaning=cases.residual_meaning,
        order=2,
        cost=cases.cost,
        applies=applies,
        solve=partial(
            solve,
            model=name,
            write=partial(told, cases=cases.write_to_run),
            run=cases.run,
            read=partial(cases.read, model=name, keeps=keeps),
        ),
        available=availability,
        write=partial(told, cases=cases.write),
        schemes=schemes,
    )


def write(
    scene: Any,
    directory: Path,
    *,
    cases: Callable[..., None],
    model: str,
    schemes: tuple[str, ...],
    reynolds_number: float | None,
    resolution: int | None = None,
    tolerance: float | None = None,
    scheme: str | None = None,
    processes: int = 1,
) -> None:
    """Write ``cases`` of a scene as a model wants them; InputError for another scheme than its, and what they raise."""
    cases(
        scene,
        directory,
        reynolds_number=scene.reynolds_number if reynolds_number is None else reynolds_number,
        resolution=resolution,
        tolerance=tolerance,
        scheme=chosen_scheme(model, schemes, scheme),
        processes=processes,
    )


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
    """Write, run and read; raises what the three raise, and UnavailableError where OpenFOAM is not here."""
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
