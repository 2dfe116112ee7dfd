"""A random field fitted to the seeds of a known description has its spectrum, heights and lay, and its scatter."""

import numpy as np
import pytest
from scipy import stats

from roughfilm.contact.fitting.fit import fit_random_field
from roughfilm.contact.fitting.text import description_text
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description, read_entries
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.random_field import DECIBEL, octave_of, power_of_waves
from roughfilm.contact.synthetic.self_affine import self_affine

COUNT = 40


def self_affine_cell(seed: int, points: int = 48) -> Surface:
    """A self-affine field whose waves have random amplitudes, and a lognormal rms height of its own."""
    rms_height = 1e-6 * float(np.exp(0.3 * np.random.default_rng([seed, 7]).standard_normal()))
    return self_affine(
        size=(1e-4, 1e-4),
        points=(points, points),
        seed=seed,
        hurst=0.7,
        roll_off=4e-5,
        cut_off=6e-6,
        rms_height=rms_height,
        amplitudes="random",
    )


def with_lay(seed: int) -> Surface:
    return gaussian(
        size=(1e-4, 8e-5),
        points=(48, 40),
        seed=seed,
        rms_height=5e-7,
        correlation_length=1e-5,
        anisotropy=3.0,
        lay_angle=np.radians(40),
        amplitudes="random",
    )


@pytest.fixture(scope="module")
def cells():
    return [self_affine_cell(seed) for seed in range(COUNT)]


@pytest.fixture(scope="module")
def fitted(cells):
    return fit_random_field(cells)


def seeds_of(description, count=COUNT):
    return [make(description.model_copy(update={"seed": seed})) for seed in range(count)]


def logarithms(surfaces):
    return np.log([one.heights.std() for one in surfaces])


def test_rms_height_and_its_scatter_are_those_of_the_windows(cells, fitted):
    windows, seeds = logarithms(cells), logarithms(seeds_of(fitted, 120))
    # Two samples of one population differ in their mean by less than 3.3 standard errors, and in their deviation by
    # less than F of one in a thousand; the predictive distribution is wider by (1 + 1/n)(n - 1)/(n - 3).
    error = np.hypot(windows.std() / np.sqrt(len(windows)), seeds.std() / np.sqrt(len(seeds)))
    assert abs(windows.mean() - seeds.mean()) < 3.3 * error
    ratio = seeds.var(ddof=1) / windows.var(ddof=1)
    assert stats.f.ppf(5e-4, 119, COUNT - 1) < ratio < 1.1 * stats.f.ppf(1 - 5e-4, 119, COUNT - 1)


def test_the_power_of_each_octave_is_the_mean_of_the_windows(cells, fitted):
    def octaves(surface):
        waves = np.abs(np.fft.fft2(surface.heights, norm="forward")) ** 2
        q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(surface.shape, surface.spacing, strict=True)]
        octave = octave_of(q[0][:, None], q[1][None, :], surface.size, len(fitted.population.octaves))
        waves[0, 0] = 0
        return np.log(np.bincount(octave.ravel(), waves.ravel()))

    windows, seeds = (np.array([octaves(one) for one in some]) for some in (cells, seeds_of(fitted)))
    error = np.hypot(windows.std(axis=0), seeds.std(axis=0)) / np.sqrt(COUNT)
    filled = windows.mean(axis=0) > windows.mean(axis=0).max() - np.log(1e4)  # heights by rank leave a floor below
    assert filled.sum() >= 4
    assert (np.abs(windows.mean(axis=0) - seeds.mean(axis=0)) < 3.5 * error)[filled].all()


def test_the_table_has_the_slope_of_a_self_affine_spectrum(fitted):
    q = 2 * np.pi * np.linspace(1 / 2.5e-5, 1 / 9e-6, 12)
    power = [power_of_waves(fitted.spectrum, q * np.cos(angle), q * np.sin(angle)) for angle in np.linspace(0, 3, 9)]
    slope = np.polyfit(np.log(q), np.log(np.mean(power, axis=0)), 1)[0]
    assert slope == pytest.approx(-2 - 2 * 0.7, abs=0.25)


def test_the_spectrum_of_a_seed_sums_to_its_mean_square_height(fitted):
    for seed in seeds_of(fitted, 3):
        assert power_spectrum(seed).power.sum() == pytest.approx(seed.heights.var(), rel=1e-12)


def test_octaves_sum_to_the_mean_square_height_of_the_mean_window(cells, fitted):
    population = fitted.population
    power = np.exp(DECIBEL * np.array(population.octaves))
    assert population.rms_height == pytest.approx(np.exp(logarithms(cells).mean()), rel=0.1)
    assert (power <= 1).all()
    assert max(power) == 1


def test_lay_and_skewness_are_found_again():
    described = {
        "kind": "gaussian",
        "size": ["100 um", "80 um"],
        "points": [48, 40],
        "rms_height": "0.5 um",
        "correlation_length": "10 um",
        "anisotropy": 3,
        "lay_angle": "40 deg",
        "amplitudes": "random",
        "height_distribution": {"skewness": -0.8},
    }
    seeds = seeds_of(fit_random_field([make(read_entries({**described, "seed": seed})) for seed in range(24)]), 24)
    doubled = np.mean([np.exp(2j * np.radians(texture_direction(power_spectrum(one)))) for one in seeds])
    assert np.degrees(np.angle(doubled)) / 2 % 180 == pytest.approx(40, abs=6)
    skewness = [stats.skew(one.heights, axis=None) for one in seeds]
    assert np.mean(skewness) == pytest.approx(-0.8, abs=0.12)


def test_the_fit_of_transposed_windows_is_transposed():
    cells = [with_lay(seed) for seed in range(12)]
    turned = [
        Surface(heights=cell.heights.T, spacing=(cell.spacing[1], cell.spacing[0]), periodic=True) for cell in cells
    ]
    one, other = fit_random_field(cells), fit_random_field(turned)
    q = 2 * np.pi * np.random.default_rng(1).uniform(-1.5e5, 1.5e5, size=(2, 200))
    assert np.allclose(
        np.log(power_of_waves(one.spectrum, *q) + 1e-9),
        np.log(power_of_waves(other.spectrum, *q[::-1]) + 1e-9),
        atol=0.02,
    )
    assert np.allclose(one.population.octaves, other.population.octaves, atol=2e-3)
    assert np.allclose(one.population.heights, other.population.heights, atol=2e-6)


def test_the_fit_does_not_depend_on_the_units(cells):
    larger = [cell.with_heights(1e3 * cell.heights, spacing=tuple(1e3 * d for d in cell.spacing)) for cell in cells]
    one, other = fit_random_field(cells), fit_random_field(larger)
    assert one.spectrum.decibels == other.spectrum.decibels
    assert other.population.rms_height == pytest.approx(1e3 * one.population.rms_height, rel=1e-5)
    assert np.allclose(one.population.heights, other.population.heights, atol=2e-6)


def test_the_file_is_read_back_and_gives_the_same_seeds(fitted, tmp_path):
    path = tmp_path / "fitted.toml"
    path.write_text(description_text(fitted, ["Surface: a test."]), encoding="utf-8")
    again = read_description(path)
    assert again == fitted
    assert make(again).heights.tobytes() == make(fitted).heights.tobytes()


def test_windows_that_do_not_differ_have_no_modes():
    description = fit_random_field([self_affine_cell(0)] * 6)
    assert description.population.modes == ()
    rms = [one.heights.std() for one in seeds_of(description, 3)]
    assert rms == pytest.approx([self_affine_cell(0).heights.std()] * 3, rel=1e-2)


@pytest.mark.parametrize(
    ("cells", "worth", "words"),
    [
        ([self_affine_cell(0)] * 3, None, "take smaller windows or measure more places"),
        ([self_affine_cell(0)] * 8, 2.5, "worth 2.5 independent ones"),
        ([*[self_affine_cell(0)] * 4, self_affine_cell(1, 40)], None, "window 5: has another shape"),
        ([self_affine_cell(0).with_heights(np.zeros((48, 48)))] * 4, None, "window 1: is flat"),
    ],
)
def test_windows_without_a_fit_are_refused_in_one_line(cells, worth, words):
    with pytest.raises(InputError, match=words) as refused:
        fit_random_field(cells, worth)
    assert "\n" not in str(refused.value)
