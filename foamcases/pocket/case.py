"""Write the case directory of a pocket scene: mesh, dictionaries, and a README and a script to run it by hand."""

from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.conformal.orthogonal import orthogonal
from roughfilm.foamcases.openfoam.block_mesh import in_space, write_block
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import SIDES, write_dictionaries
from roughfilm.foamcases.openfoam.one_flow import write_flow
from roughfilm.foamcases.openfoam.residuals import PLANE, flat_slack, judged_fields
from roughfilm.foamcases.openfoam.settling import functions
from roughfilm.foamcases.pocket.card import Card, layers_of
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.pocket.scene import Pocket

README = """\
One period of a groove under a sliding wall, for OpenFOAM's simpleFoam. Run it with ./Allrun

Lengths are in film thicknesses, velocities in sliding speeds, so nu = 1 / Re and
  p [Pa]    = p * {pressure:.12g}
  U [m/s]   = U * {speed:.12g}
  x, y [m]  = x, y * {film:.12g}
The upper wall (patch "upper", y = 1) slides; "inlet" and "outlet" are one periodic boundary.
"""


def vertices_of(scene: Pocket, resolution: int) -> Array:
    """The corners of the cells of a scene's mesh, shape (columns + 1, layers + 1, 2, 3), in film thicknesses.

    Parameters
    ----------
    scene : the pocket scene.
    resolution : number of columns along the film, about; there are a fifth as many layers, and at least 4.
    """
    return in_space(orthogonal(scene.gap(), resolution, layers_of(resolution)))


def write_case(
    scene: Pocket,
    directory: Path,
    request: CheckedRequest,
    reynolds_number: float,
    dialect: Dialect,
    *,
    run: bool = False,
) -> None:
    """Write the case of a scene completely or not at all.

    Parameters
    ----------
    scene : the pocket scene.
    directory : the directory of the case, which is made; it may exist if it is empty.
    request : numerical options. The resolution is the number of mesh columns along the film, about, as columns begin
        and end at every corner of the gap; there are a fifth as many layers. The scheme is a key of ``ADVECTION``.
    reynolds_number : the Reynolds number ρ u Ly/η at which the case is run; the model chooses it.
    dialect : the dialect of OpenFOAM in which the case is written.
    run : whether the case is to be run by this library at once, which needs no dictionaries of a second try.

    Raises
    ------
    InputError
        If the directory is not empty or cannot be written, or cells of the mesh fold.
    """
    vertices = vertices_of(scene, request.resolution)
    along, across = np.diff(vertices[..., 0], axis=0), np.diff(vertices[..., 1], axis=1)
    judged = judged_fields(PLANE, along, across)
    card = Card(
        columns=vertices.shape[0] - 1,
        layers=vertices.shape[1] - 1,
        reynolds_number=reynolds_number,
        resolution=request.resolution,
        tolerance=request.tolerance,
        scheme=request.scheme,
        processes=request.processes,
        dialect=dialect.name,
        judged=judged,
        slack=1.0 if judged == PLANE else flat_slack(along, across, request.tolerance),
    )
    readme = README.format(pressure=scene.pressure_unit * reynolds_number, speed=scene.speed, film=scene.geometry.film)

    def fill(place: Path) -> None:
        write_block(vertices, SIDES, place)
        write_dictionaries(
            place,
            dialect=dialect,
            viscosity=1 / reynolds_number,
            tolerance=request.tolerance,
            scheme=request.scheme,
            parts=(request.processes, 1),
            relaxation=card.relaxation,
            functions=functions(dialect) if card.settles else None,
        )

    write_flow(directory, fill, card, card.criteria, dialect, readme=readme, run=run, settles=card.settles)
