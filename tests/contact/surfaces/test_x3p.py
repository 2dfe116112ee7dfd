"""Archives of X3P are read in a folder and with empty offsets; damaged ones and bombs give one line."""

import io
import json
import re
import zipfile

import numpy as np
import pytest

from roughfilm.contact.surfaces import instrument_reader, instruments
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.x3p import repaired

pytest.importorskip("SurfaceTopography")

HEIGHTS = 1e-6 * np.random.default_rng(871).normal(size=(7, 5))
DX, DY = 2e-6, 3e-6
MOST = 1_000_000
SAMPLES = ("iso5436_sample1.x3p", "pyramid.x3p")

MAIN = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx}</Increment>{offset}</CX>
<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{dy}</Increment>{offset}</CY>
<CZ><AxisType>A</AxisType><DataType>D</DataType>{scale}{offset}</CZ></Axes></Record1>
<Record2><Date>2026-01-01T00:00:00</Date><Instrument><Manufacturer>none</Manufacturer></Instrument></Record2>
<Record3><MatrixDimension><SizeX>7</SizeX><SizeY>5</SizeY><SizeZ>1</SizeZ></MatrixDimension>
<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3>
</p:ISO5436_2>"""


def members(offset="<Offset>0</Offset>", scale="<Increment>1</Increment>", folder=""):
    """The members of a minimal X3P, heights in rows along x, by their names."""
    main = MAIN.format(dx=DX, dy=DY, offset=offset, scale=scale)
    return {f"{folder}main.xml": main.encode(), f"{folder}bindata/data.bin": HEIGHTS.T.astype("<f8").tobytes()}


def write(path, content, *, compression=zipfile.ZIP_STORED):
    with zipfile.ZipFile(path, "w", compression) as archive:
        for name, data in content.items():
            archive.writestr(name, data)
    return path


def child(path):
    """The header and the heights, or None, that a child process would send."""
    out = io.BytesIO()
    instrument_reader.main({"path": str(path), "channel": None, "most": 10_000}, out)
    head, _, rest = out.getvalue().partition(b"\n")
    header = json.loads(head)
    return header, None if "shape" not in header else np.frombuffer(rest).reshape(header["shape"])


def listed(texts=None):
    """The same with the heights as a list in the index, in rows along x, and the revision of another writer."""
    texts = [f"{height:.17g}" for height in HEIGHTS.T.ravel()] if texts is None else texts
    data = "".join(f"<Datum>{text}</Datum>" for text in texts)
    index = members()["main.xml"].decode().replace("ISO5436 - 2000", "ISO5436 \N{EN DASH} 2007")
    return {"main.xml": re.sub("<DataLink>.*</DataLink>", f"<DataList>{data}</DataList>", index).encode()}


GOOD = {
    "as it should be": members(),
    "in a folder": {"my surface/": b"", **members(folder="my surface/")},
    "in two folders": members(folder="a/b/"),
    "in a folder beside other files": {**members(folder="a/"), "__MACOSX/a/._main.xml": b"\0", "notes.txt": b"none"},
    "empty offsets": members(offset="<Offset/>"),
    "blank offsets": members(offset="<Offset> \n</Offset>"),
    "empty increment of the heights": members(scale="<Increment/>"),
    "empty offsets in a folder": members(offset="<Offset></Offset>", folder="a/"),
    "no offsets": members(offset=""),
    "heights in the index": listed(),
    "another revision": {
        **members(),
        "main.xml": members()["main.xml"].replace(b"ISO5436 - 2000", "ISO5436 \N{EN DASH} 2000".encode()),
    },
}


@pytest.mark.parametrize("kind", GOOD)
def test_an_archive_gives_its_heights(tmp_path, kind):
    header, heights = child(write(tmp_path / "s.x3p", GOOD[kind]))
    assert header.get("fault") is None
    assert header["format"] == "x3p"
    assert header["size"] == pytest.approx([7 * DX, 5 * DY])
    assert np.allclose(heights, HEIGHTS, rtol=0, atol=1e-20)


def test_an_empty_height_of_a_list_is_invalid(tmp_path):
    """Heights run along x first: the ninth of a map of 7 x 5 is that of x 1, y 1."""
    texts = [f"{height:.17g}" for height in HEIGHTS.T.ravel()]
    texts[8] = ""
    surface = read_surface(write(tmp_path / "s.x3p", listed(texts)))
    assert np.argwhere(surface.invalid).tolist() == [[1, 1]]
    assert np.allclose(surface.heights[surface.valid], HEIGHTS[surface.valid], rtol=0, atol=1e-20)


def test_a_surface_in_a_folder_is_read(tmp_path):
    surface = read_surface(write(tmp_path / "s.x3p", members(offset="<Offset/>", folder="a/")))
    assert surface.spacing == pytest.approx((DX, DY))
    assert surface.source["format"] == "x3p"
    assert np.allclose(surface.heights, HEIGHTS, rtol=0, atol=1e-20)


BAD = {
    "two measurements": ({**members(folder="a/"), **members(folder="b/")}, "is an archive of 2 measurements"),
    "a damaged index": ({**members(folder="a/"), "a/main.xml": b"<p>"}, "has a damaged main.xml"),
    "no heights": ({"a/main.xml": members()["main.xml"]}, "cannot be read"),
    "too few heights": ({**members(folder="a/"), "a/bindata/data.bin": b"\0" * 99}, "cannot be read"),
    "another index": ({"a/main.xml": b"<html/>"}, "cannot be read|is in no format"),
    "a short list": (listed(["1e-6"] * 34), "lists 34 heights for 7 x 5 points"),
    "a list of words": (listed(["high"] * 35), "lists the height 'high'"),
    "a count of points in words": (
        {"main.xml": listed()["main.xml"].replace(b"<SizeX>7<", b"<SizeX>many<")},
        "gives the number of points 'many'",
    ),
    "a bomb": ({**members(folder="a/"), "a/bindata/data.bin": b"\0" * 30_000_000}, "claims 30.* bytes of members"),
    "a bomb of an index": (
        {**members(folder="a/"), "a/main.xml": b"<p>" + b" " * 20_000_000 + b"</p>"},
        "claims 20.* bytes of members",
    ),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_damaged_archive_is_one_line(tmp_path, kind):
    content, message = BAD[kind]
    header, heights = child(write(tmp_path / "s.x3p", content, compression=zipfile.ZIP_DEFLATED))
    assert heights is None
    assert "\n" not in header["fault"]
    assert len(header["fault"]) < 250
    assert re.match(message, header["fault"])


@pytest.mark.parametrize("part", [0.1, 0.5, 0.95])
def test_a_truncated_archive_is_one_line(tmp_path, part):
    path = write(tmp_path / "s.x3p", members(folder="a/"))
    whole = path.read_bytes()
    path.write_bytes(whole[: int(part * len(whole))])
    header, heights = child(path)
    assert heights is None
    assert "\n" not in header["fault"]


def test_what_is_no_x3p_is_left_alone(tmp_path):
    (tmp_path / "s.opd").write_bytes(b"x")
    assert repaired(tmp_path / "s.opd", MOST) is None
    assert repaired(write(tmp_path / "other.zip", {"a.txt": b""}), MOST) is None
    assert repaired(write(tmp_path / "good.x3p", members()), MOST) is None


@pytest.mark.measured
def test_the_samples_of_the_format_are_read(measured_file):
    """A map of 4 x 4 with one empty height, and a pyramid of 5 x 5 with another dash in its revision."""
    sample, pyramid = (instruments.read_instrument(measured_file(name)) for name in SAMPLES)
    assert sample.heights.shape == (4, 4)
    assert np.isnan(sample.heights).sum() == 1
    assert pyramid.heights.shape == (5, 5)
    assert np.array_equal(pyramid.heights, pyramid.heights[::-1])
    assert np.array_equal(pyramid.heights, pyramid.heights.T)


@pytest.mark.measured
def test_a_measured_surface_zipped_in_a_folder_is_the_same(measured_file, tmp_path):
    name = "ground_striated.x3p"
    with zipfile.ZipFile(measured_file(name)) as archive:
        content = {one: archive.read(one) for one in archive.namelist() if not one.endswith("/")}
    packed = write(tmp_path / name, {f"in/{one}": data for one, data in content.items()})
    expected, found = (instruments.read_instrument(path) for path in (measured_file(name), packed))
    assert (found.size, found.height_unit, found.format) == (expected.size, expected.height_unit, expected.format)
    assert np.array_equal(found.heights, expected.heights, equal_nan=True)
