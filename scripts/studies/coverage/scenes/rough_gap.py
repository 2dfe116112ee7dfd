"""Random rough gaps: between ridges on one wall or on both, and between surfaces, also pressed."""

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance, length
from scripts.studies.coverage.scenes.dry_contact import pressed
from scripts.studies.coverage.surfaces import drawn_surface, in_file, rms_slope, stored

MEAN_GAP = 10e-6
"""Mean gap, m; only ratios of lengths matter."""

POINTS = 128
"""Number of points along a period."""

HIGHEST_WAVE = 12
"""Number of the shortest wave of a period."""

SIDE_POINTS = 48
"""Number of points along a side of a surface."""


def draw(rng: Generator) -> Entries:
    """Return a gap between ridges, or one of 3 times in 10 between surfaces."""
    ridged = between_ridges(rng)
    return between_surfaces(rng) if chance(rng, 0.3) else ridged


def between_surfaces(rng: Generator) -> Entries:
    """Return a gap of rms height 0.01 to 0.4 mean gaps and rms slope 0.005 to 1.5, Re = 0.001 to 200.

    Two of five are pressed together under P/(E* g') = 0.003 to 0.1, and a third of the others has two rough walls.
    """
    drive = driven(rng)
    if chance(rng, 0.4):
        return {**pressed(rng, SIDE_POINTS, (3e-3, 0.1)), **drive}
    heights = drawn_surface(rng, SIDE_POINTS, rng.uniform(6, 16))
    height, slope = MEAN_GAP * between(rng, 0.01, 0.4), between(rng, 5e-3, 1.5)
    step = height * rms_slope(heights) / slope / SIDE_POINTS
    geometry = {**in_file(height * heights, (step, step)), "mean_gap": length(MEAN_GAP)}
    if chance(rng, 0.33):
        other = drawn_surface(rng, SIDE_POINTS, rng.uniform(6, 16))
        geometry["upper"] = in_file(height * between(rng, 0.2, 1.0) * other, (step, step))
    return {"geometry": geometry, **drive}


def driven(rng: Generator) -> Entries:
    """Return an oil and its flow, creeping in every second gap."""
    return {
        "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
        "flow": {"reynolds_number": 1e-3 if chance(rng, 0.5) else between(rng, 0.1, 200)},
    }


def between_ridges(rng: Generator) -> Entries:
    """Return a gap with ridges across x, 1.5 to 60 mean gaps long, at least 0.12 mean gaps apart."""
    period = MEAN_GAP * between(rng, 1.5, 60)
    lower, upper = _profile(rng), _profile(rng) * rng.uniform(0.2, 1) * (0.0 if chance(rng, 0.6) else 1.0)
    amplitude = rng.uniform(0.03, 0.88) * MEAN_GAP / float(-(upper - lower).min())
    geometry = {**_wall(lower * amplitude, period), "mean_gap": length(MEAN_GAP)}
    if np.ptp(upper) > 0:
        geometry["upper"] = _wall(upper * amplitude, period)
    return {
        "geometry": geometry,
        **driven(rng),
    }


def _profile(rng: Generator) -> Array:
    """Return heights of one period with mean 0, of waves up to ``HIGHEST_WAVE`` alone, shape (POINTS,)."""
    x = 2 * np.pi * np.arange(POINTS) / POINTS
    shape = rng.integers(4)
    if shape == 0:
        heights = np.cos(x)
    elif shape == 1:
        orders = np.arange(1, int(rng.integers(2, 7)))
        sizes = rng.normal(size=orders.size) * orders ** -rng.uniform(0, 1.5)
        heights = sizes @ np.cos(orders[:, None] * x + rng.uniform(0, 7, (orders.size, 1)))
    elif shape == 2:
        heights = rng.choice([-1, 1]) * np.exp(rng.uniform(1, 4) * (np.cos(x) - 1))
    else:
        heights = np.tanh(rng.uniform(1, 2.5) * np.cos(x))
    waves = np.fft.rfft(heights)
    waves[[0, *range(HIGHEST_WAVE + 1, waves.size)]] = 0
    kept = np.fft.irfft(waves, POINTS)
    return np.asarray(kept / np.abs(kept).max())


def _wall(heights: Array, period: float) -> Entries:
    step = period / POINTS
    return {
        "surface": str(stored(np.repeat(heights[:, None], 2, axis=1))),
        "spacing": [with_unit(step, "m"), with_unit(4 * step, "m")],
    }
