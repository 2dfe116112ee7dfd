"""OpenFOAM cases of a scene or a study, which are written, run and read in a directory that is kept."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughfilm import ladder
from roughfilm.batch.directory import alone
from roughfilm.batch.execute import refuse_lost
from roughfilm.batch.executors import MOST_PROCESSES, workers
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import whole_in_range
from roughfilm.contact.foundation.reading.regular import named_path
from roughfilm.foamcases.openfoam.dialect import dialect_named
from roughfilm.foamcases.openfoam.installation import dialect_here
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.generated.collect import collect
from roughfilm.generated.manifest import read_manifest
from roughfilm.generated.write import study_to_generate, write_cases
from roughfilm.interface.scenes import checked_scene
from roughfilm.interface.studies import read_table
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.meshes.result_mesh import result_mesh

if TYPE_CHECKING:
    import pyvista


class OpenFOAMCase:
    """An OpenFOAM case of a scene, in a directory of its own.

    Attributes
    ----------
    scene : the scene.
    model : the model whose equations the case solves.
    directory : the case directory; its script ``./Allrun`` also runs the case.
    """

    def __init__(self, scene: Scene, model: CaseModel[Any, Any], directory: Path) -> None:
        self.scene, self.model, self.directory = scene, model, directory
        self._result: Result | None = None

    def run(self, progress: Progress = silent) -> Result:
        """Run the case, check that it converged, and return its result.

        Parameters
        ----------
        progress : called with the done fraction and a few words.

        Raises
        ------
        ConvergenceError
            If the mesh has faults, or the flow does not converge.
        UnavailableError
            If OpenFOAM is not installed on this machine.
        """
        run = self.model.run(self.directory, progress)
        self._result = self.model.read(self.scene, self.directory, run)
        return self._result

    def result(self) -> Result:
        """Return the result of the last run; raises InputError if the case has not been run."""
        if self._result is None:
            raise InputError(f"{self.directory}: this case has not been run; call run() first")
        return self._result

    def mesh(self) -> "pyvista.UnstructuredGrid":
        """Return the cells of the case, with lengths in m, and its fields as data of the cells.

        The data are "cell_velocity (m/s)" and "cell_pressure (Pa)", with one value for each cell. Raises InputError if
        the case has not been run.
        """
        import pyvista  # takes seconds to import

        found = result_mesh(self.result())
        cell = pyvista.CellType[found.cell_type.name]
        mesh = pyvista.UnstructuredGrid({cell: found.cells}, np.ascontiguousarray(found.points))
        mesh.point_data.update(dict(found.point_data))
        mesh.cell_data.update(dict(found.cell_data))
        return mesh


def write_case(
    scene: Scene,
    directory: str | os.PathLike[str],
    *,
    model: str = "navier_stokes",
    resolution: int | None = None,
    tolerance: float | None = None,
    scheme: str | None = None,
    processes: int = 1,
    dialect: str | None = None,
) -> OpenFOAMCase:
    """Write the OpenFOAM case of a scene: mesh, dictionaries, Allrun and a README with the units.

    Parameters
    ----------
    scene : a scene of kind "pocket", "rough_gap", or "bearing" if it is an infinitely wide pad.
    directory : the case directory, which must be empty or not exist.
    model : "navier_stokes" or "stokes".
    resolution : number of mesh columns, as ``resolution_meaning`` of the model explains; the model has a default.
    tolerance : residual at which the solver stops; the model has a default.
    scheme : advection scheme, one of ``schemes`` of the model; the default is the first.
    processes : number of MPI processes of the run.
    dialect : "com" for openfoam.com, "org" for openfoam.org 8 or later; the default is that of this machine's OpenFOAM,
        or "com" without one.

    Returns
    -------
    OpenFOAMCase
        ``run()`` runs the case and returns the Result, ``result()`` returns it again, and ``mesh()`` returns a pyvista
        mesh.

    Raises
    ------
    InputError
        If the model writes no OpenFOAM cases, an option is out of range, or the directory cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> with tempfile.TemporaryDirectory() as directory:
    ...     case = rf.write_case(scene, directory + "/case", resolution=30)
    ...     sorted(path.name for path in case.directory.iterdir())[:3]
    ['0', 'Allrun', 'README']
    """
    by = ladder.find(checked_scene(scene).kind, model)
    if not isinstance(by, CaseModel):
        known = [one.name for one in ladder.models(scene.kind) if one.outside]
        remedy = f"it must be {' or '.join(known)}" if known else f"no model of a {scene.kind} has any"
        raise InputError(f"model: got {model!r}, which writes no OpenFOAM case; {remedy}")
    request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
    place = named_path("directory", directory)
    by.write(scene, place, request, dialect=dialect_named(dialect) if dialect is not None else None)
    return OpenFOAMCase(scene, by, place)


def write_study(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    processes: int = 1,
    dialect: str | None = None,
    progress: Progress = silent,
) -> list[Path]:
    """Write the OpenFOAM cases of a study, with scripts to run them by hand or under Slurm.

    Parameters
    ----------
    path : the study file (TOML), as :func:`roughfilm.load_study` reads it; OpenFOAM need not be on this machine.
    out : the directory, which must be empty or not exist. ``Allrun.all`` in it runs all cases.
    processes : number of MPI processes of each case.
    dialect : "com" or "org", as in :func:`roughfilm.write_case`.
    progress : called with the done fraction and a few words.

    Returns
    -------
    list of Path
        The directory of each case; :func:`roughfilm.collect_study` reads the results.

    Raises
    ------
    InputError
        If the file is not a study or is wrong, no model of it runs OpenFOAM, or the directory cannot be written.

    Examples
    --------
    >>> import roughfilm as rf
    >>> try:
    ...     rf.write_study("scripts/examples/studies/pocket.toml", "cases")
    ... except rf.InputError as error:
    ...     print(error)
    study.models: none of them runs OpenFOAM; name stokes or navier_stokes, or solve it with 'batch'
    """
    file, place = named_path("path", path), named_path("out", out)
    study = study_to_generate(file)
    if study is None:
        raise InputError(f"{file}: is the scene of one case, not a study; write it with write_case")
    written_in = dialect_here() if dialect is None else dialect_named(dialect)
    manifest = write_cases(study, place, written_in, processes=processes, file=file, progress=progress)
    return [place / one.directory for one in manifest.generated]


def collect_study(
    out: str | os.PathLike[str], *, processes: int = 1, progress: Progress = silent
) -> dict[str, NDArray[Any]]:
    """Read the OpenFOAM cases of a study that have finished, and write its results and tables.

    Each case is checked as a run of this library is. Models of the study that need no OpenFOAM are solved here.

    Parameters
    ----------
    out : the directory that :func:`roughfilm.write_study` wrote; its cases may still run.
    processes : number of processes for the models that need no OpenFOAM; 1 is this process.
    progress : called with the done fraction and a few words.

    Returns
    -------
    dict of arrays
        The columns of ``out/table.h5``, as :func:`roughfilm.run_study` returns them. The column "outcome" says which
        cases have not finished or failed, and "warnings" which were edited.

    Raises
    ------
    InputError
        If the directory holds no manifest of this version, is in use, or cannot be written.
    UnavailableError
        If a process that solves a case dies twice; what is solved is kept.

    Examples
    --------
    >>> import roughfilm as rf
    >>> try:
    ...     table = rf.collect_study("docs")
    ... except rf.InputError as error:
    ...     print(error)
    docs: holds no manifest.json; name a directory that 'roughfilm generate' wrote
    """
    processes = whole_in_range("processes", processes, 1, MOST_PROCESSES)
    place = named_path("out", out)
    read_manifest(place)
    with alone(place) as scratch:
        found = collect(place, workers(processes, scratch), progress)
    refuse_lost([failure for _, failure in found.progress.failures], len(found.study.cases), "cases")
    return read_table(place / "table.h5")
