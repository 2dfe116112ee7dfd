"""Instrument files: those we have give the numbers known of them; damaged ones give one line, in little memory."""

import io
import json
import re
import signal
import struct
import subprocess
import sys
import time
import tracemalloc
from importlib.util import find_spec
from pathlib import Path

import h5py
import numpy as np
import pytest
from PIL import Image

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import InputError, UnavailableError
from roughfilm.contact.surfaces import instrument_reader, instruments
from roughfilm.contact.surfaces.files import read_surface

pytest.importorskip("SurfaceTopography")

FILES = {
    "milled_NT1100.opd": ("opd", (736, 480), (1203e-6, 915.2e-6), 0.00229),
    "oblique_grooves.x3p": ("x3p", (1197, 940), (4404e-6, 3459e-6), 0.0038),
    "periodic_grooves.plu": ("plu", (768, 576), (255e-6, 191.2e-6), 0),
    "ground_striated.x3p": ("x3p", (650, 650), (82.98e-6, 204.5e-6), 0),
    "isotropic.al3d": ("al3d", (200, 296), (87.61e-6, 129.7e-6), 0),
    "polished.opd": ("opd", (640, 480), (125.9e-6, 94.43e-6), 0.0004),
    "polished_with_spikes.sur": ("sur", (563, 484), (1961e-6, 1686e-6), 0.0004),
    "stitching_artefacts.txt": ("asc", (650, 650), (240.4e-6, 240.4e-6), 0),
}
"""Format, points, size in m, invalid part: as the folder's own table says."""


def child(path, channel=None):
    """The header and the heights, or None, that a child process would send."""
    out = io.BytesIO()
    instrument_reader.main({"path": str(path), "channel": channel, "most": instruments.MAX_POINTS}, out)
    head, _, rest = out.getvalue().partition(b"\n")
    header = json.loads(head)
    return header, None if "shape" not in header else np.frombuffer(rest).reshape(header["shape"])


@pytest.mark.measured
@pytest.mark.parametrize("name", ["milled_NT1100.opd", "periodic_grooves.plu"])
def test_an_instrument_file_is_read(measured_file, name):
    format_, points, size, invalid = FILES[name]
    surface = read_surface(measured_file(name))
    assert surface.shape == points
    assert surface.size == pytest.approx(size, rel=5e-4)
    assert surface.invalid.mean() == pytest.approx(invalid, abs=5e-5)
    assert surface.source["format"] == format_
    assert surface.source["file"] == name


@pytest.mark.measured
@pytest.mark.parametrize("name", FILES)
def test_every_kind_of_file_says_what_is_known_of_it(measured_file, name):
    format_, points, size, invalid = FILES[name]
    header, heights = child(measured_file(name))
    assert heights.shape == points
    assert header["size"] == pytest.approx(size, rel=5e-4)
    assert np.isnan(heights).mean() == pytest.approx(invalid, abs=5e-5)
    assert header["format"] == format_


@pytest.mark.measured
@pytest.mark.parametrize("name", FILES)
def test_a_truncated_file_is_refused_or_still_holds_all_its_heights(measured_file, tmp_path, name):
    whole = measured_file(name).read_bytes()
    _, expected = child(measured_file(name))
    refused = 0
    for kept in (8, 100, 1000, *(int(part * len(whole)) for part in (0.1, 0.5, 0.8))):
        path = tmp_path / name
        path.write_bytes(whole[:kept])
        header, heights = child(path)
        if "fault" in header:
            refused += 1
            assert "\n" not in header["fault"]
            assert len(header["fault"]) < 250
        else:
            assert np.array_equal(heights, expected, equal_nan=True)
    assert refused >= 4


@pytest.mark.measured
def test_a_sur_header_of_thirty_thousand_squared_is_refused_in_little_memory(measured_file, tmp_path):
    data = bytearray(measured_file("polished_with_spikes.sur").read_bytes())
    data[108:116] = struct.pack("<ii", 30_000, 30_000)
    (tmp_path / "large.sur").write_bytes(data)
    tracemalloc.start()
    header, heights = child(tmp_path / "large.sur")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert heights is None
    assert re.match(r"claims 30000 x 30000 points|cannot be read|is in no format", header["fault"])
    assert peak < 100e6


def test_more_points_than_a_file_of_its_length_can_hold_are_refused(tmp_path):
    """A few kilobytes of compressed zeros that claim 2000 x 2000 points."""
    path = tmp_path / "bomb.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("heights", data=np.zeros((2000, 2000)), chunks=(2000, 2000), compression="gzip")
    assert path.stat().st_size < 60_000
    with pytest.raises(InputError, match=r"bomb\.h5: claims 2000 x 2000 points; at most \d+ fit a file of its length"):
        read_surface(path)


def test_a_text_header_of_thirty_thousand_squared_is_refused(tmp_path):
    path = tmp_path / "large.txt"
    path.write_text(
        "h=30000 w=30000\npixel size=3.7e-007 m\nheight conversion factor (-> m)=6e-008\n1 2 3 4\n5 6 7 8\n"
    )
    tracemalloc.start()
    header, _ = child(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert re.match(r"is in no format|cannot be read", header["fault"])
    assert peak < 100e6


@pytest.mark.parametrize(
    "content", [b"Dear colleague,\nhere is the surface.\n", b"\x00" * 5000, b"\x89HDF\r\n\x1a\n" + b"x" * 90]
)
def test_what_is_no_surface_is_one_line(tmp_path, content):
    path = tmp_path / "letter.dat"
    path.write_bytes(content)
    header, _ = child(path)
    assert "\n" not in header["fault"]
    assert header["fault"].endswith(("export it again from the instrument", "it may be damaged"))


def test_a_matrix_in_text_needs_a_spacing_and_unit(tmp_path):
    path = tmp_path / "plain.txt"
    path.write_text("1 2 3 4\n5 6 7 8\n9 10 11 12\n")
    with pytest.raises(InputError, match=r"plain\.txt: gives no spacing of its points; set read\.spacing"):
        read_surface(path)
    read = read_surface(path, spacing=(1e-6, 1e-6), height_unit="um")
    assert read.shape == (4, 3)
    assert read.heights[3, 1] == pytest.approx(8e-6)


@pytest.mark.measured
def test_a_channel_is_chosen_by_name(measured_file):
    header, _ = child(measured_file("polished.opd"), "Raw")
    assert header["channel"] == "Raw"
    header, _ = child(measured_file("polished.opd"), "nonsense")
    assert header["fault"].startswith("has no channel 'nonsense'; its channels are 'Raw'")


@pytest.mark.parametrize(("greedy", "end"), [("bytearray(3 << 30)", 1), ("while True: pass", -signal.SIGKILL)])
def test_a_child_gets_no_more_memory_and_time_than_it_is_given(greedy, end):
    program = f"from roughfilm.contact.surfaces.instrument_reader import _limit\n_limit(2 << 30, 1)\n{greedy}"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == end
    assert ("MemoryError" in done.stderr) == (end == 1)


def test_a_reader_that_takes_all_memory_is_reported(tmp_path, monkeypatch):
    def greedy(*_):
        raise MemoryError

    monkeypatch.setattr(instrument_reader, "_read", greedy)
    header, _ = child(tmp_path / "s.opd")
    assert header["fault"] == "needs more memory than a file of its length should; it may be damaged"


def test_a_library_that_does_not_load_is_no_fault_of_the_file(tmp_path, monkeypatch):
    def broken(*_):
        raise ImportError("no module named scipy")

    monkeypatch.setattr(instrument_reader, "_read", broken)
    header, _ = child(tmp_path / "s.opd")
    assert header == {"missing": "no module named scipy"}


def test_a_reader_that_never_ends_is_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(instruments, "CPU_TIME_LIMIT", (1, 0))
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    (tmp_path / "python").write_text("#!/bin/sh\nexec sleep 60\n")
    (tmp_path / "python").chmod(0o755)
    (tmp_path / "s.opd").write_bytes(b"x")
    with pytest.raises(InputError, match=r"s\.opd: reading it took more than 4 s; the file may be damaged"):
        read_surface(tmp_path / "s.opd")


@pytest.mark.skipif(not terminate_with_parent(), reason="no setpriv (util-linux) on this machine")
def test_a_killed_parent_leaves_no_reader(tmp_path):
    """The reader is a stand-in that prints its process id and then sleeps."""
    (tmp_path / "python").write_text(
        f"#!/bin/sh\necho $$ > {tmp_path}/number.part\nmv {tmp_path}/number.part {tmp_path}/number\nexec sleep 60\n"
    )
    (tmp_path / "python").chmod(0o755)
    (tmp_path / "s.opd").write_bytes(b"x")
    program = (
        "import sys; from pathlib import Path; from roughfilm.contact.surfaces.instruments import read_instrument\n"
        f"sys.executable = '{tmp_path}/python'; read_instrument(Path('{tmp_path}/s.opd'))"
    )
    parent = subprocess.Popen([sys.executable, "-c", program])
    number = tmp_path / "number"
    deadline = time.monotonic() + 60
    while not number.exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    reader = int(number.read_text())
    assert runs(reader)
    parent.kill()
    parent.wait()
    deadline = time.monotonic() + 10
    while runs(reader) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not runs(reader)


def runs(process_id):
    """Whether a process is there and has not ended, as one that waits to be counted has."""
    try:
        return (Path("/proc") / str(process_id) / "stat").read_text().rpartition(")")[2].split()[0] not in "XZ"
    except OSError:
        return False


def test_without_the_library_the_message_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(instruments, "find_spec", lambda _: None)
    (tmp_path / "s.opd").write_bytes(b"x")
    with pytest.raises(UnavailableError, match=r"pip install 'roughfilm\[instruments\]'"):
        read_surface(tmp_path / "s.opd")


@pytest.mark.measured
def test_a_file_of_nms_is_read_by_its_own_reader(measured_file):
    """512 x 512 points with a standard deviation of 0.4178 um, as the instrument's program states."""
    found = read_surface(measured_file("areal.nms"))
    assert found.shape == (512, 512)
    assert found.heights[found.valid].std() == pytest.approx(0.4178e-6, rel=2e-4)


@pytest.mark.parametrize(("numbers", "order"), [("f4", "<"), ("f8", ">"), ("u2", ">"), ("i1", "<")])
def test_a_tiff_of_heights_is_read_with_a_row_for_each_y(tmp_path, numbers, order):
    tifffile = pytest.importorskip("tifffile")
    heights = np.arange(120, dtype=numbers).reshape(10, 12)
    tifffile.imwrite(tmp_path / "map.tif", heights, byteorder=order)
    with pytest.raises(InputError, match=r"gives no spacing of its points; set read.spacing"):
        read_surface(tmp_path / "map.tif")
    with pytest.raises(InputError, match=r"gives no unit of its heights; set read.height_unit"):
        read_surface(tmp_path / "map.tif", spacing=(1e-6, 2e-6))
    surface = read_surface(tmp_path / "map.tif", spacing=(1e-6, 2e-6), height_unit="nm")
    assert np.array_equal(surface.heights, 1e-9 * heights.astype(float).T)
    assert surface.spacing == (1e-6, 2e-6)


def test_pages_of_a_tiff_are_channels_and_colours_are_no_heights(tmp_path):
    tifffile = pytest.importorskip("tifffile")
    pages = np.random.default_rng(1).standard_normal((2, 8, 9)).astype("f4")
    tifffile.imwrite(tmp_path / "two.tif", pages, photometric="minisblack")
    with pytest.raises(InputError, match=r"holds 2 pages: '1' \(9 x 8\), '2' \(9 x 8\); name one, as in read"):
        read_surface(tmp_path / "two.tif")
    found = read_surface(tmp_path / "two.tif", channel="2", spacing=(1e-6, 1e-6), height_unit="um")
    assert found.heights == pytest.approx(1e-6 * pages[1].T.astype(float))
    with pytest.raises(InputError, match=r"has no channel '3'; its pages are"):
        read_surface(tmp_path / "two.tif", channel="3")
    Image.fromarray(pages[0]).save(tmp_path / "lzw.tif", compression="tiff_lzw")
    if find_spec("imagecodecs") is None:
        with pytest.raises(InputError, match="is compressed by LZW, which is not read here; save it"):
            read_surface(tmp_path / "lzw.tif")
    tifffile.imwrite(tmp_path / "rgb.tif", np.zeros((8, 9, 3), dtype="u1"), photometric="rgb")
    with pytest.raises(InputError, match="is an image without a page of heights"):
        read_surface(tmp_path / "rgb.tif")


def test_controls_in_a_damaged_file_do_not_reach_the_terminal(tmp_path):
    """The reader of Alicona quotes a key of the file, here one with the sequence that clears a terminal."""
    path = tmp_path / "bad.al3d"
    path.write_bytes(b"AliconaImaging\x00\r\n" + b"\x1b[2J\x07\x9b\x00" * 40)
    with pytest.raises(InputError) as caught:
        read_surface(path)
    assert str(caught.value).isprintable()
    assert "cannot be read as al3d" in str(caught.value)
