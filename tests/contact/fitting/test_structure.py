"""Copies of random phase keep spectrum and heights; scratches, plateaus and grooves are found in known surfaces."""

import numpy as np
import pytest

from roughfilm.contact.fitting.structure import (
    flatness_of_tops,
    kurtosis_of_projections,
    strongest_line,
    surrogate,
)
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.gaussian import gaussian


def cell_of(heights) -> Surface:
    return Surface(heights=heights, spacing=(1e-6, 1e-6), periodic=True)


def random_cell(seed: int) -> Surface:
    return gaussian(
        size=(6.4e-5, 6.4e-5),
        points=(64, 64),
        seed=seed,
        rms_height=1e-6,
        correlation_length=8e-6,
        amplitudes="random",
    )


def grooves(shift: float) -> Surface:
    """Sharp grooves, 8 in the cell, along y."""
    x = np.arange(64) / 8 + shift
    return cell_of(1e-6 * np.tile(np.abs(np.sin(np.pi * x))[:, None] ** 0.5, (1, 64)))


def test_a_copy_has_the_heights_and_the_spectrum_of_its_cell():
    cell = random_cell(1)
    copy = surrogate(cell, 3)
    assert np.array_equal(np.sort(copy.heights, axis=None), np.sort(cell.heights, axis=None))
    own, other = (np.abs(np.fft.fft2(one.heights)) for one in (cell, copy))
    assert np.linalg.norm(own - other) < 0.02 * np.linalg.norm(own)
    assert abs(np.corrcoef(cell.heights.ravel(), copy.heights.ravel())[0, 1]) < 0.5


def test_a_scratch_has_a_large_kurtosis_across_it():
    cell = random_cell(2)
    x, y = np.meshgrid(np.arange(64), np.arange(64), indexing="ij")
    angle = np.radians(35)
    distance = (y - 31.5) * np.cos(angle) - (x - 31.5) * np.sin(angle)
    scratched = cell_of(cell.heights - 4e-6 * np.exp(-((distance / 1.5) ** 2)))
    plain, (kurtosis, direction) = kurtosis_of_projections(cell)[0], kurtosis_of_projections(scratched)
    assert kurtosis > 1.5 * plain
    assert direction == pytest.approx(35, abs=5)
    assert kurtosis_of_projections(surrogate(scratched, 0))[0] < 0.7 * kurtosis


def test_plateaus_are_flatter_than_their_valleys():
    cell = random_cell(3)
    z = cell.heights / cell.heights.std()
    assert abs(flatness_of_tops(cell)) < 0.25
    assert flatness_of_tops(cell_of(1e-6 * np.minimum(z, 0.2 + 0.1 * z))) > 0.5
    assert flatness_of_tops(cell_of(-1e-6 * np.minimum(z, 0.2 + 0.1 * z))) < -0.5


def test_grooves_are_steady_lines_whose_harmonics_are_locked():
    shifts = np.random.default_rng(5).uniform(size=24)
    line = strongest_line([grooves(shift) for shift in shifts])
    assert line.wavelength == pytest.approx(8e-6, rel=1e-6)
    assert line.angle == pytest.approx(90)
    assert line.share > 0.5
    assert line.steadiness < 0.25
    assert line.harmonic > 0.9


def test_random_waves_are_neither_steady_nor_locked():
    line = strongest_line([random_cell(seed) for seed in range(24)])
    assert line.share < 0.5
    assert line.steadiness > 0.6
    assert line.harmonic < 0.65
