"""Write the directory of a case completely or not at all, with a README, a shell script and a card to read it by."""

import json
import tempfile
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.installation import OPEN_MPI

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

CARD = "case.json"
"""Name of the card: the file of the options with which a case was written."""

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


TOLERANCES = (1e-10, 1e-2)
"""Least and greatest tolerance allowed: the residual at which a run may end."""


def check_tolerance(tolerance: float) -> None:
    """Raise InputError for a tolerance outside ``TOLERANCES``."""
    least, most = TOLERANCES
    if not least <= tolerance <= most:
        raise InputError(f"tolerance: got {tolerance}; it must be {least:g} to {most:g}")


def commands(processes: int) -> str:
    """The shell commands that run simpleFoam in a case directory, with mpirun for more than one process."""
    settings = " ".join(f"{name}={value}" for name, value in OPEN_MPI.items())
    return SERIAL if processes == 1 else PARALLEL.format(processes=processes, environment=settings)


def write_whole(directory: Path, fill: Callable[[Path], None]) -> None:
    """Make a case directory completely or not at all.

    Parameters
    ----------
    directory : the directory to make; it may exist if it is empty.
    fill : fill(place), which writes the files of the case into a temporary directory.

    Raises
    ------
    InputError
        If the path contains a blank, the directory is not empty, or it cannot be written.
    """
    if any(map(str.isspace, str(directory.absolute()))):
        path = repr(str(directory.absolute()))
        raise InputError(f"{path}: OpenFOAM takes no blanks in a path; name another place, or set TMPDIR to one")
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
    """Write the README, the shell script and the card of a case."""
    (directory / "README").write_text(readme, encoding="utf-8")
    (directory / "Allrun").write_text(allrun, encoding="utf-8")
    (directory / "Allrun").chmod(0o755)
    (directory / CARD).write_text(json.dumps(asdict(card), indent=1) + "\n", encoding="utf-8")


def read_card(directory: Path, kind: type[SomeCard]) -> SomeCard:
    """The card of a case, an object of the class ``kind``; InputError if the directory holds no such card."""
    try:
        return kind(**json.loads((directory / CARD).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise InputError(f"{directory}: holds no {CARD} of this version; generate the case again") from error
