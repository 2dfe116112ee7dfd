"""roughfilm doctor: the programs that are on this machine, their versions, and how to install the others."""

import platform
import subprocess
from collections.abc import Callable
from importlib import metadata
from typing import Any

from roughfilm.figures.rendering import probe
from roughfilm.foamcases.openfoam.installation import Installation, environment, installation, look, places
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Availability
from roughfilm.rom.ladder.provenance import versions
from roughfilm.terminal.console import AsJson, print_json
from roughfilm.terminal.results import print_all, table_of

EXAMPLES = ("roughfilm doctor",)


def _python() -> Availability:
    return Availability(
        available=True, detail=f"Python {platform.python_version()}, roughfilm {versions()['roughfilm']}"
    )


def _mpi() -> Availability:
    if not installation().has("mpirun"):
        return Availability(available=False, detail="no mpirun; install it with: sudo apt-get install openmpi-bin")
    try:
        text = subprocess.run(
            [*installation().command, "mpirun", "--version"],
            env=environment(),
            capture_output=True,
            text=True,
            timeout=30,
            check=False,
        ).stdout
    except (OSError, subprocess.SubprocessError) as error:
        return Availability(available=False, detail=f"mpirun does not start ({error})")
    return Availability(available=True, detail=next(iter(text.splitlines()), "mpirun"))


def _instruments() -> Availability:
    try:
        return Availability(available=True, detail=f"SurfaceTopography {metadata.version('SurfaceTopography')}")
    except metadata.PackageNotFoundError:
        return Availability(available=False, detail="install it with: pip install 'roughfilm[instruments]'")


def _openfoam() -> Availability:
    here, names = installation(), sorted({model.name for model in models() if model.outside})
    if here.release is None:
        return Availability(available=False, detail=f"{here.detail}; {' and '.join(names)} cannot run without it")
    tried = "tried with roughfilm" if here.release.tried else "never tried with roughfilm"
    return Availability(available=True, detail=f"{here.release}, {here.place}, {tried}; runs {' and '.join(names)}")


def _places() -> list[Installation]:
    """What is found in each place where OpenFOAM is looked for."""
    return [look(place) for place in places()]


CHECKS: dict[str, Callable[[], Availability]] = {
    "Python": _python,
    "OpenFOAM": _openfoam,
    "MPI": _mpi,
    "rendering": probe,
    "instrument files": _instruments,
}


def command(as_json: AsJson = False) -> None:
    """Check Python, OpenFOAM, MPI, rendering and the reader of instrument files; give remedies."""
    parts = {name: check() for name, check in CHECKS.items()}
    if as_json:
        entries: dict[str, Any] = {
            name: {"available": part.available, "detail": part.detail} for name, part in parts.items()
        }
        release = installation().release
        entries["OpenFOAM"] |= {
            "family": release and f"openfoam.{release.family}",
            "release": release and release.number,
            "dialect": release and release.dialect.name,
            "tried": release is not None and release.tried,
            "places": [
                {"place": one.place, "found": one.detail, "used": one.place == installation().place}
                for one in _places()
            ],
        }
        print_json(entries)
        return
    rows = [(name, "yes" if part.available else "no", part.detail) for name, part in parts.items()]
    table = table_of(("part", "here", "version, or remedy"), rows, left=3)
    for row, part in zip(table.rows, parts.values(), strict=True):
        row.style = "default" if part.available else "red"
    missing = [name for name, part in parts.items() if not part.available]
    others = f"{len(parts) - len(missing)} of {len(parts)} parts are here"
    last = f"{others}; missing: {', '.join(missing)}" if missing else f"{others}: every model can run"
    used = installation().place
    found = [(one.place, one.detail, "yes" if one.place == used else "") for one in _places()]
    print_all([table, table_of(("OpenFOAM in", "found", "used"), found, left=3), last])
