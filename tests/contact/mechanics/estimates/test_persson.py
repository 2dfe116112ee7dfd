"""Persson's contact: its limits, its work, and contacts that were solved."""

import numpy as np
import pytest
from scipy.special import erf

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.persson import ENERGY_REDUCTION, elastic_mean_gap, persson
from roughfilm.contact.mechanics.exact.light_load import PERSSON
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine

MODULUS, SLOPE = 1e11, 0.1
STIFFNESS = MODULUS * SLOPE


@pytest.fixture(scope="module")
def surfaces():
    return [
        self_affine(
            size=(1e-3, 1e-3), points=(128, 128), seed=seed, hurst=0.8, roll_off=2e-4, cut_off=6e-5, rms_slope=SLOPE
        )
        for seed in (6007, 6011)
    ]


@pytest.fixture(scope="module")
def spectrum(surfaces):
    return wave_power(surfaces[0].heights, surfaces[0].spacing)


def estimate(spectrum, ratio, **changes):
    return persson(spectrum, composite_modulus=MODULUS, load=ratio * STIFFNESS, **changes)


def test_area_has_the_slope_of_light_load_and_fills(spectrum):
    assert estimate(spectrum, 1e-6).area_fraction == pytest.approx(PERSSON * 1e-6, rel=1e-9)
    assert estimate(spectrum, 5.0).area_fraction == pytest.approx(1, abs=1e-12)
    assert estimate(spectrum, 5.0).mean_gap == pytest.approx(0, abs=1e-20)


def test_full_contact_has_the_pressures_of_the_solver(surfaces, spectrum):
    """A load at which the surface is flat: the density is that of a histogram of solved pressures."""
    pressure = np.concatenate(
        [Press(s.heights, s.spacing, MODULUS).at(2 * STIFFNESS, tolerance=1e-8).pressure.ravel() for s in surfaces]
    )
    edges = STIFFNESS * np.linspace(0.5, 3.5, 13)
    counted = np.histogram(pressure, edges)[0] / pressure.size / np.diff(edges)
    density = estimate(spectrum, 2.0).pressure_density((edges[1:] + edges[:-1]) / 2)
    assert pressure.std() == pytest.approx(STIFFNESS / 2, rel=1e-3)
    np.testing.assert_allclose(counted, density, rtol=0, atol=0.05 * density.max())


@pytest.mark.parametrize(("ratio", "area"), [(0.02, 0.71), (0.2, 0.83), (0.8, 0.98)])
def test_solved_contacts_have_more_area_as_it_says(surfaces, spectrum, ratio, area):
    solved = np.mean(
        [Press(s.heights, s.spacing, MODULUS).at(ratio * STIFFNESS, tolerance=1e-6).area_fraction for s in surfaces]
    )
    assert estimate(spectrum, ratio).area_fraction / solved == pytest.approx(area, rel=0.04)


@pytest.mark.parametrize("ratio", [0.02, 0.1, 0.2])
def test_solved_contacts_have_its_mean_gap_within_a_tenth(surfaces, spectrum, ratio):
    solved = np.mean(
        [Press(s.heights, s.spacing, MODULUS).at(ratio * STIFFNESS, tolerance=1e-6).mean_gap for s in surfaces]
    )
    assert estimate(spectrum, ratio).mean_gap == pytest.approx(solved, rel=0.1)


def test_a_soft_solid_is_all_plastic_and_a_hard_one_elastic(spectrum):
    soft = estimate(spectrum, 0.01, hardness=0.05 * STIFFNESS)
    assert soft.area_fraction == soft.plastic_fraction == pytest.approx(0.2)
    assert soft.mean_contact_pressure == pytest.approx(0.05 * STIFFNESS)
    assert soft.mean_gap is None
    hard = estimate(spectrum, 0.01, hardness=20 * STIFFNESS)
    assert hard.plastic_fraction < 1e-20
    assert hard.area_fraction == pytest.approx(estimate(spectrum, 0.01).area_fraction)


def test_a_solved_plastic_contact_has_more_elastic_area(surfaces, spectrum):
    """H = E* g'/2, P/H = 0.3: areas 0.36 and 0.30, plastic 0.22 and 0.30 of the nominal."""
    hardness = STIFFNESS / 2
    solved = Press(surfaces[0].heights, surfaces[0].spacing, MODULUS, hardness=hardness).at(
        0.3 * hardness, tolerance=1e-6
    )
    found = estimate(spectrum, 0.15, hardness=hardness)
    assert 1.0 < solved.area_fraction / found.area_fraction < 1.25
    assert 0.7 < solved.plastic_fraction / found.plastic_fraction < 1.0


def test_the_gap_closes_by_the_work_of_the_load(spectrum):
    """−P du = dU, with the energy summed wave by wave, between loads that differ little."""
    q, power = spectrum.wave_numbers, spectrum.power
    square = q**2 * power
    spread = MODULUS / 2 * np.sqrt(np.cumsum(square) - square / 2)

    def energy(load):
        share = erf(load / (np.sqrt(2) * spread))
        return np.sum(MODULUS * q / 4 * power * share * (ENERGY_REDUCTION + (1 - ENERGY_REDUCTION) * share**2))

    for ratio in (1e-3, 0.03, 0.3, 1.0):
        low, high = ratio * STIFFNESS * (1 - 1e-3), ratio * STIFFNESS * (1 + 1e-3)
        gaps = [elastic_mean_gap(spectrum, composite_modulus=MODULUS, load=load) for load in (low, high)]
        assert ratio * STIFFNESS * (gaps[0] - gaps[1]) == pytest.approx(energy(high) - energy(low), rel=1e-5)


def test_the_energy_left_in_full_contact_is_exact(surfaces, spectrum):
    """∫ P du over all gaps is ½ <p u> of the flattened surface."""
    loads = STIFFNESS * np.geomspace(1e-7, 4, 400)
    gaps = [elastic_mean_gap(spectrum, composite_modulus=MODULUS, load=load) for load in loads]
    flat = Press(surfaces[0].heights, surfaces[0].spacing, MODULUS).at(4 * STIFFNESS)
    work = -np.trapezoid(loads, gaps)
    assert work == pytest.approx(np.mean(flat.pressure * flat.elastic_displacement) / 2, rel=2e-3)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"load": 0.0}, "load"),
        ({"load": 3e9, "hardness": 2e9}, "beyond the hardness"),
        ({"hardness": np.nan}, "hardness"),
        ({"composite_modulus": -1.0}, "composite_modulus"),
    ],
)
def test_what_makes_no_sense_is_refused(spectrum, changes, words):
    with pytest.raises(InputError, match=words):
        persson(spectrum, **({"composite_modulus": MODULUS, "load": 1e7} | changes))
