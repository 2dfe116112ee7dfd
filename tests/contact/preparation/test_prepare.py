"""The whole recipe: reproducible to the byte, honest about what it did, and sound on real surfaces."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.roughness_parameters import parameters
from roughfilm.contact.preparation.filters import l_filter, s_filter
from roughfilm.contact.preparation.prepare import level, prepare
from roughfilm.contact.preparation.recipe import Recipe, read_recipe, recipe_entries
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD
from roughfilm.contact.surfaces.store import load_surface, save_surface
from roughfilm.contact.surfaces.surface import Surface


def measured(seed=841, lay=1.0):
    """Tilted, bent, with holes, spikes and edges that do not meet; ridges along x where ``lay`` is above 1."""
    rng = np.random.default_rng(seed)
    n = 400
    q = np.hypot(lay * np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None, :]) * n
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(n, n))) * (q < 60), s=(n, n))[:300, :220]
    heights /= heights.std()
    x, y = np.meshgrid(np.linspace(-1, 1, 300), np.linspace(-1, 1, 220), indexing="ij")
    invalid = rng.random(heights.shape) < 0.02
    heights[17, 19] += 40
    heights[170, 40] -= 30
    return Surface(
        heights=1e-6 * (heights + 5 * x - 3 * y + 4 * x * y + 100), spacing=(1.2e-6, 1.7e-6), invalid=invalid
    )


def test_twice_the_same_recipe_gives_the_same_bytes(tmp_path):
    recipe = read_recipe({"window": {"size": ["250 um", "280 um"]}})
    for name in ("a.h5", "b.h5"):
        save_surface(prepare(measured(), recipe).surface, tmp_path / name)
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()


def test_the_stored_surface_knows_its_recipe_and_what_was_done(tmp_path):
    recipe = read_recipe({"form": "tilt", "smoothing": 5})
    prepared = prepare(measured(), recipe)
    save_surface(prepared.surface, tmp_path / "s.h5")
    source = load_surface(tmp_path / "s.h5").source
    assert read_recipe(source["recipe"]) == recipe
    assert source["record"]["invalid"]["points"] == int(measured().invalid.sum())


def test_every_step_leaves_its_mark():
    given = measured()
    prepared = prepare(given, Recipe())
    record = prepared.record
    assert np.abs(prepared.measured.heights[prepared.measured.valid].mean()) < 1e-9
    assert record["invalid"]["residual"] <= 1e-9
    assert record["outliers"]["spikes"] + record["outliers"]["rims"] == 2
    assert (record["outliers"]["above"], record["outliers"]["below"]) == (0, 0)
    assert record["filled"]["points"] == record["invalid"]["points"] + 2
    assert np.ptp(prepared.surface.heights) < 0.3 * np.ptp(prepared.measured.heights)
    assert prepared.surface.shape == tuple(record["window"]["pixels"])
    pixels = np.array(record["window"]["pixels"])
    assert np.array_equal(pixels + record["edges"]["shortened"], given.shape)
    assert prepared.surface.size == pytest.approx(pixels * given.spacing)
    assert prepared.surface.periodic
    assert record["periodicity_mismatch"]["before"] > 0.5
    assert record["periodicity_mismatch"]["after"] < MISMATCH_THRESHOLD
    assert [one.partition(" lowers")[0] for one in prepared.warnings] == ["smoothing over 3 points"]


def test_filters_follow_the_outliers_and_precede_the_window():
    """A spike does not spread: the heights are those of the filters on the surface without outliers."""
    given = measured()
    entries = {"s_filter": "6 um", "l_filter": "80 um", "grid": {"points": "kept"}, "edges": {"direction": "none"}}
    prepared = prepare(given, read_recipe(entries))
    levelled = level(given, read_recipe({}))
    expected = l_filter(s_filter(levelled.trusted, 6e-6), 80e-6)
    valid = expected.valid
    assert not valid[17, 19]
    assert np.array_equal(prepared.measured.invalid, ~valid)
    assert np.array_equal(prepared.measured.heights, expected.heights)
    assert np.array_equal(prepared.surface.heights[valid], expected.heights[valid])
    assert prepared.record["scale"] == {"form": "quadratic", "s_filter": 6e-6, "l_filter": 80e-6}


def test_nesting_indices_beyond_pixels_and_sides_warn():
    warnings = prepare(measured(), read_recipe({"s_filter": "4 um", "l_filter": "0.5 mm"})).warnings
    assert [warning.partition(":")[0] for warning in warnings] == ["s_filter", "l_filter"]


@pytest.mark.parametrize("method", ["seams", "blended"])
def test_edges_and_middle_are_those_of_their_steps(method):
    prepared = prepare(measured(), read_recipe({"grid": {"points": "kept"}, "edges": {"method": method}}))
    middle = (slice(60, 200), slice(50, 150))
    assert np.array_equal(prepared.joined.heights[middle], prepared.cell.heights[middle])
    assert prepared.cell.shape == prepared.joined.shape == prepared.joint.weight.shape
    assert prepared.record["edges"]["blended_fraction"] == np.mean(prepared.joint.weight > 0)
    assert prepared.record["edges"]["mean_weight"] == pytest.approx(prepared.joint.weight.mean())
    assert (prepared.cell.shape == (300, 220)) == (method == "blended")


def test_a_window_inside_of_the_measurement_keeps_its_size():
    entries = {"window": {"size": ["240 um", "255 um"], "start": ["60 um", "60 um"]}, "grid": {"points": "kept"}}
    prepared = prepare(measured(), read_recipe(entries))
    assert prepared.record["window"] == {"start": [50, 35], "pixels": [200, 150]}
    assert prepared.record["edges"]["shortened"] == [0, 0]


@pytest.mark.parametrize(("transposed", "direction"), [(False, "x"), (True, "y")])
def test_a_strong_lay_is_blended_along_itself_only(transposed, direction):
    given = measured(842, lay=12.0)
    if transposed:
        given = Surface(heights=given.heights.T, spacing=(1.7e-6, 1.2e-6), invalid=given.invalid.T)
    blended = prepare(given, read_recipe({"edges": {"method": "blended"}}))
    assert blended.record["edges"]["direction"] == direction
    assert prepare(given, Recipe()).record["edges"]["direction"] == "both"


def test_without_a_lay_all_edges_are_joined():
    assert prepare(measured(), Recipe()).record["edges"]["direction"] == "both"


@pytest.mark.parametrize("heights", [np.full((40, 40), 3e-6), np.arange(40.0)[:, None] * np.ones(40) * 1e-6])
def test_a_surface_without_roughness_is_refused(heights):
    with pytest.raises(InputError, match="there is no roughness to prepare"):
        prepare(Surface(heights=heights, spacing=(1e-6, 1e-6)), Recipe())


def test_a_surface_of_guesses_warns():
    given = measured()
    invalid = given.invalid | (np.random.default_rng(843).random(given.shape) < 0.4)
    warnings = prepare(given.with_heights(given.heights, invalid=invalid), Recipe()).warnings
    assert any(warning.startswith(f"{100 * invalid.mean():.0f} % of the points were invalid") for warning in warnings)


def test_a_window_of_guesses_is_refused_and_the_measurement_too():
    given = measured(845)
    invalid = np.zeros(given.shape, bool)
    invalid[100:250, 20:200] = True
    hole = {"window": {"start": ["132 um", "51 um"], "size": ["120 um", "170 um"]}}
    with pytest.raises(InputError, match=r"^window: 100 % of its points are invalid; choose another window"):
        prepare(given.with_heights(given.heights, invalid=invalid), read_recipe(hole))
    invalid[:] = True
    invalid[:, ::20] = False
    with pytest.raises(InputError, match=r"^invalid points: they are 95 % of all; measure again"):
        prepare(given.with_heights(given.heights, invalid=invalid), Recipe())


def test_a_second_preparation_keeps_the_record_of_the_first():
    first = prepare(measured(), Recipe()).surface
    again = prepare(first, read_recipe({"smoothing": 1})).surface
    assert again.source["prepared_from"] == first.source
    assert first.source["prepared_from"] == measured().source


def test_pixels_far_from_square_get_a_width_each():
    given = measured(846)
    flat = Surface(heights=given.heights[:, :24], spacing=(1e-6, 20e-6), invalid=given.invalid[:, :24])
    prepared = prepare(
        flat, read_recipe({"grid": {"points": "kept"}, "edges": {"method": "blended", "direction": "both"}})
    )
    assert prepared.record["edges"]["width"][1] >= 10e-6


def test_a_joint_that_stays_bad_warns():
    """The thesis's surface 3a: slanted ridges that a blend along them cannot make meet."""
    x, y = np.meshgrid(np.arange(256), np.arange(256), indexing="ij")
    ridges = np.sin(2 * np.pi * (x / 32 + 0.5 * y / 256)) * 1e-6
    prepared = prepare(Surface(heights=ridges, spacing=(1e-6, 1e-6)), read_recipe({"edges": {"direction": "y"}}))
    assert any(warning.startswith("periodicity mismatch") for warning in prepared.warnings)


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        (
            {"window": {"size": ["1 mm", "1 mm"], "start": ["0 m", "0 m"]}},
            "^window: got 833 pixels from pixel 0 along x",
        ),
        ({"window": {"size": ["1 mm", "1 mm"]}}, "^window: got at least 834 pixels along x, where the surface has 300"),
        ({"edges": {"direction": "x", "width": "1 mm"}}, "^edges: got a width of .* pixels along x; give"),
        ({"s_filter": "1 mm"}, "^s_filter: got a nesting index of 0.001 m, longer than the shorter side"),
        ({"l_filter": "1 um"}, "^l_filter: got a nesting index of 1e-06 m, shorter than the pixel spacing"),
        ({"grid": {"points": [12, 12]}, "smoothing": 13}, "^smoothing: got 13 points"),
        ({"grid": {"points": [50_000, 50_000]}}, "^grid: got 50000 x 50000 points; at most 100000000 are made"),
        ({"window": {"size": ["1e13 m", "1e13 m"]}}, "^window: got at least 1000000000 pixels along x"),
        (
            {"window": {"size": ["10 um", "10 um"], "start": ["-1e13 m", "0 m"]}},
            "^window: got .* from pixel -1000000000",
        ),
    ],
)
def test_a_step_that_cannot_be_taken_says_which(entries, message):
    with pytest.raises(InputError, match=message):
        prepare(measured(), read_recipe(entries))


@pytest.mark.measured
@pytest.mark.parametrize("name", ["milled_NT1100.opd", "polished.opd", "polished_with_spikes.sur"])
def test_real_surfaces_keep_their_roughness_and_lose_their_spikes(measured_file, name):
    prepared = prepare(read_surface(measured_file(name)), Recipe())
    before, after = parameters(prepared.measured), parameters(prepared.surface)
    assert after["Sa"].value == pytest.approx(before["Sa"].value, rel=0.12)
    assert after["Sz"].value < 0.8 * before["Sz"].value
    assert recipe_entries(Recipe()) == prepared.surface.source["recipe"]


@pytest.mark.measured
@pytest.mark.parametrize("method", ["seams", "blended"])
def test_striations_that_slant_are_warned_of_and_a_shorter_window_mends_them(measured_file, method):
    """What the thesis found of its surface 3: the longer the window along the lay, the worse the joint."""
    surface = read_surface(measured_file("ground_striated.x3p"))
    whole = prepare(surface, read_recipe({"edges": {"method": method}}))
    part = prepare(surface, read_recipe({"edges": {"method": method}, "window": {"size": ["40 um", "40 um"]}}))
    assert any("mismatch" in warning for warning in whole.warnings)
    assert part.record["periodicity_mismatch"]["after"] < 0.2 * whole.record["periodicity_mismatch"]["after"]
    assert method == "seams" or not part.warnings


@pytest.mark.measured
@pytest.mark.parametrize(
    "name", ["milled_NT1100.opd", "oblique_grooves.x3p", "periodic_grooves.plu", "isotropic.al3d", "polished.opd"]
)
def test_seams_of_measured_surfaces_fit_and_mix_a_few_points_only(measured_file, name):
    surface = read_surface(measured_file(name))
    by_seams, blended = (
        prepare(surface, read_recipe({"edges": {"method": method}})).record for method in ("seams", "blended")
    )
    assert by_seams["periodicity_mismatch"]["after"] < MISMATCH_THRESHOLD
    assert by_seams["edges"]["blended_fraction"] < 0.6 * blended["edges"]["blended_fraction"]
    assert by_seams["edges"]["mean_weight"] < 0.2 * blended["edges"]["mean_weight"]
