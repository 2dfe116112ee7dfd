"""A flow through a periodic box with solids of any shape: a case by snappyHexMesh, run and read."""

import shutil
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.meshes.files import write_mesh
from roughfilm.foamcases.openfoam.block_mesh import Patch, write_block
from roughfilm.foamcases.openfoam.case_directory import (
    SHELL,
    check_tolerance,
    commands,
    read_card,
    write_papers,
    write_whole,
)
from roughfilm.foamcases.openfoam.dictionaries import write_files
from roughfilm.foamcases.openfoam.installation import REMEDY
from roughfilm.foamcases.openfoam.program import succeed
from roughfilm.foamcases.openfoam.residuals import FIELDS, Judged
from roughfilm.foamcases.openfoam.run import check_mesh, converge, ready, remarks
from roughfilm.foamcases.rough_gap.dictionaries import CONTACT, SIDES, Drive, gap_dictionaries, relaxation
from roughfilm.foamcases.rough_gap.model import TOLERANCE
from roughfilm.foamcases.rough_gap.run import mean_velocity, settled_within, unsettled
from roughfilm.foamcases.snappy.dictionary import SURFACE, snappy_dictionary
from roughfilm.foamcases.snappy.solid import Carved
from roughfilm.rom.ladder.model import Progress, silent

PROGRAM = "snappyHexMesh"
STILL: Any = [0.0, 0.0, 0.0]
LEVEL: Any = 0.0
"""Initial pressure of every cell; the mesh does not exist yet."""

ALL = Judged()

ALLRUN = """\
snappyHexMesh -overwrite > log.snappyHexMesh 2>&1 &&
    checkMesh > log.checkMesh 2>&1 &&
    {commands}
status=$?
grep -h "Mesh OK" log.checkMesh
grep -h "SIMPLE solution converged" log.simpleFoam
exit $status
"""

README = """\
A flow through one period of a box with solids in it, for OpenFOAM's snappyHexMesh and simpleFoam. Run it with ./Allrun

The block of cells is in constant/polyMesh and what is cut out of it in constant/triSurface. The source in
constant/fvOptions is the mean pressure gradient over the density. Lengths are in a unit h, velocities in
h^2 G / (12 eta) with the mean pressure gradient G, so a smooth gap of height h carries 1 per width.
"""


@dataclass(frozen=True, kw_only=True)
class SnappedCard:
    """The options for running and reading a case; the liquid must reach the sides ``open``."""

    area: float
    tolerance: float
    scheme: str
    processes: int
    open: list[str]


@dataclass(frozen=True, kw_only=True)
class SnappedFlow:
    """The results of a flow through a box.

    Attributes
    ----------
    flow_per_width : ∫ u dV over the area of the box, in units of h and h²G/(12η), shape (3,); a column of A/h³.
    volume : of the liquid over the area of the box, in h: the mean gap.
    cells : of the mesh.
    residual : as of :class:`roughfilm.foamcases.pocket.run.Run`.
    unsettled : by what part of itself the largest of the flows would still change, by its trend.
    cpu_s : of mesh, flow and checks; mesh_cpu_s of the mesh alone.
    warnings : remarks of the mesh check.
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
) -> None:
    """Write the case of a box and its solid, whole or not at all.

    Parameters
    ----------
    reynolds_number : ρ q/η of a smooth gap of height h.
    scheme : a key of ``ADVECTION``; "" for a creeping flow.
    level : how many times cells at the solid are halved.
    sides : patches at x-, x+, y-, y+, z-, z+; those that the solid covers vanish.

    The sides at z- and z+ drive a flow only as far as the solid leaves them bare.

    Raises
    ------
    InputError
        For numbers out of range, a place of the liquid outside the box, or a directory that is not empty.
    """
    check_tolerance(tolerance)
    box, inside = carved.box, np.asarray(carved.inside)
    if not ((inside > [0, 0, box.bottom]) & (inside < [*box.size, box.top])).all():
        raise InputError(f"inside: got {carved.inside}, which lies outside the box; name a place in the liquid")
    length, width, height = box.steps
    through = [sides[2 * axis].name for axis, part in enumerate(drive.gradient) if part]
    if drive.speed:
        through.append(sides[5].name)
    card = SnappedCard(area=box.size[0] * box.size[1], tolerance=tolerance, scheme=scheme, processes=1, open=through)

    def fill(place: Path) -> None:
        write_block(box.vertices, sides, place)
        surface = place / "constant" / "triSurface" / SURFACE
        write_mesh(carved.solid, surface)
        files = gap_dictionaries(
            drive,
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
        write_papers(place, readme=README, allrun=SHELL + ALLRUN.format(commands=commands(1)), card=card)

    write_whole(directory, fill)


def run_snapped(directory: Path, judged: Judged = ALL, *, progress: Progress = silent) -> SnappedFlow:
    """Mesh a case that :func:`write_snapped` wrote, check the mesh, iterate the flow and read it.

    Raises
    ------
    UnavailableError
        If OpenFOAM or its snappyHexMesh is not here.
    ConvergenceError
        If the liquid does not reach through the box, the mesh has faults, or the flow does not converge.
    """
    from foamlib import FoamCase  # slow to import

    ready(1)
    if shutil.which(PROGRAM) is None:
        raise UnavailableError(f"no {PROGRAM} on the PATH; {REMEDY}")
    wall, card = time.perf_counter(), read_card(directory, SnappedCard)
    progress(0.0, PROGRAM)
    mesh = succeed(directory, [PROGRAM, "-overwrite"], f"log.{PROGRAM}")
    _check_open(directory, card.open)
    checked = check_mesh(directory)
    run = converge(directory, card, judged, progress, settled_within(card.tolerance, directory, judged))
    volumes = succeed(directory, ["postProcess", "-func", "writeCellVolumes", "-latestTime"], "log.volumes")
    try:
        last = FoamCase(directory)[-1]
        velocity = np.asarray(last["U"].internal_field, dtype=float)
        volume = np.asarray(last["V"].internal_field, dtype=float)
    except (OSError, LookupError, ValueError) as error:
        raise ConvergenceError(f"{directory}: holds no finished fields; run the case again") from error
    if not (np.isfinite(velocity).all() and volume.min() > 0):
        raise ConvergenceError(f"{directory}: the fields are not finite; lower the Reynolds number or refine the mesh")
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
    """ConvergenceError if no liquid is left at a side that it is to pass, or that is to drive it."""
    from foamlib import FoamFile  # slow to import

    patches: Any = FoamFile(directory / "constant" / "polyMesh" / "boundary")[None]
    faces = {name: entries["nFaces"] for name, entries in patches}
    for name in names:
        if not faces.get(name):
            raise ConvergenceError(
                f"{directory}: the liquid does not reach the side {name!r}, which it is to pass or to be driven by; "
                "refine the cells or name another place in the liquid"
            )
