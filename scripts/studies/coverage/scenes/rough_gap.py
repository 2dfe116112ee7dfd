"""Random rough gaps: ridges and surfaces from files, one or two rough walls, open or pressed together."""

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.advice.scenes import Entries, between, chance, length
from scripts.studies.coverage.scenes.dry_contact import pressed
from scripts.studies.coverage.surfaces import drawn_surface, in_file, rms_slope

POINTS = 48
"""Points along a side of a surface."""

RIDGE_POINTS = (96, 4)
"""Points along and across ridges."""

GAP = 10e-6
"""Mean gap, m."""


def draw(rng: Generator) -> Entries:
    """Return a gap of rms height 0.01 to 0.4 mean gaps and rms slope 0.005 to 1.5, Re = 0.001 to 200.

    A quarter has ridges of one to five waves across the flow or along it, a fifth is pressed together under
    P/(E* g') = 0.003 to 0.1, and a quarter of the others has two rough walls.
    """
    drive: Entries = {
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3"},
        "flow": {"reynolds_number": 1e-3 if chance(rng, 0.3) else between(rng, 0.1, 200)},
    }
    if chance(rng, 0.2):
        return {**pressed(rng, POINTS, (3e-3, 0.1)), **drive}
    heights = ridges(rng) if chance(rng, 0.25) else drawn_surface(rng, POINTS, rng.uniform(6, 16))
    height, slope = GAP * between(rng, 0.01, 0.4), between(rng, 5e-3, 1.5)
    side = height * _slope(heights) / slope
    spacing = (side / heights.shape[0], side / max(heights.shape))
    geometry = {**in_file(height * heights, spacing), "mean_gap": length(GAP)}
    if heights.shape[0] == heights.shape[1] and chance(rng, 0.25):
        other = drawn_surface(rng, POINTS, rng.uniform(6, 16))
        geometry["upper"] = in_file(height * between(rng, 0.2, 1.0) * other, spacing)
    return {"geometry": geometry, **drive}


def ridges(rng: Generator) -> Array:
    """Return ridges of unit rms along x or y: one to five waves with random amplitudes and phases."""
    points, across = RIDGE_POINTS
    x = 2 * np.pi * np.arange(points) / points
    waves = [
        rng.uniform(0.2, 1) / k * np.cos(k * x + rng.uniform(0, 2 * np.pi)) for k in range(1, int(rng.integers(2, 7)))
    ]
    profile = np.sum(waves, axis=0)
    profile = (profile - profile.mean()) / profile.std()
    heights = np.repeat(profile[:, None], across, axis=1)
    return heights if chance(rng, 0.7) else np.ascontiguousarray(heights.T)


def _slope(heights: Array) -> float:
    """Return the rms slope of heights whose longer side is 1."""
    if heights.shape[0] == heights.shape[1]:
        return rms_slope(heights)
    profile = heights[:, 0] if heights.shape[0] > heights.shape[1] else heights[0]
    number = 2 * np.pi * np.fft.fftfreq(profile.size) * profile.size
    return float(np.sqrt((number**2 * np.abs(np.fft.fft(profile) / profile.size) ** 2).sum()))
