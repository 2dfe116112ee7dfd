"""What is read is a regular file of a bounded size, and claims of a file are checked against what it holds."""

import os
import socket

import h5py
import numpy as np
import pytest
from forging import forge

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading import global_heaps, limits
from roughfilm.contact.foundation.reading.global_heaps import refuse_endless_heaps
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.npy import read_header, read_numbers
from roughfilm.contact.foundation.reading.regular import file_size, holds_data, opened, read_bytes, read_text
from roughfilm.contact.foundation.toml import read_toml
from roughfilm.contact.surfaces.store import load_surface, save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.grid import Grid

HEIGHTS = np.random.default_rng(861).normal(size=(6, 4))


@pytest.fixture
def surface_file(tmp_path):
    path = tmp_path / "s.h5"
    save_surface(Surface(heights=HEIGHTS, spacing=(1e-6, 1e-6)), path)
    return path


@pytest.fixture(params=["a pipe", "a device", "a directory", "a socket"])
def irregular(request, tmp_path, monkeypatch):
    path = tmp_path / "file"
    monkeypatch.chdir(tmp_path)
    match request.param:
        case "a pipe":
            os.mkfifo(path)
        case "a device":
            path.symlink_to("/dev/zero")
        case "a directory":
            path.mkdir()
        case "a socket":
            with socket.socket(socket.AF_UNIX) as one:
                one.bind("file")
    return path, request.param


def test_what_is_no_regular_file_is_refused_unread(irregular):
    path, kind = irregular
    for read in (file_size, holds_data, lambda *given: read_bytes(given[0], 10, given[1])):
        with pytest.raises(InputError, match=f"file: is no file, but {kind}; name a table"):
            read(path, "name a table")
    with pytest.raises(InputError, match="is no file"), opened(path, "name a table"):
        pass


def test_a_larger_file_and_one_that_is_not_utf8_are_refused(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"abc\n\xff")
    assert read_bytes(path, 5, "") == b"abc\n\xff"
    with pytest.raises(InputError, match="is larger than 4 bytes; give fewer"):
        read_bytes(path, 4, "give fewer")
    with pytest.raises(InputError, match=r"file:2: byte 4 is not UTF-8"):
        read_text(path, 5, "")
    with pytest.raises(InputError, match="no such file"):
        read_bytes(tmp_path / "none", 4, "")


def put(file, name, **options):
    attributes = dict(file[name].attrs)
    del file[name]
    file.create_dataset(name, **options).attrs.update(attributes)


def external(file, name):
    put(file, name, shape=(6, 4), dtype="f8", external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])


def linked(file, link):
    del file["heights"]
    file["heights"] = link


FORGED = {
    "shape": (lambda file: put(file, "heights", data=HEIGHTS[0]), "'heights' has the shape (4,), not (nx, ny)"),
    "claim": (
        lambda file: put(file, "heights", shape=(10**6, 10**6), dtype="f8"),
        "'heights' claims 8e+12 bytes, and 0",
    ),
    "fill": (
        lambda file: put(file, "heights", shape=(45_000, 45_000), dtype="f8", chunks=(9, 9), compression="gzip"),
        "'heights' claims 1.62e+10 bytes, and 0",
    ),
    "chunk": (
        lambda file: put(file, "heights", data=HEIGHTS, maxshape=(None, None), chunks=(9000, 9000), compression="gzip"),
        "'heights' has pieces of the shape (9000, 9000)",
    ),
    "type": (lambda file: put(file, "heights", data=HEIGHTS * 1j), "'heights' has the type complex128, not float"),
    "infinite": (lambda file: put(file, "heights", data=HEIGHTS / 0.0), "'heights' is infinite"),
    "missing": (lambda file: file.__delitem__("heights"), "'heights' is missing"),
    "soft link": (lambda file: linked(file, h5py.SoftLink("/invalid")), "'heights'"),
    "link": (lambda file: linked(file, h5py.ExternalLink("/dev/zero", "/x")), "'heights'"),
    "external": (lambda file: external(file, "heights"), "'heights' lies in another file"),
    "filter": (lambda file: put(file, "heights", data=HEIGHTS, scaleoffset=2), "'heights' has an unknown filter"),
    "attribute": (lambda file: file.attrs.__delitem__("spacing"), "'@spacing' is missing"),
    "length": (lambda file: file.attrs.update(spacing=[1.0, 1.0, 1.0]), "'@spacing' has the shape (3,), not (2)"),
    "text": (lambda file: file.attrs.update(source=7), "'@source' is no text"),
    "JSON": (lambda file: file.attrs.update(source="[" * 10_000), "'@source' cannot be read"),
    "JSON number": (lambda file: file.attrs.update(source='{"a": 1e999}'), "'@source' cannot be read"),
}


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.parametrize("change", FORGED)
def test_forged_content_is_refused_in_one_line(surface_file, change):
    forge(surface_file, FORGED[change][0])
    with pytest.raises(InputError) as raised:
        load_surface(surface_file)
    message = str(raised.value)
    assert message.startswith(f"{surface_file}: is damaged or incomplete ({FORGED[change][1]}")
    assert message.endswith("; make it again")
    assert "\n" not in message


TEXTS = [f"{number:0{5 * number}}" for number in range(1, 300)]


@pytest.fixture
def file_of_texts(tmp_path):
    with h5py.File(tmp_path / "t.h5", "w") as file:
        file.create_dataset("texts", data=TEXTS, dtype=h5py.string_dtype())
    return tmp_path / "t.h5"


def test_whole_global_heaps_are_read(file_of_texts):
    assert file_of_texts.read_bytes().count(b"GCOL") > 3
    refuse_endless_heaps(file_of_texts, "make it again")


@pytest.mark.parametrize("last", [False, True])
@pytest.mark.parametrize(
    ("number", "length"),
    [(0, 0), (1, 2**64 - 16), (1, 2**64 - 8), (0, 10**6)],
    ids=["0", "to itself", "0 * 8", "beyond"],
)
def test_a_global_heap_that_the_library_reads_for_ever_is_refused(file_of_texts, number, length, last):
    """The second object of the first or the last collection."""
    data = bytearray(file_of_texts.read_bytes())
    start = (data.rfind if last else data.find)(b"GCOL")
    place = start + 32 + -(-int.from_bytes(data[start + 24 : start + 32], "little") // 8) * 8
    data[place : place + 2], data[place + 8 : place + 16] = number.to_bytes(2, "little"), length.to_bytes(8, "little")
    file_of_texts.write_bytes(data)
    with pytest.raises(InputError, match=rf"is damaged \(texts at byte {start}\); make it again$"):
        refuse_endless_heaps(file_of_texts, "make it again")


def test_collections_that_overlap_are_refused(tmp_path):
    """Otherwise a file of many collections, each of which claims all bytes behind it, would be read many times."""
    collection = b"GCOL\1\0\0\0" + (16).to_bytes(8, "little")
    (tmp_path / "whole.h5").write_bytes(collection * 400_000)
    refuse_endless_heaps(tmp_path / "whole.h5", "make it again")
    outer = b"GCOL\1\0\0\0" + (16 + 32).to_bytes(8, "little") + b"\1" + bytes(7) + (16).to_bytes(8, "little")
    (tmp_path / "t.h5").write_bytes(outer + collection)
    with pytest.raises(InputError, match="texts at byte 32"):
        refuse_endless_heaps(tmp_path / "t.h5", "make it again")


def test_a_signature_between_two_chunks_is_found(tmp_path, monkeypatch):
    (tmp_path / "t.h5").write_bytes(bytes(10) + b"GCOL\1\0\0\0" + bytes(40))
    for length in range(1, 30):
        monkeypatch.setattr(global_heaps, "CHUNK_BYTES", length)
        with pytest.raises(InputError, match="texts at byte 10"):
            refuse_endless_heaps(tmp_path / "t.h5", "make it again")


def test_an_array_is_read_in_its_order_and_no_object_is_unpickled(tmp_path):
    path = tmp_path / "a.npy"
    for values in (HEIGHTS, np.asfortranarray(HEIGHTS), np.arange(6, dtype=np.int16).reshape(3, 2), np.array(7.0)):
        np.save(path, values)
        assert np.array_equal(read_numbers(path, read_header(path, "")), values)
    np.save(path, np.array([print, 1], dtype=object), allow_pickle=True)
    with pytest.raises(InputError, match=r"got object of shape \(2,\)"):
        read_header(path, "")


def test_entries_of_another_type_are_named():
    assert from_json('{"a": 1}', dict[str, float]) == {"a": 1.0}
    for text, words in (('{"a": "x"}', "^a: "), ("[1]", "an object"), ("{", "EOF"), ("[" * 10_000, "recursion")):
        with pytest.raises(ValueError, match=words) as raised:
            from_json(text, dict[str, float])
        assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a." * 100_000 + "a = 1", "too many parts"),
        ("a = " + "[" * 30 + "]" * 30, "nested too deeply"),
        ("a = 0x" + "f" * 1000, "an integer beyond 64 bits"),
        ("a = " + "[" * 100_000, "is not TOML"),
    ],
)
def test_toml_without_end_is_one_line(tmp_path, text, words):
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(InputError, match=words) as raised:
        read_toml(tmp_path / "a.toml", "a = 1")
    assert "\n" not in str(raised.value)


def test_a_surface_beyond_the_memory_is_refused_before_it_is_made(monkeypatch):
    monkeypatch.setattr(limits, "memory_available", lambda: 2.0**30)
    Grid(kind="milled", size=(1e-3, 1e-3), points=(3000, 3000))
    with pytest.raises(InputError, match=r"milled\.points: a surface of 9000 x 9000 points takes about 6.34 GiB"):
        Grid(kind="milled", size=(1e-3, 1e-3), points=(9000, 9000))
