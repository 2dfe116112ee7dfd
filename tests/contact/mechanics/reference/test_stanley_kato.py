"""The thesis's algorithm: the contact that another solver finds, closed forms, and where it gives up."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.reference.stanley_kato import stanley_kato

MODULUS = 230e9


def waves(shape, seed=83):
    """Cosines of random phase with at most 12 waves a side, and the distance of the nodes."""
    random = np.random.default_rng(seed)
    x, y = (np.arange(n) / n for n in shape)
    heights = np.zeros(shape)
    for _ in range(40):
        i, j = random.integers(-12, 13), random.integers(-12, 13) if shape[1] > 1 else 0
        q = max(math.hypot(i, j), 1.0)
        heights += q**-1.6 * np.cos(2 * np.pi * (i * x[:, None] + j * y[None, :] + random.uniform()))
    return 3e-7 * heights / heights.std(), (1e-4 / max(shape), 1e-4 / max(shape))


@pytest.mark.parametrize("shape", [(128, 1), (1, 128), (48, 48)])
@pytest.mark.parametrize("hardness", [math.inf, 1.2e9])
def test_it_finds_the_contact_that_press_finds(shape, hardness):
    heights, spacing = waves(shape)
    load = 0.4e9
    wanted = Press(heights, spacing, MODULUS, hardness=hardness).at(load, tolerance=1e-10)
    found = stanley_kato(heights, spacing, MODULUS, load, hardness=hardness, tolerance=1e-8)
    assert found.complementarity <= 1.1e-8
    assert found.pressure.mean() == pytest.approx(load, rel=1e-12)
    assert found.pressure.max() <= hardness
    assert np.abs(found.pressure - wanted.pressure).max() < 1e-4 * load
    assert np.array_equal(found.plastic, wanted.plastic)
    assert found.plastic.any() == math.isfinite(hardness)
    assert found.approach == pytest.approx(wanted.approach, rel=1e-6)
    assert np.abs(found.unloaded_heights - wanted.unloaded_heights).max() < 1e-7 * heights.std()
    assert found.iterations > 5 * wanted.iterations


def test_half_contact_of_a_wave_has_the_load_of_westergaard():
    """W/p* = sin²(πa/λ) with p* = π E* Δ/λ; the peak is 2W / sin(πa/λ) (Johnson, Contact Mechanics, 13.2)."""
    n, length, amplitude = 256, 1e-3, 1e-6
    heights = amplitude * np.cos(2 * np.pi * np.arange(n) / n)[:, None]
    load = 0.5 * np.pi * MODULUS * amplitude / length
    found = stanley_kato(heights, (length / n, length / n), MODULUS, load, tolerance=1e-7)
    assert found.area_fraction == pytest.approx(0.5, abs=1.1 / n)
    assert found.pressure.max() == pytest.approx(2 * load * math.sqrt(2), rel=1e-2)


def test_a_flat_punch_bears_a_uniform_pressure_at_once():
    found = stanley_kato(np.zeros((16, 8)), (1e-6, 1e-6), MODULUS, 1e8)
    assert found.iterations == 0
    assert found.pressure == pytest.approx(1e8)


def test_it_cannot_place_a_plane_without_elastic_nodes():
    heights = np.array([0.0, 8e-6, 0.0, 0.0, 5e-6, 0.0, 0.0, 0.0])[:, None]
    hardness = 1e6
    with pytest.raises(ConvergenceError, match="no elastic node"):
        stanley_kato(heights, (1e-5, 1e-5), MODULUS, hardness * 2 / 8, hardness=hardness)
    assert Press(heights, (1e-5, 1e-5), MODULUS, hardness=hardness).at(hardness * 2 / 8).plasticity_index == 1
    everywhere = stanley_kato(heights, (1e-5, 1e-5), MODULUS, hardness, hardness=hardness)
    assert (everywhere.pressure == hardness).all()


def test_it_says_when_its_iterations_are_used_up():
    heights, spacing = waves((128, 1))
    with pytest.raises(ConvergenceError, match="unfinished after 3") as caught:
        stanley_kato(heights, spacing, MODULUS, 1e8, most_iterations=3)
    assert caught.value.iterations == 3


@pytest.mark.parametrize(("load", "tolerance"), [(2e9, 1e-6), (0.0, 1e-6), (math.nan, 1e-6), (1e8, 0.0)])
def test_loads_and_tolerances_out_of_range(load, tolerance):
    heights, spacing = waves((32, 1))
    with pytest.raises(InputError):
        stanley_kato(heights, spacing, MODULUS, load, hardness=1e9, tolerance=tolerance)
