"""A case directory for a pocket scene: mesh, dictionaries, and what a person needs to run it by hand."""

import json
import tempfile
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam import block_mesh as mesh
from roughfilm.foamcases.openfoam.dictionaries import SIDES, write_dictionaries
from roughfilm.foamcases.openfoam.installation import OPEN_MPI
from roughfilm.rom.pocket.scene import Pocket

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

CARD = "case.json"
COARSEST, FINEST = 12, 4000
RESOLUTION = 240
TOLERANCE = 1e-7

SomeCard = TypeVar("SomeCard")

SERIAL = "simpleFoam > log.simpleFoam 2>&1"
PARALLEL = (
    "decomposePar > log.decomposePar 2>&1 &&\n"
    "    env {environment} \\\n"
    "    mpirun -np {processes} simpleFoam -parallel > log.simpleFoam 2>&1 &&\n"
    "    reconstructPar -latestTime > log.reconstructPar 2>&1"
)

SHELL = """\
#!/bin/sh
# Checks the mesh and runs the case. The mesh is already in constant/polyMesh: no blockMesh is needed.
cd "$(dirname "$0")" || exit 1
if [ -z "$WM_PROJECT_DIR" ]; then
    WM_PROJECT_DIR=$(dpkg -L openfoam | sed -n 's|/etc/controlDict$||p' | head -n 1)
    export WM_PROJECT_DIR
fi
"""

ALLRUN = """\
checkMesh > log.checkMesh 2>&1 &&
    {commands}
status=$?
grep -h "Mesh OK" log.checkMesh
grep -h "SIMPLE solution converged" log.simpleFoam
exit $status
"""

README = """\
One period of a groove under a sliding wall, for OpenFOAM's simpleFoam. Run it with ./Allrun

Lengths are in film thicknesses, velocities in sliding speeds, so nu = 1 / Re and
  p [Pa]    = p * {pressure:.12g}
  U [m/s]   = U * {speed:.12g}
  x, y [m]  = x, y * {film:.12g}
The upper wall (patch "upper", y = 1) slides; "inlet" and "outlet" are one periodic boundary.
"""


@dataclass(frozen=True, kw_only=True)
class Card:
    """What reading a case back needs to know of how it was written."""

    columns: int
    layers: int
    reynolds_number: float
    resolution: int
    tolerance: float
    scheme: str
    processes: int


def write_case(
    scene: Pocket,
    directory: Path,
    *,
    reynolds_number: float,
    resolution: int | None,
    tolerance: float | None,
    scheme: str,
    processes: int = 1,
) -> None:
    """Write the whole case of a scene at a Reynolds number of the model's choice.

    ``resolution`` is the number of mesh columns along the film, about (every corner of the gap is a column);
    a fifth as many layers cross it. ``scheme`` is a key of ``ADVECTION``. The case is there whole or not at all.
    Raises InputError for numbers out of range or a directory that is not empty.
    """
    resolution = RESOLUTION if resolution is None else resolution
    tolerance = TOLERANCE if tolerance is None else tolerance
    if not COARSEST <= resolution <= FINEST:
        raise InputError(f"--resolution: got {resolution}; it must be {COARSEST} to {FINEST} mesh columns")
    check_tolerance(tolerance)
    if not 1 <= processes <= resolution // 2:
        raise InputError(f"--processes: got {processes}; it must be 1 to {resolution // 2}, two columns for each")
    vertices = mesh.layered(scene.gap(), resolution)
    card = Card(
        columns=vertices.shape[0] - 1,
        layers=vertices.shape[1] - 1,
        reynolds_number=reynolds_number,
        resolution=resolution,
        tolerance=tolerance,
        scheme=scheme,
        processes=processes,
    )
    readme = README.format(pressure=scene.pressure_unit * reynolds_number, speed=scene.speed, film=scene.geometry.film)

    def fill(place: Path) -> None:
        mesh.write_block(vertices, SIDES, place)
        write_dictionaries(
            place, viscosity=1 / reynolds_number, tolerance=tolerance, scheme=scheme, processes=processes
        )
        write_papers(place, readme=readme, allrun=SHELL + ALLRUN.format(commands=commands(processes)), card=card)

    write_whole(directory, fill)


def check_tolerance(tolerance: float) -> None:
    """InputError for residuals that are out of reach, or of no use."""
    if not 1e-10 <= tolerance <= 1e-2:
        raise InputError(f"--tolerance: got {tolerance}; it must be 1e-10 to 1e-2")


def commands(processes: int) -> str:
    """What a shell is to do to run simpleFoam in a case directory."""
    settings = " ".join(f"{name}={value}" for name, value in OPEN_MPI.items())
    return SERIAL if processes == 1 else PARALLEL.format(processes=processes, environment=settings)


def write_whole(directory: Path, fill: Callable[[Path], None]) -> None:
    """Make a case directory that is there whole or not at all; InputError if it cannot be, or holds something."""
    if any(map(str.isspace, str(directory.absolute()))):
        told = f"{str(directory.absolute())!r}: OpenFOAM takes no blanks in a path"
        raise InputError(f"{told}; name another place, or another for what is temporary by TMPDIR")
    try:
        if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
            raise InputError(f"{directory}: is not an empty directory; name another")
        directory.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{directory.name}-", dir=directory.parent) as place:
            scratch = Path(place) / directory.name
            scratch.mkdir()
            fill(scratch)
            scratch.replace(directory)
    except OSError as error:
        raise InputError(f"{directory}: cannot be written ({error.strerror}); choose another place") from error


def write_papers(directory: Path, *, readme: str, allrun: str, card: "DataclassInstance") -> None:
    """Write what goes with a case: for a person, for a shell, and for reading it back."""
    (directory / "README").write_text(readme, encoding="utf-8")
    (directory / "Allrun").write_text(allrun, encoding="utf-8")
    (directory / "Allrun").chmod(0o755)
    (directory / CARD).write_text(json.dumps(asdict(card), indent=1) + "\n", encoding="utf-8")


def read_card(directory: Path, kind: type[SomeCard]) -> SomeCard:
    """The card of a case; InputError if there is none of this kind."""
    try:
        return kind(**json.loads((directory / CARD).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise InputError(f"{directory}: holds no {CARD} of this version; generate the case again") from error
