"""The wheel, the source archive and the editable installation hold one import name and work beside a user's files."""

import os
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest
from places import ROOT

pytestmark = pytest.mark.slow

LIBRARIES = sysconfig.get_path("purelib")
"""Where the libraries are on which the package depends; an installation made here is given these alone."""

IMPORTED = "import roughfilm; print(roughfilm.__file__); from roughfilm.rom.ladder import scene"


def run(*arguments: str | Path, cwd: Path, path: str = "") -> str:
    """What a program prints, with these directories as PYTHONPATH."""
    command, environment = [str(one) for one in arguments], {**os.environ, "PYTHONPATH": path}
    done = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def built(tree: Path, target: str, place: Path) -> Path:
    """The one archive that a build of the tree makes."""
    run(sys.executable, "-m", "hatchling", "build", "-t", target, "-d", place, cwd=tree)
    (archive,) = place.iterdir()
    return archive


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    return built(ROOT, "wheel", tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def wheel_of_archive(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("archive")
    with tarfile.open(built(ROOT, "sdist", place / "sdist")) as archive:
        archive.extraction_filter = getattr(tarfile, "data_filter", None)  # since Python 3.11.4
        archive.extractall(place / "tree")
    (tree,) = (place / "tree").iterdir()
    return built(tree, "wheel", place / "wheel")


@pytest.fixture(scope="module")
def editable_wheel(tmp_path_factory) -> Path:
    return built(ROOT, "wheel:editable", tmp_path_factory.mktemp("editable"))


def contents(wheel: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_a_wheel_holds_one_top_level_name(wheel):
    tops = {name.split("/")[0] for name in contents(wheel)}
    assert {name for name in tops if not name.endswith(".dist-info")} == {"roughfilm"}


def test_a_wheel_holds_every_file_of_the_package(wheel):
    tracked = run("git", "ls-files", "contact", "rom", "foamcases", "roughfilm", cwd=ROOT).split()
    files = {name if name.startswith("roughfilm/") else f"roughfilm/{name}" for name in tracked}
    links = {"roughfilm/contact", "roughfilm/rom", "roughfilm/foamcases"}
    assert {"roughfilm/py.typed", "roughfilm/rom/advice/laws.toml", "roughfilm/pages/templates/page.css"} < files
    assert files - links <= contents(wheel).keys()


def test_the_wheel_of_the_source_archive_is_the_wheel_of_the_tree(wheel, wheel_of_archive):
    assert contents(wheel_of_archive) == contents(wheel)


@pytest.mark.parametrize("kind", ["wheel", "editable_wheel"])
def test_an_installation_works_beside_a_users_own_contact_rom_foamcases_and_scripts(kind, tmp_path, request):
    environment, user = tmp_path / "environment", tmp_path / "user"
    run(sys.executable, "-m", "venv", "--without-pip", environment, cwd=tmp_path)
    python = environment / "bin" / "python"
    package = request.getfixturevalue(kind)
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", package, cwd=tmp_path)
    (site,) = environment.glob("lib/python*/site-packages")
    (site / "libraries.pth").write_text(f"{LIBRARIES}\n", encoding="utf-8")

    (user / "scripts").mkdir(parents=True)
    for name in ("contact.py", "rom.py", "foamcases.py", "scripts/__init__.py"):
        (user / name).write_text("raise ImportError('a file of the user was imported')\n", encoding="utf-8")
    assert run(python, "-c", IMPORTED, cwd=user).startswith(str(site if kind == "wheel" else ROOT))
    assert "film_slope" in run(environment / "bin" / "roughfilm", "models", "--json", cwd=user, path=str(user))


def test_the_citation_names_the_version():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
