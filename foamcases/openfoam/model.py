"""Models that run OpenFOAM: a case is written, run and read, together or separately."""

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Unpack

from typing_extensions import TypeVar

from roughfilm.foamcases.openfoam.case_directory import TOLERANCES
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import About, Applicability, Model, Progress, Resolutions, SceneT, silent
from roughfilm.rom.ladder.request import CheckedRequest, Request
from roughfilm.rom.ladder.result import Result

if TYPE_CHECKING:
    from roughfilm.foamcases.openfoam.run import CaseRun

CREEPING = 1e-6
"""Reynolds number of Stokes flow: advection is then a millionth of viscous stress (there is no scheme "none")."""

RunT = TypeVar("RunT", bound="CaseRun", default=Any)

CaseWriter = Callable[[SceneT, Path, CheckedRequest, float], None]
"""write(scene, directory, request, reynolds_number)."""


@dataclass(frozen=True, kw_only=True)
class Cases(Generic[SceneT, RunT]):
    """The functions that write, run and read the cases of one kind of scene, and the options of its models.

    Attributes
    ----------
    write : writes the case of a scene.
    write_to_run : the same where the case is run at once and on this machine.
    run : run(directory, progress), which returns how the run ended.
    read : read(model, scene, directory, run), the result.
    """

    kind: str
    resolutions: Resolutions | Callable[[SceneT], Resolutions]
    resolution_meaning: str
    residual_meaning: str
    tolerance: float
    most_processes: Callable[[SceneT, int], int]
    cost: Callable[[SceneT, int], float]
    write: CaseWriter[SceneT]
    write_to_run: CaseWriter[SceneT]
    run: Callable[[Path, Progress], RunT]
    read: Callable[[Model[SceneT], SceneT, Path, RunT], Result]


@dataclass(frozen=True, kw_only=True)
class CaseModel(Model[SceneT], Generic[SceneT, RunT]):
    """A model that runs OpenFOAM: ``solve`` does all in a directory that it removes; its three steps stand apart here.

    Examples
    --------
    >>> from roughfilm.ladder import find
    >>> from roughfilm.rom.ladder.scene import load_scene
    >>> model, scene = find("pocket", "stokes"), load_scene("pocket.toml")  # doctest: +SKIP
    >>> model.write(scene, directory, Request(resolution=60))  # doctest: +SKIP
    >>> result = model.read(scene, directory, model.run(directory))  # doctest: +SKIP
    """

    cases: Cases[SceneT, RunT]
    reynolds_number: Callable[[SceneT], float]

    def write(self, scene: SceneT, directory: Path, request: Request = Request()) -> None:
        """Write the case of a scene, whole or not at all.

        Raises
        ------
        InputError
            For an option outside the range that the model allows, or a directory that is not empty.
        """
        self.cases.write(scene, directory, self.checked(scene, request), self.reynolds_number(scene))

    def run(self, directory: Path, progress: Progress = silent) -> RunT:
        """Run a case that this model wrote, and verify the fields that it leaves in the directory.

        Returns
        -------
        CaseRun
            Residual, iterations, times and warnings of the run.

        Raises
        ------
        UnavailableError
            If OpenFOAM is not on this machine.
        ConvergenceError
            If the mesh has faults or the flow does not converge.
        """
        return self.cases.run(directory, progress)

    def read(self, scene: SceneT, directory: Path, run: RunT) -> Result:
        """The result of a case of this scene that was run.

        Raises
        ------
        InputError
            If the directory holds no case of this scene.
        ConvergenceError
            If it holds no finished fields.
        """
        return self.cases.read(self, scene, directory, run)


def openfoam_model(
    cases: Cases[SceneT, RunT],
    *,
    applies: Callable[[SceneT], Applicability],
    reynolds_number: Callable[[SceneT], float],
    schemes: tuple[str, ...] = (),
    **about: Unpack[About],
) -> CaseModel[SceneT, RunT]:
    """A model that runs OpenFOAM at the Reynolds number that it gives a scene."""
    return CaseModel(
        **about,
        kind=cases.kind,
        resolutions=cases.resolutions,
        resolution_meaning=cases.resolution_meaning,
        residual_meaning=cases.residual_meaning,
        order=2,
        tolerance=cases.tolerance,
        tolerances=TOLERANCES,
        schemes=schemes,
        most_processes=cases.most_processes,
        cost=cases.cost,
        applies=applies,
        outside=True,
        available=availability,
        compute=partial(solve, cases=cases, reynolds_number=reynolds_number),
        cases=cases,
        reynolds_number=reynolds_number,
    )


def creeping(_scene: Scene) -> float:
    """The Reynolds number of a model that leaves inertia out."""
    return CREEPING


def solve(
    model: Model[SceneT],
    scene: SceneT,
    request: CheckedRequest,
    progress: Progress,
    *,
    cases: Cases[SceneT, RunT],
    reynolds_number: Callable[[SceneT], float],
) -> Result:
    """Write, run and read; the run's times include those that this process spends on the case."""
    wall, cpu = time.perf_counter(), time.thread_time()
    with tempfile.TemporaryDirectory(prefix="roughfilm-") as place:
        directory = Path(place) / model.name
        cases.write_to_run(scene, directory, request, reynolds_number(scene))
        ran = cases.run(directory, progress)
        spent = time.thread_time() - cpu
        whole = replace(ran, cpu_s=ran.cpu_s + spent, wall_s=time.perf_counter() - wall)
        return cases.read(model, scene, directory, whole)
