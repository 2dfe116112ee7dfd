"""Names of files in a scene are relative to its folder, wherever the key stands; other texts are left as they are."""

from pathlib import Path

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.ladder import models
from roughfilm.rom.ladder.scene import load_scene, named_files
from roughfilm.rom.studies.study import load_study

HEIGHTS = 1e-6 * np.cos(2 * np.pi * np.arange(16) / 16)[:, None] * np.ones(16)

CONTACT = """name = "a.npy"
kind = "dry_contact"
[geometry]
surface = {surface}
spacing = "2 um"
[solid]
modulus = "210 GPa"
poisson = 0.3
[load]
pressure = "1 MPa"
"""

BEARING = """name = "hot"
kind = "bearing"
[geometry]
shape = "given"
length = "20 mm"
width = "20 mm"
film = "20 um"
thickness = "film.npy"
[lubricant]
oil = "ISO VG 32"
temperature = "40 degC"
compressibility = { law = "tabulated", table = "density.csv" }
[motion]
speed = "1 m/s"
[roughness]
kind = "surface"
surface = "a.npy"
spacing = "2 um"
[heat]
fixed_wall = { kind = "conducting", thickness = "5 mm", conductivity = "50 W/(m*K)", surroundings = "40 degC" }
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with files of heights, beside the current one."""
    there = tmp_path / "there"
    there.mkdir()
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    for name, factor in (("a.npy", 1), ("b.npy", 2), ("film.npy", 1)):
        np.save(there / name, factor * HEIGHTS)
    (there / "density.csv").write_text("pressure (MPa), density (kg/m^3)\n0, 860\n10, 866\n20, 871\n")
    return there


def written(folder: Path, text: str) -> Path:
    path = folder / "scene.toml"
    path.write_text(text)
    return path


def test_only_names_of_files_are_relative_to_the_folder(folder: Path) -> None:
    scene = load_scene(written(folder, BEARING))
    assert scene.heat.fixed_wall.thickness == 5e-3
    assert named_files(scene) == {str(folder / "a.npy"), str(folder / "film.npy")}
    assert scene.lubricant.compressibility.table[-1] == (20e6, 871.0)


def test_a_text_that_equals_the_name_of_a_file_is_no_file(folder: Path) -> None:
    assert load_scene(written(folder, CONTACT.format(surface='"a.npy"'))).name == "a.npy"


def test_files_are_swept(folder: Path) -> None:
    study = load_study(written(folder, CONTACT.format(surface='["a.npy", "b.npy"]')), models)
    assert [case.varied["surface"] for case in study.cases] == ["a.npy", "b.npy"]
    heights = [float(case.scene.geometry.read().heights.max()) for case in study.cases]
    assert heights == pytest.approx([1e-6, 2e-6])


def test_a_name_in_an_override_is_relative_to_the_current_folder(folder: Path) -> None:
    file = written(folder, CONTACT.format(surface='"a.npy"'))
    np.save("c.npy", 3 * HEIGHTS)
    scene = load_scene(file, ["geometry.surface=c.npy"])
    assert scene.geometry.read().heights.max() == pytest.approx(3e-6)
    again = rf.replace(scene, "geometry.surface", str(folder / "b.npy"))
    assert again.geometry.read().heights.max() == pytest.approx(2e-6)


def test_a_new_surface_keeps_the_spacing_that_it_needs(folder: Path) -> None:
    file = written(folder, CONTACT.format(surface='"a.npy"'))
    other = f"geometry.surface={folder / 'b.npy'}"
    for overrides in ([other], [other, "geometry.spacing=2 um"], ["geometry.spacing=2 um", other]):
        assert load_scene(file, overrides).geometry.read().spacing == (2e-6, 2e-6)


def test_a_new_surface_brings_its_own_spacing(folder: Path) -> None:
    file = written(folder, CONTACT.format(surface='"a.npy"'))
    save_surface(Surface(heights=HEIGHTS, spacing=(3e-6, 3e-6)), folder / "c.h5")
    rows = "\n".join(", ".join(f"{1e6 * height}" for height in row) for row in HEIGHTS.T)
    (folder / "c.csv").write_text(f"# spacing: 3 um, 3 um; heights: um\n{rows}\n")
    for name in ("c.h5", "c.csv"):
        assert load_scene(file, [f"geometry.surface={folder / name}"]).geometry.read().spacing == (3e-6, 3e-6)


def test_a_sinusoid_is_no_file(folder: Path) -> None:
    text = """name = "wave"
kind = "rough_gap"
geometry = { surface = "sinusoid", amplitude = "3 um", wavelength = "50 um", mean_gap = "10 um" }
lubricant = { viscosity = "10 mPa*s", density = "870 kg/m^3" }
flow = { reynolds_number = 0.5 }
"""
    scene = load_scene(written(folder, text))
    assert scene.geometry.surface == "sinusoid"
    assert named_files(scene) == frozenset()
    with_file = [f"geometry.surface={folder / 'a.npy'}", "geometry.spacing=2 um"]
    assert named_files(load_scene(written(folder, text), with_file)) == {str(folder / "a.npy")}


def test_a_name_may_begin_at_home(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(folder))
    text = BEARING.replace('"a.npy"', '"~/a.npy"').replace('"density.csv"', '"~/density.csv"')
    assert named_files(load_scene(written(folder, text))) == {"~/a.npy", str(folder / "film.npy")}


@pytest.mark.parametrize("key", ["geometry.thickness", "roughness.surface", "lubricant.compressibility.table"])
def test_a_home_that_is_not_there_is_said(folder: Path, key: str) -> None:
    with pytest.raises(rf.InputError, match=r"~nobody-of-this-name.*leads nowhere; there is no such"):
        load_scene(written(folder, BEARING), [f"{key}=~nobody-of-this-name/a.npy"])
