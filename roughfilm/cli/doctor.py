"""roughfilm doctor: what is on this machine, which version, and what to do about the rest."""

import platform
import shutil
import subprocess
from collections.abc import Callable
from importlib import metadata

from rich.table import Table

from roughfilm.figures.rendering import probe
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.model import Availability
from roughfilm.rom.ladder.provenance import versions
from roughfilm.terminal.console import AsJson, in_one_line, output, print_json


def _python() -> Availability:
    return Availability(
        available=True, detail=f"Python {platform.python_version()}, roughfilm {versions()['roughfilm']}"
    )


def _mpi() -> Availability:
    if shutil.which("mpirun") is None:
        return Availability(available=False, detail="no mpirun; install it with: sudo apt-get install openmpi-bin")
    try:
        told = subprocess.run(["mpirun", "--version"], capture_output=True, text=True, timeout=30, check=False).stdout
    except (OSError, subprocess.SubprocessError) as error:
        return Availability(available=False, detail=f"mpirun does not start ({error})")
    return Availability(available=True, detail=next(iter(told.splitlines()), "mpirun"))


def _instruments() -> Availability:
    try:
        return Availability(available=True, detail=f"SurfaceTopography {metadata.version('SurfaceTopography')}")
    except metadata.PackageNotFoundError:
        return Availability(available=False, detail="install it with: pip install 'roughfilm[instruments]'")


CHECKS: dict[str, Callable[[], Availability]] = {
    "Python": _python,
    "OpenFOAM": availability,
    "MPI": _mpi,
    "rendering": probe,
    "instrument files": _instruments,
}


@in_one_line
def command(as_json: AsJson = False) -> None:
    """Look for Python, OpenFOAM, MPI, rendering, the reader of instrument files; say what was found, what to do."""
    found = {name: check() for name, check in CHECKS.items()}
    if as_json:
        print_json({name: {"available": it.available, "detail": it.detail} for name, it in found.items()})
        return
    table = Table("part", "found", "version, or what to do")
    for name, it in found.items():
        table.add_row(name, "[green]yes[/]" if it.available else "[red]no[/]", it.detail)
    output.print(table)
