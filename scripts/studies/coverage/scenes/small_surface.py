"""Random dry contacts of small measured maps with holes and tilt, prepared by the default steps of the program."""

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.surface import Surface
from scripts.studies.coverage.random_entries import Entries, between, chance
from scripts.studies.coverage.scenes.dry_contact import MODULUS, POISSON
from scripts.studies.coverage.surfaces import drawn_surface, in_file, rms_slope, stored

POINTS = (16, 64)
"""Least and largest number of points along a side of a map."""

MAX_HOLES = 0.6
"""Largest fraction of invalid points."""

SPACING = 1e-6
"""Distance of the points, m."""


def draw(rng: Generator) -> Entries:
    """Return a map of 16 to 64 points a side, prepared, under P/(E* g') = 3·10⁻⁴ to 1.

    A third of the maps are one period of a random surface, the others a part of one, whose edges do not match. A
    quarter have bumps or dimples of 3 to 7 points on a lattice, as a texture. A map is sampled and tilted, and in three
    of four maps up to 60 % of the points are invalid, in spots, in single points, or in both.
    """
    shape = (round(between(rng, *POINTS)), round(between(rng, *POINTS)))
    whole = chance(rng, 1 / 3)
    if whole:
        shape = (2 * (shape[0] // 2),) * 2
    period = max(shape) if whole else 2 * round(max(shape) * rng.uniform(0.6, 1.0))
    heights = drawn_surface(rng, period, rng.uniform(4, min(10, period / 4)))
    if chance(rng, 0.25):
        heights = heights + _texture(rng, period)
    slope = between(rng, 3e-3, 0.3)
    heights *= slope * period * SPACING / rms_slope(heights)
    origin = {"complete": str(stored(heights)), "points": list(shape), "whole": whole}
    x, y = (np.arange(count) * SPACING for count in shape)
    rms = heights.std()
    tilt = rng.uniform(-10, 10, 2) * rms / (SPACING * np.array(shape))
    measured = Surface(
        heights=heights[: shape[0], : shape[1]] + tilt[0] * x[:, None] + tilt[1] * y,
        spacing=(SPACING, SPACING),
        invalid=_holes(rng, shape) if chance(rng, 0.75) else np.zeros(shape, dtype=bool),
        source=origin,
    )
    cell = prepare(measured, Recipe()).surface
    unit = MODULUS / (1 - POISSON**2) * slope
    return {
        "kind": "dry_contact",
        "geometry": in_file(cell.heights, cell.spacing, cell.source),
        "solid": {"modulus": with_unit(MODULUS, "Pa"), "poisson": POISSON},
        "load": {"pressure": with_unit(unit * between(rng, 3e-4, 1.0), "Pa")},
    }


def _texture(rng: Generator, period: int) -> Array:
    """Bumps or dimples of equal shape on a square lattice, in rms heights of the surface that bears them."""
    count = max(round(period / rng.uniform(8, 16)), 1)
    x = (np.arange(period) * count / period) % 1 - 0.5
    width = rng.uniform(1.2, 2.5) * count / period
    bump = np.exp(-((x / width) ** 2) / 2)
    return np.asarray(rng.choice([-1, 1]) * between(rng, 3, 15) * np.outer(bump, bump))


def _holes(rng: Generator, shape: tuple[int, int]) -> Mask:
    """A mask of invalid points, in spots and in single points, up to ``MAX_HOLES`` of the points."""
    fraction, in_spots = rng.uniform(0, MAX_HOLES), rng.choice([0.0, 0.5, 1.0])
    holes = rng.random(shape) < fraction * (1 - in_spots)
    x, y = np.ogrid[: shape[0], : shape[1]]
    while holes.mean() < fraction:
        i, j, radius = rng.uniform(0, shape[0]), rng.uniform(0, shape[1]), between(rng, 1, min(shape) / 5)
        holes |= (x - i) ** 2 + (y - j) ** 2 < radius**2
    return np.asarray(holes)
