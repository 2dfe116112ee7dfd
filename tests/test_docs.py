"""The README and the manual: links that lead somewhere, commands that exist, scenes that can be read."""

import pkgutil
import re
import shlex
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer
from places import ROOT
from typer.core import TyperGroup

from roughfilm.cli.main import MODULES, app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import toml_value
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.synthetic.description import make, read_description, read_entries
from roughfilm.ladder import models
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.studies.study import load_study

MADE = ("docs/gallery", "docs/reference/generated", "docs/source/studies")
"""Folders of pages that the build of the manual makes."""

PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *(path for path in sorted((ROOT / "docs").rglob("*.md")) if not str(path.relative_to(ROOT)).startswith(MADE)),
]
README_BYTES = 12_000
LINE_LENGTH = 120
BLOCK = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
COMMAND = re.compile(r"\broughfilm ([a-z]+)\b")
NAME = re.compile(r"\b(roughfilm(?:\.\w+)+)")
MODULE = re.compile(r"python -m (scripts\.[\w.]+)")


def _named(page: Path) -> str:
    return str(page.relative_to(ROOT))


def _blocks(page: Path, language: str) -> list[str]:
    return [text for name, text in BLOCK.findall(page.read_text()) if name == language]


def _code(page: Path) -> str:
    text = page.read_text()
    return "\n".join([*_blocks(page, "sh"), *re.findall(r"`([^`\n]+)`", BLOCK.sub("", text))])


TABLES = [
    pytest.param(text, id=f"{_named(page)}-{number}")
    for page in PAGES
    for number, text in enumerate(_blocks(page, "toml"))
    if re.search(r"^(\[|kind)", text, re.MULTILINE)
]
OIL = {"oil": "ISO VG 32", "temperature": "40 degC"}
PAD = {"shape": "linear", "length": "40 mm", "width": "40 mm", "rise": "20 um"}
BORE = {
    "shape": "lobes",
    "radius": "25 mm",
    "clearance": "40 um",
    "width": "25 mm",
    "arc": "300 deg",
    "first": "90 deg",
}
BASES: list[dict[str, Any]] = [
    {"geometry": PAD | {"film": "20 um"}, "motion": {"speed": "1 m/s"}},
    {"geometry": PAD, "motion": {"speed": "1 m/s"}},
    {"geometry": BORE, "motion": {"speed": "3000 rpm"}, "load": {"force": "300 N"}},
]
"""Bearings to which the tables of a block that is no whole scene are added: of a given film, under a load, a shaft."""


@pytest.mark.parametrize("page", PAGES, ids=_named)
def test_relative_links_point_to_files(page: Path) -> None:
    links = [link for link in LINK.findall(BLOCK.sub("", page.read_text())) if "://" not in link]
    targets = {link: (page.parent / link.partition("#")[0]).resolve() for link in links}
    made = tuple(str(ROOT / folder) for folder in MADE)
    assert [link for link, path in targets.items() if not path.exists() and not str(path).startswith(made)] == []


def test_the_readme_is_short() -> None:
    assert (ROOT / "README.md").stat().st_size <= README_BYTES


@pytest.mark.parametrize("page", PAGES, ids=_named)
def test_lines_are_short(page: Path) -> None:
    lines = [line for line in page.read_text().splitlines() if not line.startswith("|")]
    assert [line for line in lines if len(line) > LINE_LENGTH] == []


@pytest.mark.parametrize("page", [page for page in PAGES if page.name != "CHANGELOG.md"], ids=_named)
def test_commands_and_names_exist(page: Path) -> None:
    code = _code(page)
    assert [name for name in COMMAND.findall(code) if name not in MODULES] == []
    modules = [ROOT.joinpath(*name.split(".")) for name in MODULE.findall(code)]
    assert [path for path in modules if not (path.is_dir() or path.with_suffix(".py").is_file())] == []
    for name in NAME.findall(code):
        pkgutil.resolve_name(name)


TYPED = [
    pytest.param(line, id=f"{_named(page)}: {line.partition('#')[0].strip()}")
    for page in PAGES
    for block in _blocks(page, "sh")
    for line in block.splitlines()
    if re.match(r"roughfilm [a-z]+ ", f"{line} ") and page.name != "CHANGELOG.md" and not line.endswith("\\")
]


@pytest.mark.parametrize("line", TYPED)
def test_commands_can_be_typed(line: str) -> None:
    _, *words = shlex.split(line.partition(">")[0], comments=True)
    assert [word for word in words if word.startswith("scripts/") and not (ROOT / word).exists()] == []
    group = typer.main.get_command(app)
    assert isinstance(group, TyperGroup)
    called, command, rest = group.resolve_command(group.make_context("roughfilm", [*words]), words)
    assert called is not None
    command.make_context(called, rest)


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files that scenes of the manual name, which is not the current one."""
    folder = tmp_path / "scenes"
    folder.mkdir()
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    cell = make(read_entries(tomllib.loads(DESCRIBED)))
    save_surface(cell, folder / "cell.h5")
    np.save(folder / "heights.npy", cell.heights)
    for name in ("face.toml", "rough.toml"):
        (folder / name).write_text(DESCRIBED)
    (folder / "groove.csv").write_text("position (um), depth (um)\n0, 0\n150, 7.5\n300, 0\n")
    rows = [f"{10 * number}, {np.cos(number * np.pi / 2)}, -1, 3000" for number in range(4)]
    (folder / "duty.csv").write_text("\n".join(["time (ms), load_x (kN), load_y (kN), speed (rpm)", *rows]) + "\n")
    return folder


DESCRIBED = """kind = "gaussian"
size = ["0.2 mm", "0.2 mm"]
points = [32, 32]
seed = 1
rms_height = "0.5 um"
correlation_length = "20 um"
"""


@pytest.mark.parametrize("text", TABLES)
def test_tables_are_valid_in_a_file_of_another_folder(text: str, elsewhere: Path) -> None:
    entries, file = tomllib.loads(text), elsewhere / "scene.toml"
    if "name" in entries or "kind" in entries:
        file.write_text(text)
        if "name" in entries:
            assert load_study(file, models).cases
        else:
            assert read_description(file).kind == entries["kind"]
        return
    faults = []
    for base in BASES:
        whole = {"name": "of the manual", "kind": "bearing", "lubricant": OIL, **base, **entries}
        whole["motion"] = base["motion"] | whole["motion"]
        file.write_text("\n".join(f"{key} = {toml_value(value)}" for key, value in whole.items()))
        try:
            load_scene(file)
        except InputError as error:
            faults.append(str(error))
    assert len(faults) < len(BASES), faults
