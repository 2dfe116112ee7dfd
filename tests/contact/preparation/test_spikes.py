"""Spikes and spiked rims of holes are found whatever their height; ridges, scratches, pits and summits are kept."""

import numpy as np
import pytest
import scipy

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.preparation.form import remove_form
from roughfilm.contact.preparation.prepare import level, prepare
from roughfilm.contact.preparation.recipe import Recipe, read_recipe
from roughfilm.contact.preparation.spikes import find_spikes
from roughfilm.contact.surfaces.surface import Surface

RMS = 0.91e-6
COUNT = 128
AS_MEASURED = {"grid": {"points": "kept"}, "smoothing": 1}
"""A recipe that keeps all heights away from the edges."""


def rough(seed=861, *, tilted=True):
    """A self-affine surface with an rms height of 0.91 µm, tilted and bent by 30 µm."""
    rng = np.random.default_rng(seed)
    q = np.hypot(np.fft.fftfreq(COUNT)[:, None], np.fft.rfftfreq(COUNT)[None, :]) * COUNT
    amplitudes = np.where((q > 0) & (q < COUNT / 4), np.maximum(q, 4.0) ** -1.8, 0)
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(COUNT, COUNT))) * amplitudes, s=(COUNT, COUNT))
    x = np.linspace(-1, 1, COUNT)
    form = 20e-6 * x[:, None] - 8e-6 * x[None, :] + 5e-6 * x[:, None] ** 2
    return Surface(heights=RMS * heights / heights.std() + tilted * form, spacing=(2e-6, 2e-6))


def holes(*centres, radius=6.8):
    """Masks of round holes and of the rims of single points around them."""
    x, y = np.indices((COUNT, COUNT))
    invalid = np.any([np.hypot(x - i, y - j) < radius for i, j in centres], axis=0)
    return invalid, scipy.ndimage.binary_dilation(invalid, np.ones((3, 3))) & ~invalid


def spiked(surface, where, by, invalid=()):
    return surface.with_heights(surface.heights + np.where(where, by, 0.0), invalid=np.array(invalid, bool))


def mean_gap(surface, pressure=50e6):
    return Press(surface.heights, surface.spacing, 230e9).at(pressure).mean_gap


RIMS = {
    "60 um": lambda rng, rim: 60e-6,
    "1 mm": lambda rng, rim: 1e-3,
    "-60 um": lambda rng, rim: -60e-6,
    "up to 60 um": lambda rng, rim: rng.uniform(20e-6, 60e-6, rim.shape),
    "both signs": lambda rng, rim: 60e-6 * rng.choice([-1, 1], rim.shape),
}


@pytest.mark.parametrize("kind", RIMS)
def test_a_spiked_rim_around_a_hole_changes_neither_the_heights_nor_the_gap(kind):
    """The reference is the surface whose rim is marked as invalid by hand."""
    invalid, rim = holes((40, 70))
    given = spiked(rough(), rim, RIMS[kind](np.random.default_rng(862), rim), invalid)
    found = prepare(given, read_recipe(AS_MEASURED))
    by_hand = prepare(rough().with_heights(rough().heights, invalid=invalid | rim), read_recipe(AS_MEASURED))
    without = prepare(rough(), read_recipe(AS_MEASURED))
    assert found.record["outliers"]["rims"] == rim.sum()
    assert found.record["filled"]["points"] == rim.sum() + invalid.sum()
    assert found.surface.heights.std() == pytest.approx(by_hand.surface.heights.std(), rel=1e-3)
    assert found.surface.heights.std() == pytest.approx(without.surface.heights.std(), rel=0.02)
    assert mean_gap(found.surface) == pytest.approx(mean_gap(by_hand.surface), rel=2e-3)


WIDE = {
    "two points, up to 60 um": (2, lambda rng, distance: rng.uniform(5e-6, 60e-6, distance.shape)),
    "three points, 60 um": (3, lambda rng, distance: 60e-6),
    "four points, up to 60 um": (4, lambda rng, distance: rng.uniform(5e-6, 60e-6, distance.shape)),
}


@pytest.mark.parametrize("kind", WIDE)
def test_a_wide_rim_is_found_whole(kind):
    width, heights = WIDE[kind]
    invalid, _ = holes((40, 70))
    rim = scipy.ndimage.binary_dilation(invalid, np.ones((3, 3)), iterations=width) & ~invalid
    given = spiked(rough(), rim, heights(np.random.default_rng(868), rim), invalid)
    assert np.array_equal(level(given, Recipe()).trusted.invalid, invalid | rim)


@pytest.mark.parametrize("seed", range(8))
def test_a_few_spikes_anywhere_and_of_any_height_change_the_rms_height_by_a_hundredth(seed):
    rng = np.random.default_rng(863 + seed)
    count = rng.integers(1, 17)
    places = rng.integers(0, COUNT, (2, count))
    given = rough(seed).heights.copy()
    given[tuple(places)] += rng.choice([-1, 1], count) * RMS * 10 ** rng.uniform(0, 6, count)
    clean, with_spikes = (
        prepare(Surface(heights=heights, spacing=(2e-6, 2e-6)), read_recipe(AS_MEASURED)).surface.heights.std()
        for heights in (rough(seed).heights, given)
    )
    assert with_spikes == pytest.approx(clean, rel=0.02)


def test_spikes_of_several_points_are_found_whole():
    given = rough(tilted=False)
    where = np.zeros(given.shape, bool)
    where[20:27, 30:37] = where[90, 60:66] = where[0:3, 126:128] = True
    found = find_spikes(spiked(given, where, 50e-6), limit=4.0)
    assert np.array_equal(found.spikes, where)
    assert not found.rims.any()


def test_the_form_is_that_without_the_spikes():
    clean = rough()
    where = np.zeros(clean.shape, bool)
    where[3, 5:9] = where[100, 2] = True
    fitted_by_hand = remove_form(clean, "quadratic", ignored=where)
    found = level(spiked(clean, where, 1e-2), Recipe())
    assert np.array_equal(found.trusted.invalid, where)
    assert np.allclose(found.measured.heights[~where], fitted_by_hand.heights[~where], rtol=0, atol=1e-9 * RMS)


def texture(kind):
    """A surface with one rare feature of great height that belongs to it."""
    x, y = np.indices((COUNT, COUNT)) - COUNT / 2.0
    shapes = {
        "a scratch of one pixel": -20 * (y == 5),
        "a slanting scratch": -20 * (np.abs(x - 3 * y) < 2),
        "a short scratch": -20 * ((y == 5) & (np.abs(x) < 6)),
        "a ridge": 20 * (np.abs(x - 0.5 * y) < 1.5),
        "a groove": -20 * (np.abs(x) < 3),
        "a step": 20 * (x > 50),
        "a summit": 15 * np.exp(-(x**2 + y**2) / 30),
        "a pit": -15 * np.exp(-(x**2 + y**2) / 30),
        "a plateau": 20 * (np.hypot(x, y) < 6),
    }
    return spiked(rough(tilted=False), np.ones((COUNT, COUNT), bool), RMS * shapes[kind])


@pytest.mark.parametrize(
    "kind",
    [
        *("a scratch of one pixel", "a slanting scratch", "a short scratch", "a ridge", "a groove", "a step"),
        *("a summit", "a pit", "a plateau"),
    ],
)
def test_what_is_longer_or_wider_than_a_spike_is_kept(kind):
    assert not find_spikes(texture(kind), limit=4.0).points.any()


def test_the_walls_of_a_pit_with_an_invalid_bottom_are_kept():
    given = texture("a pit")
    bottom = given.heights < -8 * RMS
    assert bottom.sum() > 20
    assert not find_spikes(given.with_heights(given.heights, invalid=bottom), limit=4.0).points.any()


def test_a_surface_of_two_thirds_invalid_points_keeps_the_others():
    invalid = np.random.default_rng(865).random((COUNT, COUNT)) < 0.67
    given = rough(tilted=False)
    assert not find_spikes(given.with_heights(given.heights, invalid=invalid), limit=4.0).points.any()


def marred():
    """A surface with holes, a part of whose rims is spiked, and with spikes of either sign."""
    invalid, rim = holes((40, 70), (90, 20), radius=5)
    rng = np.random.default_rng(866)
    where = (rim & (rng.random(rim.shape) < 0.7)) | (rng.random(rim.shape) < 0.002)
    return spiked(
        rough(tilted=False), where, RMS * rng.choice([-1, 1], rim.shape) * rng.uniform(5, 90, rim.shape), invalid
    )


CHANGES = {
    "unit": (lambda s: s.with_heights(1e3 * s.heights, spacing=(2e-3, 2e-3)), lambda mask: mask),
    "offset": (lambda s: s.with_heights(s.heights + 1e-3), lambda mask: mask),
    "sign": (lambda s: s.with_heights(-s.heights), lambda mask: mask),
    "transposition": (lambda s: s.with_heights(s.heights.T, invalid=s.invalid.T), lambda mask: mask.T),
    "reflection": (lambda s: s.with_heights(s.heights[::-1], invalid=s.invalid[::-1]), lambda mask: mask[::-1]),
}


@pytest.mark.parametrize("change", CHANGES)
def test_the_same_points_are_found_in_other_units_and_directions(change):
    changed, back = CHANGES[change]
    one, other = find_spikes(marred(), limit=4.0), find_spikes(changed(marred()), limit=4.0)
    assert one.spikes.any()
    assert one.rims.any()
    assert np.array_equal(one.spikes, back(other.spikes))
    assert np.array_equal(one.rims, back(other.rims))


def test_a_larger_limit_finds_fewer_and_zero_nothing():
    counts = [int(find_spikes(marred(), limit=limit).points.sum()) for limit in (4.0, 20.0, 0.0)]
    assert counts[0] > counts[1] > counts[2] == 0


def test_many_spikes_are_said():
    where = np.random.default_rng(867).random((COUNT, COUNT)) < 0.02
    warnings = prepare(spiked(rough(), where, 40e-6), Recipe()).warnings
    assert any("were taken for spikes or rims of invalid regions" in warning for warning in warnings)


MOST_FOUND = {
    "milled_NT1100.opd": 0.0,
    "oblique_grooves.x3p": 0.0,
    "periodic_grooves.plu": 0.0,
    "ground_striated.x3p": 0.0,
    "isotropic.al3d": 0.0,
    "polished.opd": 5e-4,
    "stitching_artefacts.txt": 0.0,
}


@pytest.mark.measured
@pytest.mark.parametrize("name", MOST_FOUND)
def test_a_measured_surface_without_spikes_keeps_its_points(measured, name):
    assert find_spikes(measured(name), limit=4.0).points.mean() <= MOST_FOUND[name]


@pytest.mark.measured
def test_a_measured_surface_with_spikes_loses_them(measured):
    """Its rms height is then that of the 99.8 % of its points in the middle, and not twice that."""
    surface = measured("polished_with_spikes.sur")
    found = find_spikes(surface, limit=4.0).points
    middle = surface.heights[surface.valid]
    middle = middle[np.abs(middle - np.median(middle)) <= np.quantile(np.abs(middle - np.median(middle)), 0.998)]
    assert 0.0005 < found.mean() < 0.002
    assert surface.heights[surface.valid & ~found].std() == pytest.approx(middle.std(), rel=0.1)
