"""The OpenFOAM installation of this machine, and its environment."""

import os
import re
import shutil
import subprocess
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from roughfilm.rom.ladder.model import Availability

PROGRAMS = ("checkMesh", "simpleFoam", "foamDictionary")
"""Names of the programs that are run; the last one starts the fastest, and gives the version."""

OPEN_MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
}
"""Settings of Open MPI: any user, more processes than cores, processes not bound to cores, and no busy waiting."""

REMEDY = "install it with: sudo apt-get install openfoam"


@cache
def environment() -> Mapping[str, str]:
    """The environment variables that OpenFOAM runs with: those of a sourced distribution, or of Debian's package."""
    environment = {**os.environ, **OPEN_MPI}
    if os.environ.get("WM_PROJECT_DIR"):
        return environment
    place = _packaged()
    return {**environment, "WM_PROJECT_DIR": str(place)} if place else environment


@cache
def availability() -> Availability:
    """The availability of OpenFOAM, with its version, or with the missing program and the remedy."""
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if missing:
        return Availability(available=False, detail=f"no {' or '.join(missing)} on the PATH; {REMEDY}")
    try:
        answer = subprocess.run(
            ["foamDictionary", "-help"], env=environment(), capture_output=True, text=True, timeout=60, check=False
        )
    except (OSError, subprocess.SubprocessError) as error:
        return Availability(available=False, detail=f"OpenFOAM does not start ({error}); {REMEDY}")
    if answer.returncode != 0:
        return Availability(
            available=False,
            detail="OpenFOAM does not start; set WM_PROJECT_DIR to OpenFOAM's share directory, or " + REMEDY,
        )
    version = re.search(r"OpenFOAM-\W*v?(\w+)", answer.stdout)
    return Availability(available=True, detail=f"OpenFOAM v{version[1]}" if version else "OpenFOAM, version unknown")


def _packaged() -> Path | None:
    program = shutil.which("simpleFoam")
    place = Path(program or "/").resolve().parent.parent / "share" / "openfoam"
    return place if program and (place / "etc" / "controlDict").exists() else None
