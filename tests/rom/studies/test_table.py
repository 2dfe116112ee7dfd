"""Tables come back as they were, from HDF5 and from CSV."""

import csv

import h5py
import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.table import Column, read_table, write_csv, write_hdf5

TABLE = {
    "name": Column(values=["a,b", 'quote"µ', ""], unit=""),
    "width": Column(values=[0.1 + 0.2, float("nan"), 1e-300], unit="m"),
    "count": Column(values=[1.0, 2.0, 3e20], unit="1"),
}


def test_hdf5_keeps_every_bit_and_the_order(tmp_path):
    write_hdf5(TABLE, tmp_path / "t.h5")
    back = read_table(tmp_path / "t.h5")
    assert list(back) == list(TABLE)
    for name, column in TABLE.items():
        assert np.array_equal(back[name], column.values, equal_nan=name != "name")
    with h5py.File(tmp_path / "t.h5") as file:
        assert [item.attrs["unit"] for item in file.values()] == ["", "m", "1"]


def test_csv_says_the_same_with_units_in_its_header(tmp_path):
    write_csv(TABLE, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header == ["name", "width (m)", "count"]
    assert [row[0] for row in rows] == TABLE["name"].values
    assert rows[1][1] == ""
    assert float(rows[0][1]) == 0.1 + 0.2
    assert [float(row[2]) for row in rows] == TABLE["count"].values


def test_what_is_no_table_is_refused_in_one_line(tmp_path):
    (tmp_path / "text").write_text("no")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = np.zeros(3)
    for name in ("text", "other.h5"):
        with pytest.raises(InputError, match="is not a table of roughfilm"):
            read_table(tmp_path / name)
    with pytest.raises(InputError, match="no such file"):
        read_table(tmp_path / "none")


def test_a_table_replaces_a_table_and_no_other_file(tmp_path):
    path = tmp_path / "t.h5"
    with h5py.File(path, "w") as file:
        file["x"] = np.zeros(3)
    before = path.read_bytes()
    with pytest.raises(InputError, match=r"t\.h5: exists and is not a table of roughfilm"):
        write_hdf5(TABLE, path)
    assert path.read_bytes() == before
    with h5py.File(path, "w") as file:  # as versions without a header wrote it
        file["x"] = np.zeros(3)
        file["x"].attrs["unit"] = "m"
    write_hdf5(TABLE, path)
    assert list(read_table(path)) == list(TABLE)
