"""A series of contacts in a file: read back as it was, whole or refused, and another series is never taken for it."""

import gc
import math
import multiprocessing
import os
import resource
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from roughfilm.contact.foundation import growing_hdf5
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.growing_hdf5 import Writer, undo_file
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.writing.scratch import sweep
from roughfilm.contact.mechanics import store as contact_store
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import add, finished, load_contact, load_series, row_of

SETTINGS = {"hardness": 4e9, "model": "elastic_plastic"}


@pytest.fixture(scope="module")
def heights():
    return np.random.default_rng(5310).normal(scale=1e-7, size=(24, 18))


@pytest.fixture(scope="module")
def contacts(heights):
    press = Press(heights, (1e-6, 2e-6), 2e11, hardness=4e9)
    return [press.at(load) for load in (2e8, 3e7)]


@pytest.fixture
def inputs(heights):
    return Inputs(heights=heights, spacing=(1e-6, 2e-6), settings=SETTINGS)


@pytest.fixture
def file(tmp_path, inputs, contacts):
    path = tmp_path / "c.h5"
    for contact in contacts:
        add(path, inputs, [(row_of(contact, 0.25), contact)])
    return path


def test_what_was_written_comes_back(file, inputs, contacts):
    assert finished(file, inputs) == {contact.load: row_of(contact, 0.25) for contact in contacts}
    for contact in contacts:
        read = load_contact(file, contact.load)
        for name in ("heights", "pressure", "gap", "plastic_displacement"):
            assert np.array_equal(getattr(read, name), getattr(contact, name)), name
        off = np.abs(read.elastic_displacement - contact.elastic_displacement).max()
        assert off <= 1.01 * contact.complementarity * contact.heights.std() + 1e-20
        for name in ("load", "hardness", "spacing", "approach", "complementarity", "iterations"):
            assert getattr(read, name) == getattr(contact, name), name


def test_other_programs_find_columns_and_units(file, contacts):
    with h5py.File(file) as stored:
        assert list(stored["series/load"][()]) == [3e7, 2e8]
        gaps = stored["series/mean_gap"]
        assert gaps.attrs["unit"] == "m"
        assert list(gaps[()]) == [contacts[1].gap.mean(), contacts[0].gap.mean()]
        assert stored["loads/30000000.0/pressure"].attrs["unit"] == "Pa"
        mean = stored["loads/30000000.0/pressure"][()].mean()
        assert mean == pytest.approx(3e7, rel=1e-12)


def test_an_elastic_contact_keeps_its_hardness(tmp_path, heights):
    contact = Press(heights, (1e-6, 1e-6), 2e11).at(1e8)
    add(
        tmp_path / "c.h5",
        Inputs(heights=heights, spacing=(1e-6, 1e-6), settings={}),
        [(row_of(contact, 0.0), contact)],
    )
    assert load_contact(tmp_path / "c.h5", 1e8).hardness == math.inf


@pytest.mark.parametrize(
    ("change", "difference"),
    [
        ({"spacing": (1e-6, 2.0000001e-6)}, "of another surface"),
        ({"settings": {**SETTINGS, "hardness": 3e9}}, r"with hardness 4000000000\.0, not 3000000000\.0"),
        (
            {"heights": lambda z: np.where(np.arange(z.size).reshape(z.shape) == 100, z * (1 + 1e-15), z)},
            "of another surface",
        ),
        ({"heights": lambda z: z.reshape(18, 24)}, "of another surface"),
    ],
)
def test_another_series_is_refused_and_kept(file, inputs, contacts, change, difference):
    changed = {name: value(inputs.heights) if callable(value) else value for name, value in change.items()}
    other = replace(inputs, **changed)
    before = file.read_bytes()
    with pytest.raises(InputError, match=f"holds another series, {difference}; remove it"):
        finished(file, other)
    with pytest.raises(InputError, match="holds another series"):
        add(file, other, [(row_of(contacts[0], 0.0), contacts[0])])
    assert file.read_bytes() == before


def test_a_load_that_is_there_is_written_again(file, inputs, contacts):
    add(file, inputs, [(row_of(contacts[0], 7.0), contacts[0])])
    assert finished(file, inputs)[2e8].cpu_s == 7.0
    assert len(finished(file, inputs)) == 2


@pytest.mark.parametrize("place", [700, -1])
def test_a_damaged_file_is_refused(file, inputs, place):
    data = bytearray(file.read_bytes())
    data[place] ^= 1
    file.write_bytes(data)
    with pytest.raises(InputError, match="damaged"):
        finished(file, inputs)
    with pytest.raises(InputError, match="damaged"):
        load_contact(file, 2e8)


def test_a_cut_file_is_refused(file, inputs):
    file.write_bytes(file.read_bytes()[:-3])
    with pytest.raises(InputError, match="damaged"):
        finished(file, inputs)


def test_a_file_of_others_is_refused_and_none_holds_nothing(tmp_path, inputs):
    assert finished(tmp_path / "none.h5", inputs) == {}
    (tmp_path / "empty.h5").touch()
    assert finished(tmp_path / "empty.h5", inputs) == {}
    with h5py.File(tmp_path / "other.h5", "w") as other:
        other["loads"] = 1
    with pytest.raises(InputError, match="is no series of contacts"):
        finished(tmp_path / "other.h5", inputs)


def test_a_load_it_does_not_hold_is_refused(file):
    with pytest.raises(InputError, match="holds no fields at"):
        load_contact(file, 5e7)


def test_a_damaged_array_is_refused_where_it_is_read(file, inputs, contacts):
    with h5py.File(file) as stored:
        place = stored["loads/200000000.0/gap"].id.get_offset()
    data = bytearray(file.read_bytes())
    data[place + 16] ^= 1
    file.write_bytes(data)
    assert np.array_equal(load_contact(file, 3e7).gap, contacts[1].gap)
    for read in (lambda: load_contact(file, 2e8), lambda: load_series(file), lambda: finished(file, inputs)):
        with pytest.raises(InputError, match="damaged"):
            read()


def test_a_file_of_an_older_version_is_refused_in_one_line(tmp_path, inputs, contacts):
    old = tmp_path / "old.h5"
    with h5py.File(old, "w", userblock_size=512) as file:
        file.attrs["schema"] = 1
    with old.open("r+b") as raw:
        raw.write(contact_store.MARK + b"0" * 64 + b"\n")
    for use in (
        lambda: finished(old, inputs),
        lambda: load_series(old),
        lambda: add(old, inputs, [(row_of(contacts[0], 0.0), contacts[0])]),
    ):
        with pytest.raises(InputError, match=r"old\.h5: is of an older version of roughfilm; remove it"):
            use()


def third(contacts):
    """A third load."""
    return replace(row_of(contacts[0], 0.5), load=1e9), contacts[0]


def test_a_load_is_added_without_a_change_of_the_arrays_before(file, inputs, contacts):
    def arrays():
        with h5py.File(file) as stored:
            names = [f"loads/{load!r}/{name}" for load in (3e7, 2e8) for name in ("pressure", "gap")]
            return {name: stored[name].id.get_offset() for name in ["heights", *names]}

    before = arrays()
    add(file, inputs, [third(contacts)])
    assert arrays() == before
    assert sorted(finished(file, inputs)) == [3e7, 2e8, 1e9]
    assert os.listdir(file.parent) == ["c.h5"]


@pytest.mark.parametrize(("place", "name"), [(contact_store, "_tabulate"), (growing_hdf5, "_gaps")])
def test_a_writer_that_fails_leaves_the_loads_before(file, inputs, contacts, monkeypatch, place, name):
    before, calls, work = file.read_bytes(), [], getattr(place, name)

    def fail(*arguments):
        calls.append(name)
        if len(calls) == {"_tabulate": 1, "_gaps": 3}[name]:
            raise KeyboardInterrupt
        return work(*arguments)

    monkeypatch.setattr(place, name, fail)
    with pytest.raises(KeyboardInterrupt):
        add(file, inputs, [third(contacts)])
    assert file.read_bytes() == before
    assert os.listdir(file.parent) == ["c.h5"]


def test_a_writer_that_fails_leaves_the_arrays_that_it_was_to_replace(file, inputs, contacts, monkeypatch):
    before = file.read_bytes()

    def fail(*_arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(contact_store, "_tabulate", fail)
    again = row_of(contacts[0], 7.0), contacts[0]
    other = replace(row_of(contacts[1], 0.5), load=1e9), contacts[1]
    with pytest.raises(KeyboardInterrupt):
        add(file, inputs, [again, other])
    assert file.read_bytes() == before


KILLED_AT = [
    (Writer, "write", 1),
    (Writer, "write", 3),
    (Writer, "rename", 1),
    (contact_store, "_tabulate", 1),
    (h5py.File, "close", 1),
    (os, "fsync", 1),
    (os, "fsync", 2),
    (Path, "replace", 1),
    (Path, "unlink", 1),
]
"""Functions that a killed writer still enters, and the number of the call."""


@pytest.mark.parametrize(("place", "name", "call"), KILLED_AT)
def test_a_killed_writer_leaves_the_loads_before(file, inputs, contacts, place, name, call):
    before = file.read_bytes()

    def killed():
        work, calls = getattr(place, name), []

        def die(*arguments, **options):
            calls.append(name)
            if len(calls) == call:
                os._exit(9)
            return work(*arguments, **options)

        setattr(place, name, die)
        add(file, inputs, [third(contacts)])

    writer = multiprocessing.get_context("fork").Process(target=killed)
    writer.start()
    writer.join()
    assert writer.exitcode == 9
    assert sorted(finished(file, inputs)) == [3e7, 2e8]
    assert file.read_bytes() == before
    assert not undo_file(file).exists()
    assert np.array_equal(load_contact(file, 2e8).gap, contacts[0].gap)
    add(file, inputs, [third(contacts)])
    assert sorted(finished(file, inputs)) == [3e7, 2e8, 1e9]


def test_a_file_that_replaced_a_half_written_one_is_kept(file, inputs, contacts):
    copy = file.with_name("copy.h5")
    copy.write_bytes(file.read_bytes())

    def killed():
        contact_store._tabulate = lambda *_: os._exit(9)
        add(file, inputs, [third(contacts)])

    writer = multiprocessing.get_context("fork").Process(target=killed)
    writer.start()
    writer.join()
    add(copy, inputs, [third(contacts)])
    copy.replace(file)
    assert sorted(finished(file, inputs)) == [3e7, 2e8, 1e9]
    sweep(file.parent)
    assert os.listdir(file.parent) == ["c.h5"]


@contextmanager
def largest_file(size):
    """A limit of the size of a file, as a full disk or a quota sets it."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("room", [-math.inf, 0, 500, 3_000, 6_000])
def test_a_full_disk_leaves_the_loads_before(file, inputs, contacts, room, capfd):
    whole = file.read_bytes()
    with (
        largest_file(int(max(len(whole) + room, 100))),
        pytest.raises(InputError, match=r"c\.h5: cannot be written \(File too large\); raise"),
    ):
        add(file, inputs, [third(contacts)])
    gc.collect()
    assert capfd.readouterr().err == ""
    assert file.read_bytes() == whole
    assert os.listdir(file.parent) == ["c.h5"]
    add(file, inputs, [third(contacts)])
    assert 1e9 in finished(file, inputs)


@pytest.mark.parametrize("size", [0, 600, 3_000, 9_000, 15_000])
def test_a_full_disk_leaves_no_new_file(inputs, contacts, tmp_path, size, capfd):
    path = tmp_path / "new" / "c.h5"
    with largest_file(size), pytest.raises(InputError, match=r"c\.h5: cannot be written \(File too large\); raise"):
        add(path, inputs, [(row_of(contact, 0.25), contact) for contact in contacts])
    gc.collect()
    assert capfd.readouterr().err == ""
    assert not [*path.parent.iterdir()]


@pytest.mark.skipif(not Path("/proc/self/io").exists(), reason="bytes written are not counted here")
def test_a_load_is_written_once_however_many_the_file_holds(tmp_path):
    heights = np.random.default_rng(5317).normal(scale=1e-7, size=(256, 256))
    inputs, path = Inputs(heights=heights, spacing=(1e-6, 1e-6), settings=SETTINGS), tmp_path / "c.h5"
    contact = Press(heights, (1e-6, 1e-6), 2e11).at(3e7)

    def written():
        return int(Path("/proc/self/io").read_text().partition("wchar: ")[2].split()[0])

    before = written()
    for number in range(1, 13):
        one = replace(contact, load=number * 1e6)
        add(path, inputs, [(row_of(one, 0.25), one)])
    assert written() - before < 1.3 * path.stat().st_size


@pytest.mark.parametrize("text", [b"", b"{}\n", b'{"inode": 1, "size": 1, "places": [[0, 9]]}\nabc'])
def test_a_damaged_undo_file_is_one_line(file, inputs, text):
    undo_file(file).write_bytes(text)
    with pytest.raises(InputError, match=r"\.undo: is damaged \(.*\); remove it") as raised:
        finished(file, inputs)
    assert "\n" not in str(raised.value)
