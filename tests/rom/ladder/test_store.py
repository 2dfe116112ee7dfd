"""A stored result comes back as it was, and what is no result is refused in one line."""

import json
from dataclasses import replace

import h5py
import numpy as np
import pytest
from forging import forge

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find
from roughfilm.rom.ladder import store
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import SolverRun, with_uncertainties
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.store import as_entries, load, save


@pytest.fixture
def result(make_scene):
    return find("pocket", "inertial_reynolds").solve(make_scene(0.3, 0.25, 40))


def test_round_trip(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    back = load(path)
    assert as_entries(back) == as_entries(result)
    for name, field in result.fields.items():
        assert np.array_equal(back.fields[name].values, field.values)
        assert back.fields[name].unit == field.unit


def test_what_a_result_says_of_its_accuracy_is_stored(result, tmp_path):
    runs = (
        SolverRun(name="along", outcome="stalled", iterations=np.int64(900)),
        SolverRun(name="along", iterations=40, recipe="started by upwind", residual=1e-7, imbalance=0.01),
    )
    full = replace(
        result,
        quantities=with_uncertainties(result.quantities, {"load_plus": 0.25, "friction_plus": np.inf}),
        numerics=replace(result.numerics, processes=2, runs=runs, details={"layers": 8}),
        warnings=("the mesh is coarse", "out of range"),
        outside=("Re = 1.7e4 exceeds 1440, above which shear flow is turbulent",),
        expected_error={"load_plus": 0.02},
    )
    save(full, tmp_path / "r.h5")
    back = load(tmp_path / "r.h5")
    assert back == replace(full, quantities=back.quantities, fields=back.fields)
    assert back.quantities == full.quantities
    assert (back["load_plus"].uncertainty, back["friction_plus"].uncertainty) == (0.25, None)
    with h5py.File(tmp_path / "r.h5") as file:
        assert file["quantities/load_plus"].attrs["uncertainty"] == 0.25
        assert "uncertainty" not in file["quantities/friction_plus"].attrs


def test_a_quantity_that_is_not_there_is_answered_with_those_that_are(result):
    with pytest.raises(KeyError, match=r"'lift'.*pressure_max"):
        result["lift"]


def write_schema_2(path, provenance):
    """A file as it was before uncertainties and warnings had places of their own."""
    with h5py.File(path, "w") as file:
        file.attrs.update(schema=2, model="stokes", provenance=json.dumps(provenance))
        numbers = {"residual": 1e-9, "iterations": 7, "cpu_s": 1.5, "wall_s": 2.0}
        file.create_group("numerics").attrs.update(
            **numbers, degrees_of_freedom=64, resolution=16, tolerance=1e-8, scheme=""
        )
        for name, value in {"A11": 0.5, "mean_gap": 1e-6}.items():
            file.create_dataset(f"quantities/{name}", data=value).attrs["unit"] = "1"
        file.create_dataset("fields/gap", data=np.ones((2, 3)), compression="gzip").attrs["unit"] = "m"


def test_results_of_the_schema_before_are_read(tmp_path):
    tries = [
        {"recipe": "", "outcome": "stalled", "iterations": 3},
        {"recipe": "started by upwind", "outcome": "converged", "iterations": 4},
    ]
    old = {
        "scene": {"kind": "rough_gap"},
        "warnings": ["coarse"],
        "uncertainty": {"A11": 0.01},
        "processes": 2,
        "runs": {"along": tries},
        "equations": {"along": 2e-9},
        "imbalance": {"along": 0.001},
        "tries": tries[1:],
        "grids": [{"nodes": [9, 5], "iterations": 6}],
    }
    write_schema_2(tmp_path / "old.h5", old)
    found = load(tmp_path / "old.h5")
    assert found["A11"] == Quantity(value=0.5, unit="1", uncertainty=0.01)
    assert found["mean_gap"].uncertainty is None
    assert (found.warnings, found.provenance) == (("coarse",), {"scene": {"kind": "rough_gap"}})
    assert (found.numerics.processes, found.numerics.iterations, found.numerics.cpu_s) == (2, 7, 1.5)
    assert found.numerics.runs == (
        SolverRun(name="9 x 5", iterations=6),
        SolverRun(iterations=4, recipe="started by upwind"),
        SolverRun(name="along", outcome="stalled", iterations=3),
        SolverRun(name="along", iterations=4, recipe="started by upwind", residual=2e-9, imbalance=0.001),
    )
    assert found.fields["gap"].values.shape == (2, 3)
    save(found, tmp_path / "new.h5")
    assert as_entries(load(tmp_path / "new.h5")) == as_entries(found)


def test_an_old_result_without_warnings_is_read(tmp_path):
    write_schema_2(tmp_path / "old.h5", {"scene": {"kind": "rough_gap"}})
    found = load(tmp_path / "old.h5")
    assert (found.warnings, found.numerics.runs, found["A11"].uncertainty) == ((), (), None)


def test_a_result_of_before_ranges_were_stored_is_inside_its_range(result, tmp_path, monkeypatch):
    monkeypatch.setattr(store, "ENTRIES", {name: item for name, item in store.ENTRIES.items() if name != "outside"})
    save(replace(result, outside=("Re is too large",)), tmp_path / "old.h5")
    monkeypatch.undo()
    assert load(tmp_path / "old.h5").outside == ()


def test_results_of_an_unknown_schema_are_refused(result, tmp_path):
    save(result, tmp_path / "new.h5")
    forge(tmp_path / "new.h5", lambda file: file.attrs.update(schema=99))
    with pytest.raises(InputError, match="has schema 99; this version reads 4, solve again"):
        load(tmp_path / "new.h5")
    write_schema_2(tmp_path / "old.h5", {"scene": {"kind": "rough_gap"}})
    with h5py.File(tmp_path / "old.h5", "a") as file:
        file.attrs["schema"] = 1
    with pytest.raises(InputError, match="has schema 1; this version reads 2 to 4, solve again"):
        load(tmp_path / "old.h5")


def test_results_of_schema_3_which_had_no_header_are_read(result, tmp_path):
    save(result, tmp_path / "new.h5")
    with h5py.File(tmp_path / "new.h5") as new, h5py.File(tmp_path / "old.h5", "w") as old:
        old.attrs.update(new.attrs, schema=3)
        for name in new:
            new.copy(name, old)
    assert as_entries(load(tmp_path / "old.h5")) == as_entries(result)


def test_a_result_with_any_byte_changed_is_refused(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    whole = path.read_bytes()
    for place in np.random.default_rng(851).integers(0, len(whole), 100):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
        with pytest.raises(InputError, match=r"was damaged or changed|is not a result"):
            load(path)


def test_provenance_suffices_to_compute_it_again(result, tmp_path):
    save(result, tmp_path / "r.h5")
    stored = load(tmp_path / "r.h5")
    scene = read_scene(stored.provenance["scene"])
    again = find("pocket", stored.model).solve(scene, Request(resolution=stored.numerics.resolution))
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
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / "absent.h5")


@pytest.mark.parametrize("name", ["scene.toml", "surface.h5"])
def test_a_result_replaces_a_result_and_no_other_file(result, tmp_path, name):
    path = tmp_path / name
    if path.suffix == ".h5":
        with h5py.File(path, "w") as file:
            file.attrs["schema"], file["heights"] = 3, [[0.0, 1.0]]
    else:
        path.write_text("kind = 'pocket'", encoding="utf-8")
    before = path.read_bytes()
    with pytest.raises(InputError, match="exists and is not a result"):
        save(result, path)
    assert path.read_bytes() == before
    path.unlink()
    save(result, path)
    save(result, path)
    assert load(path).model == result.model


def test_a_truncated_result_is_refused(result, tmp_path):
    path = tmp_path / "r.h5"
    save(result, path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(InputError, match="was damaged or changed since it was written; solve again"):
        load(path)


def test_a_result_with_the_wrong_parts_is_refused(result, tmp_path):
    path = tmp_path / "r.h5"

    def flat(file):
        del file["quantities"]
        file["quantities"] = 7.0

    for change in (
        flat,
        lambda file: file.attrs.update(provenance="[]"),
        lambda file: file.attrs.update(provenance='{"scene": {"kind": "unheard-of"}}'),
        lambda file: file.attrs.__delitem__("model"),
        lambda file: file["quantities/load_plus"].attrs.__delitem__("unit"),
        lambda file: file["quantities/load_plus"].write_direct(np.array(np.nan)),
    ):
        save(result, path)
        forge(path, change)
        with pytest.raises(InputError, match=r"is damaged or incomplete \('.*'.*\); solve again$"):
            load(path)


def test_an_empty_hdf5_file_is_refused(tmp_path):
    h5py.File(tmp_path / "r.h5", "w").close()
    with pytest.raises(InputError, match="is not a result"):
        load(tmp_path / "r.h5")


def test_one_time_costs_are_read_back_and_older_files_have_none(result, tmp_path):
    dear = replace(result, numerics=replace(result.numerics, one_time={"table": 187.0, "compilation": 4.0}))
    save(dear, tmp_path / "dear.h5")
    assert load(tmp_path / "dear.h5").numerics.one_time == {"table": 187.0, "compilation": 4.0}

    def older(file):
        numerics = json.loads(file.attrs["numerics"])
        del numerics["one_time"]
        file.attrs["numerics"] = json.dumps(numerics)

    forge(tmp_path / "dear.h5", older)
    assert load(tmp_path / "dear.h5").numerics.one_time == {}
