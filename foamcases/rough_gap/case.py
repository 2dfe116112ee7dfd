"""Write the case directory of a rough gap: one mesh, and one case of simpleFoam for each drive of the flow."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.foamcases.openfoam.allrun import allrun
from roughfilm.foamcases.openfoam.block_mesh import write_block
from roughfilm.foamcases.openfoam.case_directory import write_papers, write_whole, written_for
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import parts_of, write_files, write_second_try
from roughfilm.foamcases.openfoam.memory import check_memory
from roughfilm.foamcases.openfoam.residuals import Judged
from roughfilm.foamcases.rough_gap.dictionaries import (
    CONTACT,
    DRIVES,
    SIDES,
    Drive,
    gap_dictionaries,
    relaxation,
)
from roughfilm.foamcases.rough_gap.mesh import Columns, columns_between
from roughfilm.foamcases.rough_gap.start import Start
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.rough_gap.scene import MIN_LAYERS, RoughGap
from roughfilm.rom.rough_gap.walls import Walls

RESIDUAL_SLACK = 300.0
"""Allowed residual over the tolerance once the flow has settled; what remains are waves as short as the cells."""

LAYERS_PER_COLUMN = 1 / 4
"""Number of cells across the gap over the number along its longer side, unless the scene gives the former."""

README = """\
One period of a rough gap, for OpenFOAM's simpleFoam. Run it with ./Allrun

Each of these directories is a case: {drives}. Their mesh is the same, in constant/polyMesh here.
  along    a mean pressure gradient drives the flow along x (constant/fvOptions)
  across   the same along y
  sliding  the upper wall (patch "upper") slides along x
Lengths are in mean gaps h; velocities in V = h^2 G / (12 eta), with the pressure gradient G = {gradient:.12g} Pa/m,
which a smooth gap carries on average; nu = 1 / Re. So
  p [Pa]      = p * {pressure:.12g}      (without the mean gradient's part)
  U [m/s]     = U * {speed:.12g}
  x, y, z [m] = x, y, z * {length:.12g}
"lower" is the wall at rest, "contact" the edges of what the walls' contact closes; all else repeats itself.

The mean velocity of all cells is in postProcessing/flow/0/volFieldValue.dat of each case, by iteration. Allrun ends a
flow when it has settled: the mean velocity no longer changes. Residuals of waves as short as the cells may remain.
Times the volume of the mesh over the area of its period that mean velocity is
  along, across   (A11, A21) and (A12, A22) over h^3, times {excess:.12g} by the layers: divide by that
  sliding         (B1, B2) over h
"""


@dataclass(frozen=True, kw_only=True)
class GapCard:
    """The options with which a case was written, which are needed to run and read it.

    Attributes
    ----------
    layers : number of cells across the gap.
    cells : number of cells of the mesh; 0 where contact leaves no open gap.
    dialect : name of the dialect of OpenFOAM in which the cases are written.
    judged : for each drive, the fields that are not constant, the main velocity first.
    relaxation : for each drive, the relaxation of velocity.
    """

    layers: int
    cells: int = field(metadata={"may_be_zero": True})
    reynolds_number: float
    resolution: int
    tolerance: float
    scheme: str
    processes: int
    dialect: str
    judged: dict[str, list[str]]
    relaxation: dict[str, float]

    @property
    def drives(self) -> dict[str, Judged]:
        """The criteria of convergence of each drive."""
        return {
            name: Judged(main=fields[0], fields=tuple(fields), slack=RESIDUAL_SLACK)
            for name, fields in self.judged.items()
        }


def layers_of(scene: RoughGap, resolution: int) -> int:
    """The number of cells across the gap, as the scene gives it or a quarter of the number along the longer side."""
    return scene.layers or max(MIN_LAYERS, round(resolution * LAYERS_PER_COLUMN))


def columns_of(scene: RoughGap, resolution: int) -> tuple[int, int]:
    """The numbers of mesh columns along x and y: ``resolution`` along the longer side, and at least 2."""
    shape = scene.surface().shape
    nx, ny = (max(2, round(points * resolution / max(shape))) for points in shape)
    return nx, ny


CLOSED = "Contact seals this gap both ways on this mesh: there is no flow to compute. Allrun only says so.\n"
"""README of a gap without flows."""

HEIGHT_ROUND_OFF = 1e-12
"""Largest difference of heights, over the mean gap, that counts as round-off."""


def mesh_of(scene: RoughGap, resolution: int) -> tuple[Walls, Columns]:
    """The walls with ``resolution`` nodes along the longer side, and the mesh between them in units of the mean gap."""
    walls = scene.walls(resolution)
    return walls, columns_between(walls, scene.mean_gap, layers_of(scene, resolution))


def judged_of(drive: Drive, walls: Walls) -> tuple[str, ...]:
    """The fields of a flow that are not constant, the main velocity first.

    If the walls do not change along the flow, the velocity has one component and the pressure is constant. If they do
    not change across the flow, there is no velocity across it.
    """
    both = np.stack([walls.lower, walls.upper])
    changes = [bool((np.ptp(both, axis=axis) > HEIGHT_ROUND_OFF * walls.mean_gap).any()) for axis in (1, 2)]
    main = int(drive.gradient[1] != 0)
    names = "Ux", "Uy"
    if not changes[main]:
        return (names[main],)
    return (names[main], *([names[1 - main]] if changes[1 - main] else []), "Uz", "p")


def write_gap_case(
    scene: RoughGap,
    directory: Path,
    request: CheckedRequest,
    reynolds_number: float,
    dialect: Dialect,
    *,
    run: bool = False,
) -> None:
    """Write the cases of a scene, one for each drive, in one directory, completely or not at all.

    In a direction that contact seals there is no flow and no case. A gap that contact seals both ways has none.

    Parameters
    ----------
    scene : the rough gap.
    directory : the directory of the cases, which is made; it may exist if it is empty.
    request : numerical options; the resolution is the number of columns along the longer side.
    reynolds_number : the Reynolds number at which the cases are run; the model chooses it.
    dialect : the dialect of OpenFOAM in which the cases are written.
    run : whether the cases are to be run by this library at once, which needs more memory than to write them, and no
        dictionaries of a second try.

    Raises
    ------
    InputError
        If the directory is not empty, or the mesh does not fit into this machine's memory.
    """
    resolution, processes = request.resolution, request.processes
    nx, ny = columns_of(scene, resolution)
    check_memory((nx, ny), layers_of(scene, resolution), run=run)
    walls, columns = mesh_of(scene, resolution)
    layers = layers_of(scene, resolution)
    sides = walls.spacing[0] / scene.mean_gap, walls.spacing[1] / scene.mean_gap
    drives = _drives(walls, columns)
    judged = {drive.name: list(judged_of(drive, walls)) for drive in drives}
    card = GapCard(
        layers=layers,
        cells=int(columns.kept.sum()) * layers,
        reynolds_number=reynolds_number,
        resolution=resolution,
        tolerance=request.tolerance,
        scheme=request.scheme,
        processes=processes,
        dialect=dialect.name,
        judged=judged,
        relaxation={name: relaxation(layers, sides, straight=len(fields) == 1) for name, fields in judged.items()},
    )
    script = allrun({}, tolerance=card.tolerance, processes=1, dialect=dialect)
    closed = partial(write_papers, readme=CLOSED, allrun=script, card=card)
    write_whole(directory, _filled(scene, walls, columns, drives, card, dialect, run=run) if drives else closed)


def _drives(walls: Walls, columns: Columns) -> list[Drive]:
    """The drives that make liquid flow on the mesh."""
    closed = sealed(columns.kept.astype(float))
    open_to = {"along": not closed[0], "across": not closed[1], "sliding": walls.slides and not all(closed)}
    return [drive for drive in DRIVES if open_to[drive.name]]


def _filled(
    scene: RoughGap,
    walls: Walls,
    columns: Columns,
    drives: list[Drive],
    card: GapCard,
    dialect: Dialect,
    *,
    run: bool,
) -> Callable[[Path], None]:
    """The function that fills a directory with the cases."""
    shape = (*columns.kept.shape, card.layers)
    kept = np.broadcast_to(columns.kept[..., None], shape)
    chosen = kept.ravel(order="F")
    patches = SIDES if kept.all() else (*SIDES, CONTACT)
    speed = scene.nominal_flow / scene.mean_gap
    names = " ".join(drive.name for drive in drives)
    readme = README.format(
        drives=names,
        gradient=scene.pressure_gradient,
        pressure=scene.pressure_gradient * scene.mean_gap / 12 * card.reynolds_number,
        speed=speed,
        length=scene.mean_gap,
        excess=1 + 2 / card.layers**2,
    )
    readme += written_for(dialect)
    script = allrun(card.drives, tolerance=card.tolerance, processes=card.processes, dialect=dialect)

    def fill(place: Path) -> None:
        write_block(columns.vertices, SIDES, place, kept=kept, cut=CONTACT)
        start = Start(walls, scene.mean_gap, columns)
        for drive in drives:
            velocity, pressure = start.fields(drive)
            case = place / drive.name
            write_files(
                case,
                gap_dictionaries(
                    drive,
                    dialect=dialect,
                    reynolds_number=card.reynolds_number,
                    tolerance=card.tolerance,
                    scheme=card.scheme,
                    parts=parts_of(card.processes, walls.size),
                    relaxation=card.relaxation[drive.name],
                    moving=card.drives[drive.name].fields,
                    velocity=velocity.reshape(-1, 3, order="F")[chosen],
                    pressure=pressure.reshape(-1, order="F")[chosen] / card.reynolds_number,
                    patches=patches,
                ),
            )
            if not run:
                write_second_try(case, scheme=card.scheme, tolerance=card.tolerance)
            (case / "constant" / "polyMesh").symlink_to(Path("..") / ".." / "constant" / "polyMesh")
        write_papers(place, readme=readme, allrun=script, card=card)

    return fill
