"""The README and the manual: links that lead somewhere, commands that exist, scenes that can be read."""

import pkgutil
import re
import shlex
import tomllib
from pathlib import Path

import pytest
import typer
from places import ROOT
from typer.core import TyperGroup

from roughfilm.cli.main import MODULES, app
from roughfilm.rom.ladder.scene import read_scene

MADE = ("docs/gallery", "docs/reference/generated", "docs/source/studies")
"""Folders of pages that the build of the manual makes."""

PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *(path for path in sorted((ROOT / "docs").rglob("*.md")) if not str(path.relative_to(ROOT)).startswith(MADE)),
]
RUN = ("start", "howto")
"""Parts of the manual whose scenes and commands are run by ``test_transcripts.py``."""

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


SCENES = [
    pytest.param(text, id=f"{_named(page)}: {tomllib.loads(text)['name']}")
    for page in PAGES
    if page.parent.name not in RUN
    for text in _blocks(page, "toml")
    if text.startswith("name =")
]


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


@pytest.mark.parametrize("text", SCENES)
def test_scenes_are_valid(text: str) -> None:
    entries = tomllib.loads(text)
    assert read_scene(entries).name == entries["name"]
