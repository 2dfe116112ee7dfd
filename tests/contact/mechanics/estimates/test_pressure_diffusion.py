"""Diffusing pressures: against the equation on a grid, and what the walls take."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import eigh_tridiagonal
from scipy.special import erf

from roughfilm.contact.mechanics.estimates.pressure_diffusion import PressureDiffusion


def inner(diffusion):
    """Area and load of the density, by quadrature over the ten standard deviations that count."""
    low = max(0.0, diffusion.load - 10 * diffusion.spread)
    high = min(diffusion.hardness, diffusion.load + 10 * diffusion.spread)
    return [
        quad(lambda p, n=n: p**n * diffusion.density(p), low, high, points=[diffusion.load], limit=400)[0]
        for n in (0, 1)
    ]


@pytest.mark.parametrize("load", [0.1, 0.97])
@pytest.mark.parametrize("spread", [0.1, 0.4, 1.1])
def test_it_is_the_diffusion_on_a_grid(load, spread):
    """H = 1, 300 cells, walls at 0: f' = ½ f'' by the modes of its matrix; walls take ½ |f'| each."""
    count = 300
    step = 1 / count
    p = np.arange(1, count) * step
    rates, shapes = eigh_tridiagonal(-2 * np.ones(count - 1) / step**2, np.ones(count - 2) / step**2)
    start = np.zeros(count - 1)
    start[round(load / step) - 1] = 1 / step
    decayed = np.exp(rates * spread**2 / 2)
    density = shapes @ (decayed * (shapes.T @ start))
    found = PressureDiffusion(load=load, spread=spread, hardness=1.0)
    np.testing.assert_allclose(found.density(p), density, rtol=0, atol=5e-3 * density.max())
    assert found.elastic == pytest.approx(density.sum() * step, abs=1e-4)
    taken = shapes @ ((decayed - 1) / rates * (shapes.T @ start))  # ½ ∫ f dV
    assert found.plastic == pytest.approx(taken[-1] / step, abs=1e-4)


@pytest.mark.parametrize("hardness", [1.001, 1.5, 5.0, 50.0])
@pytest.mark.parametrize("spread", [0.01, 0.3, 1.0, 4.9, 5.1, 49.0, 51.0, 300.0])
def test_load_and_area_are_kept(hardness, spread):
    found = PressureDiffusion(load=1.0, spread=spread, hardness=hardness)
    area, load = inner(found)
    assert area == pytest.approx(found.elastic, abs=1e-8)
    assert load + hardness * found.plastic == pytest.approx(1, rel=1e-8)
    assert 0 <= found.plastic <= 1 / hardness
    assert found.elastic + found.plastic <= 1 + 1e-12


def test_both_sums_agree_where_they_change_places():
    below, above = (PressureDiffusion(load=0.3, spread=spread, hardness=1.0) for spread in (1 - 1e-9, 1 + 1e-9))
    p = np.linspace(0.01, 0.99, 23)
    np.testing.assert_allclose(below.density(p), above.density(p), rtol=1e-6)
    assert below.elastic == pytest.approx(above.elastic, rel=1e-6)
    assert below.plastic == pytest.approx(above.plastic, rel=1e-6)


def test_without_a_hardness_two_gaussians_are_left():
    found = PressureDiffusion(load=2.0, spread=3.0)
    p = np.array([0.1, 1.0, 2.0, 9.0])
    one, other = (np.exp(-((p - sign * 2) ** 2) / 18) for sign in (1, -1))
    np.testing.assert_allclose(found.density(p), (one - other) / (3 * np.sqrt(2 * np.pi)), rtol=1e-12)
    assert found.elastic == pytest.approx(erf(2 / (3 * np.sqrt(2))), rel=1e-12)
    assert found.plastic == 0
    area, load = inner(found)
    assert area == pytest.approx(found.elastic, rel=1e-8)
    assert load == pytest.approx(2, rel=1e-8)


def test_a_great_hardness_is_none():
    p = np.linspace(0.1, 9, 7)
    hard, elastic = PressureDiffusion(load=2.0, spread=3.0, hardness=1e3), PressureDiffusion(load=2.0, spread=3.0)
    np.testing.assert_allclose(hard.density(p), elastic.density(p), rtol=1e-12)
    assert hard.elastic == pytest.approx(elastic.elastic, rel=1e-12)


def test_the_least_load_keeps_its_digits():
    """erf x = 2x/sqrt(π) for small x, and a soft solid as much less."""
    tiny = PressureDiffusion(load=1e-12, spread=1.0)
    assert tiny.elastic == pytest.approx(1e-12 * np.sqrt(2 / np.pi), rel=1e-12)
    soft = PressureDiffusion(load=1e-12, spread=1.0, hardness=20.0)
    assert soft.elastic == pytest.approx(tiny.elastic, rel=1e-12)


def test_at_the_hardness_all_is_plastic():
    for spread in (0.1, 3.0):
        found = PressureDiffusion(load=1.0, spread=spread, hardness=1.0)
        assert found.plastic == pytest.approx(1, rel=1e-12)
        assert found.elastic == pytest.approx(0, abs=1e-12)
