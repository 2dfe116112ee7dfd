"""Sdq and Sdr are exact for planes and of second order for waves, and invalid points make no slope."""

import numpy as np
import pytest
from scipy import special

from roughfilm.contact.parameters.gradient import developed_area, rms_gradient
from roughfilm.contact.surfaces.surface import Surface


def waves(n, *, amplitude=0.3, periodic=True):
    """One sine along x with the amplitude over the wavelength times 2π as given, sampled at n by 6 points."""
    heights = amplitude / (2 * np.pi) * np.sin(2 * np.pi * (np.arange(n) + 0.3) / n)
    return Surface(heights=np.outer(heights, np.ones(6)), spacing=(1 / n, 0.7), periodic=periodic)


def test_a_horizontal_plane_has_no_slope():
    plane = Surface(heights=np.full((5, 4), 2e-6), spacing=(1e-6, 2e-6))
    assert (rms_gradient(plane), developed_area(plane)) == (0.0, 0.0)


@pytest.mark.parametrize(("a", "b"), [(0.2, 0.0), (0.0, -3.0), (0.5, 0.25), (1e-9, 1e-9)])
def test_a_tilted_plane_has_its_slope_and_its_area(a, b):
    x, y = np.arange(7) * 1e-6, np.arange(9) * 3e-6
    plane = Surface(heights=np.add.outer(a * x, b * y), spacing=(1e-6, 3e-6))
    slope = np.hypot(a, b)
    assert rms_gradient(plane) == pytest.approx(slope, rel=1e-12)
    assert developed_area(plane) == pytest.approx(slope**2 / (1 + np.sqrt(1 + slope**2)), rel=1e-12)


def test_a_sampled_wave_has_the_factor_of_its_difference():
    """⟨((z(x + dx) − z(x))/dx)²⟩ of A sin qx is (A q)²/2 times (sin(q dx/2)/(q dx/2))²."""
    for n in (3, 8, 50):
        factor = np.sin(np.pi / n) / (np.pi / n)
        assert rms_gradient(waves(n)) == pytest.approx(0.3 / np.sqrt(2) * factor, rel=1e-12)


def test_both_converge_with_second_order_to_the_integrals_of_a_wave():
    """The length of a sine with the greatest slope s is (2/π) √(1 + s²) E(s²/(1 + s²)) over its period."""
    s = 0.3
    exact = 2 / np.pi * np.sqrt(1 + s**2) * special.ellipe(s**2 / (1 + s**2)) - 1
    counts = np.array([16, 32, 64, 128])
    for errors in (
        [abs(rms_gradient(waves(n)) - s / np.sqrt(2)) for n in counts],
        [abs(developed_area(waves(n)) - exact) for n in counts],
    ):
        assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-2, abs=0.02)


def test_the_triangles_of_an_egg_box_converge_with_second_order():
    """A surface that is curved along both axes, against the integral by the rectangle rule on 512² points."""
    fine = 2 * np.pi * np.arange(512) / 512
    slopes = np.add.outer(np.sin(fine) ** 2, np.sin(fine) ** 2)  # of z = cos x + cos y
    exact = np.sqrt(1 + slopes).mean() - 1
    counts = np.array([16, 32, 64])
    errors = []
    for n in counts:
        wave = np.cos(2 * np.pi * np.arange(n) / n)
        box = Surface(heights=np.add.outer(wave, wave), spacing=(2 * np.pi / n,) * 2, periodic=True)
        errors.append(abs(developed_area(box) - exact))
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-2, abs=0.05)


def test_gentle_slopes_have_half_the_square_as_area(band_limited):
    surface = band_limited(7101, (60, 50))
    gentle = surface.with_heights(1e-3 * surface.heights)
    assert developed_area(gentle) == pytest.approx(rms_gradient(gentle) ** 2 / 2, rel=1e-6)


def test_invalid_points_make_no_slope():
    """Heights of 1 m in the holes of a tilted plane change nothing."""
    x, y = np.arange(40) * 1e-6, np.arange(30) * 1e-6
    invalid = np.random.default_rng(7102).random((40, 30)) < 0.2
    heights = np.where(invalid, 1.0, np.add.outer(0.3 * x, 0.4 * y))
    plane = Surface(heights=heights, spacing=(1e-6, 1e-6), invalid=invalid)
    assert rms_gradient(plane) == pytest.approx(0.5, rel=1e-9)
    assert developed_area(plane) == pytest.approx(np.sqrt(1.25) - 1, rel=1e-9)


def test_the_edges_of_a_periodic_surface_are_neighbours():
    """One step of height 1 in a line of eight points: two pairs of eight differ, one of seven if it is open."""
    heights = np.outer(np.repeat([0.0, 1.0], 4), np.ones(3))
    periodic = Surface(heights=heights, spacing=(1.0, 1.0), periodic=True)
    assert rms_gradient(periodic) == pytest.approx(np.sqrt(2 / 8), rel=1e-12)
    assert rms_gradient(Surface(heights=heights, spacing=(1.0, 1.0))) == pytest.approx(np.sqrt(1 / 7), rel=1e-12)


def test_points_without_neighbours_have_no_slope():
    invalid = np.add.outer(np.arange(4), np.arange(4)) % 2 == 1
    surface = Surface(heights=np.eye(4), spacing=(1.0, 1.0), invalid=invalid)
    assert rms_gradient(surface) is None
    assert developed_area(surface) is None


def test_each_pair_of_a_periodic_surface_counts_once():
    heights = np.random.default_rng(7103).normal(size=(6, 5))
    along_x = (np.roll(heights, -1, axis=0) - heights) / 2.0
    along_y = (np.roll(heights, -1, axis=1) - heights) / 3.0
    surface = Surface(heights=heights, spacing=(2.0, 3.0), periodic=True)
    assert rms_gradient(surface) ** 2 == pytest.approx((along_x**2).mean() + (along_y**2).mean(), rel=1e-12)
