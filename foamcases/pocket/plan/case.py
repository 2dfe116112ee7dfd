"""Write the case directory of a cell in plan: mesh, dictionaries, and a README and a script to run it by hand."""

from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.openfoam.block_mesh import Patch, write_block
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import parts_of, write_dictionaries
from roughfilm.foamcases.openfoam.memory import check_memory
from roughfilm.foamcases.openfoam.one_flow import write_flow
from roughfilm.foamcases.openfoam.residuals import FIELDS, judged_fields
from roughfilm.foamcases.openfoam.settling import functions
from roughfilm.foamcases.pocket.card import Card, layers_of
from roughfilm.foamcases.pocket.plan.mesh.columns import sides_of
from roughfilm.foamcases.pocket.plan.mesh.vertices import vertices_of
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.pocket.scene import Pocket

SAME_THICKNESS = 1e-9
"""Difference of film thicknesses along a line, over the film, below which the film does not change along it."""

README = """\
One periodic cell of a film over dimples, for OpenFOAM's simpleFoam. Run it with ./Allrun

Lengths are in film thicknesses, velocities in sliding speeds, so nu = 1 / Re and
  p [Pa]      = p * {pressure:.12g}
  U [m/s]     = U * {speed:.12g}
  x, y, z [m] = x, y, z * {film:.12g}
The upper wall (patch "upper", z = 1) slides along x. "west" and "east" are one periodic boundary. {across}
"""

ACROSS = {
    False: 'So are "south" and "north".',
    True: (
        "The cell is symmetric\n"
        'about y = 0, and only its half y > 0 is solved, between the symmetry planes "south" and "north".'
    ),
}
"""The boundaries across the cell, by whether half of it is solved."""


def sides(*, mirrored: bool) -> tuple[Patch, ...]:
    """The patches of a cell at x-, x+, y-, y+, z-, z+; symmetry planes across it if half of it is solved."""

    def through(name: str, other: str) -> Patch:
        return Patch(name=name, entries={"type": "cyclic", "neighbourPatch": other})

    across = (
        tuple(Patch(name=name, entries={"type": "symmetryPlane"}) for name in ("south", "north"))
        if mirrored
        else (through("south", "north"), through("north", "south"))
    )
    walls = tuple(Patch(name=name, entries={"type": "wall"}) for name in ("lower", "upper"))
    return (through("west", "east"), through("east", "west"), *across, *walls)


def judged_of(vertices: Array) -> tuple[str, ...]:
    """The fields of a flow that are judged: where the film does not change along y, nothing flows across."""
    height = vertices[:, :, -1, 2] - vertices[:, :, 0, 2]
    moving = FIELDS if (np.ptp(height, axis=1) > SAME_THICKNESS).any() else ("Ux", "Uz", "p")
    return judged_fields(moving, np.diff(vertices[..., 0], axis=0), np.diff(vertices[..., 2], axis=2))


def write_case(
    scene: Pocket,
    directory: Path,
    request: CheckedRequest,
    reynolds_number: float,
    dialect: Dialect,
    *,
    run: bool = False,
) -> None:
    """Write the case of a scene in plan completely or not at all.

    Parameters
    ----------
    scene : a pocket scene in plan.
    directory : the directory of the case, which is made; it may exist if it is empty.
    request : numerical options. The resolution is the number of mesh columns along the cell; there are as many per
        length across it, and a fifth as many layers. The scheme is a key of ``ADVECTION``.
    reynolds_number : the Reynolds number ρ u film/η at which the case is run; the model chooses it.
    dialect : the dialect of OpenFOAM in which the case is written.
    run : whether the case is to be run by this library at once, which needs more memory than to write it, and no
        dictionaries of a second try.

    Raises
    ------
    InputError
        If the directory is not empty or cannot be written, or the mesh does not fit into this machine's memory.
    """
    plan, resolution = scene.plan(), request.resolution
    rows, layers = sides_of(plan, resolution).y.size - 1, layers_of(resolution)
    solved = rows // 2 if plan.mirrored else rows
    check_memory((resolution, solved), layers, run=run)
    vertices = vertices_of(plan, resolution)
    patches = sides(mirrored=plan.mirrored)
    card = Card(
        columns=resolution,
        layers=layers,
        rows=rows,
        steps=(plan.length / plan.film / resolution, plan.breadth / plan.film / rows),
        mirrored=plan.mirrored,
        judged=judged_of(vertices),
        reynolds_number=reynolds_number,
        resolution=resolution,
        tolerance=request.tolerance,
        scheme=request.scheme,
        processes=request.processes,
        dialect=dialect.name,
    )
    readme = README.format(
        pressure=scene.pressure_unit * reynolds_number,
        speed=scene.speed,
        film=scene.geometry.film,
        across=ACROSS[plan.mirrored],
    )

    def fill(place: Path) -> None:
        write_block(vertices[:, rows - solved :], patches, place)
        write_dictionaries(
            place,
            dialect=dialect,
            viscosity=1 / reynolds_number,
            tolerance=request.tolerance,
            scheme=request.scheme,
            parts=parts_of(request.processes, (plan.length, plan.breadth * solved / rows)),
            relaxation=card.relaxation,
            sides=patches,
            functions=functions(dialect) if card.settles else None,
        )

    write_flow(directory, fill, card, card.criteria, dialect, readme=readme, run=run, settles=card.settles)
