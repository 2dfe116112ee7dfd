"""A surface made of a profile has the statistics of the surface on which the profile was measured."""

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.fitting.profile import fit_profile
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.profile import prepare_profile
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.synthetic.description import make

LENGTH = 6.0
"""Correlation length of the Gaussian surfaces, points."""


def lines(seed, count=6, points=5000):
    """Profiles of an isotropic surface of unit variance with the autocorrelation exp(−r²/(2 LENGTH²))."""
    kernel = np.exp(-((np.arange(-40, 41) / LENGTH) ** 2))
    noise = np.random.default_rng(seed).standard_normal((count, points + 80))
    found = np.array([np.convolve(one, kernel, "valid") for one in noise])
    return found / np.sqrt((kernel**2).sum())


def slopes(surface):
    """Rms slopes along x and y, by central differences over the periodic surface."""
    return [
        float(
            np.sqrt(np.mean(((np.roll(surface.heights, -1, axis) - np.roll(surface.heights, 1, axis)) / (2 * d)) ** 2))
        )
        for axis, d in enumerate(surface.spacing)
    ]


@pytest.mark.parametrize("anisotropy", [1.0, 3.0])
def test_heights_and_slopes_are_those_of_the_surface(anisotropy):
    """Along any direction an isotropic surface has the slope of its profile, 1/LENGTH for a variance of 1."""
    found = []
    for z in lines(3):
        field = fit_profile(Profile(heights=1e-6 * z, spacing=1e-6), anisotropy=anisotropy)
        surface = make(field)
        found.append([float(surface.heights.std()), *slopes(surface)])
    rms, along, across = np.mean(found, axis=0)
    assert rms == pytest.approx(1e-6, rel=0.05)
    assert along == pytest.approx(1 / LENGTH, rel=0.05)
    assert across == pytest.approx(1 / LENGTH / anisotropy, rel=0.05)


def test_the_contact_is_that_of_the_surface_the_profile_is_of():
    """Of Gaussian surfaces of one spectrum at an area of about 8 %; single surfaces scatter by 7 %."""
    wave = np.hypot(*np.meshgrid(np.fft.fftfreq(512), np.fft.rfftfreq(512), indexing="ij"))
    amplitude = np.exp(-((np.pi * wave * LENGTH) ** 2))
    areas = []
    for seed in range(3):
        noise = np.random.default_rng(seed).standard_normal((512, 512))
        heights = np.fft.irfft2(np.fft.rfft2(noise) * amplitude)
        areas.append(rf.press(1e-7 * heights / heights.std(), spacing=1e-6, modulus=1e11, load=1e8).area_fraction)
    made = [make(fit_profile(Profile(heights=1e-7 * z, spacing=1e-6))) for z in lines(5, count=4, points=2560)]
    found = [rf.press(one, modulus=1e11, load=1e8).area_fraction for one in made]
    assert np.mean(found) == pytest.approx(np.mean(areas), rel=0.12)


def test_skewed_heights_stay_skewed():
    z = np.minimum(lines(9, count=1)[0], 0.3)
    surface = rf.fit_profile(Profile(heights=1e-6 * z, spacing=1e-6), seed=4)
    skewness = [float(np.mean(((one - one.mean()) / one.std()) ** 3)) for one in (z, surface.heights)]
    assert skewness[1] == pytest.approx(skewness[0], abs=0.15)


def test_seeds_give_other_surfaces_and_the_same_seed_the_same():
    profile = Profile(heights=1e-6 * lines(2, count=1)[0], spacing=1e-6)
    one, two, again = (rf.fit_profile(profile, seed=seed).heights for seed in (1, 2, 1))
    assert np.array_equal(one, again)
    assert not np.allclose(one, two)


@pytest.mark.parametrize(("points", "anisotropy", "message"), [(100, 1.0, "160 are needed"), (500, 0.0, "anisotropy")])
def test_too_short_profiles_and_wrong_ratios_are_refused(points, anisotropy, message):
    with pytest.raises(InputError, match=message):
        fit_profile(Profile(heights=1e-6 * lines(1, 1, points)[0], spacing=1e-6), anisotropy=anisotropy)


def test_form_and_waves_are_removed_as_the_transmission_says():
    """The Gaussian profile filter keeps exp(−π (α λ/L)²) of a wave, α² = ln 2/π: half of it at the nesting index."""
    x = np.arange(4000)
    wave = 1e-6 * np.sin(2 * np.pi * x / 100)
    long = 2e-6 * np.sin(2 * np.pi * x / 800)
    given = Profile(heights=wave + long + 1e-9 * x + 1e-12 * x**2, spacing=1e-6)
    found = prepare_profile(given, read_recipe({"form": "quadratic", "l_filter": "0.1 mm"})).heights[1000:3000]
    part = 2 * np.mean(found * np.sin(2 * np.pi * x[1000:3000] / 100))
    rest = 2 * np.mean(found[:1600] * np.sin(2 * np.pi * x[1000:2600] / 800))
    assert part == pytest.approx(0.5e-6, rel=0.01)
    assert rest == pytest.approx(2e-6 * (1 - 2 ** -(1 / 64)), rel=0.1)


@pytest.mark.parametrize("index", ["0.1 um", "9 mm"])
def test_an_index_beyond_the_profile_is_refused(index):
    with pytest.raises(InputError, match=r"^l_filter: got a nesting index of .* m; give one from the distance"):
        prepare_profile(Profile(heights=np.sin(np.arange(90.0)), spacing=1e-6), read_recipe({"l_filter": index}))
