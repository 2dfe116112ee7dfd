"""Windows are prepared alike, keep the pixels of the measurement, and are refused where they do not fit."""

import numpy as np
import pytest
from small_scenes import SEEDS

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import load_recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.sampling.plan import planned

MEASURED = {
    "kind": "gaussian",
    "size": ["0.4 mm", "0.3 mm"],
    "points": [200, 144],
    "seed": 5,
    "rms_height": "1 um",
    "correlation_length": "10 um",
    "amplitudes": "random",
}


def plan_of(given, *, set_=(), **options):
    options = {"count": 6, "size": 1e-4, "sizes": None, "name": "m", **options}
    return planned(given, load_recipe(None, set_), progress=lambda *_: None, **options)


@pytest.fixture(scope="module")
def measured():
    return make(read_entries(MEASURED)).with_heights(make(read_entries(MEASURED)).heights, periodic=False)


def test_windows_keep_the_pixels_and_come_in_three_sizes(measured):
    plan = plan_of(measured, size=1.4e-4, set_=["smoothing=1"])
    assert [group.cells[0].shape for group in plan.groups] == [(72, 64), (32, 32)]
    assert [cell.spacing for group in plan.groups for cell in group.cells] == [measured.spacing] * 12
    assert plan.groups[0].size == pytest.approx(64 * measured.spacing[1])
    assert plan.warnings[-1] == "windows of 35 µm are left out: fewer than 32 pixels along a side"


def test_warnings_of_the_measurement_stand_once_and_those_of_windows_are_counted(measured):
    kept = plan_of(measured, sizes=[])
    assert [one.split(" over ")[0] for one in kept.warnings] == ["6 of 6 windows: smoothing"]
    plan = plan_of(measured, sizes=[], set_=["edges.direction=none"])
    assert sorted(one.split(" of ", 1)[1][:18] for one in plan.warnings) == ["6 windows: periodi", "6 windows: smoothi"]


def test_places_in_a_hole_are_replaced_by_others_as_far_as_there_are_any(measured):
    """With a quarter of the surface missing, the places whose pixels are mostly missing are counted one by one."""
    invalid = np.zeros(measured.shape, dtype=bool)
    invalid[:100, :72] = True
    holed = measured.with_heights(np.where(invalid, 0.0, measured.heights), invalid=invalid)
    whole, plan = (plan_of(one, sizes=[], set_=["form=none"]) for one in (measured, holed))
    lacks = [invalid[place.slices].mean() for place in whole.groups[0].windows]
    kept = tuple(place for place, part in zip(whole.groups[0].windows, lacks, strict=True) if part < 0.25)
    assert 0 < len(kept) < 6
    assert not any(0.2 < part < 0.33 for part in lacks)
    found = plan.groups[0].windows
    assert found[: len(kept)] == kept
    assert len(found) == len(plan.groups[0].cells) == 6
    assert max(invalid[place.slices].mean() for place in found) <= 0.25
    said = f"{6 - len(kept)} of 6 places for windows of 48 x 48 pixels"
    assert any(one.startswith(said) and one.endswith(f"{6 - len(kept)} taken elsewhere") for one in plan.warnings)


def test_a_surface_without_a_place_of_valid_points_is_refused_and_one_with_scattered_gaps_is_not(measured):
    scattered = np.random.default_rng(1).random(measured.shape) < 0.4
    kept = plan_of(measured.with_heights(measured.heights, invalid=scattered), sizes=[])
    assert len(kept.groups[0].windows) == 6
    stripes = np.ones(measured.shape, dtype=bool)
    stripes[96:104] = False
    with pytest.raises(InputError, match=r"window|invalid"):
        plan_of(measured.with_heights(np.where(stripes, 0.0, measured.heights), invalid=stripes), sizes=[])


def test_a_window_is_prepared_as_the_recipe_prepares_it(measured):
    """The same cell as that of `prepare` with this window and the edges that were chosen for the whole."""
    plan = plan_of(measured, set_=["smoothing=1"])
    window, cell = plan.groups[0].windows[3], plan.groups[0].cells[3]
    start, size = (
        [n * step for n, step in zip(pair, measured.spacing, strict=True)] for pair in (window.start, window.shape)
    )
    direction = plan.source["recipe"]["edges"]["direction"]
    recipe = load_recipe(
        None,
        ["smoothing=1"],
        {
            "grid": {"points": "kept"},
            "edges": {"direction": direction},
            "window": {"start": [f"{x} m" for x in start], "size": [f"{x} m" for x in size]},
        },
    )
    assert np.array_equal(prepare(measured, recipe).surface.heights, cell.heights)


def test_the_direction_of_the_edges_is_that_of_the_whole_surface():
    lay = make(read_entries(MEASURED | {"anisotropy": 8}))
    plan = plan_of(lay.with_heights(lay.heights, periodic=False), count=9, set_=["edges.method=blended"])
    directions = {cell.source["record"]["edges"]["direction"] for group in plan.groups for cell in group.cells}
    assert directions == {"x"}
    assert len({str(cell.source["record"]["edges"]["width"]) for group in plan.groups for cell in group.cells}) == 1


def test_seeds_of_a_description_keep_its_spacing_and_differ(tmp_path):
    path = tmp_path / "rough.toml"
    path.write_text(SEEDS)
    plan = plan_of(path, count=3, size=8e-5, sizes=[4e-5])
    assert [group.seeds for group in plan.groups] == [(20071, 20072, 20073), (120071, 120072, 120073)]
    assert [group.cells[0].shape for group in plan.groups] == [(64, 64), (32, 32)]
    assert {cell.spacing for group in plan.groups for cell in group.cells} == {(1.25e-6, 1.25e-6)}
    assert len({cell.heights.tobytes() for cell in plan.groups[0].cells}) == 3
    assert np.array_equal(plan.groups[1].cells[0].heights.shape, (32, 32))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"size": 1e-3}, "size: got 1000 µm; the measurement is 300 µm wide, take less"),
        ({"size": 4e-5}, "size: got 40 µm, which is 16 pixels; a window has at least 32 along each side"),
        ({"sizes": [4e-4]}, "sizes: got 400 µm; the measurement is 300 µm wide"),
        ({"size": -1.0}, r"^size: got -1.0; it must be 1e-22 to 1e\+13 m"),
        ({"sizes": [float("nan")]}, "^sizes: got nan; it must be"),
        ({"sizes": "none"}, "^sizes: got 'none'; give a list of lengths in m"),
        ({"count": 0}, "windows: got 0; give a whole number from 1 to 10000"),
        ({"count": 2.5}, "windows: got 2.5; give a whole number from 1 to 10000"),
        ({"set_": ['window.size=["0.1 mm", "0.1 mm"]']}, "window: is set; the windows are chosen here"),
    ],
)
def test_windows_that_cannot_be_are_refused(measured, options, message):
    with pytest.raises(InputError, match=message):
        plan_of(measured, **options)


def test_a_description_without_a_seed_is_refused(tmp_path):
    path = tmp_path / "wave.toml"
    path.write_text('kind = "sinusoid"\nsize = ["1 mm", "1 mm"]\npoints = [32, 32]\namplitude = "1 um"\n')
    with pytest.raises(InputError, match="got 'sinusoid', which has no seed; all its windows are the same"):
        plan_of(path)


def test_the_default_size_is_five_decay_lengths_and_at_most_half_of_the_measurement(measured):
    rng = np.random.default_rng(1)
    plan = plan_of(measured, size=None, count=1, sizes=[])
    assert len(plan.groups) == 1
    assert plan.groups[0].size == pytest.approx(1.5e-4, rel=0.05)
    rough = Surface(heights=1e-6 * rng.normal(size=(256, 256)), spacing=(1e-6, 1e-6))
    plan = plan_of(rough, size=None, count=16)
    assert plan.groups[0].cells[0].shape == (64, 64)
    assert plan.groups[0].independent == pytest.approx(16, rel=0.01)
