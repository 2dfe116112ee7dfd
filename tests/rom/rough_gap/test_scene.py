"""Scenes of rough gaps: what is taken, what is refused, and the walls they have."""

import numpy as np
import pytest

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

MODELS = of_kind(ladder(rom), "rough_gap")

WAVE = {
    "name": "wave",
    "kind": "rough_gap",
    "geometry": {"surface": "sinusoid", "amplitude": "3 um", "wavelength": "50 um", "mean_gap": "10 um"},
    "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
    "flow": {"reynolds_number": 2.0},
}

BUMPS = {
    "kind": "sinusoid",
    "size": ["60 um", "40 um"],
    "points": [48, 32],
    "amplitude": "2 um",
    "wavelength_x": "60 um",
    "wavelength_y": "20 um",
}


def changed(**tables):
    entries = {key: dict(value) if isinstance(value, dict) else value for key, value in WAVE.items()}
    for table, keys in tables.items():
        merged = {**entries.get(table, {}), **keys}
        entries[table] = {key: value for key, value in merged.items() if value is not None}
    return entries


PRESSED = {
    "geometry": {"surface": BUMPS, "amplitude": None, "wavelength": None, "mean_gap": None},
    "solid": {"modulus": "200 GPa", "poisson": 0.3},
    "load": {"pressure": "2 GPa"},
}


def test_a_sinusoid_of_a_file_is_no_file(tmp_path):
    text = """
name = "wave"
kind = "rough_gap"
[geometry]
surface = "sinusoid"
amplitude = "3 um"
wavelength = "50 um"
mean_gap = "10 um"
[lubricant]
viscosity = "10 mPa*s"
density = "870 kg/m^3"
[flow]
pressure_gradient = "1 MPa/m"
"""
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    scene = load_scene(tmp_path / "scene.toml", ["flow.reynolds_number=3", "geometry.amplitude=2um"])
    walls = scene.walls(64)
    x = np.arange(64) / 64 * 50e-6
    assert walls.lower[:, 0] == pytest.approx(2e-6 * np.cos(2 * np.pi * x / 50e-6), abs=1e-15)
    assert walls.upper == pytest.approx(np.full((64, 2), 10e-6))
    assert walls.size[0] == pytest.approx(50e-6)
    assert scene.reynolds_number == 3.0


def test_the_scene_is_written_back_whole():
    for entries in (WAVE, changed(**PRESSED)):
        scene = read_scene(entries)
        assert read_scene(scene_entries(scene)) == scene


def test_reynolds_number_and_gradient_are_each_other():
    scene = read_scene(WAVE)
    mean_speed = scene.mean_gap**2 * scene.pressure_gradient / (12 * scene.viscosity)
    assert 870 * mean_speed * 10e-6 / 10e-3 == pytest.approx(2.0)
    other = read_scene(
        changed(flow={"reynolds_number": None, "pressure_gradient": f"{scene.pressure_gradient!r} Pa/m"})
    )
    assert other.reynolds_number == pytest.approx(2.0)
    assert other.sliding_speed * other.mean_gap / 2 == pytest.approx(other.nominal_flow)


def test_slope_and_wavelength_of_a_wave():
    scene = read_scene(WAVE)
    assert scene.rms_height == pytest.approx(3e-6 / np.sqrt(2), rel=1e-9)
    assert scene.rms_slope == pytest.approx(3e-6 * 2 * np.pi / 50e-6 / np.sqrt(2), rel=1e-9)
    assert scene.gap_over_wavelength == pytest.approx(0.2, rel=1e-9)


def test_two_rough_walls_of_the_same_heights_leave_an_even_gap():
    scene = read_scene(
        changed(
            geometry={
                "surface": BUMPS,
                "amplitude": None,
                "wavelength": None,
                "mean_gap": "1 um",
                "upper": {"surface": BUMPS},
            }
        )
    )
    walls = scene.walls(48)
    assert walls.gap == pytest.approx(np.full((48, 32), 1e-6), rel=1e-9)
    assert np.ptp(walls.lower) == pytest.approx(4e-6)
    assert not walls.slides
    alone = read_scene(changed(geometry={"surface": BUMPS, "amplitude": None, "wavelength": None, "mean_gap": "9 um"}))
    assert scene.rms_slope == pytest.approx(np.sqrt(2) * alone.rms_slope)
    assert scene.rms_height == pytest.approx(np.sqrt(2) * alone.rms_height)
    found = find("rough_gap", "homogenized").solve(scene)
    assert found.quantities["A11"].value == pytest.approx(1.0, rel=1e-9)
    assert "B1" not in found.quantities


def test_a_load_leaves_a_gap_with_contact():
    scene = read_scene(changed(**PRESSED))
    walls = scene.walls(48)
    touching = float((walls.gap == 0).mean())
    assert 0.05 < touching < 0.95
    assert walls.gap[walls.gap > 0].min() >= scene.smallest_gap
    lighter = read_scene(changed(**{**PRESSED, "load": {"pressure": "0.5 GPa"}}))
    assert lighter.mean_gap > scene.mean_gap
    assert (lighter.walls(48).gap == 0).mean() < touching
    found = find("rough_gap", "homogenized").solve(scene)
    assert found.quantities["contact_area"].value == pytest.approx(touching)
    through = found.quantities["A11"].value * scene.mean_gap**3
    easier = find("rough_gap", "homogenized").solve(lighter).quantities["A11"].value * lighter.mean_gap**3
    assert 0 < through < easier


def test_what_is_thinner_than_the_smallest_gap_is_closed_for_every_model():
    entries = changed(geometry={"amplitude": "9.5 um"}, mesh={"smallest_gap": "1 um"})
    scene = read_scene(entries)
    closed = 2 * np.arccos(9 / 9.5) / (2 * np.pi)
    found = find("rough_gap", "homogenized").solve(scene)
    assert found.quantities["contact_area"].value == pytest.approx(closed, abs=2 / 256)
    assert found.quantities["A11"].value == 0
    assert found.quantities["A22"].value > 1


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        (changed(geometry={"mean_gap": "2 um"}), "geometry.mean_gap: got 2e-06 m, with which the walls cross"),
        (changed(geometry={"mean_gap": None}), "geometry.mean_gap: is missing"),
        (changed(geometry={"wavelength": None}), "geometry: wavelength: is missing|geometry.wavelength: is missing"),
        (changed(geometry={"surface": BUMPS}), "amplitude: needs surface"),
        (changed(geometry={"surface": "nowhere.h5", "amplitude": None, "wavelength": None}), "no such file"),
        (changed(mesh={"layers": 2}), "mesh.layers: got 2; it must be 4 to 1000"),
        (changed(mesh={"layers": 2.5}), "mesh.layers: got 2.5; write a whole number"),
        (changed(mesh={"layers": 10**6}), "mesh.layers: got 1000000"),
        (changed(mesh={"smallest_gap": "-1 um"}), "mesh.smallest_gap: got"),
        (changed(flow={"pressure_gradient": "1 Pa/m"}), "flow: got both"),
        (changed(flow={"reynolds_number": 1e13}), "flow: got Reynolds number 1e"),
        (changed(load={"pressure": "1 MPa"}), "solid: is missing"),
        (changed(lubricant={"viscosity": "1e300 Pa*s"}), "lubricant.viscosity: .*; a viscosity must be 1e-16 to"),
        (changed(lubricant={"viscosity": "1e-200 Pa*s"}), "lubricant.viscosity: .*; a viscosity must be 1e-16 to"),
        (changed(geometry={"mean_gap": "1e120 m"}), "geometry.mean_gap: .*; a length must be 1e-22 to"),
        (changed(**{**PRESSED, "load": {"pressure": None}}), "load"),
        (changed(**{**PRESSED, "geometry": {"surface": BUMPS, "amplitude": None, "wavelength": None}}), "leave mean_"),
        (
            changed(
                geometry={
                    "surface": BUMPS,
                    "amplitude": None,
                    "wavelength": None,
                    "upper": {"surface": {**BUMPS, "size": ["60 um", "60 um"]}},
                }
            ),
            "it must be that of the lower wall",
        ),
        (changed(geometry={"wave_length": "1 um"}), "did you mean 'wavelength'"),
    ],
)
def test_bad_scenes_are_refused_in_one_line(entries, words):
    with pytest.raises(InputError, match=words) as caught:
        read_scene(entries)
    assert "\n" not in str(caught.value)


def test_a_surface_that_does_not_repeat_itself_is_refused(tmp_path):
    ramp = np.add.outer(np.linspace(0, 1e-6, 64), np.zeros(64))
    np.save(tmp_path / "ramp.npy", ramp)
    entries = changed(
        geometry={"surface": str(tmp_path / "ramp.npy"), "spacing": "1 um", "amplitude": None, "wavelength": None}
    )
    with pytest.raises(InputError, match=r"is not periodic.*prepare it with: roughfilm surface"):
        read_scene(entries)


def test_a_film_that_is_closed_everywhere_is_no_film():
    scene = read_scene(changed(mesh={"smallest_gap": "1 mm"}))
    with pytest.raises(InputError, match="the walls touch everywhere"):
        find("rough_gap", "homogenized").solve(scene)


def test_walls_that_cross_without_their_short_waves_are_refused(tmp_path):
    flat_topped = np.minimum(np.cos(2 * np.pi * np.arange(64) / 64), 0.5) * 1e-6
    np.save(tmp_path / "topped.npy", np.add.outer(flat_topped, np.zeros(8)))
    nearest = float(flat_topped.max() - flat_topped.mean())
    entries = changed(
        geometry={
            "surface": str(tmp_path / "topped.npy"),
            "spacing": "1 um",
            "amplitude": None,
            "wavelength": None,
            "mean_gap": f"{1.01 * nearest!r} m",
        },
        mesh={"smallest_gap": "1 pm"},
    )
    scene = read_scene(entries)
    assert scene.walls(64).gap.min() == pytest.approx(0.01 * nearest)
    with pytest.raises(InputError, match=r"^resolution: got 16"):
        scene.walls(16)


def test_a_load_presses_two_rough_walls_and_leaves_the_upper_one_its_shape():
    waves = {**BUMPS, "wavelength_x": "20 um"}
    geometry = {**PRESSED["geometry"], "upper": {"surface": waves}}
    scene = read_scene(changed(**{**PRESSED, "geometry": geometry}))
    walls = scene.walls(48)
    assert walls.upper == pytest.approx(scene.geometry.upper.read().heights, abs=1e-18)
    assert not walls.slides
    assert 0 < (walls.gap == 0).mean() < 1


def test_waves_that_a_grid_cannot_hold_count_in_the_error_bars():
    short = {"kind": "sinusoid", "size": ["8 um", "2 um"], "points": [32, 8], "amplitude": "0.2 um"}
    geometry = {"surface": {**short, "wavelength_x": "0.8 um"}, "amplitude": None, "wavelength": None}
    scene = read_scene(changed(geometry={**geometry, "mean_gap": "1 um"}))
    found = find("rough_gap", "homogenized").solve(scene, Request(resolution=16))
    a = 0.2
    for name, truth in {"A11": (1 - a**2) ** 2.5 / (1 + a**2 / 2), "A22": 1 + 1.5 * a**2}.items():
        value = found.quantities[name].value
        assert value == pytest.approx(1.0, abs=1e-9)
        assert 0.7 * abs(value - truth) < found[name].uncertainty < 2 * abs(value - truth)


@pytest.mark.parametrize("name", ["homogenized", "slope_corrected"])
def test_a_result_without_uncertainty_has_a_warning(name):
    few = BUMPS | {"points": [6, 6], "wavelength_y": "40 um"}
    scene = read_scene(changed(geometry={"surface": few, "amplitude": None, "wavelength": None}))
    found = find("rough_gap", name).solve(scene)
    assert all(quantity.uncertainty is None for quantity in found.quantities.values())
    assert any("no coarser grid" in warning for warning in found.warnings)


def test_nodes_that_are_open_each_by_itself_neither_pass_nor_rub(tmp_path):
    i, j = np.indices((16, 16))
    path = tmp_path / "checkerboard.npy"
    np.save(path, np.where((i + j) % 2, 1e-7, -1e-7))
    pressed = {"solid": {"modulus": "1 GPa", "poisson": 0.3}, "load": {"pressure": "1 kPa"}}
    geometry = {"surface": str(path), "spacing": "1 um", "amplitude": None, "wavelength": None, "mean_gap": None}
    found = find("rough_gap", "slope_corrected").solve(read_scene(changed(geometry=geometry, **pressed)))
    assert found.quantities["contact_area"].value == pytest.approx(0.5)
    assert {found.quantities[name].value for name in ("A11", "A22", "friction")} == {0.0}
