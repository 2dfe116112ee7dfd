"""Random bearings with a shaft in lobes, or a tilted pad, at a given place; pads of a bore may still tilt."""

from numpy.random import Generator

from scripts.studies.coverage.random_entries import Entries
from scripts.studies.coverage.scenes.free_bearing import bearing


def draw(rng: Generator) -> Entries:
    """Return a bearing as ``free_bearing`` draws it, with the place of its wall in place of a load.

    Raises
    ------
    InputError
        If the pressures are too high for the laws of the lubricant.
    """
    return bearing(rng, loaded=False)
