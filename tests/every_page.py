"""One page of every kind, from the smallest scenes: the command that writes it and where it is."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from places import SCENES
from small_scenes import CONTACT, SEAL, SURFACE
from typer.testing import CliRunner
from window_sets import surface_of_seed, write_set

from roughfilm.batch import jobs
from roughfilm.charts.families import FAMILIES
from roughfilm.charts.family import Ask, ChartFamily, Measured, ReferenceValue
from roughfilm.cli.first_steps import compare
from roughfilm.cli.main import app
from roughfilm.cli.upkeep import stability
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures import base
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.stability import pocket as stability_pocket
from roughfilm.stability.pocket import POCKET, Places

STUDY = """
name = "pockets"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 mm"
depth = ["10 um", "20 um"]
profile = "cylindrical"
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
speed = "40 m/s"
[study]
models = ["reynolds", "inertial_reynolds"]
"""

WASHER = ["roughness.surface.points=[32, 32]", "roughness.surface.correlation_length=0.2 mm"]
WASHER += ["roughness.surface.anisotropy=1"]
PAD = ["roughness.surface.points=[32, 32]", "roughness.surface.correlation_length=60um"]
STEEL = ["--modulus", "200GPa", "--poisson", "0.3", "--hardness", "4GPa", "--loads", "100MPa,1GPa"]

FEW_WINDOWS = ["--windows", 4, "--size", "80um", "--sizes", "40um", "--jobs", 1]

SCENES_COMPARED = {
    "pocket": SCENES / "pocket.toml",
    "dimple": SCENES / "dimple.toml",
    "bearing": SCENES / "journal.toml",
    "dry_contact": Path("contact.toml"),
    "seal": Path("seal.toml"),
    "rough_gap": SCENES / "rough_gap.toml",
}


def run(*arguments: object) -> None:
    """Run a command, which succeeds."""
    done = CliRunner().invoke(app, [str(argument) for argument in arguments], catch_exceptions=False)
    assert done.exit_code == 0, done.output


def changes(*changed: str) -> list[str]:
    """The options of a command that change a scene."""
    return [part for change in changed for part in ("--set", change)]


def comparison(kind: str, folder: Path) -> Path:
    """The page of a comparison by the models that need no other program; on coarse grids for films in plan."""
    plan = kind in ("dimple", "bearing")
    coarse = {"resolutions": Resolutions(least=8, most=32, default=32, series=(8, 16, 32))} if plan else {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            compare, "models", lambda kind: tuple(replace(one, **coarse) for one in models(kind) if not one.outside)
        )
        run("compare", folder / SCENES_COMPARED[kind], "--out", folder / kind)
    return folder / kind / "report.html"


def sweep(folder: Path) -> Path:
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    run("batch", folder / "study.toml", "--out", folder / "sweep", "--jobs", 1)
    run("report", folder / "sweep")
    return folder / "sweep" / "report.html"


def stability_map(folder: Path) -> Path:
    places = Places(reynolds_numbers=(40.0, 2000.0), depths_plus=(0.25, 3.0))
    with pytest.MonkeyPatch.context() as patch:
        bare = tuple(one for one in models("pocket") if not one.outside)
        patch.setattr(stability_pocket, "models", lambda _: bare)
        patch.setitem(stability.FAMILIES, "pocket", replace(POCKET, solve=places.solve))
        run("stability", "pocket", "--out", folder / "stability")
    return next((folder / "stability").glob("*.html"))


def charts(folder: Path) -> Path:
    """Points of a known cost and error."""
    points = (("plain", 4, 0.1, 0.2), ("plain", 8, 0.2, 0.1), ("fine", 4, 0.3, 0.02), ("fine", 8, 1.0, 0.002))
    family = ChartFamily(
        name="test",
        work="Something is computed.",
        quantity="load",
        unit="N",
        resolution_meaning="nodes",
        truth=lambda: ReferenceValue(value=2.0, uncertainty=1e-5, source="a formula"),
        truth_cost=1.0,
        own=[
            Ask(solver=name, resolution=n, cost=1.0, measure=partial(Measured, value=2 * (1 + error), cpu_s=cpu))
            for name, n, cpu, error in points
        ],
        peers=(),
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(FAMILIES, "test", lambda _: family)
        run("charts", "--family", "test", "--out", folder / "charts")
    return folder / "charts" / "charts.html"


def validation(folder: Path) -> Path:
    """The page of the two sources that are solved fastest."""
    run("validate", "--source", "fowell", "--source", "hertz", "--out", folder / "validation")
    return folder / "validation" / "report.html"


def reported(command: str, *options: object) -> Callable[[Path], Path]:
    """The page of a command on the small surface."""

    def make(folder: Path) -> Path:
        page = folder / f"{command}.html"
        run(command, folder / "rough.toml", *options, "--report", page)
        return page

    return make


def written(command: str, scene: Path, *options: object) -> Callable[[Path], Path]:
    """The page of a command that writes a directory."""

    def make(folder: Path) -> Path:
        run(command, folder / scene, *options, "--out", folder / command)
        return folder / command / "report.html"

    return make


def over_windows(command: str, *arguments: object, cells: Sequence[Surface]) -> Callable[[Path], Path]:
    """The page of a command over a set of windows."""

    def make(folder: Path) -> Path:
        windows = write_set(folder / f"{command} windows", cells)
        out = folder / f"{command} over windows"
        if command == "factors":
            run(command, windows, *arguments, "--out", folder / "w.h5", "--report", folder / "w.html")
            return folder / "w.html"
        run(command, *arguments, "--windows", windows, "--jobs", 1, "--out", out)
        return out / "report.html"

    return make


SEEDS = [surface_of_seed(seed, 24) for seed in (1, 2, 3)]
"""Windows of the pages over sets of windows."""

KINDS: dict[str, Callable[[Path], Path]] = {
    "surface": reported("surface"),
    "combination": reported("combine", "rough.toml", "--operation", "sum"),
    "contact": reported("contact", *STEEL),
    "fit": reported("fit", "--windows", 16, "--seeds", 40),
    "factors": reported("factors", "--tolerance", 0.2, "--out", "factors.h5"),
    "leakage": written("leakage", Path("seal.toml")),
    "stribeck": written(
        "stribeck",
        SCENES / "rough_washer.toml",
        *changes(*WASHER),
        *("--resolution", 16, "--loads", "1MPa,2MPa", "--speeds", "20rpm,500rpm"),
    ),
    "dynamics": written(
        "dynamics",
        SCENES / "grooved_journal.toml",
        *("--resolution", 32, "--loads", "5kN,10kN", "--speeds", "1000rpm,3000rpm"),
    ),
    "windows": written("windows", Path("rough.toml"), "--scene", "seal.toml", *FEW_WINDOWS),
    "leakage over windows": over_windows("leakage", Path("seal.toml"), "--loads", "10kPa,40kPa", cells=SEEDS),
    "factors over windows": over_windows("factors", "--tolerance", 0.2, cells=SEEDS),
    "stribeck over windows": over_windows(
        "stribeck",
        SCENES / "rough_washer.toml",
        *changes("roughness.scale=10", "roughness.stretch=10"),
        *("--resolution", 16, "--loads", "1MPa", "--speeds", "20rpm,500rpm"),
        cells=SEEDS,
    ),
    "effects": written("effects", SCENES / "pad.toml", *changes(*PAD), "--resolution", 32),
    **{kind: partial(comparison, kind) for kind in SCENES_COMPARED},
    "sweep": sweep,
    "stability": stability_map,
    "charts": charts,
    "validation": validation,
}
"""How the page of each kind is made in a folder that holds the small scenes."""


def small_scenes(folder: Path) -> None:
    for name, text in (("rough", SURFACE), ("contact", CONTACT), ("seal", SEAL)):
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")


def made(kind: str, folder: Path, look: Callable[[base.Figure], None]) -> Path:
    """Make the page of a kind; ``look`` sees each of its figures once it has been drawn."""
    with pytest.MonkeyPatch.context() as patch:
        readings = base.readings

        def seen(figure: base.Figure) -> list[dict[str, object]]:
            found = readings(figure)
            look(figure)
            return found

        patch.setattr(base, "readings", seen)
        patch.setattr(jobs, "REPEATS", 1)
        patch.chdir(folder)
        return KINDS[kind](folder)
