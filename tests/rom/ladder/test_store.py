"""A stored result comes back as it was, and what is no result is refused in one line."""

import h5py
import numpy as np
import pytest

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.model import find, ladder
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.store import as_entries, load, save


@pytest.fixture
def result(make_scene):
    return find(ladder(rom), "inertial_reynolds").solve(make_scene(0.3, 0.25, 40))


def test_round_trip(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    back = load(path)
    assert as_entries(back) == as_entries(result)
    for name, field in result.fields.items():
        assert np.array_equal(back.fields[name].values, field.values)
        assert back.fields[name].unit == field.unit


def test_provenance_suffices_to_compute_it_again(result, tmp_path):
    save(result, tmp_path / "r.h5")
    stored = load(tmp_path / "r.h5")
    scene = read_scene(stored.provenance["scene"])
    again = find(ladder(rom), stored.model).solve(scene, resolution=stored.numerics.resolution)
    assert again.quantities == stored.quantities
    assert {"versions", "commit", "machine", "created", "sources", "keeps"} <= set(stored.provenance)


def test_units_stand_beside_every_number(result, tmp_path):
    save(result, tmp_path / "r.h5")
    with h5py.File(tmp_path / "r.h5") as file:
        for group in ("quantities", "fields"):
            for item in file[group].values():
                assert item.attrs["unit"] in {"1", "Pa", "m", "m/s"}


@pytest.mark.parametrize("content", [b"", b"not hdf5", b"\x89HDF\r\n\x1a\n" + b"\0" * 100])
def test_other_files_are_refused(tmp_path, content):
    path = tmp_path / "r.h5"
    path.write_bytes(content)
    with pytest.raises(InputError, match="is not a result"):
        load(path)
    with pytest.raises(InputError, match="is not a result"):
        load(tmp_path / "absent.h5")


def test_a_truncated_result_is_refused(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(InputError, match="is not a result"):
        load(path)


def test_a_result_with_the_wrong_parts_is_refused(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    with h5py.File(path, "a") as file:
        del file["quantities"]
        file["quantities"] = 7.0
    with pytest.raises(InputError, match="is not a result"):
        load(path)
    save(result, path)
    with h5py.File(path, "a") as file:
        file.attrs["provenance"] = "[]"
    with pytest.raises(InputError, match="is not a result"):
        load(path)


def test_an_empty_hdf5_file_is_refused(tmp_path):
    h5py.File(tmp_path / "r.h5", "w").close()
    with pytest.raises(InputError, match="is not a result"):
        load(tmp_path / "r.h5")
