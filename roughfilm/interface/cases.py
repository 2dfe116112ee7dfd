"""OpenFOAM cases of a scene, which are written, run and read in a directory that is kept."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm import ladder
from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.interface.scenes import checked_scene
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
) -> OpenFOAMCase:
    """Write the OpenFOAM case of a scene: mesh, dictionaries, Allrun and a README with the units.

    Parameters
    ----------
    scene : a scene of kind "pocket" or "rough_gap".
    directory : the case directory, which must be empty or not exist.
    model : "navier_stokes" or "stokes".
    resolution : number of mesh columns, as ``resolution_meaning`` of the model explains; the model has a default.
    tolerance : residual at which the solver stops; the model has a default.
    scheme : advection scheme, one of ``schemes`` of the model; the default is the first.
    processes : number of MPI processes of the run.

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
    by.write(scene, Path(directory), request)
    return OpenFOAMCase(scene, by, Path(directory))
