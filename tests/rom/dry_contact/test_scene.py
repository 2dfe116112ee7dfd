"""Scenes of dry contact: surfaces from files and descriptions, what is written back, every fault in one line."""

import numpy as np
import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.ladder import models
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries
from roughfilm.rom.studies.study import as_toml, load_study

EXAMPLE = SCENES / "dry_contact.toml"


def heights():
    return 1e-7 * np.random.default_rng(20071).standard_normal((12, 10))


def test_the_example_is_ground_steel_on_steel():
    scene = load_scene(EXAMPLE)
    assert scene.composite_modulus == pytest.approx(210e9 / (2 * (1 - 0.3**2)))
    assert scene.rms_slope == pytest.approx(0.1)
    assert scene.hardness == 4e9
    assert scene.resolutions == (32, 64, 128, 256)


def test_without_a_counter_body_it_is_rigid_and_without_hardness_elastic():
    entries = scene_entries(load_scene(EXAMPLE))
    del entries["counter"], entries["solid"]["hardness"]
    scene = read_scene(entries)
    assert scene.composite_modulus == pytest.approx(210e9 / (1 - 0.3**2))
    assert scene.hardness == np.inf


def test_a_described_surface_is_written_out_whole_and_reads_back(tmp_path):
    scene = load_scene(EXAMPLE)
    (tmp_path / "again.toml").write_text(as_toml(scene), encoding="utf-8")
    again = load_scene(tmp_path / "again.toml")
    assert again == scene
    assert again.geometry.surface["amplitudes"] == "fixed"
    assert again.surface().heights.tobytes() == scene.surface().heights.tobytes()


def test_files_are_sought_beside_the_scene_and_known_by_their_heights(tmp_path, make_contact):
    np.save(tmp_path / "s.npy", heights())
    text = EXAMPLE.read_text(encoding="utf-8").replace('"ground_steel.toml"', '"s.npy"\nspacing = ["1 um", "2 um"]')
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    scene = load_scene(tmp_path / "scene.toml")
    assert scene.surface().spacing == (1e-6, 2e-6)
    assert scene.surface().heights == pytest.approx(heights())
    entries = scene_entries(scene)
    assert read_scene(entries) == scene
    square = make_contact(tmp_path / "s.npy", spacing="1 um")
    assert square.surface().spacing == (1e-6, 1e-6)
    assert square.geometry.digest != scene.geometry.digest
    np.save(tmp_path / "s.npy", 2 * heights())
    with pytest.raises(InputError, match=r"scene\.geometry\.digest: got .* holds other heights by now"):
        read_scene(entries)


def test_a_surface_of_our_own_says_its_spacing_itself(tmp_path, make_contact):
    save_surface(Surface(heights=heights(), spacing=(3e-6, 4e-6), periodic=True), tmp_path / "s.h5")
    assert make_contact(tmp_path / "s.h5").surface().spacing == (3e-6, 4e-6)
    with pytest.raises(InputError, match=r"scene\.geometry\.surface: in .*s\.h5: it contains its spacing"):
        make_contact(tmp_path / "s.h5", spacing="1 um")


def test_invalid_points_are_refused(tmp_path, make_contact):
    holed = heights()
    holed[3, 4] = np.nan
    np.save(tmp_path / "s.npy", holed)
    with pytest.raises(InputError, match=r"scene\.geometry\.surface: has 1 invalid points; fill them"):
        make_contact(tmp_path / "s.npy", spacing="1 um")


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("geometry.surface=none.h5", r"scene\.geometry\.surface: in none\.h5: no such file"),
        ("geometry.surface=7", r"scene\.geometry\.surface: got 7; name a file"),
        ("geometry.surface=none.toml", r"scene\.geometry\.surface: in none\.toml: .*no such file"),
        ('geometry.surface={"kind": "gausian"}', r"scene\.geometry\.surface\.kind: got 'gausian'; it must be one of"),
        (
            'geometry.surface={"kind": "sinusoid", "size": ["1 um", "1 um"], "points": [9, 9], "amplitudes": "1 um"}',
            r"scene\.geometry\.surface\.amplitudes: unknown key; did you mean 'amplitude'\?",
        ),
        (
            'geometry.surface={"kind": "sinusoid", "size": ["1 um", "1 um"], "points": [9, 9], "amplitude": "1 um", '
            '"wavelength_x": "0.3 um"}',
            r"scene\.geometry\.surface\.wavelength_x: got",
        ),
        ("geometry.surfaces=x.h5", r"scene\.geometry\.surfaces: unknown key; did you mean 'surface'\?"),
        ("geometry.spacing=3", r"scene\.geometry\.spacing"),
        ("solid.modulus=210", r"scene\.solid\.modulus: got 210, a number without a unit"),
        ("solid.poisson=0.6", r"scene\.solid\.poisson: got 0\.6; it must be 0 to 0\.5"),
        ("solid.hardness=-1 GPa", r"scene\.solid\.hardness: got .* above zero"),
        ("solid.hardnes=1 GPa", r"scene\.solid\.hardnes: unknown key; did you mean 'hardness'\?"),
        ("counter.hardness=1 GPa", r"scene\.counter\.hardness: unknown key"),
        ("load.pressure=5 GPa", r"scene\.load\.pressure: got 5e\+09 Pa; it must be at most the hardness of 4e\+09 Pa"),
        ("load.pressure=1 mm", r"scene\.load\.pressure: .* wrong dimension"),
        ("lubricant.density=1 kg/m^3", r"scene\.lubricant: unknown key"),
    ],
)
def test_every_fault_is_one_line_that_names_the_key(override, words):
    with pytest.raises(InputError, match=words) as caught:
        load_scene(EXAMPLE, [override])
    assert "\n" not in str(caught.value)


def test_a_file_without_spacing_or_of_another_kind_is_refused(tmp_path, make_contact):
    np.save(tmp_path / "s.npy", heights())
    with pytest.raises(InputError, match=r"gives no spacing of its points; add spacing = "):
        make_contact(tmp_path / "s.npy")
    (tmp_path / "s.opd").write_bytes(b"x" * 100)
    with pytest.raises(InputError, match="neither a surface of roughfilm nor NPY nor CSV; prepare it"):
        make_contact(tmp_path / "s.opd")


def test_a_study_sweeps_what_is_no_list_by_nature(tmp_path):
    text = EXAMPLE.read_text(encoding="utf-8").replace('surface = "ground_steel.toml"', "")
    text = text.replace('"100 MPa"', '["50 MPa", "100 MPa"]')
    text += """
[geometry.surface]
kind = "sinusoid"
size = ["1 mm", "2 mm"]
points = [[16, 32], [32, 64]]
amplitude = ["1 um", "2 um", "3 um"]
wavelength_x = "0.5 mm"
[study]
models = ["elastic", "bearing_area"]
"""
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    study = load_study(tmp_path / "study.toml", models)
    assert len(study.cases) == 2 * 2 * 3
    assert {case.scene.surface().shape for case in study.cases} == {(16, 32), (32, 64)}
    assert [setting.model.name for setting in study.settings] == ["elastic", "bearing_area"]
    (tmp_path / "study.toml").write_text(text.replace('"elastic", ', '"reynolds", '), encoding="utf-8")
    with pytest.raises(InputError, match=r"study\.models: got 'reynolds'; it must be one of greenwood_williamson"):
        load_study(tmp_path / "study.toml", models)


def test_kinds_are_not_mixed_in_a_study(tmp_path):
    text = EXAMPLE.read_text(encoding="utf-8") + '\n[[variants]]\nkind = "pocket"\n'
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="variants: got a kind"):
        load_study(tmp_path / "study.toml", models)
