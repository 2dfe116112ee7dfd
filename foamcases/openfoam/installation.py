"""The OpenFOAM installations of this machine: where they are looked for, which one is used, and its environment."""

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from glob import glob
from pathlib import Path

from roughfilm.foamcases.openfoam.dialect import COM, Dialect, Release, release_in
from roughfilm.rom.ladder.model import Availability

VARIABLE = "ROUGHFILM_OPENFOAM"
"""Environment variable that names the OpenFOAM to use."""

PROGRAMS = ("checkMesh", "simpleFoam", "foamDictionary")
"""Names of the programs that are run; the last one starts the fastest, and gives the version."""

PLACES = (
    "$FOAM_INST_DIR/OpenFOAM-*",
    "/usr/lib/openfoam/openfoam*",
    "/opt/openfoam*",
    "/opt/OpenFOAM/OpenFOAM-*",
    "$HOME/OpenFOAM/OpenFOAM-*",
)
"""Directories of installations that are not on the PATH, as patterns; each has a file ``etc/bashrc``."""

SETTINGS = {
    "FOAM_SIGFPE": "true",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
}
"""Settings of every run.

A program stops at a floating-point error, which openfoam.org's do only with ``FOAM_SIGFPE``. Open MPI allows any user
and more processes than cores, does not bind processes to cores, and does not wait busily.
"""

NAMES = "a directory with etc/bashrc, a file bashrc, or a command that is put in front"
"""What the variable may name, in words."""

REMEDY = f"install it with: sudo apt-get install openfoam; or name one in {VARIABLE}"

START_TIME_S = 60.0
"""Longest time that a program may take to print its help, or an installation to set its environment, s."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """A place where OpenFOAM may be.

    Attributes
    ----------
    name : the place in words.
    command : words put before each command, such as "apptainer exec IMAGE".
    bashrc : the file that sets the environment; None if the environment of this process is used.
    """

    name: str
    command: tuple[str, ...] = ()
    bashrc: Path | None = None


@dataclass(frozen=True, kw_only=True)
class Installation:
    """An OpenFOAM that answers, or a place where none does.

    Attributes
    ----------
    release : the release; None if OpenFOAM does not run from there.
    detail : the release, or the reason why there is none.
    place : the place in words.
    command : words put before each command.
    environment : environment variables of each command.
    """

    release: Release | None
    detail: str
    place: str = ""
    command: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=lambda: {**os.environ, **SETTINGS})

    def has(self, program: str) -> bool:
        """Whether a program can be called; behind a command put in front this is not known, and True."""
        return bool(self.command) or shutil.which(program, path=self.environment.get("PATH", "")) is not None


@cache
def installation() -> Installation:
    """The OpenFOAM that is used: the one that is named, else the first that runs of all ``places``."""
    tried = []
    for place in places():
        found = look(place)
        if found.release is not None:
            return found
        tried.append(f"{found.place}: {found.detail}")
    named = os.environ.get(VARIABLE)
    if named:
        reason = f"OpenFOAM, as {VARIABLE} or an option names it: {tried[0]}; give {NAMES}"
    else:
        reason = f"no OpenFOAM: {'; '.join(tried)}; {REMEDY}"
    return Installation(release=None, detail=reason)


def environment() -> Mapping[str, str]:
    """The environment variables that OpenFOAM runs with."""
    return installation().environment


def availability() -> Availability:
    """The availability of OpenFOAM, with its version, or with what is missing and the remedy."""
    here = installation()
    return Availability(available=here.release is not None, detail=here.detail)


def dialect_here() -> Dialect:
    """The dialect of the OpenFOAM of this machine; that of openfoam.com if there is none."""
    release = installation().release
    return release.dialect if release else COM


def places() -> Iterator[Place]:
    """The places where OpenFOAM may be, best first; if one is named, that one alone."""
    named = os.environ.get(VARIABLE)
    if named:
        yield _named(named)
        return
    yield Place(name="on the PATH")
    own = os.environ.get("WM_PROJECT_DIR")
    found = [Path(own)] if own else []
    for pattern in PLACES:
        found += sorted(map(Path, glob(os.path.expandvars(pattern))), key=_number, reverse=True)
    for directory in dict.fromkeys(found):
        if (directory / "etc" / "bashrc").is_file():
            yield Place(name=str(directory), bashrc=directory / "etc" / "bashrc")


def look(place: Place) -> Installation:
    """The OpenFOAM of a place, or the reason why none runs from there."""

    def absent(reason: str) -> Installation:
        return Installation(release=None, detail=reason, place=place.name)

    if place.bashrc is not None and not place.bashrc.is_file():
        return absent(f"no file {place.bashrc}")
    try:
        here = Installation(
            release=None, detail="", place=place.name, command=place.command, environment=_environment(place)
        )
        own = _own_folders(here.environment) if place.bashrc else here.environment.get("PATH", "")
        missing = [one for one in PROGRAMS if not place.command and shutil.which(one, path=own) is None]
        if missing:
            return absent(f"no {' or '.join(missing)}")
        answer = subprocess.run(
            [*here.command, PROGRAMS[-1], "-help"],
            env=here.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=START_TIME_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return absent(f"does not answer within {START_TIME_S:g} s; it may wait for input")
    except subprocess.CalledProcessError as error:
        return absent(f"its bashrc stops with code {error.returncode}")
    except FileNotFoundError:
        return absent("no such file or command")
    except OSError as error:
        return absent(f"does not start ({error.strerror or error})")
    if answer.returncode != 0:
        packaged = _packaged() if place.command and "WM_PROJECT_DIR" not in here.environment else None
        if packaged is not None:
            return absent(f"{PROGRAMS[-1]} stops with code {answer.returncode}; set WM_PROJECT_DIR={packaged} first")
        last = next(iter(answer.stderr.strip().splitlines()[-1:]), "")
        return absent(f"{PROGRAMS[-1]} stops with code {answer.returncode}" + (f" ({last.strip()})" if last else ""))
    release = release_in(answer.stdout)
    if release is None:
        return absent(f"{PROGRAMS[-1]} is neither openfoam.com's nor openfoam.org's")
    if release.family == "org" and here.environment.get("WM_LABEL_SIZE") == "64":
        return absent(f"{release} is built with labels of 64 bits, which misreads the mesh; build it with 32 bits")
    return Installation(
        release=release, detail=str(release), place=place.name, command=here.command, environment=here.environment
    )


def _named(text: str) -> Place:
    """The place that a user names: a directory with ``etc/bashrc``, such a file, or words to put before a command."""
    path = Path(text).expanduser()
    if path.is_dir():
        return Place(name=text, bashrc=path / "etc" / "bashrc")
    if path.is_file() and (path.name == "bashrc" or not os.access(path, os.X_OK)):
        return Place(name=text, bashrc=path)
    try:
        words = shlex.split(text)
    except ValueError:  # a quotation that does not end
        words = []
    return Place(name=text, command=tuple(words) or (text,))


def _environment(place: Place) -> Mapping[str, str]:
    """The environment of a place; OSError or SubprocessError if its file cannot be sourced."""
    if place.bashrc is None:
        packaged = None if place.command or os.environ.get("WM_PROJECT_DIR") else _packaged()
        return {**os.environ, **({"WM_PROJECT_DIR": str(packaged)} if packaged else {}), **SETTINGS}
    answer = subprocess.run(
        ["bash", "-c", 'file=$1; set --; . "$file" > /dev/null 2>&1; env -0', "-", str(place.bashrc.absolute())],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=START_TIME_S,
        check=True,
    )
    if not answer.stdout:
        raise OSError("its bashrc ends the shell that reads it")
    entries = os.fsdecode(answer.stdout).split("\0")
    return {**dict(entry.split("=", 1) for entry in entries if "=" in entry), **SETTINGS}


def _own_folders(environment: Mapping[str, str]) -> str:
    """The folders of an installation's own programs; the PATH may lead to those of another one."""
    if "FOAM_APPBIN" not in environment:
        return environment.get("PATH", "")
    return os.pathsep.join([environment["FOAM_APPBIN"], os.path.join(environment.get("WM_PROJECT_DIR", ""), "bin")])


def _packaged() -> Path | None:
    """The directory of Debian's package, whose programs are on the PATH of every user."""
    program = shutil.which("simpleFoam")
    place = Path(program or "/").resolve().parent.parent / "share" / "openfoam"
    return place if program and (place / "etc" / "controlDict").exists() else None


def _number(directory: Path) -> int:
    """The number in the name of an installation, such as 2412; -1 without one."""
    digits = re.search(r"\d+", directory.name)
    return int(digits[0]) if digits else -1
