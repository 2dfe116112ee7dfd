"""Models that run OpenFOAM: they write, run and read a case, in one call or step by step."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Unpack

from typing_extensions import TypeVar

from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.case_directory import TOLERANCES
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.installation import availability, dialect_here
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import About, Applicability, Model, Progress, Resolutions, SceneT, silent
from roughfilm.rom.ladder.request import CheckedRequest, Request
from roughfilm.rom.ladder.result import Result, with_finite_numbers

if TYPE_CHECKING:
    from roughfilm.foamcases.openfoam.run import CaseRun

CREEPING = 1e-6
"""Reynolds number for Stokes flow: advection is a millionth of viscous stress, as OpenFOAM has no scheme without it."""

RunT = TypeVar("RunT", bound="CaseRun", default=Any)

CaseWriter = Callable[[SceneT, Path, CheckedRequest, float, Dialect], None]
"""Function write(scene, directory, request, reynolds_number, dialect) that writes the case of a scene."""


@dataclass(frozen=True, kw_only=True)
class Cases(Generic[SceneT, RunT]):
    """The functions that write, run and read the cases of one kind of scene, and the options of its models.

    Attributes
    ----------
    kind : kind of the scenes.
    resolutions : allowed and default resolutions, or a function of the scene that returns them.
    resolution_meaning, residual_meaning : what resolution counts and the residual measures, in words.
    tolerance : default residual at which a run ends.
    most_processes : most_processes(scene, resolution), the largest number of processes.
    cost : cost(scene, resolution), expected CPU seconds.
    write : write(scene, directory, request, reynolds_number, dialect), which writes the case of a scene.
    write_to_run : the function with the same parameters that writes a case to be run at once on this machine.
    run : run(directory, progress), which runs a case and returns a ``CaseRun``.
    kept_run : kept_run(directory), the ``CaseRun`` of a case that its script ``Allrun`` ran.
    read : read(model, scene, directory, run), which returns the result of a case that was run.
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
    kept_run: Callable[[Path], RunT]
    read: Callable[[Model[SceneT], SceneT, Path, RunT], Result]


@dataclass(frozen=True, kw_only=True)
class CaseModel(Model[SceneT], Generic[SceneT, RunT]):
    """A model that runs OpenFOAM: ``write``, ``run`` and ``read`` are the three steps that ``solve`` does at once.

    ``solve`` uses a temporary directory, which it removes at its end.

    Attributes
    ----------
    cases : the functions that write, run and read the cases.
    reynolds_number : reynolds_number(scene), the Reynolds number at which a case is run.

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

    def write(
        self, scene: SceneT, directory: Path, request: Request = Request(), *, dialect: Dialect | None = None
    ) -> None:
        """Write the case of a scene completely or not at all.

        Parameters
        ----------
        scene : the scene.
        directory : the directory of the case, which is made; it may exist if it is empty.
        request : numerical options.
        dialect : the dialect of the case; None for that of the OpenFOAM of this machine, or ``COM`` without one.

        Raises
        ------
        InputError
            For an option outside the range that the model allows, or a directory that is not empty.
        """
        checked = self.checked(scene, request)
        self.cases.write(scene, directory, checked, self.reynolds_number(scene), dialect or dialect_here())

    def run(self, directory: Path, progress: Progress = silent) -> RunT:
        """Run a case that this model wrote, and verify the fields that the run leaves in the directory.

        Returns
        -------
        CaseRun
            Times, warnings and OpenFOAM version of the run; its subclasses add residuals and iterations.

        Raises
        ------
        InputError
            If the directory holds no case of this model, or one for another dialect of OpenFOAM.
        UnavailableError
            If OpenFOAM is not on this machine.
        ConvergenceError
            If the mesh has faults or the flow does not converge.
        """
        return self.cases.run(directory, progress)

    def kept_run(self, directory: Path) -> RunT:
        """Read the run of a case of this model that its script ``Allrun`` ran; OpenFOAM is not needed.

        Raises
        ------
        InputError
            If the directory holds no case of this model.
        ConvergenceError
            If the mesh has faults, the flow did not converge, or the fields on disk were not verified.
        """
        return self.cases.kept_run(directory)

    def read(self, scene: SceneT, directory: Path, run: RunT) -> Result:
        """Read the result of a case of this scene that was run, with all ways in which it is outside the range.

        Raises
        ------
        InputError
            If the directory holds no case of this scene.
        ConvergenceError
            If the directory holds no finished fields, or a number of the result is not finite.
        """
        with finite_arithmetic(self.name):
            return self.bounded(scene, with_finite_numbers(self.cases.read(self, scene, directory, run)))


def openfoam_model(
    cases: Cases[SceneT, RunT],
    *,
    applies: Callable[[SceneT], Applicability],
    reynolds_number: Callable[[SceneT], float],
    schemes: tuple[str, ...] = (),
    **about: Unpack[About],
) -> CaseModel[SceneT, RunT]:
    """Make a model that runs OpenFOAM.

    Parameters
    ----------
    cases : the functions and options of the cases of one kind of scene.
    applies : applies(scene), whether the model can solve it, and which effects it leaves out.
    reynolds_number : reynolds_number(scene), the Reynolds number at which a case is run.
    schemes : advection schemes that the model offers, the default first.
    **about : name, summary, effects and sources of the model, as in ``About``.
    """
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
    """The Reynolds number ``CREEPING``, for models that leave inertia out."""
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
    """Write, run and read a case in a temporary directory; the times of the run include those of this process."""
    wall, cpu = time.perf_counter(), time.thread_time()
    with scratch_directory() as place:
        directory = place / model.name
        cases.write_to_run(scene, directory, request, reynolds_number(scene), dialect_here())
        ran = cases.run(directory, progress)
        spent = time.thread_time() - cpu
        whole = replace(ran, cpu_s=ran.cpu_s + spent, wall_s=time.perf_counter() - wall)
        return cases.read(model, scene, directory, whole)
