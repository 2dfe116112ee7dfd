"""Write, run and read a case of the flow through a periodic box with solids of any shape, meshed by snappyHexMesh."""

import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.meshes.files import write_mesh
from roughfilm.foamcases.openfoam.allrun import allrun
from roughfilm.foamcases.openfoam.block_mesh import Patch, write_block
from roughfilm.foamcases.openfoam.case_directory import (
    check_tolerance,
    read_card,
    write_papers,
    write_whole,
    written_for,
)
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import write_files, write_second_try
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields
from roughfilm.foamcases.openfoam.installation import REMEDY, dialect_here, installation
from roughfilm.foamcases.openfoam.program import succeed
from roughfilm.foamcases.openfoam.residuals import FIELDS, Judged
from roughfilm.foamcases.openfoam.run import check_mesh, converge, ready, remarks
from roughfilm.foamcases.openfoam.settling import mean_velocity, settled_within, unsettled
from roughfilm.foamcases.rough_gap.dictionaries import CONTACT, SIDES, Drive, gap_dictionaries, relaxation
from roughfilm.foamcases.rough_gap.model import TOLERANCE
from roughfilm.foamcases.snappy.dictionary import SURFACE, snappy_dictionary
from roughfilm.foamcases.snappy.solid import Carved
from roughfilm.rom.ladder.model import Progress, silent

PROGRAM = "snappyHexMesh"
VOLUMES = ("V", "Vc")
"""The names of the field of cell volumes; the second is that of openfoam.org from 11 on."""

STILL: Any = [0.0, 0.0, 0.0]
"""Initial velocity of every cell."""

LEVEL: Any = 0.0
"""Initial pressure of every cell; the mesh does not exist yet."""

ALL = Judged()
"""The default criteria of convergence: all fields, with Ux as the main velocity."""

README = """\
A flow through one period of a box with solids in it, for OpenFOAM's snappyHexMesh and simpleFoam. Run it with ./Allrun

The block of cells is in constant/polyMesh and what is cut out of it in constant/triSurface. The source in
constant/fvOptions is the mean pressure gradient over the density. Lengths are in a unit h, velocities in
h^2 G / (12 eta) with the mean pressure gradient G, so a smooth gap of height h carries 1 per width.
"""


@dataclass(frozen=True, kw_only=True)
class SnappedCard:
    """The options with which a case was written, which are needed to run it and read it back.

    Attributes
    ----------
    area : area of the box in the plane, in h².
    tolerance : the residual, or the remaining relative change of the flow, at which the run ends.
    scheme : a key of ``ADVECTION``.
    processes : number of processes, 1.
    open : names of the sides that the liquid must reach.
    dialect : name of the dialect of OpenFOAM in which the case is written.
    """

    area: float
    tolerance: float
    scheme: str
    processes: int
    open: list[str]
    dialect: str


@dataclass(frozen=True, kw_only=True)
class SnappedFlow:
    """The results of a flow through a box.

    Attributes
    ----------
    flow_per_width : ∫ u dV over the area of the box, in units of h and h²G/(12η), shape (3,); a column of A/h³.
    volume : volume of the liquid over the area of the box, which is the mean gap, in h.
    cells : number of cells of the mesh.
    iterations : number of iterations of the last try.
    residual : largest initial residual of velocity and pressure that a new process computes from the fields on disk.
    unsettled : extrapolated remaining change of the largest component of the mean velocity, over that component.
    cpu_s : CPU time of the mesh, the flow and the checks, s.
    mesh_cpu_s : CPU time of the mesh and its check, s.
    wall_s : wall-clock time, s.
    warnings : warnings of the mesh check.
    """

    flow_per_width: Array
    volume: float
    cells: int
    iterations: int
    residual: float
    unsettled: float
    cpu_s: float
    mesh_cpu_s: float
    wall_s: float
    warnings: tuple[str, ...]


def write_snapped(
    carved: Carved,
    directory: Path,
    *,
    drive: Drive,
    reynolds_number: float,
    tolerance: float = TOLERANCE,
    scheme: str = "",
    level: int = 0,
    sides: tuple[Patch, ...] = SIDES,
    dialect: Dialect | None = None,
) -> None:
    """Write the case of a box and its solid completely or not at all.

    Parameters
    ----------
    carved : the box, the solid and a point in the liquid, in the unit h.
    directory : the directory of the case, which is made; it may exist if it is empty.
    drive : the mean pressure gradient and the speed of the side at z+.
    tolerance : the residual, or the remaining relative change of the flow, at which the run ends.
    reynolds_number : ρ q/η of a smooth gap of height h.
    scheme : a key of ``ADVECTION``; "" for a creeping flow.
    level : how many times cells at the solid are halved.
    sides : patches at x-, x+, y-, y+, z-, z+. The sides at z- and z+ act on the liquid only where the solid leaves
        them free, and a side that the solid covers has no faces.
    dialect : the dialect of the case; None for that of the OpenFOAM of this machine, or ``COM`` without one.

    Raises
    ------
    InputError
        If the tolerance is out of range, the point in the liquid is outside of the box, or the directory is not empty.
    """
    check_tolerance(tolerance)
    dialect = dialect or dialect_here()
    box, inside = carved.box, np.asarray(carved.inside)
    if not ((inside > [0, 0, box.bottom]) & (inside < [*box.size, box.top])).all():
        raise InputError(f"inside: got {carved.inside}, which lies outside the box; name a place in the liquid")
    length, width, height = box.steps
    through = [sides[2 * axis].name for axis, part in enumerate(drive.gradient) if part]
    if drive.speed:
        through.append(sides[5].name)
    card = SnappedCard(
        area=box.size[0] * box.size[1],
        tolerance=tolerance,
        scheme=scheme,
        processes=1,
        open=through,
        dialect=dialect.name,
    )

    def fill(place: Path) -> None:
        write_block(box.vertices, sides, place)
        surface = place / "constant" / "triSurface" / SURFACE
        write_mesh(carved.solid, surface)
        files = gap_dictionaries(
            drive,
            dialect=dialect,
            reynolds_number=reynolds_number,
            tolerance=tolerance,
            scheme=scheme,
            parts=(1, 1),
            relaxation=relaxation(round(1 / height), (length, width)),
            moving=FIELDS,
            velocity=STILL,
            pressure=LEVEL,
            patches=(*sides, CONTACT),
        )
        write_files(place, {**files, "system/snappyHexMeshDict": snappy_dictionary(carved.inside, level)})
        write_second_try(place, scheme=scheme, tolerance=tolerance)
        judged = replace(ALL, main="Uy" if drive.gradient[1] else "Ux")
        mesher = f"{PROGRAM} -overwrite"
        script = allrun({".": judged}, tolerance=tolerance, processes=1, dialect=dialect, mesher=mesher)
        write_papers(place, readme=README + written_for(dialect), allrun=script, card=card)

    write_whole(directory, fill)


def run_snapped(directory: Path, judged: Judged = ALL, *, progress: Progress = silent) -> SnappedFlow:
    """Mesh a case that :func:`write_snapped` wrote, check the mesh, iterate the flow and read its fields.

    Raises
    ------
    UnavailableError
        If OpenFOAM or its program snappyHexMesh is not on this machine.
    ConvergenceError
        If the liquid does not reach through the box, the mesh has faults, or the flow does not converge.
    """
    if not installation().has(PROGRAM):
        raise UnavailableError(f"no {PROGRAM} in the OpenFOAM that is used; {REMEDY}")
    wall, card = time.perf_counter(), read_card(directory, SnappedCard)
    ready(directory, card.dialect, card.processes)
    progress(0.0, PROGRAM)
    mesh = succeed(directory, [PROGRAM, "-overwrite"], f"log.{PROGRAM}")
    _check_open(directory, card.open)
    checked = check_mesh(directory)
    run = converge(directory, card, judged, progress, settled_within(card.tolerance, directory, judged))
    volumes = succeed(directory, ["postProcess", "-func", "writeCellVolumes", "-latestTime"], "log.volumes")
    try:
        last = last_fields(directory)
        volume = internal_field(
            next((last / name for name in VOLUMES if (last / name).exists()), last / VOLUMES[0]), 1
        )[:, 0]
        velocity = internal_field(last / "U", 3, volume.size)
    except InputError as error:
        raise ConvergenceError(f"{directory}: holds no finished fields ({error})") from error
    if not volume.min() > 0:
        raise ConvergenceError(f"{directory}: a cell has no volume; refine the mesh")
    flow = volume @ velocity / card.area
    return SnappedFlow(
        flow_per_width=flow,
        volume=float(volume.sum()) / card.area,
        cells=volume.size,
        iterations=run.tries[-1].iterations,
        residual=run.residual,
        unsettled=unsettled(mean_velocity(directory)[:, np.abs(flow).argmax()]),
        cpu_s=mesh.cpu_s + checked.cpu_s + run.cpu_s + volumes.cpu_s,
        mesh_cpu_s=mesh.cpu_s + checked.cpu_s,
        wall_s=time.perf_counter() - wall,
        warnings=remarks(checked),
    )


def _check_open(directory: Path, names: list[str]) -> None:
    """Raise ConvergenceError if a side through which liquid flows, or which drives it, has no faces in the mesh."""
    from foamlib import FoamFile  # slow to import

    patches: Any = FoamFile(directory / "constant" / "polyMesh" / "boundary")[None]
    faces = {name: entries["nFaces"] for name, entries in patches}
    for name in names:
        if not faces.get(name):
            raise ConvergenceError(
                f"{directory}: the liquid does not reach the side {name!r}, which it is to pass or to be driven by; "
                "refine the cells or name another place in the liquid"
            )
