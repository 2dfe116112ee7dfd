"""Numbers from Python are in SI units; those of a scene file and of --set need a unit."""

import numpy as np
import pytest
from places import SCENES

import roughfilm as rf
from roughfilm.rom.ladder.scene import load_entries, load_scene, scene_entries

POCKET = {
    "name": "groove",
    "kind": "pocket",
    "geometry": {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "7.5 um"},
    "lubricant": {"viscosity": "10 mPa*s", "density": "1 g/cm^3", "cavitation_pressure": "-50 kPa"},
    "motion": {"speed": "2 m/s"},
}
IN_SI = {
    **POCKET,
    "geometry": {"length": 1e-3, "film": 3e-5, "profile": "cylindrical", "width": np.float64(3e-4), "depth": 7.5e-6},
    "lubricant": {"viscosity": 0.01, "density": np.int64(1000), "cavitation_pressure": -5e4},
    "motion": {"speed": 2},
}


def test_numbers_are_those_of_texts_in_si_units():
    scene = rf.read_scene(IN_SI)
    assert scene == rf.read_scene(POCKET)
    assert rf.read_scene(scene_entries(scene)) == scene


def test_numbers_reach_lists_arrays_and_the_descriptions_of_surfaces():
    wave = {"kind": "sinusoid", "amplitude": 1e-7, "wavelength_x": 1e-4, "size": (1e-4, 2e-4), "points": [16, 8]}
    geometry = {"shape": "parallel", "length": 0.01, "film": 1e-6}
    table = np.array([[0.0, 1.0], [1e8, 1.05], [2e8, 1.08]])
    scene = rf.read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": 0.1, "compressibility": {"law": "tabulated", "table": table}},
            "motion": {"speed": 1.0},
            "roughness": {"kind": "surface", "surface": wave},
        }
    )
    assert scene.roughness.read().size == pytest.approx((1e-4, 2e-4))
    assert scene.roughness.read().shape == (16, 8)
    assert scene.lubricant.compressibility.valid_to == 2e8


def test_a_number_in_set_is_in_si_units_and_one_of_a_file_needs_a_unit(tmp_path):
    path = SCENES / "pocket.toml"
    bare = tmp_path / "bare.toml"
    bare.write_text(path.read_text(encoding="utf-8").replace('"7.5 um"', "7.5e-6"), encoding="utf-8")
    assert rf.load_scene(path, set={"geometry.depth": 9e-6}).grooves[0].depth == 9e-6
    for refuse in (
        lambda: rf.load_scene(path, set={"geometry.depth": "9e-6"}),
        lambda: load_scene(path, ["geometry.depth=9e-6"]),
        lambda: load_scene(bare),
    ):
        with pytest.raises(rf.InputError, match=r"geometry\.depth: got .*, a number without a unit"):
            refuse()


@pytest.mark.parametrize("depth", [-1e-6, 0.0, float("nan"), float("inf"), True, None])
def test_a_number_out_of_range_is_refused(depth):
    entries = load_entries(SCENES / "pocket.toml")
    entries["geometry"]["depth"] = depth
    with pytest.raises(rf.InputError, match=r"scene\.geometry\.depth: got "):
        rf.read_scene(entries)
