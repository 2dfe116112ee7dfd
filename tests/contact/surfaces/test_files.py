"""Surfaces come back from files as they were, and damaged files are refused in one line."""

from pathlib import Path

import h5py
import numpy as np
import pytest
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces import store as surface_store
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface

SPACING = (1.5e-6, 2e-6)


@pytest.fixture
def heights():
    made = np.random.default_rng(831).normal(size=(7, 5)) * 1e-6
    made[2, 3] = np.nan
    return made


def test_npy_is_x_by_y_in_metres(tmp_path, heights):
    np.save(tmp_path / "s.npy", heights)
    read = read_surface(tmp_path / "s.npy", spacing=SPACING)
    assert read.spacing == SPACING
    assert read.size == (7 * 1.5e-6, 5 * 2e-6)
    assert np.array_equal(read.invalid, np.isnan(heights))
    assert np.array_equal(read.heights, np.nan_to_num(heights))


def test_npy_may_hold_other_units_and_whole_numbers(tmp_path):
    np.save(tmp_path / "s.npy", np.arange(12, dtype=np.int16).reshape(4, 3))
    read = read_surface(tmp_path / "s.npy", spacing=SPACING, height_unit="nm")
    assert read.heights[3, 2] == pytest.approx(11e-9)


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_csv_has_a_line_for_each_y(tmp_path, newline):
    text = newline.join(["# spacing: 1.5 um, 2 um; heights: um", "1,2,3", "4,,6", ""])
    (tmp_path / "s.csv").write_text(text, newline="")
    read = read_surface(tmp_path / "s.csv")
    assert np.allclose(read.heights * 1e6, [[1, 4], [2, 0], [3, 6]])
    assert np.array_equal(np.argwhere(read.invalid), [[1, 1]])
    assert np.allclose(read.spacing, SPACING)


def test_csv_without_header_takes_the_spacing_and_unit_given(tmp_path):
    (tmp_path / "s.csv").write_text("1,2\n3,nan\n")
    read = read_surface(tmp_path / "s.csv", spacing=SPACING, height_unit="mm")
    assert read.heights[1, 0] == 2e-3


def test_our_own_file_brings_everything_back_and_is_the_same_bytes_again(tmp_path, heights):
    given = Surface(
        heights=np.nan_to_num(heights),
        spacing=SPACING,
        invalid=np.isnan(heights),
        periodic=True,
        source={"file": "a", "recipe": {"form": "tilt"}},
    )
    for name in ("a.h5", "b.h5"):
        save_surface(given, tmp_path / name)
    read = read_surface(tmp_path / "a.h5")
    assert np.array_equal(read.heights, given.heights)
    assert np.array_equal(read.invalid, given.invalid)
    assert (read.spacing, read.periodic, read.source) == (SPACING, True, given.source)
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()


def test_a_source_names_the_file_by_its_digest(tmp_path, heights):
    np.save(tmp_path / "s.npy", heights)
    np.save(tmp_path / "t.npy", heights * 2)
    first, second = (read_surface(tmp_path / name, spacing=SPACING).source for name in ("s.npy", "t.npy"))
    assert first["file"] == "s.npy"
    assert first["format"] == "npy"
    assert first["sha256"] != second["sha256"]


HEAD = "# spacing: 1 um, 1 um; heights: um\n"

BAD_CSV = {
    "": "is empty; export it again",
    "\n\n": "holds no numbers",
    HEAD + "1,2\n3\n": "line 3 has 1 cells, the first 2",
    HEAD + "1,2\n3,x4\n": "line 3: got 'x4'; write numbers",
    HEAD + "1,2,3\n": "is a profile of 3 points, where a surface is needed",
    HEAD + "1,2\n3,inf\n": "the height at x 1, y 1 is infinite; mark invalid points by NaN",
    HEAD + "nan,nan\nnan,nan\n": "every pixel is invalid",
    HEAD + "1e300,2\n3,4\n": "got a height of .* look at the unit",
    "1,2\n3,4\n": "gives no spacing of its points; set read.spacing",
    "# something else\n1,2\n3,4\n": "line 1 is no header of a surface; write for example",
    "# spacing: 1 um, 1 s; heights: um\n1,2\n3,4\n": "line 1: got '1 s', which has the wrong dimension",
    "# spacing: 1 um, 1 um; heights: kg\n1,2\n3,4\n": "heights: got '1 kg', which has the wrong dimension",
    "# spacing: 1 um, 0 um; heights: um\n1,2\n3,4\n": "got spacing .* give two lengths in m, 1e-15 or more",
    HEAD + "\n1,2\n\n3,x\n": "line 5: got 'x'",
    HEAD + "1,2,\n3,4,\n": "column 3 is empty; take it out",
    HEAD + '1,"2\n3",4\n': "line 2: got '\"2'",
    HEAD + "1_000,2\n3,4\n": "line 2: got '1_000'",
    HEAD + "\u0661,2\n3,4\n": "line 2: got '\u0661'",
    HEAD + "1;2\n3;4\n": "line 2: got '1;2'",
    HEAD + "1," + "9" * 200_000 + "x\n3,4\n": "line 2: got '9999999",
    "Dear colleague,\nhere is the surface.\n": "line 1: got 'Dear colleague'; write numbers",
}


@pytest.mark.parametrize("text", BAD_CSV)
def test_a_bad_csv_is_one_line(tmp_path, text):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=BAD_CSV[text]) as raised:
        read_surface(path)
    assert str(raised.value).startswith(f"{path}: ")
    assert "\n" not in str(raised.value)


def test_text_that_is_not_utf8_is_refused(tmp_path):
    (tmp_path / "s.csv").write_bytes(b"1,2\n\xff,4\n")
    with pytest.raises(InputError, match="byte 4 is not UTF-8"):
        read_surface(tmp_path / "s.csv")


@pytest.mark.parametrize("kept", [0, 5, 60, 127, 200])
def test_a_truncated_npy_is_refused(tmp_path, kept):
    np.save(tmp_path / "whole.npy", np.zeros((20, 20)))
    (tmp_path / "s.npy").write_bytes((tmp_path / "whole.npy").read_bytes()[:kept])
    with pytest.raises(InputError, match=r"is no whole NPY array|is empty"):
        read_surface(tmp_path / "s.npy", spacing=SPACING)


@pytest.mark.parametrize(("shape", "whole"), [("(4L, 3L)", True), ("(4L, 3L1)", False), ("(4if 1else 3, 3)", False)])
def test_an_npy_header_of_python_2_is_read_without_a_warning(tmp_path, shape, whole):
    heights = np.arange(12.0).reshape(4, 3)
    np.save(tmp_path / "s.npy", heights)
    data = (tmp_path / "s.npy").read_bytes()
    spaces = b" " * (len(shape) - len("(4, 3)"))
    (tmp_path / "s.npy").write_bytes(data.replace(b"(4, 3), }" + spaces, shape.encode() + b", }"))
    if whole:
        assert np.array_equal(read_surface(tmp_path / "s.npy", spacing=SPACING).heights, heights)
    else:
        with pytest.raises(InputError, match="is no whole NPY array"):
            read_surface(tmp_path / "s.npy", spacing=SPACING)


def test_an_npy_header_beyond_its_file_takes_no_memory(tmp_path):
    head = {"descr": "<f8", "fortran_order": False, "shape": (30_000, 30_000)}
    with (tmp_path / "s.npy").open("wb") as file:
        np.lib.format.write_array_header_1_0(file, head)
        file.write(bytes(800))
    with pytest.raises(InputError, match="is no whole NPY array"):
        read_surface(tmp_path / "s.npy", spacing=SPACING)


@pytest.mark.parametrize("array", [np.zeros((2, 2, 2)), np.zeros((3, 3), complex), np.array([["a"] * 2] * 2)])
def test_an_npy_that_is_no_map_of_heights_is_refused(tmp_path, array):
    np.save(tmp_path / "s.npy", array)
    with pytest.raises(InputError, match=r"save numbers of shape \(nx, ny\)"):
        read_surface(tmp_path / "s.npy", spacing=SPACING)


def test_an_npy_of_objects_is_never_unpickled(tmp_path):
    np.save(tmp_path / "s.npy", np.array([[print, 1], [2, 3]], dtype=object), allow_pickle=True)
    with pytest.raises(InputError, match="got object of shape"):
        read_surface(tmp_path / "s.npy", spacing=SPACING)


def test_our_own_file_is_known_by_what_it_holds_not_by_its_name(tmp_path):
    save_surface(Surface(heights=np.eye(4), spacing=SPACING), tmp_path / "s.npy")
    assert read_surface(tmp_path / "s.npy").spacing == SPACING


def test_our_own_file_is_hdf5_for_others_too(tmp_path):
    save_surface(Surface(heights=np.eye(4), spacing=SPACING), tmp_path / "s.h5")
    with h5py.File(tmp_path / "s.h5") as file:
        assert np.array_equal(file["heights"][()], np.eye(4))
        assert file["heights"].attrs["unit"] == "m"


@pytest.mark.parametrize("part", [0.02, 0.1, 0.5, 0.9, 0.999])
def test_our_own_file_truncated_is_refused(tmp_path, part):
    heights = np.random.default_rng(832).normal(size=(64, 64))
    save_surface(Surface(heights=heights, spacing=SPACING), tmp_path / "s.h5")
    whole = (tmp_path / "s.h5").read_bytes()
    (tmp_path / "s.h5").write_bytes(whole[: int(part * len(whole))])
    with pytest.raises(InputError, match=r"s\.h5: was damaged or changed since it was written; make it again$"):
        read_surface(tmp_path / "s.h5")


def test_our_own_file_with_any_bit_turned_is_refused(tmp_path):
    """The library that reads HDF5 can crash or hang on such a file, so it never sees one."""
    save_surface(Surface(heights=np.random.default_rng(833).normal(size=(16, 16)), spacing=SPACING), tmp_path / "s.h5")
    whole = (tmp_path / "s.h5").read_bytes()
    for place in np.random.default_rng(834).integers(60, len(whole), 300):
        damaged = bytearray(whole)
        damaged[place] ^= 1 << (place % 8)
        (tmp_path / "s.h5").write_bytes(damaged)
        with pytest.raises(InputError, match=r"was damaged or changed"):
            read_surface(tmp_path / "s.h5")


def test_our_own_file_of_another_version_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(surface_store, "SCHEMA", 99)
    save_surface(Surface(heights=np.eye(4), spacing=SPACING), tmp_path / "s.h5")
    monkeypatch.undo()
    with pytest.raises(InputError, match=r"s\.h5: has schema 99; this version reads 1, make it again"):
        read_surface(tmp_path / "s.h5")


@pytest.mark.parametrize("given", [{"spacing": SPACING}, {"height_unit": "um"}, {"channel": "Raw"}])
def test_our_own_file_is_not_contradicted(tmp_path, given):
    save_surface(Surface(heights=np.eye(4), spacing=SPACING), tmp_path / "s.h5")
    with pytest.raises(InputError, match="holds its own spacing and unit; leave out"):
        read_surface(tmp_path / "s.h5", **given)


def test_a_link_that_leads_in_circles_is_refused(tmp_path):
    (tmp_path / "loop.csv").symlink_to(tmp_path / "loop.csv")
    with pytest.raises(InputError, match=r"cannot be read .*links"):
        read_surface(tmp_path / "loop.csv")


def test_a_home_that_is_not_known_is_refused():
    with pytest.raises(InputError, match="leads nowhere"):
        read_surface(Path("~nobody-of-this-name/s.opd"))


def test_what_is_no_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="no such file; name a measured surface"):
        read_surface(tmp_path / "absent.opd")
    with pytest.raises(InputError, match="is no file, but a directory; name a measured surface"):
        read_surface(tmp_path)


def test_a_channel_is_for_files_that_have_some(tmp_path):
    np.save(tmp_path / "s.npy", np.eye(4))
    with pytest.raises(InputError, match=r"has no channels; leave out read\.channel"):
        read_surface(tmp_path / "s.npy", spacing=SPACING, channel="Raw")


@pytest.mark.parametrize("read", [rf.read_surface, rf.read_profile])
def test_functions_name_their_arguments_and_commands_the_keys_of_a_recipe(tmp_path, read):
    np.save(tmp_path / "bare.npy", np.random.default_rng(1).standard_normal((12, 14)))
    (tmp_path / "bare.csv").write_text("1,2,4\n2,3,7\n1,1,5\n")
    with pytest.raises(InputError, match=r"gives no spacing of its points; give spacing=1e-6, in m$"):
        read(tmp_path / "bare.npy")
    with pytest.raises(InputError, match=r'gives no unit of its heights; give height_unit="um"$'):
        read(tmp_path / "bare.csv", spacing=1e-6)
    with pytest.raises(InputError, match=r"has no channels; leave out channel$"):
        read(tmp_path / "bare.npy", channel="z")
    done = CliRunner().invoke(app, ["combine", str(tmp_path / "bare.npy"), str(tmp_path / "bare.npy")])
    assert "set read.spacing" in done.output
