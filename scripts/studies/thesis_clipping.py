"""Preparation of measured surfaces with the clipping of the thesis, which the recipe of roughfilm leaves out."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.preparation.filling import fill_invalid
from roughfilm.contact.preparation.prepare import Prepared, cell_of, level
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.surface import Surface

BINS, POINTS = 1000, 10
"""Bins of the histogram of heights, and points that the outermost bins must hold (thesis, E.3.1)."""


def clipped(surface: Surface) -> Surface:
    """Clip heights to the outermost of a thousand bins of their histogram that hold ten points.

    The upper edge of the highest such bin and the lower edge of the lowest one are the limits. Of 256 x 256 points of a
    Gaussian surface 0.8 % are clipped, of 48 x 48 points 46 %: it serves published results alone.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1.
    """
    counts, edges = np.histogram(surface.heights[surface.valid], bins=BINS)
    full = np.flatnonzero(counts >= POINTS)
    heights = np.clip(surface.heights, edges[full[0]], edges[full[-1] + 1])
    return surface.with_heights(np.where(surface.invalid, 0.0, heights))


def prepare_as_in_the_thesis(surface: Surface, recipe: Recipe) -> Prepared:
    """Prepare a surface by a recipe without filters, with the clipping of the thesis after the removal of spikes."""
    levelled = level(surface, recipe)
    trusted = clipped(levelled.trusted)
    return cell_of(replace(levelled, trusted=trusted, filled=fill_invalid(trusted)[0]), recipe)
