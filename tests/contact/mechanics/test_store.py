"""A series of contacts in a file: read back as it was, whole or refused, and another series is never taken for it."""

import math
import os

import h5py
import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics import store as contact_store
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import add, finished, load_contact, row_of

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
    other = Inputs(**{**vars(inputs), **changed})
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


@pytest.mark.parametrize("dies", ["_tabulate", "content_digest"])
def test_a_writer_that_dies_leaves_the_loads_before(file, inputs, contacts, monkeypatch, dies):
    before = file.read_bytes()

    def die(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(contact_store, dies, die)
    row = row_of(contacts[0], 0.5)
    with pytest.raises(KeyboardInterrupt):
        add(file, inputs, [(type(row)(**{**vars(row), "load": 1e9}), contacts[0])])
    assert file.read_bytes() == before
    assert os.listdir(file.parent) == ["c.h5"]
