"""The quantities of each window are those of the models, and a run that stops goes on with what is finished."""

import math
from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
from batches import Threads
from places import SCENES
from small_scenes import CONTACT, SEAL, SEEDS

import roughfilm as rf
from roughfilm.batch.jobs import Failure
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.recipe import load_recipe
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.sampling.answer import answer_of
from roughfilm.sampling.asked import Asked, asked_of, with_cell
from roughfilm.sampling.plan import planned
from roughfilm.sampling.rows import row_path
from roughfilm.sampling.run import examined


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    place = tmp_path_factory.mktemp("sampling")
    for name, text in {"rough.toml": SEEDS, "seal.toml": SEAL, "contact.toml": CONTACT}.items():
        (place / name).write_text(text)
    return place


@pytest.fixture(scope="module")
def plan(place):
    plan = planned(
        place / "rough.toml",
        load_recipe(),
        count=5,
        size=8e-5,
        sizes=[4e-5],
        name="rough.toml",
        progress=lambda *_: None,
    )
    save_surface(plan.groups[0].cells[0], place / "cell.h5")
    return plan


def rows_of(plan, asked, directory=None, workers=None, progress=lambda *_: None):
    return examined(plan, asked, directory=directory, place=workers or nullcontext(), progress=progress)


def test_a_window_of_a_seal_has_the_answers_of_the_models(plan, place):
    asked = asked_of(place / "seal.toml", place / "cell.h5", sealing=True)
    row = rows_of(plan, asked).by_group[0][0]
    scene = rf.load_scene(place / "seal.toml", set={"geometry.surface": str(place / "cell.h5")})
    result = rf.solve(scene, model="direct_leakage")
    for name in ("leakage_per_width", "area_fraction", "mean_gap"):
        assert row.quantities[name] == result.quantities[name]
    factors = rf.flow_factors(plan.groups[0].cells[0], gap=1e-5)  # names and units alone
    assert {"A11", "A12", "A22", "B1", "d", "e"} <= row.quantities.keys() & factors.keys()
    permeability = rf.solve(scene, model="homogenized_leakage").quantities["permeability"]
    along = row.quantities["A22"]
    assert along.value * row.quantities["mean_gap"].value ** 3 == pytest.approx(permeability.value, rel=1e-3)
    assert along.uncertainty > 0
    for factor, sealed in ((0.99, 0), (1.01, 1)):
        load = f"{factor * row.quantities['sealing_load'].value} Pa"
        pressed = rf.solve(rf.replace(scene, "load.pressure", load), model="direct_leakage")
        assert pressed.quantities["sealed"].value == sealed


def test_a_window_of_a_dry_contact_has_the_answers_of_the_model(plan, place):
    row = rows_of(plan, asked_of(place / "contact.toml", place / "cell.h5")).by_group[0][0]
    scene = rf.load_scene(place / "contact.toml", set={"geometry.surface": str(place / "cell.h5")})
    result = rf.solve(scene, model="elastic")
    assert row.quantities["area_fraction"] == result.quantities["area_fraction"]
    assert row.quantities["mean_contact_pressure"] == result.quantities["mean_contact_pressure"]
    assert row.quantities["rms_height"].value == plan.groups[0].cells[0].heights.std()


def test_a_window_without_a_scene_has_its_parameters_and_flow_factors(plan):
    row, cell = rows_of(plan, Asked(gap=5e-7)).by_group[0][1], plan.groups[0].cells[1]
    assert row.quantities["Sal"] == rf.parameters(cell)["Sal"]
    assert row.quantities["A11"] == rf.flow_factors(cell, gap=5e-7)["A11"]
    assert "Std" not in row.quantities


def test_a_bearing_with_the_windows_as_its_roughness(plan, place):
    scene = rf.load_scene(SCENES / "rough_washer.toml", set={"load.pressure": "1 MPa", "roughness.scale": 4.0})
    asked = asked_of(scene, place / "cell.h5", resolution=16)
    row = rows_of(planned_of_one(plan), asked).by_group[0][0]
    assert row.failure is None, row.failure
    bearing = with_cell(asked, place / "cell.h5")
    (curve,) = rf.stribeck(bearing, [bearing.motion.speed], [1e6], resolution=16)
    assert row.quantities["friction_coefficient"].value == pytest.approx(curve.points[0].friction_coefficient, rel=1e-3)


def planned_of_one(plan):
    first = plan.groups[0]
    return replace(plan, groups=(replace(first, cells=first.cells[:1], seeds=first.seeds[:1], independent=1.0),))


def test_scenes_that_have_no_place_for_a_window_are_refused(place, plan):  # noqa: ARG001 (writes the cell)
    with pytest.raises(InputError, match="kind: got 'pocket'; windows are put into scenes of the kinds dry_contact"):
        asked_of(SCENES / "pocket.toml", place / "cell.h5")
    with pytest.raises(InputError, match=r"roughness[.]kind: got None; windows are put into a roughness of the kind"):
        asked_of(SCENES / "washer.toml", place / "cell.h5")


class Stop(BaseException):
    """Ends a run."""


def test_a_stopped_run_goes_on_where_it_was(plan, place, tmp_path):
    asked = asked_of(place / "contact.toml", place / "cell.h5")
    whole = rows_of(plan, asked)

    def stop(_done, words):
        if words.startswith("4 of"):
            raise Stop

    with pytest.raises(Stop):
        rows_of(plan, asked, tmp_path, progress=stop)
    rest = rows_of(plan, asked, tmp_path)
    assert rest.found == 4
    for first, second in zip(whole.by_group, rest.by_group, strict=True):
        assert [row.quantities for row in first] == [row.quantities for row in second]


def test_rows_of_another_scene_and_damaged_ones_are_computed_again(plan, place, tmp_path, caplog):
    asked = asked_of(place / "contact.toml", place / "cell.h5")
    rows_of(plan, asked, tmp_path)
    assert rows_of(plan, asked, tmp_path).found == 10
    next(row_path(tmp_path, "x").parent.iterdir()).write_text('{\n "row_of": "')
    assert rows_of(plan, asked, tmp_path).found == 9
    edited = next(row_path(tmp_path, "x").parent.iterdir())
    edited.write_text(edited.read_text().replace("0.", "1."))
    assert rows_of(plan, asked, tmp_path).found == 9
    assert [record.getMessage() for record in caplog.records][-1].startswith(f"{edited}: was damaged or changed; its ")
    scene = rf.load_scene(place / "contact.toml", set={"load.pressure": "20 kPa"})
    assert rows_of(plan, asked_of(scene, place / "cell.h5"), tmp_path).found == 0
    assert len(list((tmp_path / "rows").iterdir())) == 10


def test_workers_give_the_same_rows(plan, place):
    asked = asked_of(place / "contact.toml", place / "cell.h5")
    here, there = rows_of(plan, asked), rows_of(plan, asked, workers=Threads(1))
    for first, second in zip(here.by_group, there.by_group, strict=True):
        assert [row.quantities for row in first] == [row.quantities for row in second]


def test_windows_that_fail_are_left_out_and_said(plan, place):
    asked = asked_of(place / "contact.toml", place / "cell.h5")
    rows = rows_of(plan, asked)
    failure = Failure(kind="ConvergenceError", message="it stalled", outcome="stalled")
    own = [replace(rows.by_group[0][0], quantities={}, failure=failure), *rows.by_group[0][1:]]
    answer = answer_of(plan, asked, replace(rows, by_group=(tuple(own), rows.by_group[1])), 0.05)
    assert answer.quantities["area_fraction"].scatter.values.size == 4
    assert answer.quantities["area_fraction"].lacking == 1
    assert "1 of 10 windows have no answer and are left out; the first: it stalled" in answer.warnings
    none = [replace(row, quantities={}, failure=failure) for row in own]
    with pytest.raises(rf.ConvergenceError, match="no window has an answer; the first: it stalled"):
        answer_of(plan, asked, replace(rows, by_group=(tuple(none), rows.by_group[1])), 0.05)


def test_a_measurement_whose_halves_differ_is_said():
    """Two halves of different roughness; one of equal roughness is not reported."""
    rng = np.random.default_rng(1)
    flat = rng.normal(size=(256, 256))
    for factor, reported in ((1.0, False), (1.4, True)):
        heights = 1e-6 * flat * np.where(np.arange(256) < 128, 1.0, factor)[:, None]
        found = rf.windows(rf.Surface(heights=heights, spacing=(1e-6, 1e-6)), count=16, sizes=[32e-6])
        assert any("two halves of the measurement differ" in one for one in found.warnings) == reported
        assert math.isfinite(found.quantities["Sq"].drift)
