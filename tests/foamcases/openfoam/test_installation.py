"""Where OpenFOAM is looked for, which one is taken, and how a command is put in front; all with programs of our own."""

import json
import os
import re
import shutil
import subprocess

import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.foamcases.openfoam import installation as module
from roughfilm.foamcases.openfoam.allrun import HEAD
from roughfilm.foamcases.openfoam.dialect import COM, ORG
from roughfilm.foamcases.openfoam.installation import PROGRAMS, VARIABLE, dialect_here, installation, places
from roughfilm.foamcases.openfoam.program import execute

V2412 = "Using: OpenFOAM-v2412 (2412) - visit www.openfoam.com"
V1912 = "Using: OpenFOAM- (1912) - visit www.openfoam.com"
ORG_13 = "Using: OpenFOAM-13 (see https://openfoam.org)"


@pytest.fixture(autouse=True)
def bare_machine(tmp_path, monkeypatch):
    """A machine with a shell and without OpenFOAM."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("bash", "sh", "env", "dirname", "cat", "setpriv", "true"):
        if found := shutil.which(name):
            (tools / name).symlink_to(found)
    monkeypatch.setenv("PATH", str(tools))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in (VARIABLE, "WM_PROJECT_DIR", "FOAM_INST_DIR", "FOAM_APPBIN", "FOAM_SIGFPE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(module, "PLACES", ("$HOME/OpenFOAM/OpenFOAM-*", "$FOAM_INST_DIR/OpenFOAM-*"))
    installation.cache_clear()
    yield
    installation.cache_clear()


def script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


def install(place, banner, *, programs=PROGRAMS):
    """Make an installation whose programs need the environment that its ``etc/bashrc`` sets."""
    for name in programs:
        script(place / "bin" / name, f'[ "$WM_PROJECT_DIR" = "{place}" ] || exit 1\necho "{banner}"')
    (place / "etc").mkdir()
    (place / "etc" / "bashrc").write_text(
        f'export WM_PROJECT_DIR="{place}" FOAM_APPBIN="{place}/bin" ARGUMENTS="$#"\nexport PATH="{place}/bin:$PATH"\n'
    )
    return place


def test_without_any_the_places_and_the_remedy_are_named():
    here = installation()
    assert here.release is None
    assert here.detail.startswith("no OpenFOAM: on the PATH: no checkMesh or simpleFoam or foamDictionary; install it")
    assert dialect_here() is COM


def test_a_sourced_one_is_taken_as_it_is(tmp_path, monkeypatch):
    place = install(tmp_path / "other", ORG_13)
    monkeypatch.setenv("WM_PROJECT_DIR", str(place))
    monkeypatch.setenv("PATH", f"{place}/bin:{os.environ['PATH']}")
    assert (installation().place, installation().detail) == ("on the PATH", "OpenFOAM 13 of openfoam.org")
    assert dialect_here() is ORG


@pytest.mark.parametrize("where", ["home/OpenFOAM/OpenFOAM-v2412", "site/OpenFOAM-v2412", "own"])
def test_one_off_the_path_is_found(where, tmp_path, monkeypatch):
    place = install(tmp_path / where, V2412)
    monkeypatch.setenv("FOAM_INST_DIR", str(tmp_path / "site"))
    if where == "own":
        monkeypatch.setenv("WM_PROJECT_DIR", str(place))
    here = installation()
    assert (here.place, here.detail) == (str(place), "OpenFOAM v2412")
    assert here.environment["FOAM_SIGFPE"] == "true"
    assert here.environment["ARGUMENTS"] == "0"  # a bashrc reads its arguments as settings
    assert here.has("simpleFoam")
    assert not here.has("mpirun")


def test_the_newest_of_openfoam_com_comes_first(tmp_path):
    found = tmp_path / "home" / "OpenFOAM"
    for name, banner in (("OpenFOAM-13", ORG_13), ("OpenFOAM-v1912", V1912), ("OpenFOAM-v2412", V2412)):
        install(found / name, banner)
    (found / "OpenFOAM-v9999").mkdir()  # without a bashrc
    assert [place.name.rpartition("-")[2] for place in places()] == ["on the PATH", "v2412", "v1912", "13"]
    assert installation().detail == "OpenFOAM v2412"


def test_an_unfinished_one_is_not_taken_for_the_one_on_the_path(tmp_path, monkeypatch):
    packaged = tmp_path / "packaged"
    for name in PROGRAMS:
        script(packaged / name, f'echo "{V1912}"')
    monkeypatch.setenv("PATH", f"{packaged}:{os.environ['PATH']}")
    monkeypatch.setenv(VARIABLE, str(install(tmp_path / "new", ORG_13, programs=["simpleFoam"])))
    assert installation().release is None
    assert "new: no checkMesh or foamDictionary; give a directory with etc/bashrc" in installation().detail


@pytest.mark.parametrize("name", ["", "etc/bashrc"])
def test_a_named_one_goes_first(name, tmp_path, monkeypatch):
    install(tmp_path / "home" / "OpenFOAM" / "OpenFOAM-v2412", V2412)
    monkeypatch.setenv(VARIABLE, str(install(tmp_path / "mine", ORG_13) / name))
    assert installation().detail == "OpenFOAM 13 of openfoam.org"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("nowhere", "nowhere: no such file or command"),
        ("an 'open quotation", "quotation: "),
        (" ", "no such file or command|names nothing|is empty"),
        ("tools", "no file .*tools/etc/bashrc"),
        ("env A=1", "stops with code 127"),
    ],
)
def test_a_wrong_name_is_refused(name, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(VARIABLE, name)
    assert installation().release is None
    assert re.search(rf"{VARIABLE} .*: .*{words}.*; give a directory with etc/bashrc", installation().detail)


@pytest.mark.parametrize(
    ("line", "words"),
    [("exit 0", "its bashrc ends the shell that reads it"), ("exit 7", "its bashrc stops with code 7")],
)
def test_a_bashrc_that_exits_is_said_without_the_command_that_reads_it(line, words, tmp_path, monkeypatch):
    place = install(tmp_path / "mine", ORG_13)
    (place / "etc" / "bashrc").write_text(f"{line}\n")
    monkeypatch.setenv(VARIABLE, str(place))
    assert words in installation().detail
    assert "bash'" not in installation().detail


def test_a_program_of_another_family_is_not_taken(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(install(tmp_path / "extend", "foam-extend-5.0")))
    assert "is neither openfoam.com's nor openfoam.org's" in installation().detail


def test_a_build_that_misreads_the_mesh_is_not_taken(tmp_path, monkeypatch):
    monkeypatch.setenv("WM_LABEL_SIZE", "64")
    monkeypatch.setenv(VARIABLE, str(install(tmp_path / "long", ORG_13)))
    assert "labels of 64 bits" in installation().detail
    installation.cache_clear()
    monkeypatch.setenv(VARIABLE, str(install(tmp_path / "other", V2412)))
    assert installation().detail == "OpenFOAM v2412"  # reads the size of labels from the file


def test_a_command_is_put_before_every_other(tmp_path, monkeypatch):
    place = install(tmp_path / "inside", V2412)
    script(place / "bin" / "mpirun", 'echo "mpirun got $*"; shift 2; "$@"')
    script(tmp_path / "tools" / "container", f'shift 2; . {place}/etc/bashrc; echo "put before $1"; exec "$@"')
    monkeypatch.setenv(VARIABLE, "container run image")
    assert installation().detail == "OpenFOAM v2412"
    assert installation().has("mpirun")  # nobody knows
    ended = execute(tmp_path, ["mpirun", "-np", "2", "simpleFoam", "-parallel"], "log")
    assert ended.code == 0
    assert ended.log.splitlines()[:2] == ["put before mpirun", "mpirun got -np 2 simpleFoam -parallel"]


def test_a_written_script_finds_one_off_the_path(tmp_path):
    place = install(tmp_path / "home" / "OpenFOAM" / "OpenFOAM-v2412", V2412)
    script(place / "bin" / "simpleFoam", 'echo "$WM_PROJECT_DIR $FOAM_SIGFPE $ARGUMENTS"')
    (tmp_path / "Allrun").write_text(f"{HEAD}simpleFoam\n")
    done = subprocess.run(["bash", tmp_path / "Allrun", "-np", "8"], capture_output=True, text=True, check=True)
    assert done.stdout == f"{place} true 0\n"


def run(*arguments):
    return CliRunner().invoke(app, [*map(str, arguments)])


def test_doctor_says_which_one_is_used_and_what_else_is_here(tmp_path):
    found = tmp_path / "home" / "OpenFOAM"
    install(found / "OpenFOAM-v2412", V2412)
    install(found / "OpenFOAM-13", ORG_13, programs=["simpleFoam"])
    part = json.loads(run("doctor", "--json").stdout)["OpenFOAM"]
    assert {name: part[name] for name in ("family", "release", "dialect", "tried")} == {
        "family": "openfoam.com",
        "release": "2412",
        "dialect": "com",
        "tried": False,
    }
    assert part["detail"].endswith("never tried with roughfilm; runs navier_stokes and stokes")
    assert [(one["place"].rpartition("-")[2], one["found"], one["used"]) for one in part["places"]] == [
        ("on the PATH", "no checkMesh or simpleFoam or foamDictionary", False),
        ("v2412", "OpenFOAM v2412", True),
        ("13", "no checkMesh or foamDictionary", False),
    ]


@pytest.mark.parametrize(("banner", "times"), [(V2412, 1), (V1912, 0)])
def test_a_release_that_was_never_tried_is_said_once(banner, times, tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, "")  # restored after the option has set it
    result = run("models", "pocket", "--openfoam", install(tmp_path / "new", banner))
    assert result.exit_code == 0
    assert result.stderr.count("was never tried") == times
