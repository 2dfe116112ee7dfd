"""Wear of a known volume is found within its uncertainty; two walls that face each other add up."""

import json

import numpy as np
import pytest
from scipy import ndimage

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.registration.combine import composite, difference
from roughfilm.contact.surfaces.store import load_surface, save_surface
from roughfilm.contact.surfaces.surface import Surface

SIDE, EDGE = 110, 15
N = SIDE + 2 * EDGE


def rough(rng, shape=(N, N), short=0.15):
    """A random periodic surface with rms height 1, and its Fourier coefficients."""
    q = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1]))
    waves = np.fft.rfft2(rng.normal(size=shape)) * np.where(q < short, np.maximum(q, 1 / 40) ** -1.8, 0)
    heights = np.fft.irfft2(waves, s=shape)
    return heights / heights.std(), waves / heights.std()


def worn_pair(seed):
    """Before and after, and the volume per area that is gone over ``SIDE`` squared pixels, times them, m."""
    rng = np.random.default_rng(seed)
    before, waves = rough(rng)
    shift, noise = rng.uniform(-8, 8, 2), 10 ** rng.uniform(-2, -1)
    phase = np.fft.fftfreq(N)[:, None] * shift[0] + np.fft.rfftfreq(N) * shift[1]
    after = np.fft.irfft2(waves * np.exp(-2j * np.pi * phase), s=(N, N))
    x, y = np.meshgrid(np.arange(N), np.arange(N), indexing="ij")
    radius, depth, (i, j) = rng.uniform(12, 25), rng.uniform(0.5, 3), N / 2 + rng.uniform(-10, 10, 2)
    scar = depth * np.maximum(1 - ((x - i) ** 2 + (y - j) ** 2) / radius**2, 0)
    after = after - scar + 0.002 * x - 0.003 * y + 5
    inner = np.s_[EDGE:-EDGE, EDGE:-EDGE]
    pair = [
        Surface(heights=1e-6 * (z + noise * rng.normal(size=(N, N)))[inner], spacing=(1e-6, 2e-6))
        for z in (before, after)
    ]
    return pair, 1e-6 * np.pi * radius**2 * depth / 2, 1e-6 * depth  # a paraboloid


def test_the_volume_and_depth_of_a_scar_lie_within_their_uncertainty():
    """Of 12 random scars on random surfaces with noise, sub-pixel shift and tilt; chance allows 1 or 2 to miss."""
    missed = {"volume": 0, "depth": 0}
    for seed in range(12):
        (before, after), volume, depth = worn_pair(950 + seed)
        found = difference(before, after)
        gone, deepest = (found.quantities[name] for name in ("worn_volume_per_area", "largest_depth"))
        expected = volume / found.surface.heights.size
        missed["volume"] += abs(gone.value - expected) > gone.uncertainty
        missed["depth"] += abs(deepest.value - depth) > deepest.uncertainty
        assert gone.value == pytest.approx(expected, rel=0.1)
        assert deepest.value == pytest.approx(depth, rel=0.15)
        assert not found.warnings
    assert max(missed.values()) <= 2


def test_two_measurements_of_one_place_differ_by_noise_alone():
    rng = np.random.default_rng(961)
    heights, _ = rough(rng)
    pair = [Surface(heights=1e-6 * (heights + 0.1 * rng.normal(size=(N, N))), spacing=(1e-6, 1e-6)) for _ in range(2)]
    combined = difference(*pair)
    found = combined.quantities
    assert found["noise"].value == pytest.approx(0.1e-6 * np.sqrt(2), rel=0.05)
    assert found["worn_fraction"].value == 0
    assert (found["worn_volume_per_area"].value, found["worn_volume_per_area"].uncertainty) == (0, None)
    assert combined.warnings[-1].startswith("no place differs by more than noise")


@pytest.mark.parametrize("offset", [0.0, 1e-3])
@pytest.mark.parametrize("short", [0.15, 1.0])
def test_a_measurement_against_itself_has_no_wear(offset, short):
    """Equal heights, also with another zero of the instrument, differ by rounding, which is no wear and no noise."""
    for seed in range(4):
        heights = 1e-6 * rough(np.random.default_rng(seed), (64, 60), short)[0]
        before, after = (Surface(heights=z, spacing=(1e-6, 1e-6)) for z in (heights, heights + offset))
        found = difference(before, after)
        sizes = {name: one.value for name, one in found.quantities.items() if not name.startswith("shift")}
        assert sizes.pop("correlation") == pytest.approx(1, abs=1e-12)
        assert sizes.pop("common_fraction") == 1
        assert set(sizes.values()) == {0.0}
        assert not found.surface.heights.any()
        assert "no place differs by more than noise" in found.warnings[-1]


def test_a_rotation_that_spoils_the_difference_warns():
    """By 0.4° a difference keeps the scar; by 4° the unworn points differ by half of their height."""
    rng = np.random.default_rng(962)
    heights, _ = rough(rng)
    x, y = np.meshgrid(np.arange(N) - N / 2, np.arange(N) - N / 2, indexing="ij")
    scar = np.maximum(1 - (x**2 + y**2) / 20**2, 0)
    inner = np.s_[EDGE:-EDGE, EDGE:-EDGE]
    before = Surface(heights=1e-6 * heights[inner], spacing=(1e-6, 1e-6))
    warned = []
    for angle in np.radians([0.4, 4.0]):
        c, s = np.cos(angle), np.sin(angle)
        turned = ndimage.map_coordinates(heights, [c * x + s * y + N / 2, c * y - s * x + N / 2], mode="grid-wrap")
        after = Surface(heights=1e-6 * (turned - scar)[inner], spacing=(1e-6, 1e-6))
        warned.append(any("rotation" in warning for warning in difference(before, after).warnings))
    assert warned == [False, True]


def test_a_plane_through_all_points_hides_part_of_a_wide_scar():
    (before, after), *_ = worn_pair(970)
    unworn, every = (difference(before, after, level=level) for level in ("unworn", "all"))
    assert "the level is that of all points" in every.warnings[-1]
    assert not any("zero by definition" in one for one in unworn.warnings)
    unworn, every = unworn.quantities, every.quantities
    assert (every["worn_volume_per_area"].value, every["worn_volume_per_area"].uncertainty) == (0, None)
    assert every["largest_depth"].value < unworn["largest_depth"].value


def test_a_coarser_measurement_is_met_on_its_own_grid():
    """After, measured with pixels of twice the size; the waves are 10 pixels long and more."""
    rng = np.random.default_rng(971)
    heights, _ = rough(rng, (160, 160), short=0.1)
    coarse = heights[20:140, 20:140].reshape(60, 2, 60, 2).mean(axis=(1, 3))
    before = Surface(heights=1e-6 * heights, spacing=(1e-6, 1e-6))
    found = difference(before, Surface(heights=1e-6 * coarse, spacing=(2e-6, 2e-6)))
    assert found.surface.spacing == (2e-6, 2e-6)
    assert found.quantities["shift_x"].value == pytest.approx(20e-6, abs=0.02e-6)
    assert found.quantities["noise"].value < 0.02e-6


def test_walls_add_up_mirrored_and_uncorrelated_ones_by_their_squares():
    rng = np.random.default_rng(972)
    first, second = (Surface(heights=1e-6 * rough(rng)[0], spacing=(1e-6, 1e-6), periodic=True) for _ in range(2))
    found = composite(first, second)
    assert np.abs(found.surface.heights - first.heights - second.heights[:, ::-1]).max() < 1e-20 + 1e-12 * 1e-6
    assert found.surface.periodic
    one, two, both, r = (found.quantities[k].value for k in ("Sq_first", "Sq_second", "Sq_sum", "correlation"))
    assert both**2 == pytest.approx(one**2 + two**2 + 2 * r * one * two, rel=1e-12)
    assert both**2 == pytest.approx(one**2 + two**2, rel=0.2)
    across = composite(first, second, mirror="x").surface.heights
    assert np.allclose(across, first.heights + second.heights[::-1], rtol=0, atol=1e-17)


def test_a_periodic_wall_is_moved_around_its_period():
    rng = np.random.default_rng(973)
    first, second = (Surface(heights=1e-6 * rough(rng)[0], spacing=(1e-6, 2e-6), periodic=True) for _ in range(2))
    found = composite(first, second, shift=(7e-6, -10e-6), mirror="none").surface
    assert np.abs(found.heights - first.heights - np.roll(second.heights, (7, -5), axis=(0, 1))).max() < 1e-17


def test_a_wall_and_its_replica_interlock():
    rng = np.random.default_rng(974)
    heights, _ = rough(rng)
    wall = Surface(heights=1e-6 * heights[:100, :90], spacing=(1e-6, 1e-6))
    replica = Surface(heights=-1e-6 * heights[9:120, 3:110][:, ::-1], spacing=(1e-6, 1e-6))
    found = composite(wall, replica, shift="registered")
    assert [found.quantities[f"shift_{axis}"].value for axis in "xy"] == pytest.approx([9e-6, 3e-6], abs=1e-11)
    assert found.quantities["Sq_sum"].value < 0.2 * found.quantities["Sq_first"].value
    assert found.quantities["correlation"].value < -0.95


def test_the_result_is_stored_with_the_sources_of_both(tmp_path):
    (before, after), *_ = worn_pair(975)
    holes = np.zeros(before.shape, bool)
    holes[20:30, 40:45] = True
    found = difference(before.with_heights(before.heights, invalid=holes, source={"file": "b.x3p"}), after)
    save_surface(found.surface, tmp_path / "d.h5")
    stored = load_surface(tmp_path / "d.h5")
    assert stored.source["combined_from"][0] == {"file": "b.x3p"}
    assert stored.source["combination"]["operation"] == "difference"
    assert stored.source["combination"] == json.loads(json.dumps(dict(found.record)))
    assert 50 <= stored.invalid.sum() <= 100


def test_the_recipe_is_taken_by_both():
    (before, after), *_ = worn_pair(976)
    recipe = read_recipe({"form": "tilt", "outliers": {"limit": 0}, "s_filter": "6 um"})
    plain, smooth = difference(before, after), difference(before, after, recipe)
    assert smooth.quantities["noise"].value < 0.7 * plain.quantities["noise"].value


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda one, two: difference(one, two, shift=(105e-6, 0.0)), "^registration: the surfaces overlap by 5 pixels"),
        (lambda one, two: composite(one, two, mirror="z"), "^mirror: got 'z'; it must be one of x, y, none"),
    ],
)
def test_faults_are_refused_in_one_line(call, message):
    (before, after), *_ = worn_pair(977)
    with pytest.raises(InputError, match=message):
        call(before, after)
