"""A scene file is read completely, and every fault in it is one line that names the key."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries


def test_the_example(pocket_file):
    scene = load_scene(pocket_file)
    assert scene.geometry.film == 3e-5
    assert scene.grooves[0].width == 3e-4
    assert scene.reynolds_number == pytest.approx(160, rel=1e-5)
    assert scene.pressure_unit == pytest.approx(0.01 * 53.333 / 3e-5)


def test_reynolds_number_gives_the_speed(pocket_file):
    scene = load_scene(pocket_file, ["motion.reynolds_number=40"])
    assert scene.speed == pytest.approx(40 * 0.01 / (1000 * 3e-5))


def test_entries_are_complete_and_read_back_unchanged(pocket_file):
    scene = load_scene(pocket_file)
    assert read_scene(scene_entries(scene)) == scene


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("geometry.depht=1 um", r"scene\.geometry\.depht: unknown key; did you mean 'depth'\?"),
        ("geometrie.depth=1 um", r"scene\.geometrie: unknown key; did you mean 'geometry'\?"),
        ("width=1 mm", r"scene\.width: unknown key; known here: name, kind"),
        ("zzz=1", r"scene\.zzz: unknown key; known here: name, kind"),
        ("geometry.depth=7.5", r"scene\.geometry\.depth: got 7\.5, a number without a unit"),
        ("geometry.depth=7.5 Pa", r"scene\.geometry\.depth: .* wrong dimension"),
        ("geometry.depth=7.5 parsecz", r"scene\.geometry\.depth: .* not known"),
        ("geometry.depth=-1 um", r"scene\.geometry\.depth: got '-1 um'; it must be above zero"),
        ("geometry.depth=0 um", r"scene\.geometry\.depth: got '0 um'; it must be above zero"),
        ("geometry.depth=0.2 mm", r"scene\.geometry\.depth: .* half circle"),
        ("geometry.width=1 mm", r"scene\.geometry\.width: .* below length"),
        ("geometry.width=0.1 um", r"pocket\.toml:10: geometry\.depth: .* half circle"),
        (
            "geometry.profile=square",
            r"scene\.geometry\.profile: got 'square'; it must be one of 'cylindrical', 'splined'",
        ),
        ("kind=gearbox", r"scene\.kind: got 'gearbox'; it must be .*'pocket'"),
        ("name=7", r"scene\.name: got 7"),
        ("geometry=7", r"scene\.geometry: got 7"),
        ("lubricant.viscosity=-0.01 Pa*s", r"scene\.lubricant\.viscosity: .* above zero"),
        ("lubricant.viscosity=0.01 m^2", r"scene\.lubricant\.viscosity: .* wrong dimension"),
        ("motion.reynolds_number=NaN", r"scene\.motion\.reynolds_number: got 'NaN'"),
        ("motion.reynolds_number=1e999", r"scene\.motion\.reynolds_number: got inf"),
        ("motion.reynolds_number=-4", r"scene\.motion\.reynolds_number: .* above zero"),
        ("motion.reynolds_number=4 m", r"scene\.motion\.reynolds_number: got '4 m'; write a plain number"),
        ("motion.reynolds_number=1e13", r"scene\.motion: got Reynolds number"),
        ("motion.reynolds_number=1" + "0" * 400, r"scene\.motion\.reynolds_number: got 1000.* must be 0 or 1e-16"),
        ("geometry.film=1 fm", r"pocket\.toml:6: geometry\.length: .* film thicknesses"),
        ("geometry", r"^set geometry: got no key=value"),
        ("=5", r"^set =5: got no key=value"),
        ("name.x=5", r"'name' is not a table"),
    ],
)
def test_every_fault_is_one_line_that_names_the_key(pocket_file, override, words):
    with pytest.raises(InputError, match=words) as caught:
        load_scene(pocket_file, [override])
    assert "\n" not in str(caught.value)


def test_missing_keys_and_neither_motion(pocket_file):
    entries = scene_entries(load_scene(pocket_file))
    del entries["geometry"]["width"]
    with pytest.raises(InputError, match=r"scene\.geometry\.width: missing"):
        read_scene(entries)
    entries = scene_entries(load_scene(pocket_file))
    entries["motion"] = {}
    with pytest.raises(InputError, match=r"scene\.motion: got neither"):
        read_scene(entries)
    entries["motion"] = {"speed": "1 m/s", "reynolds_number": 4}
    with pytest.raises(InputError, match=r"scene\.motion: got both"):
        read_scene(entries)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"name = ", "is not TOML"),
        (b"\xff\xfe", "not UTF-8"),
        (b"x = " + b"[" * 5000, "is not TOML"),
        (b"depth = 7.5 um", r'line 1, column 13\)\); put the value in straight quotes: depth = "7\.5 um"$'),
        (b"kind = pocket # a comment", r'put the value in straight quotes: kind = "pocket"$'),
        (b"a = 1\na = 2", "remove one of the two"),
        (b'name = "x"\nfilm = "30 \xb5m"', r"scene\.toml:2: byte .* is not UTF-8"),
        (b"#" * 1_000_001, "larger than"),
    ],
)
def test_unreadable_files(tmp_path, content, words):
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words) as caught:
        load_scene(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "words"), [("absent.toml", "no such file"), (".", "is no file"), ("x" * 5000, "cannot be read")]
)
def test_no_file(tmp_path, name, words):
    with pytest.raises(InputError, match=words):
        load_scene(tmp_path / name)


def test_all_faults_of_a_file_come_at_once_with_their_lines(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(
        """name = "pocket"
kind = "pocket"

[geometry]
length = "1 mm"
film = '''
30 umm'''
profile = "cylindrical" # film = 1
width = 0.3
depht = "7,5 um"

[lubricant]
viscosity = "30 mPas"
density = "1000 kg"

[boundry]
ambient_pressure = "1 bar"
""",
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        load_scene(path, ["lubricant.cavitation_pressure=1 m"])
    lines = str(caught.value).splitlines()
    places = [line.partition(": ")[0].removeprefix(str(tmp_path)) for line in lines]
    keys = [line.split(": ")[1] for line in lines]
    assert places == [
        "scene.lubricant.cavitation_pressure",
        "/scene.toml",
        *(f"/scene.toml:{number}" for number in (6, 9, 10, 14, 16)),
    ]
    assert keys[1] == "motion"
    assert keys[2:] == ["geometry.film", "geometry.width", "geometry.depht", "lubricant.density", "boundry"]


def test_a_file_that_holds_nothing_lacks_name_and_kind(tmp_path):
    (tmp_path / "scene.toml").write_text("")
    with pytest.raises(InputError) as caught:
        load_scene(tmp_path / "scene.toml")
    assert [line.partition("scene.toml: ")[2] for line in str(caught.value).splitlines()] == [
        "name: missing; add it",
        "kind: missing; add it",
    ]


def test_a_byte_order_mark_is_no_fault(pocket_file, tmp_path):
    (tmp_path / "scene.toml").write_bytes(b"\xef\xbb\xbf" + pocket_file.read_bytes())
    assert load_scene(tmp_path / "scene.toml") == load_scene(pocket_file)


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=8,
)
keys = st.sampled_from(["name", "kind", "geometry", "lubricant", "motion", "x"])


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(st.dictionaries(keys, json_values, max_size=6))
def test_no_entries_raise_anything_but_input_error(entries):
    with pytest.raises(InputError):
        read_scene(entries)
