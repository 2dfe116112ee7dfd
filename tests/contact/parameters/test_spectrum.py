"""The power spectrum holds the mean square, each wave in its place, and the lay is across the wave vector."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.spectrum import angular_power, power_spectrum, radial_power, texture_direction
from roughfilm.contact.surfaces.surface import Surface


def ridges(degrees, *, shape=(200, 160), spacing=(1e-6, 1.5e-6), period=1.7e-5, amplitude=1e-6):
    """Waves whose ridges run at an angle from the x axis: not periodic."""
    x, y = (np.arange(n) * d for n, d in zip(shape, spacing, strict=True))
    across = np.add.outer(-x * np.sin(np.radians(degrees)), y * np.cos(np.radians(degrees)))
    return Surface(heights=amplitude * np.sin(2 * np.pi * across / period + 0.4), spacing=spacing)


def waves(kx, ky, *, shape=(60, 84), spacing=(1e-6, 1.5e-6), amplitude=1e-6):
    """A whole number of waves along each side: periodic."""
    x, y = (np.arange(n) / n for n in shape)
    heights = amplitude * np.sin(2 * np.pi * np.add.outer(kx * x, ky * y) + 0.7)
    return Surface(heights=heights, spacing=spacing, periodic=True)


def apart(a, b):
    """Angle between two directions without sense, degrees."""
    return abs((a - b + 90) % 180 - 90)


@pytest.mark.parametrize("shape", [(16, 20), (15, 20), (16, 21), (15, 21), (2, 2), (3, 2)])
@pytest.mark.parametrize("periodic", [True, False])
def test_its_sum_is_the_mean_square(shape, periodic):
    heights = np.random.default_rng(6201).normal(size=shape)
    spectrum = power_spectrum(Surface(heights=heights, spacing=(1.0, 2.0), periodic=periodic))
    assert spectrum.power.shape == (shape[0], shape[1] // 2 + 1)
    assert spectrum.power.sum() == pytest.approx(heights.var())
    assert spectrum.power.min() >= 0
    assert radial_power(spectrum)[1].sum() == pytest.approx(heights.var())
    assert angular_power(spectrum)[1].sum() == pytest.approx(heights.var())


@pytest.mark.parametrize(("kx", "ky"), [(3, 0), (0, 5), (7, 4), (-7, 4)])
def test_a_wave_is_in_its_place(kx, ky):
    spectrum = power_spectrum(waves(kx, ky))
    frequency = np.abs(np.meshgrid(*spectrum.frequencies, indexing="ij"))
    mine = (np.abs(frequency[0] - abs(kx) / 60e-6) < 1) & (np.abs(frequency[1] - ky / 126e-6) < 1)
    assert spectrum.power[mine].sum() == pytest.approx(0.5e-12, rel=1e-9)
    rings, power = radial_power(spectrum)
    assert rings[power.argmax()] == pytest.approx(np.hypot(kx / 60e-6, ky / 126e-6), abs=0.5 / 60e-6)
    assert power.max() == pytest.approx(0.5e-12, rel=1e-9)


@pytest.mark.parametrize(("kx", "ky"), [(3, 0), (0, 5), (1, 1), (-1, 1), (7, 4), (-7, 4), (1, 30)])
def test_the_lay_of_a_periodic_wave_is_exact(kx, ky):
    """Its wave vector is (kx/Lx, ky/Ly), its ridges run along (−ky/Ly, kx/Lx)."""
    expected = np.degrees(np.arctan2(kx / 60e-6, -ky / 126e-6)) % 180
    found = texture_direction(power_spectrum(waves(kx, ky)))
    assert 0 <= found < 180
    assert apart(found, expected) < 1e-9


@pytest.mark.parametrize(("waves_across", "tolerance"), [(5, 0.6), (12, 0.1), (25, 0.015)])
def test_the_lay_of_any_ridges_is_found_between_the_wave_vectors(waves_across, tolerance):
    for degrees in (0, 3, 30, 45, 59, 77.7, 90, 111, 135, 163.2, 179):
        surface = ridges(degrees, period=2e-4 / waves_across)
        assert apart(texture_direction(power_spectrum(surface)), degrees) < tolerance, degrees


def test_an_open_edge_makes_no_cross():
    """Without fading out, the jump at the edges of oblique ridges puts a hundredth of the power towards 0° and 90°."""
    angle, power = angular_power(power_spectrum(ridges(37.0)))
    near = np.abs(angle - 37) < 30
    assert power[~near].sum() < 1e-4 * power.sum()


def test_of_two_lays_the_stronger_counts_not_their_mean():
    strong, weak = ridges(20.0), ridges(100.0, amplitude=0.8e-6)
    assert apart(texture_direction(power_spectrum(strong.with_heights(strong.heights + weak.heights))), 20) < 0.1


def test_rough_ridges_in_noise_with_holes_keep_their_lay():
    surface = ridges(64.0)
    generator = np.random.default_rng(6202)
    heights = surface.heights + generator.normal(scale=5e-7, size=surface.shape)
    holed = surface.with_heights(heights, invalid=generator.random(surface.shape) < 0.1)
    assert apart(texture_direction(power_spectrum(holed)), 64) < 0.3


def test_long_waves_do_not_pull_the_lay_to_an_axis():
    """A bow over the whole width lies on the wave vectors of the axes only because no others are that long."""
    surface = ridges(80.0)
    bow = 1.5e-6 * np.cos(2 * np.pi * np.arange(200) / 200)[:, None]
    assert apart(texture_direction(power_spectrum(surface.with_heights(surface.heights + bow))), 80) < 0.5


def test_turning_the_lay_by_a_right_angle_turns_std_too():
    surface = ridges(20.0, spacing=(1e-6, 1e-6), shape=(160, 160))
    turned = surface.with_heights(np.rot90(surface.heights))
    assert apart(texture_direction(power_spectrum(turned)), texture_direction(power_spectrum(surface)) - 90) < 1e-6


def test_isotropic_power_has_no_direction():
    k = np.fft.fftfreq(256, 1 / 256)
    amplitude = np.exp(-np.add.outer(k**2, k**2) / (2 * 30**2))
    noise = np.fft.fft2(np.random.default_rng(6203).normal(size=(256, 256)))
    surface = Surface(heights=np.fft.ifft2(amplitude * noise / np.abs(noise)).real, spacing=(1.0, 1.0), periodic=True)
    _, power = angular_power(power_spectrum(surface), 36)
    np.testing.assert_allclose(power, power.mean(), rtol=0.05)


def test_the_ring_of_a_wavelength_holds_its_part():
    surface, fine = waves(2, 1), waves(10, 8, amplitude=0.5e-6)
    rings, power = radial_power(power_spectrum(surface.with_heights(surface.heights + fine.heights)))
    assert power[rings > 5e4].sum() == pytest.approx(0.125e-12, rel=1e-9)


def test_no_sectors_are_refused():
    with pytest.raises(InputError, match="at least 1"):
        angular_power(power_spectrum(waves(3, 0)), 0)


def test_constant_heights_have_none():
    with pytest.raises(InputError, match="all the same"):
        power_spectrum(Surface(heights=np.full((5, 5), 0.1), spacing=(1.0, 1.0)))
