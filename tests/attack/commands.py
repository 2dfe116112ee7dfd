"""Every command that writes, on scenes that it solves in seconds."""

import importlib.util
import shutil
from dataclasses import dataclass
from pathlib import Path

from attack.forked import ROOT
from small_scenes import CONTACT, SEAL, SURFACE

POCKET = """
name = "pocket"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 mm"
depth = {depth}
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = {number}
"""

STUDY = POCKET.format(depth='["6 um", "7.5 um"]', number="[10, 20, 40]") + "[study]\nmodels = {models}\n"

BEARING = """
name = "pad"
kind = "bearing"
[geometry]
shape = "linear"
length = "20 mm"
width = "20 mm"
film = "4.5 um"
rise = "0.5 um"
[lubricant]
viscosity = "0.005 Pa*s"
density = "850 kg/m^3"
cavitation_pressure = "-0.1 MPa"
[motion]
speed = "10 m/s"
[load]
pressure = "2 MPa"
[roughness]
kind = "surface"
surface = "rough.toml"
[asperities]
friction = 0.12
[asperities.solid]
modulus = "210 GPa"
poisson = 0.3
hardness = "3 GPa"
"""

SHAFT = """
name = "shaft"
kind = "bearing"
[geometry]
shape = "lobes"
radius = "25 mm"
clearance = "40 um"
width = "25 mm"
[lubricant]
viscosity = "15 mPa*s"
cavitation_pressure = "-0.1 MPa"
[motion]
speed = "6000 rpm"
[load]
force = "300 N"
[body]
mass = "10 kg"
unbalance = "500 g*mm"
"""

ROUGH_GAP = """
name = "gap"
kind = "rough_gap"
[geometry]
mean_gap = "1 um"
surface = "rough.toml"
[lubricant]
viscosity = "10 mPa*s"
density = "870 kg/m^3"
[flow]
reynolds_number = 1
"""

FILES = {
    "rough.toml": SURFACE,
    "seal.toml": SEAL,
    "contact.toml": CONTACT,
    "pocket.toml": POCKET.format(depth='"7.5 um"', number=40),
    "pad.toml": BEARING,
    "shaft.toml": SHAFT,
    "gap.toml": ROUGH_GAP,
    "study.toml": STUDY.format(models='["reynolds", "inertial_reynolds"]'),
    "foam.toml": STUDY.format(models='["navier_stokes"]') + "resolution.navier_stokes = 30\n",
}
"""The files that the commands read."""

STEEL = ("--modulus", "1GPa", "--poisson", "0.3")
SCHEDULER = "SCHEDULER"
"""Stands for the address of a dask scheduler."""


@dataclass(frozen=True, kw_only=True)
class Command:
    """A command that writes.

    Attributes
    ----------
    words : its arguments.
    before : commands that must have ended before it, each by its arguments.
    needs : "openfoam", "mpi" or "dask" where it needs one.
    once : whether it refuses, with exit code 2, to write again what it has written.
    slow : whether it takes longer than ten seconds; it is attacked more rarely.
    """

    words: tuple[str, ...]
    before: tuple[tuple[str, ...], ...] = ()
    needs: str = ""
    once: bool = False
    slow: bool = False

    @property
    def here(self) -> bool:
        """Whether what it needs is on this machine."""
        openfoam = shutil.which("simpleFoam") is not None
        return {
            "": True,
            "openfoam": openfoam,
            "mpi": openfoam and shutil.which("mpirun") is not None,
            "dask": importlib.util.find_spec("distributed") is not None,
        }[self.needs]


def _words(text: str) -> tuple[str, ...]:
    return tuple(text.split())


CONTACTS = ("contact", "rough.toml", *STEEL, *_words("--loads 100kPa..10MPa:12 --out c.h5"))
GENERATE = _words("generate foam.toml --out cases")
BATCH = _words("batch study.toml --out sweep --jobs 2")
WINDOWS = _words("windows rough.toml --windows 4 --sizes 80um --out windows --jobs 2")

COMMANDS = {
    "solve": Command(words=_words("solve pocket.toml --model film --out film.h5 --json")),
    "solve, OpenFOAM": Command(
        words=_words("solve pocket.toml --model navier_stokes --resolution 30 --out ns.h5 --json"), needs="openfoam"
    ),
    "solve, MPI": Command(
        words=_words("solve pocket.toml --model navier_stokes --resolution 30 --processes 2 --out ns.h5 --json"),
        needs="mpi",
    ),
    "compare": Command(words=_words("compare contact.toml --out study --json")),
    "factors": Command(words=_words("factors rough.toml --out table.h5 --json")),
    "factors, report": Command(words=_words("factors rough.toml --gap 1um --report page.html --json")),
    "factors, contacts": Command(words=_words("factors c.h5 --out table.h5 --json"), before=(CONTACTS,)),
    "contact": Command(words=(*CONTACTS, "--json")),
    "contact, report": Command(words=(*CONTACTS, "--report", "page.html", "--json")),
    "leakage": Command(words=_words("leakage seal.toml --out seal --loads 10kPa,20kPa,40kPa,80kPa --json")),
    "stribeck": Command(
        words=_words("stribeck pad.toml --out curves --resolution 16 --loads 1MPa,2MPa --speeds 1m/s,5m/s,10m/s --json")
    ),
    "march, shaft": Command(
        words=_words("march shaft.toml --out marched --end 3ms --cells 16,8 --fields 3 --json"),
    ),
    "effects": Command(words=_words("effects pad.toml --out pad --resolution 16 --json")),
    "surface": Command(words=_words("surface rough.toml --out cell.h5 --report page.html --json")),
    "fit": Command(words=_words("fit rough.toml --windows 16 --seeds 40 --out fitted.toml --report page.html --json")),
    "windows": Command(
        words=_words("windows rough.toml --scene seal.toml --windows 6 --sizes 80um --out windows --jobs 2 --json")
    ),
    "combine": Command(words=_words("combine rough.toml rough.toml --out wear.h5 --report page.html --json")),
    "leakage, windows": Command(
        words=_words("leakage seal.toml --windows windows --out seal --jobs 2 --loads 10kPa,40kPa --json"),
        before=(WINDOWS,),
    ),
    "factors, windows": Command(words=_words("factors windows --out table.h5 --json"), before=(WINDOWS,)),
    "stribeck, windows": Command(
        words=_words(
            "stribeck pad.toml --windows windows --out curves --jobs 2 --resolution 16 --loads 1MPa --speeds 1m/s,5m/s "
            "--json"
        ),
        before=(WINDOWS,),
    ),
    "export": Command(words=_words("export gap.toml --out gap.vtu --resolution 16 --json")),
    "export, surface": Command(words=_words("export rough.toml --out rough.stl --json")),
    "generate": Command(words=(*GENERATE, "--json"), once=True),
    "collect": Command(
        words=_words("collect cases --jobs 2 --json"), before=(GENERATE, ("cases/Allrun.all",)), needs="openfoam"
    ),
    "batch": Command(words=(*BATCH, "--json")),
    "batch, OpenFOAM": Command(words=_words("batch foam.toml --out sweep --jobs 2 --json"), needs="openfoam"),
    "batch, dask": Command(
        words=_words(f"batch study.toml --out sweep --executor dask --scheduler {SCHEDULER} --json"), needs="dask"
    ),
    "report": Command(words=_words("report sweep --json"), before=(BATCH,)),
    "stability": Command(words=_words("stability cell --out map --resolution 64 --jobs 2 --json"), slow=True),
    "charts": Command(words=("charts", "--family", "cavitating slider", "--out", "charts", "--json")),
    "validate": Command(words=_words("validate --source fowell --source hertz --out numbers --json")),
    "dynamics": Command(
        words=_words("dynamics shaft.toml --out whirl --speeds 3000rpm,6000rpm,9000rpm --resolution 32 --json"),
    ),
    "march": Command(words=("march.py",)),
}
"""The commands by a name that says what they use."""


def lay_out(work: Path) -> None:
    """Write the files that the commands read."""
    work.mkdir(parents=True)
    for name, text in FILES.items():
        (work / name).write_text(text, encoding="utf-8")
    shutil.copy(ROOT / "tests" / "attack" / "march.py", work)
