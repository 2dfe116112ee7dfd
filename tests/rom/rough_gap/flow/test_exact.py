"""Exact Stokes flow in rough gaps: ridges, low waves and smooth cells, by methods that know nothing of each other."""

from dataclasses import astuple, replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.homogenization.exact import nearly_smooth, sinusoid
from roughfilm.rom.rough_gap.flow.exact import ridge_flow, sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.flow.ritz import ritz_flow
from roughfilm.rom.rough_gap.flow.waves import THIN_RESPONSE, attenuation, nearly_smooth_flow, wall_response
from roughfilm.rom.rough_gap.walls import Walls

SEED = 7753


def numbers(flow):
    return np.array(astuple(flow))


def collocated(amplitude, wavelength, waves=14):
    """A across and along ridges under a flat wall: solutions in the strip, fitted on the walls at a pressure of 12."""
    q = 2 * np.pi * np.arange(1, waves + 1) / wavelength
    x = (np.arange(4 * waves) + 0.5) / (8 * waves) * wavelength

    def modes(z, crest):
        """Stream functions with ∇⁴ψ = 0: value, ∂/∂z and ∂/∂x; and harmonic functions; even in x."""
        cosine, sine = np.cos(np.outer(x, q)), np.sin(np.outer(x, q))
        up, down = np.exp(q * (z[:, None] - 1)), np.exp(-q * (z[:, None] - crest))
        tall = z[:, None]
        value = [up, down, tall * up, tall * down]
        rise = [q * up, -q * down, (1 + q * tall) * up, (1 - q * tall) * down]
        psi = [np.ones_like(z)[:, None], z[:, None], z[:, None] ** 2]
        psi_z = [0 * z[:, None], np.ones_like(z)[:, None], 2 * z[:, None]]
        stream = np.hstack(psi + [f * cosine for f in value])
        along = np.hstack(psi_z + [f * cosine for f in rise])
        aside = np.hstack([0 * one for one in psi] + [-f * q * sine for f in value])
        harmonic = np.hstack([np.ones_like(z)[:, None], z[:, None], up * cosine, down * cosine])
        return stream, along, aside, harmonic

    lower, upper = -amplitude * np.cos(2 * np.pi * x / wavelength), np.ones_like(x)
    low, high = modes(lower, -amplitude), modes(upper, -amplitude)
    matrix = np.vstack([low[1], low[2], high[1], high[2]])
    wanted = np.concatenate([6 * lower**2, 0 * lower, 6 * upper**2, 0 * upper])
    fitted = np.linalg.lstsq(matrix, wanted, rcond=1e-15)[0]
    assert np.abs(matrix @ fitted - wanted).max() < 1e-7
    across = (high[0] @ fitted - 2 * upper**3) - (low[0] @ fitted - 2 * lower**3)
    fitted = np.linalg.lstsq(np.vstack([low[3], high[3]]), np.concatenate([6 * lower**2, 6 * upper**2]), rcond=1e-15)[0]
    s, weights = np.polynomial.legendre.leggauss(30)
    along = 0.0
    for t, weight in zip((s + 1) / 2, weights / 2, strict=True):
        z = lower + t * (upper - lower)
        along += weight * ((modes(z, -amplitude)[3] @ fitted - 6 * z**2) * (upper - lower)).mean()
    return across.mean(), along


@pytest.mark.parametrize(("amplitude", "length"), [(0.3, 10.0), (0.1, 4.0), (0.05, 1.5)])
def test_ridges_agree_with_modes_of_the_strip(amplitude, length):
    found = sinusoidal_ridge_flow(amplitude, length)
    assert (found.across, found.along) == pytest.approx(collocated(amplitude, length), rel=1e-6)


def test_long_ridges_tend_to_thin_films_with_the_square_of_slope():
    across, along = sinusoid(0.6), sinusoid(0.6, direction=np.pi / 2)
    thin = np.array(
        [
            across.pressure[0, 0],
            across.pressure[1, 1],
            across.shear[0],
            along.shear[0],
            across.couette + 3 * across.shear_couette,
            along.couette + 3 * along.shear_couette,
        ]
    )
    off = [numbers(sinusoidal_ridge_flow(0.6, length)) - thin for length in (40.0, 80.0)]
    assert np.abs(off[1]).max() < 0.01
    assert np.log2(off[0] / off[1]) == pytest.approx(2, abs=0.05)


def along_x(profile, spacing):
    lower = np.tile(np.asarray(profile)[:, None], (1, 2))
    return Walls(lower=lower, upper=np.ones_like(lower), spacing=(spacing, 1.0))


@pytest.mark.parametrize("length", [12.0, 3.0, 1.5])
def test_low_ridges_tend_to_perturbation_theory_with_the_fourth_power(length):
    off = []
    for amplitude in (0.02, 0.04):
        wave = amplitude * np.cos(2 * np.pi * np.arange(8) / 8)
        walls = along_x(wave, length / 8)
        turned = Walls(lower=walls.lower.T, upper=walls.upper.T, spacing=walls.spacing[::-1])
        low, aside = nearly_smooth_flow(walls), nearly_smooth_flow(turned)
        stated = [*np.diag(low.pressure), low.shear[0], aside.shear[0], low.friction, aside.friction]
        off.append(numbers(sinusoidal_ridge_flow(amplitude, length, tolerance=1e-10)) - stated)
    clear = np.abs(off[1]) > 1e-8
    assert clear.sum() >= 4
    assert np.log2(off[1][clear] / off[0][clear]) == pytest.approx(4, abs=0.1)


def test_both_walls_low():
    n, length, height = 16, 4.0, 0.01
    x = 2 * np.pi * np.arange(n) / n
    lower, upper = height * np.cos(x), 1 + 0.8 * height * np.cos(x + 1.1)
    found = ridge_flow(lower, upper, length)
    walls = Walls(
        lower=np.tile(lower[:, None], (1, 2)), upper=np.tile(upper[:, None], (1, 2)), spacing=(length / n, 1.0)
    )
    stated = nearly_smooth_flow(walls).pressure
    assert (found.across, found.along) == pytest.approx((stated[0, 0], stated[1, 1]), abs=20 * height**4)
    assert np.isnan(found.drag)


def test_perturbation_theory_without_slope_is_that_of_thin_films():
    rng = np.random.default_rng(SEED)
    lower = rng.normal(size=(12, 10)) * 0.01
    walls = Walls(lower=lower, upper=np.ones_like(lower), spacing=(0.3, 0.2))
    stated, thin = nearly_smooth_flow(walls, stokes=False), nearly_smooth(walls.gap, walls.spacing)
    assert stated.pressure == pytest.approx(thin.pressure, abs=1e-12)
    assert stated.shear == pytest.approx(thin.shear, abs=1e-12)
    assert stated.friction == pytest.approx(thin.couette + 3 * thin.shear_couette, abs=1e-12)


def test_walls_answer_long_waves_as_thin_films_do_and_short_ones_alone():
    assert wall_response(0.0) == pytest.approx(THIN_RESPONSE)
    k = 60.0
    assert wall_response(k) == pytest.approx(np.array([[1, 1], [0.5, 0.5]]) * k, rel=0.06)
    assert wall_response(1e6) == pytest.approx(np.array([[1, 1], [0.5, 0.5]]) * 1e6, rel=1e-5)
    k = np.array([0.3, 0.9, 1.1])
    s, c = np.sinh(k), np.cosh(k)
    direct = [[k * (c - 1) / (s - k), k * (c + 1) / (s + k)], [k / 2 * np.tanh(k / 2), k / 2 / np.tanh(k / 2)]]
    assert wall_response(k) == pytest.approx(np.array(direct), rel=1e-11)
    assert np.all(np.diff(attenuation(np.geomspace(3, 1e3, 40)), axis=-1) < 0)


def test_ridges_moved_mirrored_and_turned_over_are_the_same():
    x = 2 * np.pi * np.arange(24) / 24
    wave = 0.2 * np.cos(x) + 0.1 * np.sin(2 * x + 0.5)
    one = numbers(ridge_flow(wave, np.ones(24), 6.0, tolerance=1e-5))
    assert numbers(ridge_flow(np.roll(wave, 7), np.ones(24), 6.0, tolerance=1e-5)) == pytest.approx(one, rel=2e-5)
    assert numbers(ridge_flow(wave[::-1] * 3, 3 * np.ones(24), 18.0, tolerance=1e-5)) == pytest.approx(one, rel=2e-5)
    over = ridge_flow(-np.ones(24), -wave, 6.0, tolerance=1e-5)
    assert (over.across, over.along) == pytest.approx(one[:2], rel=2e-5)
    even, shifted = (0.3 * np.cos(x + phase) for phase in (0.0, 0.4))
    pair = [numbers(ridge_flow(wall, np.ones(24), 4.0)) for wall in (even, shifted)]
    assert pair[0] == pytest.approx(pair[1], rel=1e-7)


def test_cells_of_ridges_are_ridges():
    wave = 0.25 * np.cos(2 * np.pi * np.arange(8) / 8)
    lower = np.add.outer(wave, np.zeros(8))
    found = ritz_flow(Walls(lower=lower, upper=np.ones_like(lower), spacing=(0.625, 0.7)), tolerance=3e-4)
    exact = sinusoidal_ridge_flow(0.25, 5.0)
    assert np.diag(found.pressure) == pytest.approx([exact.across, exact.along], abs=3e-4)
    assert found.pressure[0, 1] == pytest.approx(0, abs=1e-9)
    assert found.shear == pytest.approx([exact.drag, 0], abs=3e-4)
    assert found.friction == pytest.approx(exact.friction, abs=3e-4)


def test_low_cells_are_as_perturbation_theory_has_them():
    n, height = 8, 0.01
    x, y = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(n) / n, indexing="ij")
    lower = height * (np.cos(x + y) + np.sin(x) - 0.7 * np.cos(y + 0.4))
    walls = Walls(lower=lower, upper=np.ones_like(lower), spacing=(0.5, 0.6))
    for own in (walls, replace(walls, upper=1 + np.roll(lower.T, 1, axis=0))):
        found, stated = ritz_flow(own, tolerance=1e-5), nearly_smooth_flow(own)
        assert found.pressure == pytest.approx(stated.pressure, abs=60 * height**3)
        if own.slides:
            assert found.shear == pytest.approx(stated.shear, abs=60 * height**3)
            assert found.friction == pytest.approx(stated.friction, abs=60 * height**3)


def test_what_cannot_be_solved_is_stated():
    with pytest.raises(InputError, match=r"amplitude 1\.0"):
        sinusoidal_ridge_flow(1.0, 3.0)
    with pytest.raises(InputError, match="must not touch"):
        ridge_flow([0, 1, 0, -1], np.ones(4), 3.0)
    with pytest.raises(InputError, match="shapes"):
        ridge_flow([0, 1, 0], np.ones(4), 3.0)
    with pytest.raises(InputError, match="tolerance 0"):
        ridge_flow(np.zeros(4), np.ones(4), 3.0, tolerance=0)
    with pytest.raises(ConvergenceError, match="loosen the tolerance"):
        ridge_flow([0.9, 0, -0.9, 0], np.ones(4), 0.2, max_unknowns=200)
    contact = np.zeros((4, 4))
    contact[1, 1] = 1.0
    with pytest.raises(InputError, match="touch"):
        ritz_flow(Walls(lower=contact, upper=np.ones((4, 4)), spacing=(1.0, 1.0)))
