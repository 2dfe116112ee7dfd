"""Points of a groove from files: found beside the scene, read to the bit, every fault in one line."""

import shutil

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries
from roughfilm.rom.pocket.profile import checked

GOOD = "position (um), depth (um)\n-100, 0\n\n0, 10\n50, 8\n200, 0\n"
POINTS = ((-1e-4, 0.0), (0.0, 1e-5), (5e-5, 8e-6), (2e-4, 0.0))


@pytest.fixture
def scene_file(tmp_path, pocket_file):
    """A scene beside which the file of points is sought."""
    lines = pocket_file.read_text().splitlines()
    kept = [line for line in lines if not line.startswith(("profile", "width", "depth"))]
    place = kept.index("[geometry]") + 1
    path = tmp_path / "scene.toml"
    path.write_text("\n".join([*kept[:place], 'profile = "points"', 'points = "groove.csv"', *kept[place:]]))
    return path


def test_points_are_read_beside_the_scene_and_stay_in_it(scene_file, tmp_path):
    (tmp_path / "groove.csv").write_text(GOOD)
    scene = load_scene(scene_file)
    assert scene.grooves[0].points == POINTS
    written = scene_entries(scene)
    (tmp_path / "groove.csv").unlink()
    assert read_scene(written) == scene


@pytest.mark.parametrize("noise", [6.1e-23, -3.7e-23])
def test_a_rounding_error_of_zero_counts_as_zero(tmp_path, noise):
    rows = [(0.0, 0.0), (1e-5, 1e-7), (2e-5, noise), (3e-5, 1e-7), (4e-5, noise)]
    zero = tuple((place, 0.0 if depth == noise else depth) for place, depth in rows)
    np.save(tmp_path / "groove.npy", rows)
    (tmp_path / "groove.csv").write_text("position (m), depth (m)\n" + "".join(f"{x}, {y}\n" for x, y in rows))
    assert checked(rows) == checked(str(tmp_path / "groove.npy")) == checked(str(tmp_path / "groove.csv")) == zero


def test_an_override_is_sought_in_the_current_directory(scene_file, tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "other.csv").write_text(GOOD.replace("10", "12"))
    monkeypatch.chdir(tmp_path / "here")
    assert load_scene(scene_file, ["geometry.points=other.csv"]).grooves[0].depth == 1.2e-5


def test_a_home_and_a_root_are_followed(scene_file, tmp_path, monkeypatch):
    home = tmp_path / "home"
    home.mkdir()
    (home / "groove.csv").write_text(GOOD)
    monkeypatch.setenv("HOME", str(home))
    text = scene_file.read_text()
    for name in ("~/groove.csv", str(home / "groove.csv")):
        scene_file.write_text(text.replace('"groove.csv"', f'"{name}"'))
        assert load_scene(scene_file).grooves[0].points == POINTS


def test_setting_points_replaces_width_and_depth(pocket_file, tmp_path):
    (tmp_path / "groove.csv").write_text(GOOD)
    overrides = ["geometry.profile=points", f"geometry.points={tmp_path / 'groove.csv'}"]
    assert load_scene(pocket_file, overrides).grooves[0].points == POINTS


def test_points_of_several_grooves_are_sought_beside_the_scene_too(tmp_path, pocket_file):
    shutil.copy(pocket_file.parent / "two_grooves.toml", tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text()
    first = text.index("profile ")
    text = text[:first] + 'profile = "points"\npoints = "groove.csv"\n' + text[text.index("[[geometry", first) :]
    (tmp_path / "scene.toml").write_text(text)
    (tmp_path / "groove.csv").write_text(GOOD)
    assert load_scene(tmp_path / "scene.toml").grooves[0].points == POINTS


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        ("position (mm), depth (mm)", 1e-3),
        ("Position [nm],Depth [nm]", 1e-9),
        ("position (inch), depth (inch)", 25.4e-3),
    ],
)
def test_units_are_those_of_the_header(scene_file, tmp_path, header, factor):
    (tmp_path / "groove.csv").write_text("\ufeff" + GOOD.replace("position (um), depth (um)", header))
    overrides = [f"geometry.length={1000 * factor!r} m", f"geometry.film={30 * factor!r} m"]
    points = np.array(load_scene(scene_file, overrides).grooves[0].points)
    assert points == pytest.approx(np.array(POINTS) * 1e6 * factor, rel=1e-12)


@pytest.mark.parametrize("kind", ["float64", "float32", "int32"])
def test_npy_is_in_metres(scene_file, tmp_path, kind):
    array = np.array([[-2, 0], [0, 1], [1, 0]], dtype=kind)
    np.save(tmp_path / "groove.npy", array)
    overrides = ["geometry.length=10 m", "geometry.film=1 m", f"geometry.points={tmp_path / 'groove.npy'}"]
    assert load_scene(scene_file, overrides).grooves[0].points == ((-2, 0), (0, 1), (1, 0))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b"\xff\xfe\x00", "byte 0 is not UTF-8"),
        (b"#" * 1_000_001, "larger than"),
        (b"position (um), depth (um)\n", "got 0 points"),
        (b"position (um), depth (um)\n0,0\n1,0\n", "got 2 points; a groove needs 3"),
        (b"position (um), depth (um)\n" + b"\n".join(b"%d,0" % n for n in range(2001)), "got 2001 points"),
        (b"position, depth\n0,0\n1,1\n2,0\n", r"line 1: got 'position, depth'"),
        (b"position (um)\n0\n1\n2\n", "line 1: got"),
        (b"position (um), depth (um), time (s)\n0,0,0\n", "line 1: got"),
        (b"depth (um), position (um)\n0,0\n1,1\n2,0\n", "line 1: got"),
        (b"position (um), depth (Pa)\n0,0\n1,1\n2,0\n", "wrong dimension"),
        (b"position (um), depth (parsecz)\n0,0\n1,1\n2,0\n", "not known"),
        (b"position (" + b" " * 100_000 + b"), depth (um)\n0,0\n1,1\n2,0\n", "line 1: got"),
        (b"0,0\n1,1\n2,0\n", "line 1: got"),
        (b"position (um), depth (um)\n0,0\n1\n2,0\n", "line 3: got 1 columns"),
        (b"position (um), depth (um)\n0,0\n1,1,1\n2,0\n", "line 3: got 3 columns"),
        (b"position (um), depth (um)\n0,0\n1,nan\n2,0\n", "line 3: got 'nan um'"),
        (b"position (um), depth (um)\n0,0\n1,inf\n2,0\n", "line 3: got 'inf um'"),
        (b"position (um), depth (um)\n0,0\n1,1e999\n2,0\n", "line 3: got '1e999 um'; a length must be"),
        (b"position (um), depth (um)\n0,0\n1,x\n2,0\n", "line 3: got"),
        (b"position (um), depth (um)\n0,0\n1,1\n0.5,1\n2,0\n", "at point 3 after .*; positions must increase"),
        (b"position (um), depth (um)\n0,0\n1,0\n1,1\n2,0\n", "points at 1e-06 m, numbers 2 and 3; .* finite slope"),
        (b"position (um), depth (um)\n0,0\n1,-1\n2,0\n", "got depth -1e-06 m at point 2"),
        (b"position (um), depth (um)\n0,1\n1,1\n2,0\n", "at the first point; a groove begins and ends with depth 0"),
        (b"position (um), depth (um)\n0,0\n1,1\n2,1\n", "at the last point"),
        (b"position (um), depth (um)\n0,0\n1,0\n2,0\n", "depth 0 at every point"),
        (b"position (um), depth (um)\n0,0\n1,1\n2000,0\n", "must be below length"),
        (b"position (um), depth (um)\n300,0\n301,1\n510,0\n", "1e-05 m over the end of the period"),
    ],
)
def test_every_fault_of_a_file_is_one_line_that_names_it(scene_file, tmp_path, content, words):
    (tmp_path / "groove.csv").write_bytes(content)
    with pytest.raises(InputError, match=r"scene\.toml:\d+: geometry\.\w+: .*" + words) as caught:
        load_scene(scene_file)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("write", "words"),
    [
        (lambda path: np.save(path, np.zeros((4, 3))), r"got float64 of shape \(4, 3\)"),
        (lambda path: np.save(path, np.zeros(4)), "got float64 of shape"),
        (lambda path: np.save(path, np.zeros((4, 2), complex)), "got complex128"),
        (
            lambda path: np.save(path, np.array([[0, 0], [1, np.nan], [2, 0]])),
            r"got nan m as depth of point 2; it must be 0 or 1e-22 to 1e\+13 in size",
        ),
        (lambda path: np.save(path, np.array([[{}, 1]]), allow_pickle=True), "got object of shape"),
        (lambda path: path.write_bytes(b"position (um), depth (um)\n"), "is no whole NPY array"),
        (lambda path: path.write_bytes(b"\x93NUMPY\x01\x00\xff\xff{"), "is no whole NPY array"),
        (lambda path: path.write_bytes(b""), "is no whole NPY array"),
    ],
)
def test_every_fault_of_an_array_is_one_line_that_names_it(scene_file, tmp_path, write, words):
    path = tmp_path / "groove.npy"
    write(path)
    with pytest.raises(InputError, match=r"scene\.geometry\.points: file '.*groove\.npy': " + words) as caught:
        load_scene(scene_file, [f"geometry.points={path}"])
    assert "\n" not in str(caught.value)


def test_an_array_whose_header_claims_more_than_there_is_takes_no_memory(scene_file, tmp_path):
    path = tmp_path / "groove.npy"
    with path.open("wb") as file:
        claimed = {"descr": "<f8", "fortran_order": False, "shape": (10**13, 2)}
        np.lib.format.write_array_header_1_0(file, claimed)
        file.write(bytes(64))
    with pytest.raises(InputError, match="is no whole NPY array"):
        load_scene(scene_file, [f"geometry.points={path}"])


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("absent.csv", "no such file"),
        (".", "is no file"),
        ("~nobody-of-this-name/x.csv", "leads nowhere"),
        ("x" * 5000, "be read"),
    ],
)
def test_no_file(scene_file, name, words):
    with pytest.raises(InputError, match=words):
        load_scene(scene_file, [f"geometry.points={name}"])


values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=12,
)


@settings(deadline=None)
@given(values | st.lists(st.lists(st.floats() | st.integers(), min_size=2, max_size=2), min_size=3, max_size=5))
def test_points_are_points_or_a_value_error(points):
    try:
        rows = checked(points)
    except ValueError as error:
        assert "\n" not in str(error)  # noqa: PT017
        return
    array = np.array(rows)
    assert array.shape == (len(points), 2)
    assert np.isfinite(array).all()
    assert np.all(np.diff(array[:, 0]) > 0)
    assert array[0, 1] == array[-1, 1] == 0 < array[:, 1].max()
    assert array[:, 1].min() >= 0
