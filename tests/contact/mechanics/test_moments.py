"""Spectral moments: of waves by their closed forms, of Gaussian surfaces by their summits."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.moments import SpectralMoments, wave_power
from roughfilm.contact.synthetic.distribution import rms_slope
from roughfilm.contact.synthetic.gaussian import gaussian


def gaussian_surface(seed, points=(256, 256)):
    """Smooth, of many bumps: 15 pixels a correlation length."""
    return gaussian(
        size=(1e-3, 1e-3), points=points, seed=seed, rms_height=1e-6, correlation_length=6e-5, amplitudes="random"
    )


def summits(z):
    """Points above all eight neighbours."""
    around = [np.roll(z, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    return (z > np.max(around, axis=0)).nonzero()


@pytest.mark.parametrize("count", [64, 65])
def test_waves_along_a_profile_add_their_squares(count):
    """½A² q^n of each, from the derivatives of cos."""
    x = np.arange(count) * 2e-6
    q = 2 * np.pi / (count * 2e-6) * np.array([1, 5, 12])
    amplitudes = np.array([3e-6, 1e-6, 4e-7])
    z = (amplitudes * np.cos(np.outer(x, q) + np.array([0.3, 1, 2]))).sum(axis=1) + 7e-6
    found = wave_power(z[:, None], (2e-6, 1.0)).moments
    assert found.line
    for name, power in (("m0", 0), ("m2", 2), ("m4", 4)):
        assert getattr(found, name) == pytest.approx(np.sum(amplitudes**2 / 2 * q**power), rel=1e-12)
    assert wave_power(z[None, :], (1.0, 2e-6)).moments.m4 == pytest.approx(found.m4, rel=1e-12)
    assert found.rms_slope == pytest.approx(np.sqrt(np.sum(amplitudes**2 / 2 * q**2)), rel=1e-12)


@pytest.mark.parametrize("shape", [(40, 30), (41, 31), (40, 31)])
def test_moments_of_a_surface_are_the_mean_over_profiles_in_all_directions(shape):
    """A wave A cos(q·x) seen along θ has the wave number q cos θ."""
    spacing = (1e-6, 2e-6)
    (nx, ny), (m, n) = shape, (4, -7)
    q = 2 * np.pi * np.array([m / (nx * spacing[0]), n / (ny * spacing[1])])
    z = 1e-6 * np.cos(q[0] * spacing[0] * np.arange(nx)[:, None] + q[1] * spacing[1] * np.arange(ny))
    found = wave_power(z, spacing).moments
    seen = np.hypot(*q) * np.cos(np.linspace(0, 2 * np.pi, 24, endpoint=False))
    assert found.m0 == pytest.approx(5e-13, rel=1e-12)
    assert found.m2 == pytest.approx(5e-13 * np.mean(seen**2), rel=1e-12)
    assert found.m4 == pytest.approx(5e-13 * np.mean(seen**4), rel=1e-12)
    assert found.rms_slope == pytest.approx(1e-6 * np.hypot(*q) / np.sqrt(2), rel=1e-12)
    assert found.nayak == pytest.approx(1.5)


def test_they_are_those_of_the_surface_whatever_the_grid():
    coarse, fine = (gaussian_surface(3019, points) for points in ((60, 60), (128, 90)))
    one, other = (wave_power(surface.heights, surface.spacing) for surface in (coarse, fine))
    assert one.power.sum() == pytest.approx(coarse.heights.var(), rel=1e-12)
    assert one.moments.rms_slope == pytest.approx(rms_slope(coarse), rel=1e-12)
    for name in ("m0", "m2", "m4"):
        assert getattr(one.moments, name) == pytest.approx(getattr(other.moments, name), rel=2e-3)
    assert (np.diff(one.wave_numbers) >= 0).all()


def test_of_a_gaussian_autocorrelation_they_have_closed_forms():
    """exp(−t²/l²): m2 = 2m0/l², m4 = 12m0/l⁴; l = λ/sqrt(ln 5), where it is 0.2 at λ.

    The part πl²/L² of m0, which is constant height, is left out of the surface.
    """
    surface = gaussian(size=(1e-3, 1e-3), points=(128, 128), seed=3023, rms_height=1e-6, correlation_length=6e-5)
    found = wave_power(surface.heights, surface.spacing).moments
    length = 6e-5 / np.sqrt(np.log(5))
    whole = found.m0 / (1 - np.pi * length**2 / 1e-6)
    assert found.m0 == pytest.approx(1e-12, rel=1e-12)
    assert found.m2 == pytest.approx(2 * whole / length**2, rel=1e-4)
    assert found.m4 == pytest.approx(12 * whole / length**4, rel=1e-4)


def test_summits_of_gaussian_surfaces_are_as_many_and_as_high_as_predicted():
    """Counted on 8 surfaces of some 1000 summits together."""
    surfaces = [gaussian_surface(seed) for seed in range(3041, 3049)]
    moments = [wave_power(s.heights, s.spacing).moments for s in surfaces]
    counted = [summits(s.heights) for s in surfaces]
    heights = np.concatenate([s.heights[where] for s, where in zip(surfaces, counted, strict=True)])
    curvatures = np.concatenate(
        [
            sum(2 * s.heights - np.roll(s.heights, 1, axis) - np.roll(s.heights, -1, axis) for axis in (0, 1))[where]
            / (2 * s.spacing[0] ** 2)
            for s, where in zip(surfaces, counted, strict=True)
        ]
    )
    assert heights.size / 8e-6 == pytest.approx(np.mean([m.summit_density for m in moments]), rel=0.04)
    assert heights.mean() == pytest.approx(np.mean([m.summit_mean for m in moments]), rel=0.08)
    assert heights.std() == pytest.approx(np.mean([m.summit_spread for m in moments]), rel=0.05)
    assert 1 / curvatures.mean() == pytest.approx(np.mean([m.summit_radius for m in moments]), rel=0.04)


def test_peaks_of_gaussian_profiles_are_as_many_and_as_high_as_predicted():
    """Counted on a profile of some 4500 peaks."""
    count, band = 1 << 17, 6000
    random = np.random.default_rng(3061)
    waves = np.zeros(count // 2 + 1, dtype=complex)
    waves[1:band] = random.normal(size=(band - 1, 2)).view(complex)[:, 0]
    z = np.fft.irfft(waves, count)
    moments = wave_power(z[:, None], (1 / count, 1.0)).moments
    peaks = (z > np.roll(z, 1)) & (z > np.roll(z, -1))
    curvatures = (2 * z - np.roll(z, 1) - np.roll(z, -1))[peaks] * count**2
    assert np.count_nonzero(peaks) == pytest.approx(moments.summit_density, rel=0.02)
    assert z[peaks].mean() == pytest.approx(moments.summit_mean, rel=0.02)
    assert z[peaks].std() == pytest.approx(moments.summit_spread, rel=0.02)
    assert 1 / curvatures.mean() == pytest.approx(moments.summit_radius, rel=0.02)


@pytest.mark.parametrize(
    ("heights", "spacing", "words"),
    [
        (np.arange(4.0), (1.0, 1.0), "nx, ny"),
        (np.zeros((4, 4)), (1.0, 1.0), "all the same"),
        (np.full((4, 4), np.nan), (1.0, 1.0), "heights"),
        (np.eye(4), (0.0, 1.0), "spacing"),
    ],
)
def test_what_makes_no_sense_is_refused(heights, spacing, words):
    with pytest.raises(InputError, match=words):
        wave_power(heights, spacing)


@pytest.mark.parametrize("values", [(0.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, np.inf), (1.0, 2.0, 1.0)])
def test_moments_no_profile_has_are_refused(values):
    with pytest.raises(InputError, match="moments"):
        SpectralMoments(**dict(zip(("m0", "m2", "m4"), values, strict=True)), line=True)
